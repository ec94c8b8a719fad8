// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What follows from a list of keys without touching a file: checks and their sentences, rows, explanation, resolved
// text.
#include "lucy/files/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lucy/errors.hpp"

namespace lucy::files {
namespace {

constexpr std::size_t text_width = 100;
constexpr std::size_t most_rows = 10000;

/// A bound as a person would write it: 4, 0.2, 10000.
std::string bound_text(double bound) { return fmt::format("{}", bound); }

/// Edits (insert, delete, replace, swap of neighbours) between two words.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> edits(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) edits[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) edits[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = edits[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      edits[i][j] = std::min({edits[i - 1][j] + 1, edits[i][j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  return edits[a.size()][b.size()];
}

/// Lines of at most text_width characters, each after `indent` spaces.
std::string wrapped(std::string_view text, std::size_t indent) {
  std::string result;
  std::string line;
  const auto end_line = [&] {
    if (!line.empty()) result += std::string(indent, ' ') + line + "\n";
    line.clear();
  };
  while (!text.empty()) {
    const std::size_t space = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, space);
    text.remove_prefix(std::min(space + 1, text.size()));
    if (word.empty()) continue;
    if (!line.empty() && indent + line.size() + 1 + word.size() > text_width) end_line();
    if (!line.empty()) line += ' ';
    line += word;
  }
  end_line();
  return result;
}

std::string lists_text(const Key& key) {
  switch (key.lists) {
    case Lists::none:
      return "";
    case Lists::multiply:
      return fmt::format(", or a list of such {} (lists multiply)", key.type == Type::choice ? "words" : "numbers");
    case Lists::one_per_entry:
      return fmt::format(", or a list with one such number per entry of {}", key.entries_of);
  }
  return "";
}

std::string key_explanation(const Key& key) {
  std::string value = "none, must be given";
  if (!key.required && key.default_value) {
    value = toml_text(*key.default_value);
    if (!key.default_text.empty()) value += " (" + key.default_text + ")";
  } else if (!key.required) {
    value = key.default_text.empty() ? "unset" : key.default_text;
  }
  return fmt::format("  {}\n", key.name) + wrapped(key.meaning, 6) +
         wrapped(fmt::format("Unit: {}. Default: {}.", key.unit.empty() ? "none" : key.unit, value), 6) +
         wrapped(fmt::format("Accepted: {}{}.", accepted_text(key), lists_text(key)), 6);
}

std::string section_explanation(const Schema& schema, const Section& section) {
  const std::string header = section.name.empty() ? "(before the first section)" : "[" + section.name + "]";
  std::string text = wrapped(header + "  " + section.meaning, 0) + "\n";
  for (const Key& key : schema.keys)
    if (key.section == section.name) text += key_explanation(key) + "\n";
  return text;
}

std::string rows_explanation(const Schema& schema) {
  return wrapped("[[" + schema.rows + "]]", 0) + wrapped(schema.rows_meaning, 2);
}

std::string without_last_newline(std::string text) {
  while (text.size() > 1 && text[text.size() - 1] == '\n' && text[text.size() - 2] == '\n') text.pop_back();
  return text;
}

/// The shared value of a key, as that of one row of a product: entry `index` of its list.
ResolvedRow::Cell cell_of(const Entry& entry, std::size_t index) {
  return {entry.values[entry.is_list ? index : 0], entry.origin};
}

bool on_one_line(std::string_view text) {
  return std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

[[noreturn]] void refuse_value(const Key& key, const Value& value, const Origin& origin) {
  std::string found = toml_text(value);
  if (found.size() > text_width) found = fmt::format("text of {} bytes", found.size());
  std::string accepted = accepted_text(key);
  constexpr std::string_view number = "a number ";  // "inf must be a number above 0" would say nothing
  const double* const real = std::get_if<double>(&value);
  if (real != nullptr && std::isinf(*real) && accepted.starts_with(number))
    accepted.replace(0, number.size(), "a finite number ");
  throw BadInput(fmt::format("{}: {} = {} must be {}", origin.where, key.path(), found, accepted));
}

void refuse_missing(const ResolvedRow& row, const Document& document, const Schema& schema) {
  for (const Key& key : schema.keys) {
    if (!key.required || row.cells.contains(key.path())) continue;
    const std::string dropped = document.rows_dropped_by.empty() ? ""
                                                                 : fmt::format(" ({} dropped the [[{}]] tables)",
                                                                               document.rows_dropped_by, schema.rows);
    const std::string section = key.section.empty() ? "before the first section" : "under [" + key.section + "]";
    throw BadInput(fmt::format("{}: {} is missing and has no default; give it {} or with --set {}=VALUE{}",
                               row.origin.where, key.path(), section, key.path(), dropped));
  }
}

ResolvedRow row_of_defaults(const Schema& schema, const Origin& origin) {
  ResolvedRow row;
  row.origin = origin;
  for (const Key& key : schema.keys)
    if (key.default_value) row.cells[key.path()] = {*key.default_value, {}};
  return row;
}

std::vector<ResolvedRow> rows_of_tables(const Document& document, const Schema& schema) {
  std::vector<ResolvedRow> rows;
  for (const Document::Row& table : document.rows) {
    ResolvedRow row = row_of_defaults(schema, table.origin);
    for (const auto& [path, entry] : document.shared) {
      if (table.entries.contains(path)) continue;
      if (entry.is_list)
        throw BadInput(
            fmt::format("{}: {} is a list, and the table [[{}]] at {} has no {} of its own; a table is one row "
                        "and takes one number",
                        entry.origin.where, path, schema.rows, table.origin.where, schema.find(path)->name));
      row.cells[path] = cell_of(entry, 0);
    }
    for (const auto& [path, entry] : table.entries) row.cells[path] = cell_of(entry, 0);
    refuse_missing(row, document, schema);
    rows.push_back(std::move(row));
  }
  return rows;
}

void refuse_lengths(const Document& document, const Schema& schema) {
  for (const Key& key : schema.keys) {
    const auto entry = document.shared.find(key.path());
    if (key.lists != Lists::one_per_entry || entry == document.shared.end() || !entry->second.is_list) continue;
    const auto other = document.shared.find(key.entries_of);
    const std::size_t expected = other == document.shared.end() ? 0 : other->second.values.size();
    if (expected != 0 && entry->second.values.size() != expected)
      throw BadInput(fmt::format("{}: {} is a list of {}, but {} has {} {}; give one number, or one per entry",
                                 entry->second.origin.where, key.path(), entry->second.values.size(), key.entries_of,
                                 expected, expected == 1 ? "value" : "values"));
  }
}

std::vector<ResolvedRow> rows_of_product(const Document& document, const Schema& schema) {
  std::size_t count = 1;
  for (const Key& key : schema.keys) {
    const auto entry = document.shared.find(key.path());
    if (key.lists != Lists::multiply || entry == document.shared.end()) continue;
    count *= entry->second.values.size();
    if (count > most_rows)
      throw BadInput(fmt::format("{}: the lists multiply to {} or more rows, at most {} are accepted",
                                 entry->second.origin.where, count, most_rows));
  }
  {
    ResolvedRow row = row_of_defaults(schema, {document.file});
    for (const auto& [path, entry] : document.shared) row.cells[path] = cell_of(entry, 0);
    refuse_missing(row, document, schema);
  }
  refuse_lengths(document, schema);

  std::vector<ResolvedRow> rows;
  for (std::size_t index = 0; index < count; ++index) {
    // The digits of `index`, the last multiplying key counting fastest, are the places in the lists.
    std::map<std::string, std::size_t, std::less<>> place;
    std::size_t rest = index;
    std::size_t rows_per_entry = count;
    for (const Key& key : schema.keys) {
      const auto entry = document.shared.find(key.path());
      if (key.lists != Lists::multiply || entry == document.shared.end()) continue;
      rows_per_entry /= entry->second.values.size();
      place[key.path()] = rest / rows_per_entry;
      rest %= rows_per_entry;
    }
    ResolvedRow row = row_of_defaults(schema, {document.file});
    for (const auto& [path, entry] : document.shared) {
      const Key& key = *schema.find(path);
      const auto found = place.find(key.lists == Lists::one_per_entry ? key.entries_of : path);
      row.cells[path] = cell_of(entry, found == place.end() ? 0 : found->second);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

bool Range::holds(double value) const {
  return std::isfinite(value) && (lower_included ? value >= lower : value > lower) &&
         (upper_included ? value <= upper : value < upper);
}

const Key* Schema::find(std::string_view path) const {
  const auto key =
      std::find_if(keys.begin(), keys.end(), [&](const Key& candidate) { return candidate.path() == path; });
  return key == keys.end() ? nullptr : &*key;
}

std::string accepted_text(const Key& key) {
  switch (key.type) {
    case Type::text:
      return "text in quotes, on one line";
    case Type::texts:
      return "a list of texts, each in quotes and on one line";
    case Type::boolean:
      return "true or false";
    case Type::choice: {
      if (key.choices.size() == 1) return fmt::format("\"{}\", the only one accepted so far", key.choices.front());
      return fmt::format("one of \"{}\"", fmt::join(key.choices, "\", \""));
    }
    case Type::integer:
    case Type::real:
      break;
  }
  const Range& range = key.range;
  const std::string what = key.type == Type::integer ? "an integer" : "a number";
  const bool from = std::isfinite(range.lower);
  const bool to = std::isfinite(range.upper);
  if (from && range.lower == range.upper)
    return fmt::format("{}, the only one accepted so far", bound_text(range.lower));
  if (from && to && range.lower_included && range.upper_included)
    return fmt::format("{} from {} to {}", what, bound_text(range.lower), bound_text(range.upper));
  const std::string lower =
      fmt::format("{} {}", range.lower_included ? "of at least" : "above", bound_text(range.lower));
  const std::string upper = fmt::format("{} {}", range.upper_included ? "at most" : "below", bound_text(range.upper));
  if (from && to) return fmt::format("{} {} and {}", what, lower, upper);
  if (from) return fmt::format("{} {}", what, lower);
  if (to) return fmt::format("{} {}", what, upper);
  return key.type == Type::integer ? "an integer" : "a finite number";
}

Value checked_value(const Key& key, const Value& value, const Origin& origin) {
  switch (key.type) {
    case Type::boolean:
      if (!std::holds_alternative<bool>(value)) refuse_value(key, value, origin);
      return value;
    case Type::integer:
      if (!std::holds_alternative<std::int64_t>(value)) refuse_value(key, value, origin);
      if (!key.range.holds(static_cast<double>(std::get<std::int64_t>(value)))) refuse_value(key, value, origin);
      return value;
    case Type::real: {
      double number = 0.0;
      if (const auto* integer = std::get_if<std::int64_t>(&value)) {
        number = static_cast<double>(*integer);
      } else if (const auto* real = std::get_if<double>(&value)) {
        number = *real + 0.0;  // minus zero becomes zero, so that equal rows have equal bits
      } else {
        refuse_value(key, value, origin);
      }
      if (!key.range.holds(number)) refuse_value(key, value, origin);
      return number;
    }
    case Type::choice:
    case Type::text: {
      const auto* text = std::get_if<std::string>(&value);
      if (text == nullptr) refuse_value(key, value, origin);
      if (!on_one_line(*text)) refuse_value(key, value, origin);
      if (key.type == Type::choice && std::find(key.choices.begin(), key.choices.end(), *text) == key.choices.end())
        refuse_value(key, value, origin);
      return value;
    }
    case Type::texts: {
      const auto* texts = std::get_if<Texts>(&value);
      if (texts == nullptr || !std::all_of(texts->begin(), texts->end(), on_one_line)) refuse_value(key, value, origin);
      return value;
    }
  }
  return value;
}

std::optional<std::string> nearest_name(std::string_view word, std::span<const std::string> names) {
  std::optional<std::string> nearest;
  std::size_t fewest = std::max<std::size_t>(2, word.size() / 3) + 1;
  if (word.size() < 4) fewest = 2;
  if (word.size() > text_width) return nearest;  // no slip of the finger
  for (const std::string& name : names) {
    // A part of a name counts as one edit: 'rate' is near to 'strain_rate'.
    const bool part = word.size() >= 4 && name.size() >= 4 &&
                      (name.find(word) != std::string::npos || word.find(name) != std::string_view::npos);
    const std::size_t edits = std::min(edit_distance(word, name), part ? std::size_t{1} : word.size() + name.size());
    if (edits < fewest) {
      fewest = edits;
      nearest = name;
    }
  }
  return nearest;
}

std::vector<ResolvedRow> expand_rows(const Document& document, const Schema& schema) {
  return document.rows.empty() ? rows_of_product(document, schema) : rows_of_tables(document, schema);
}

std::optional<Value> shared_value(const Document& document, const Schema& schema, std::string_view path) {
  const auto entry = document.shared.find(path);
  if (entry != document.shared.end()) return entry->second.values.front();
  const Key* key = schema.find(path);
  return key == nullptr ? std::nullopt : key->default_value;
}

std::string locate_refusal(std::string_view message, const ResolvedRow& row, const Document& document,
                           const Schema& schema) {
  std::size_t first = std::string_view::npos;
  const Key* named = nullptr;
  for (const Key& key : schema.keys) {
    const std::size_t at = message.find(key.path());
    // At the same place the longer name is meant: run.duration, not a key run.dur.
    const bool longer = at == first && named != nullptr && key.path().size() > named->path().size();
    if (at < first || (at != std::string_view::npos && longer)) {
      first = at;
      named = &key;
    }
  }
  std::string where = row.origin.where.empty() ? document.file : row.origin.where;
  if (named != nullptr) {
    const auto cell = row.cells.find(named->path());
    if (cell != row.cells.end() && !cell->second.origin.where.empty()) where = cell->second.origin.where;
  }
  return fmt::format("{}: {}", where, message);
}

std::string explain(const Schema& schema, std::string_view filter) {
  while (!filter.empty() && filter.front() == '[') filter.remove_prefix(1);
  while (!filter.empty() && filter.back() == ']') filter.remove_suffix(1);

  if (filter.empty()) {
    std::string text = wrapped(schema.introduction, 0) + "\n";
    for (const Section& section : schema.sections) text += section_explanation(schema, section);
    if (!schema.rows.empty()) text += rows_explanation(schema);
    return without_last_newline(text);
  }
  if (filter == schema.rows) return rows_explanation(schema);
  for (const Section& section : schema.sections)
    if (section.name == filter) return without_last_newline(section_explanation(schema, section));

  std::string text;
  for (const Key& key : schema.keys)
    if (key.path() == filter || key.name == filter)
      text += fmt::format("{}\n", key.section.empty() ? "" : "[" + key.section + "]") + key_explanation(key);
  if (!text.empty()) return text.front() == '\n' ? text.substr(1) : text;

  std::vector<std::string> names;
  for (const Section& section : schema.sections)
    if (!section.name.empty()) names.push_back(section.name);
  std::vector<std::string> section_names = names;
  if (!schema.rows.empty()) section_names.push_back(schema.rows);
  for (const Key& key : schema.keys) names.push_back(key.path());
  auto nearest = nearest_name(filter, names);
  if (!nearest) {
    std::vector<std::string> short_names;
    for (const Key& key : schema.keys) short_names.push_back(key.name);
    nearest = nearest_name(filter, short_names);
  }
  throw BadInput(fmt::format("no section or key '{}'; {}", filter,
                             nearest ? fmt::format("did you mean '{}'?", *nearest)
                                     : fmt::format("the sections are {}", fmt::join(section_names, ", "))));
}

std::string toml_text(const Value& value) {
  if (const auto* texts = std::get_if<Texts>(&value)) {
    std::string list;
    for (const std::string& text : *texts) list += (list.empty() ? "" : ", ") + toml_text(text);
    return "[" + list + "]";
  }
  if (const auto* truth = std::get_if<bool>(&value)) return *truth ? "true" : "false";
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *integer);
  if (const auto* real = std::get_if<double>(&value)) {
    // The shortest decimal that reads back with the same bits; TOML tells a real by its point or exponent.
    std::string text = fmt::format("{}", *real);
    if (!std::isfinite(*real)) return text;
    const std::size_t exponent = text.find('e');
    if (exponent == std::string::npos) return text.find('.') == std::string::npos ? text + ".0" : text;
    std::string power = text.substr(exponent + 1);
    const bool negative = power.front() == '-';
    power.erase(0, power.find_first_not_of("+-0"));
    return text.substr(0, exponent) + (negative ? "e-" : "e") + power;
  }
  std::string text = "\"";
  for (const char c : std::get<std::string>(value)) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      text += '\\';
      text += c;
    } else if (code < 0x20 || code == 0x7f) {
      text += fmt::format("\\u{:04X}", code);
    } else {
      text += c;
    }
  }
  return text + "\"";
}

std::string resolved_heading(std::string_view what) {
  return fmt::format("# The resolved input of {}, as Lucy ran it; it can be run again as it is.", what);
}

std::string resolved_text(const Schema& schema, const std::map<std::string, Value>& whole,
                          const std::vector<std::map<std::string, Value>>& rows) {
  const auto value_in = [](const std::map<std::string, Value>& values, const std::string& path) {
    const auto found = values.find(path);
    return found == values.end() ? std::optional<Value>() : std::optional<Value>(found->second);
  };
  // What all rows hold for a key; nothing where they differ or where it is unset.
  std::map<std::string, std::optional<Value>> common;
  for (const Key& key : schema.keys) {
    if (!key.in_rows || rows.empty()) continue;
    const std::string path = key.path();
    const auto first = value_in(rows.front(), path);
    const bool same =
        std::all_of(rows.begin(), rows.end(), [&](const auto& row) { return value_in(row, path) == first; });
    if (same) common[path] = first;
  }

  std::string text;
  for (const Section& section : schema.sections) {
    std::string lines;
    for (const Key& key : schema.keys) {
      if (key.section != section.name || !key.changes_results) continue;
      const auto value = key.in_rows ? common[key.path()] : value_in(whole, key.path());
      if (value) lines += fmt::format("{} = {}\n", key.name, toml_text(*value));
    }
    if (lines.empty()) continue;
    if (!text.empty()) text += "\n";
    if (!section.name.empty()) text += fmt::format("[{}]\n", section.name);
    text += lines;
  }
  if (rows.size() < 2) return text;
  for (const auto& row : rows) {
    text += fmt::format("\n[[{}]]\n", schema.rows);
    for (const Key& key : schema.keys) {
      if (!key.in_rows || common[key.path()]) continue;
      if (const auto value = value_in(row, key.path())) text += fmt::format("{} = {}\n", key.name, toml_text(*value));
    }
  }
  return text;
}

}  // namespace lucy::files
