// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an input file may hold, as data. A command lists its keys once (section, name, type, unit, default, range,
// meaning); that one list reads a TOML file strictly, refuses what is wrong in one sentence, explains itself, and
// writes the resolved input. Nothing here knows any physics or any command.
//
//   file + overrides --read_document--> Document --expand_rows--> one ResolvedRow per row --fill_row--> the case's
//   struct
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace lucy::files {

/// Texts that are one value together.
using Texts = std::vector<std::string>;

/// A single value of a key. A key of type real always holds a double, one of type text or choice a string.
using Value = std::variant<bool, std::int64_t, double, std::string, Texts>;

enum class Type { text, texts, choice, boolean, integer, real };

/// What a list means where one number could stand.
enum class Lists {
  none,           ///< lists are refused
  multiply,       ///< one row per entry, times the entries of the other lists
  one_per_entry,  ///< as many entries as the list of `Key::entries_of`, one for each
};

/// Accepted numbers. Nan and infinity are never accepted.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_included = true;
  bool upper_included = true;

  static Range above(double bound) { return {.lower = bound, .lower_included = false}; }
  static Range at_least(double bound) { return {.lower = bound}; }
  Range below(double bound) const { return {lower, bound, lower_included, false}; }
  Range at_most(double bound) const { return {lower, bound, lower_included, true}; }
  bool holds(double value) const;
};

/// One key of an input file.
struct Key {
  std::string section = {};  ///< empty: before the first section
  std::string name = {};
  Type type = Type::real;
  std::string unit = {};                    ///< in words, empty for a pure number
  std::string meaning = {};                 ///< one sentence
  Range range = {};                         ///< of an integer or a real
  std::vector<std::string> choices = {};    ///< of a choice
  bool required = false;                    ///< no default, and every row needs it
  std::optional<Value> default_value = {};  ///< absent in a key that is not required: may stay unset
  std::string default_text = {};            ///< said instead of the default value
  Lists lists = Lists::none;
  std::string entries_of = {};  ///< "section.key" of a multiplying key, for one_per_entry
  bool in_rows = true;          ///< may differ from row to row
  bool replaces_rows = false;   ///< --set of this key drops the tables of rows
  bool changes_results = true;  ///< false: left out of the resolved input

  std::string path() const { return section.empty() ? name : section + "." + name; }
};

struct Section {
  std::string name;
  std::string meaning;
};

struct Schema {
  std::string introduction;       ///< first paragraph of the explanation
  std::vector<Section> sections;  ///< in the order of explanation and of the resolved input
  std::vector<Key> keys;          ///< grouped by section; multiplying keys from the outermost to the innermost
  std::string rows = {};          ///< name of the array of tables that lists rows, such as "point"; empty: none
  std::string rows_meaning = {};
  std::vector<Section> lacking = {};  ///< sections of other commands' files; `meaning`: why these files have none
  /// The commands whose files have the key `name` in `section` (empty: in any section, any key), for refusals.
  std::function<std::vector<std::string>(std::string_view section, std::string_view name)> owners = {};

  /// The key of that path ("run.step"), or nullptr.
  const Key* find(std::string_view path) const;
};

/// Where a value was written: a line of a file, or a --set.
struct Origin {
  std::string where;  ///< "inputs/a.toml:7" or "--set run.step=0.3"
};

/// What was written for one key: one value, or a list.
struct Entry {
  std::vector<Value> values;
  bool is_list = false;
  Origin origin;
};
using Entries = std::map<std::string, Entry, std::less<>>;  ///< by Key::path()

/// A file as written, with its overrides applied; every value is of its key's type and within its range.
struct Document {
  struct Row {
    Entries entries;
    Origin origin;
  };
  std::string file;
  Entries shared;
  std::vector<Row> rows;
  std::string rows_dropped_by;  ///< the --set that dropped the tables of rows, if one did
};

/// One row with one value per key that was written somewhere or has a default.
struct ResolvedRow {
  struct Cell {
    Value value;
    Origin origin;  ///< empty for a default
  };
  std::map<std::string, Cell, std::less<>> cells;  ///< by Key::path()
  Origin origin;                                   ///< of its table, or of the file
};

/// Reads and checks a TOML file and applies `overrides` ("section.key=value", TOML values). An override replaces the
/// value everywhere, in the tables of rows as well; one of a key with `replaces_rows` drops these tables.
/// Throws BadInput naming line or override, what was found and what is accepted.
Document read_document(const std::filesystem::path& file, std::span<const std::string> overrides, const Schema& schema);

/// What a TOML file writes: the names of its sections, and the keys of its tables of rows.
struct Outline {
  std::set<std::string> sections;
  std::set<std::string> row_keys;
};

/// `rows`: the name of the tables of rows. Empty for what is no TOML file: read_document will tell why.
Outline outline_of(const std::filesystem::path& file, std::string_view rows);

/// The rows of a document: its tables of rows, each over the shared values, or else the product of its lists.
/// Throws BadInput when a required key is missing or the lengths of lists disagree.
std::vector<ResolvedRow> expand_rows(const Document& document, const Schema& schema);

/// The value of a key that is the same for the whole file (`in_rows` false): as written, or its default.
std::optional<Value> shared_value(const Document& document, const Schema& schema, std::string_view path);

/// The message of a refusal that came from a check behind the reader, with the place where the key that it names first
/// was written in front: the line of the value, or of the row's table, or else the file.
std::string locate_refusal(std::string_view message, const ResolvedRow& row, const Document& document,
                           const Schema& schema);

/// The keys in words, filtered by section or key (empty: all), wrapped to 100 columns. Throws BadInput.
std::string explain(const Schema& schema, std::string_view filter = {});

/// What is accepted for one value of a key, as in "must be ...": "a number above 0 and at most 0.2".
std::string accepted_text(const Key& key);

/// `value` as the type of the key (an integer becomes a real where a real is expected).
/// Throws BadInput ("run.step = -0.1 must be ...", with the origin in front) when type or range do not fit.
Value checked_value(const Key& key, const Value& value, const Origin& origin);

/// The name of `names` that is nearest to a mistyped `word`, or nothing when none is near.
std::optional<std::string> nearest_name(std::string_view word, std::span<const std::string> names);

/// A value as TOML that reads back with the same bits.
std::string toml_text(const Value& value);

/// The first line of a resolved input. `what` was run with it: "a sweep".
std::string resolved_heading(std::string_view what);

/// A file that read_document and expand_rows turn into these rows again: what all rows share in the sections, the rest
/// in one table per row. A value is absent where the key is unset. `whole`: the values of keys with in_rows false.
std::string resolved_text(const Schema& schema, const std::map<std::string, Value>& whole,
                          const std::vector<std::map<std::string, Value>>& rows);

// From values to the struct of a case and back -------------------------------------------------------------------

/// How one key is stored in the struct `Row` of a case.
template <class Row>
struct Binding {
  std::function<void(Row&, const Value&)> set;
  std::function<std::optional<Value>(const Row&)> get;  ///< nothing: unset
};

/// A key and where it is stored. The default of a key that is not required is what a new `Row` holds.
template <class Row>
struct BoundKey {
  Key key;
  Binding<Row> binding;

  BoundKey(Key what, Binding<Row> where) : key(std::move(what)), binding(std::move(where)) {
    if (!key.required && !key.default_value) key.default_value = binding.get(Row{});
  }
};

/// Stored in a member of type bool, std::string, Texts, any integer, or any real.
template <class Row, class Member>
Binding<Row> stored_in(Member Row::*member) {
  constexpr bool as_it_is =
      std::is_same_v<Member, bool> || std::is_same_v<Member, std::string> || std::is_same_v<Member, Texts>;
  using Held =
      std::conditional_t<as_it_is, Member, std::conditional_t<std::is_integral_v<Member>, std::int64_t, double>>;
  return {[member](Row& row, const Value& value) { row.*member = static_cast<Member>(std::get<Held>(value)); },
          [member](const Row& row) { return std::optional<Value>(static_cast<Held>(row.*member)); }};
}

/// Stored in an optional real; unset when empty.
template <class Row>
Binding<Row> stored_in(std::optional<double> Row::*member) {
  return {[member](Row& row, const Value& value) { row.*member = std::get<double>(value); },
          [member](const Row& row) {
            return (row.*member).has_value() ? std::optional<Value>(*(row.*member)) : std::nullopt;
          }};
}

/// Stored in a real that is above zero when set, and zero when unset.
template <class Row>
Binding<Row> stored_unless_zero_in(double Row::*member) {
  return {[member](Row& row, const Value& value) { row.*member = std::get<double>(value); },
          [member](const Row& row) { return row.*member > 0.0 ? std::optional<Value>(row.*member) : std::nullopt; }};
}

/// Stored in a text that is not empty when set.
template <class Row>
Binding<Row> stored_unless_empty_in(std::string Row::*member) {
  return {
      [member](Row& row, const Value& value) { row.*member = std::get<std::string>(value); },
      [member](const Row& row) { return (row.*member).empty() ? std::nullopt : std::optional<Value>(row.*member); }};
}

/// Stored in an enumeration whose names stand in a table of (name, value) pairs.
template <class Row, class Choice, std::size_t Count>
Binding<Row> stored_by_name_in(Choice Row::*member, std::array<std::pair<std::string_view, Choice>, Count> names) {
  return {[member, names](Row& row, const Value& value) {
            for (const auto& [name, choice] : names)
              if (name == std::get<std::string>(value)) row.*member = choice;
          },
          [member, names](const Row& row) {
            for (const auto& [name, choice] : names)
              if (choice == row.*member) return std::optional<Value>(std::string(name));
            return std::optional<Value>();
          }};
}

/// The names of such a table, for Key::choices.
template <class Choice, std::size_t Count>
std::vector<std::string> names_of(const std::array<std::pair<std::string_view, Choice>, Count>& table) {
  std::vector<std::string> names;
  for (const auto& entry : table) names.emplace_back(entry.first);
  return names;
}

/// A row of a case from the resolved values; members without a value keep what a new `Row` holds.
template <class Row>
Row fill_row(const ResolvedRow& resolved, const std::vector<BoundKey<Row>>& keys) {
  Row row;
  for (const auto& bound : keys) {
    const auto cell = resolved.cells.find(bound.key.path());
    if (cell != resolved.cells.end()) bound.binding.set(row, cell->second.value);
  }
  return row;
}

/// The values of a row, by path, for resolved_text.
template <class Row>
std::map<std::string, Value> values_of(const Row& row, const std::vector<BoundKey<Row>>& keys) {
  std::map<std::string, Value> values;
  for (const auto& bound : keys)
    if (const auto value = bound.binding.get(row)) values[bound.key.path()] = *value;
  return values;
}

}  // namespace lucy::files
