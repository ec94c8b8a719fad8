// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a TOML file and its overrides to checked values: the only place that knows the TOML library.
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "lucy/errors.hpp"
#include "lucy/files/schema.hpp"

namespace lucy::files {
namespace {

constexpr std::size_t most_bytes = 4u << 20;  // far beyond any input, far below a mistaken data file

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

/// Text from outside, fit for one line of a message.
std::string shown(std::string_view text, std::size_t longest = 80) {
  std::size_t end = std::min(text.size(), longest);
  const auto continues = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80; };
  while (end < text.size() && end > 0 && continues(end)) --end;  // cut between characters of UTF-8
  std::string line(text.substr(0, end));
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return end < text.size() ? line + "..." : line;
}

std::string at_line(const std::string& file, const toml::source_region& region) {
  return fmt::format("{}:{}", file, region.begin.line);
}

/// The number of the first line that is not UTF-8, 0 when all are.
std::size_t first_line_not_utf8(std::string_view text) {
  std::size_t line = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto lead = static_cast<unsigned char>(text[i]);
    if (lead == '\n') ++line;
    std::size_t following = 0;
    if (lead >= 0xc2 && lead <= 0xdf) {
      following = 1;
    } else if (lead >= 0xe0 && lead <= 0xef) {
      following = 2;
    } else if (lead >= 0xf0 && lead <= 0xf4) {
      following = 3;
    } else if (lead >= 0x80) {
      return line;
    }
    for (std::size_t k = 1; k <= following; ++k)
      if (i + k >= text.size() || (static_cast<unsigned char>(text[i + k]) & 0xc0) != 0x80) return line;
    i += following;
  }
  return 0;
}

std::string file_text(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw BadInput(fmt::format("{}: is a directory, where a TOML file is expected", name));
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw BadInput(fmt::format("{}: cannot be opened ({}), where a TOML file is expected", name,
                               errno == 0 ? "unknown cause" : std::strerror(errno)));
  std::string text(most_bytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) throw BadInput(fmt::format("{}: cannot be read, where a TOML file is expected", name));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.find('\0') != std::string::npos)
    throw BadInput(fmt::format("{}: is a binary file, where a TOML file is expected", name));
  if (const std::size_t line = first_line_not_utf8(text))
    throw BadInput(fmt::format("{}:{}: is not UTF-8 text, where a TOML file is expected", name, line));
  if (text.size() > most_bytes)
    throw BadInput(fmt::format("{}: is larger than {} MiB, too large for a TOML input file", name, most_bytes >> 20));
  return text;
}

std::string_view line_of(std::string_view text, std::size_t number) {
  for (; number > 1 && !text.empty(); --number) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.substr(0, text.find('\n'));
}

/// A word without quotes where a value is expected, the most frequent slip: the word, or nothing.
std::string_view bare_word(std::string_view value) {
  value = trimmed(value.substr(0, value.find('#')));
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto is_part = [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '/';
  };
  if (value.empty() || !is_letter(value.front()) || !std::all_of(value.begin(), value.end(), is_part)) return {};
  return value;
}

/// The sentence for a bare word, the value of `key` (nullptr: unknown); `quoted` is how it looks with quotes.
std::string bare_word_text(std::string_view word, std::string_view quoted, const Key* key) {
  std::string small(word);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (small == "true" || small == "false" || small == "inf" || small == "nan")
    return fmt::format("{} is not a TOML value; did you mean {}?", word, small);
  if (key != nullptr && key->type != Type::text && key->type != Type::choice)
    return fmt::format("{} = {} must be {}", key->path(), word, accepted_text(*key));
  return fmt::format("{} is not a TOML value; text needs quotes, as in {}", word, quoted);
}

/// What the TOML library found, as part of a sentence.
std::string syntax_text(const toml::parse_error& error) {
  std::string what(error.description());
  if (const std::size_t redefined = what.find("cannot redefine existing "); redefined != std::string::npos) {
    const std::size_t open = what.find('\'', redefined);
    if (open != std::string::npos) return fmt::format("{} is written twice", shown(what.substr(open)));
  }
  if (!what.empty() && what.front() >= 'A' && what.front() <= 'Z')
    what.front() = static_cast<char>(what.front() - 'A' + 'a');
  return "not valid TOML, " + shown(what, 200);
}

/// The key of that name in any section, or of that path, or nullptr.
const Key* key_named(const Schema& schema, std::string_view name) {
  for (const Key& key : schema.keys)
    if (key.name == name || key.path() == name) return &key;
  return nullptr;
}

toml::table parsed_file(const std::string& name, const std::string& text, const Schema& schema) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    const std::string where = at_line(name, error.source());
    const std::string_view line = line_of(text, error.source().begin.line);
    const std::size_t equals = line.find('=');
    if (equals != std::string_view::npos)
      if (const std::string_view word = bare_word(line.substr(equals + 1)); !word.empty()) {
        const std::string_view key = trimmed(line.substr(0, equals));
        throw BadInput(fmt::format(
            "{}: {}", where, bare_word_text(word, fmt::format("{} = \"{}\"", key, word), key_named(schema, key))));
      }
    throw BadInput(fmt::format("{}: {}", where, syntax_text(error)));
  }
}

/// A node that is no single value of a key, in words.
std::string kind_of(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array_of_tables()) return "an array of tables";
  if (node.is_array()) return "a list";
  if (node.is_date() || node.is_time() || node.is_date_time()) return "a date or time";
  if (node.is_string()) return "text";
  if (node.is_boolean()) return "true or false";
  return "a number";
}

std::optional<Value> single_value(const toml::node& node) {
  if (const auto* value = node.as_boolean()) return Value(value->get());
  if (const auto* value = node.as_integer()) return Value(value->get());
  if (const auto* value = node.as_floating_point()) return Value(value->get());
  if (const auto* value = node.as_string()) return Value(value->get());
  return std::nullopt;
}

std::string with_lists(const Key& key) {
  if (key.lists == Lists::none) return accepted_text(key);
  return fmt::format("{}, or a list of such {}", accepted_text(key), key.type == Type::choice ? "words" : "numbers");
}

Value checked_node(const Key& key, const toml::node& node, const Origin& origin, std::string_view is = "is") {
  const auto value = single_value(node);
  if (!value)
    throw BadInput(
        fmt::format("{}: {} must be {}, but {} {}", origin.where, key.path(), with_lists(key), is, kind_of(node)));
  return checked_value(key, *value, origin);
}

/// The list of texts that is the one value of a key of that type.
Value checked_texts(const Key& key, const toml::node& node, const Origin& origin) {
  const auto refuse = [&](std::string_view is, const toml::node& found) {
    throw BadInput(
        fmt::format("{}: {} must be {}, but {} {}", origin.where, key.path(), accepted_text(key), is, kind_of(found)));
  };
  const toml::array* list = node.as_array();
  if (list == nullptr) refuse("is", node);
  Texts texts;
  for (const toml::node& element : *list) {
    if (!element.is_string()) refuse("holds", element);
    texts.push_back(element.as_string()->get());
  }
  return checked_value(key, texts, origin);
}

/// The value of `key` as written in `node`; `in_row`: inside a table of rows, where lists are refused.
Entry entry_of(const Key& key, const toml::node& node, const Origin& origin, const std::string& row_name = {}) {
  if (key.type == Type::texts) return {{checked_texts(key, node, origin)}, false, origin};
  const toml::array* list = node.as_array();
  if (list == nullptr) return {{checked_node(key, node, origin)}, false, origin};
  if (!row_name.empty() && key.lists != Lists::none)
    throw BadInput(
        fmt::format("{}: {} is a list, but a [[{}]] table is one row and takes one number; write one table "
                    "per number",
                    origin.where, key.path(), row_name));
  if (key.lists == Lists::none)
    throw BadInput(fmt::format("{}: {} must be {}, but is a list", origin.where, key.path(), accepted_text(key)));
  if (list->empty())
    throw BadInput(fmt::format("{}: {} must be {}, but is an empty list", origin.where, key.path(), with_lists(key)));
  Entry entry{{}, true, origin};
  for (const toml::node& element : *list) entry.values.push_back(checked_node(key, element, origin, "holds"));
  return entry;
}

std::string listed(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

/// "SUBJECT belongs to an input of `lucy sweep` or `lucy isomorphism`", or nothing when it belongs to none.
std::string owners_text(const Schema& schema, std::string_view subject, std::string_view section,
                        std::string_view name) {
  if (!schema.owners) return "";
  std::vector<std::string> commands = schema.owners(section, name);
  if (commands.empty()) return "";
  for (std::string& command : commands) command = fmt::format("`lucy {}`", command);
  const std::string last = std::move(commands.back());
  commands.pop_back();
  return fmt::format("{} belongs to an input of {}{}{}", subject, fmt::join(commands, ", "),
                     commands.empty() ? "" : " or ", last);
}

/// The end of the sentence about an unknown key of `section`.
std::string suggestion(const Schema& schema, std::string_view section, std::string_view name) {
  std::vector<std::string> here;
  std::vector<std::string> elsewhere;
  for (const Key& key : schema.keys) {
    (key.section == section ? here : elsewhere).push_back(key.name);
    if (key.name == name)
      return key.section.empty() ? "; it stands before the first section"
                                 : fmt::format("; '{}' is a key of [{}]", name, key.section);
  }
  if (const std::string owners = owners_text(schema, "it", section, name); !owners.empty()) return "; " + owners;
  if (const auto nearest = nearest_name(name, here)) return fmt::format("; did you mean '{}'?", *nearest);
  if (const auto nearest = nearest_name(name, elsewhere))
    for (const Key& key : schema.keys)
      if (key.name == *nearest)
        return key.section.empty() ? fmt::format("; did you mean '{}', before the first section?", key.name)
                                   : fmt::format("; did you mean '{}' of [{}]?", key.name, key.section);
  return fmt::format("; its keys are {}", listed(here));
}

std::vector<std::string> section_names(const Schema& schema) {
  std::vector<std::string> names;
  for (const Section& section : schema.sections)
    if (!section.name.empty()) names.push_back(section.name);
  return names;
}

bool is_section(const Schema& schema, std::string_view name) {
  const auto names = section_names(schema);
  return std::find(names.begin(), names.end(), name) != names.end();
}

[[noreturn]] void refuse_unknown_section(const Schema& schema, std::string_view name, const Origin& origin) {
  const std::vector<std::string> names = section_names(schema);
  std::vector<std::string> near = names;
  if (!schema.rows.empty()) near.push_back(schema.rows);
  std::string hint = "the sections are " + listed(names);
  const auto lacking = std::ranges::find(schema.lacking, name, &Section::name);
  if (lacking != schema.lacking.end()) {
    hint = fmt::format("{}; {}", lacking->meaning, owners_text(schema, fmt::format("[{}]", name), name, ""));
  } else if (const std::string owners = owners_text(schema, "it", name, ""); !owners.empty()) {
    hint = owners;
  } else if (const auto nearest = nearest_name(name, near)) {
    hint = fmt::format("did you mean {}?", *nearest == schema.rows ? "[[" + *nearest + "]]" : "[" + *nearest + "]");
  } else if (const Key* key = key_named(schema, name)) {
    hint = fmt::format("'{}' is a key of [{}]", name, key->section);
  }
  throw BadInput(fmt::format("{}: unknown section [{}]; {}", origin.where, shown(name), hint));
}

[[noreturn]] void refuse_unknown_key(const Schema& schema, std::string_view section, std::string_view name,
                                     const Origin& origin) {
  const std::string place = section.empty() ? "" : fmt::format("[{}] ", section);
  throw BadInput(fmt::format("{}: {}unknown key '{}'{}", origin.where, place, shown(name),
                             section.empty() && schema.find(name) == nullptr && is_section(schema, name)
                                 ? fmt::format("; '{}' is a section", name)
                                 : suggestion(schema, section, name)));
}

/// One table of rows: keys by their own names (`duration = 100`), or in sections (`run.duration = 100`).
class RowReader {
 public:
  RowReader(const Schema& schema, const std::string& file, Document::Row& row)
      : schema_(schema), file_(file), row_(row) {}

  void read(const toml::table& table) {
    for (auto&& [key, node] : table) {
      const Origin origin{at_line(file_, key.source())};
      if (is_section(schema_, key.str()) && node.is_table()) {
        read_section(key.str(), *node.as_table());
      } else if (const Key* known = key_named(schema_, key.str())) {
        add(*known, node, origin);
      } else {
        refuse(key.str(), origin);
      }
    }
  }

 private:
  void read_section(std::string_view section, const toml::table& table) {
    for (auto&& [key, node] : table) {
      const Origin origin{at_line(file_, key.source())};
      const Key* known = schema_.find(fmt::format("{}.{}", section, key.str()));
      if (known == nullptr) refuse_unknown_key(schema_, section, key.str(), origin);
      add(*known, node, origin);
    }
  }

  void add(const Key& key, const toml::node& node, const Origin& origin) {
    if (!key.in_rows)
      throw BadInput(fmt::format("{}: [[{}]] cannot hold '{}', which is one for the whole file; write it {}",
                                 origin.where, schema_.rows, key.name,
                                 key.section.empty() ? "before the first section" : "under [" + key.section + "]"));
    const auto [place, added] = row_.entries.emplace(key.path(), entry_of(key, node, origin, schema_.rows));
    if (!added)
      throw BadInput(fmt::format("{}: '{}' is written twice in one [[{}]] table, as {} and as {}", origin.where,
                                 key.name, schema_.rows, key.name, key.path()));
  }

  [[noreturn]] void refuse(std::string_view name, const Origin& origin) const {
    std::vector<std::string> names;
    for (const Key& key : schema_.keys)
      if (key.in_rows) names.push_back(key.name);
    std::string hint = owners_text(schema_, "it", "", name);
    if (hint.empty()) hint = owners_text(schema_, "it", name, "");
    if (const auto nearest = nearest_name(name, names); hint.empty() && nearest)
      hint = fmt::format("did you mean '{}'?", *nearest);
    if (hint.empty()) hint = "its keys are " + listed(names);
    throw BadInput(fmt::format("{}: [[{}]] unknown key '{}'; {}", origin.where, schema_.rows, shown(name), hint));
  }

  const Schema& schema_;
  const std::string& file_;
  Document::Row& row_;
};

void read_rows(const toml::node& node, const Origin& origin, const Schema& schema, Document& document) {
  const toml::array* tables = node.as_array();
  const bool only_tables = tables != nullptr && std::all_of(tables->begin(), tables->end(),
                                                            [](const toml::node& row) { return row.is_table(); });
  if (!only_tables)
    throw BadInput(fmt::format("{}: {} must be written as [[{}]] tables, one per row, but is {}", origin.where,
                               schema.rows, schema.rows, kind_of(node)));
  if (tables->empty()) throw BadInput(fmt::format("{}: {} is an empty list of rows", origin.where, schema.rows));
  for (const toml::node& table : *tables) {
    Document::Row row;
    row.origin = {at_line(document.file, table.source())};
    RowReader(schema, document.file, row).read(*table.as_table());
    document.rows.push_back(std::move(row));
  }
}

void read_section(const toml::node& node, std::string_view section, const Origin& origin, const Schema& schema,
                  Document& document) {
  const toml::table* table = node.as_table();
  if (table == nullptr)
    throw BadInput(fmt::format("{}: '{}' must be a section, written once as [{}], but is {}", origin.where, section,
                               section, kind_of(node)));
  for (auto&& [key, value] : *table) {
    const Origin place{at_line(document.file, key.source())};
    const Key* known = schema.find(fmt::format("{}.{}", section, key.str()));
    if (known == nullptr) refuse_unknown_key(schema, section, key.str(), place);
    document.shared[known->path()] = entry_of(*known, value, place);
  }
}

/// The value after the first '=' of an override, as TOML.
toml::table parsed_override(const Key& key, std::string_view value, const Origin& origin) {
  if (value.empty()) throw BadInput(fmt::format("{}: has no value; expected --set {}=VALUE", origin.where, key.path()));
  try {
    toml::table table = toml::parse(fmt::format("value = {}", value));
    if (table.size() != 1) throw BadInput(fmt::format("{}: sets more than one key; repeat --set", origin.where));
    return table;
  } catch (const toml::parse_error& error) {
    if (const std::string_view word = bare_word(value); !word.empty())
      throw BadInput(
          fmt::format("{}: {}", origin.where,
                      bare_word_text(shown(word), fmt::format("--set '{}=\"{}\"'", key.path(), shown(word)), &key)));
    throw BadInput(fmt::format("{}: {}", origin.where, syntax_text(error)));
  }
}

void apply_override(std::string_view text, const Schema& schema, Document& document) {
  const Origin origin{"--set " + shown(text)};
  const std::size_t equals = text.find('=');
  const std::string_view path = trimmed(text.substr(0, equals));
  if (equals == std::string_view::npos || path.empty() || path.front() == '.' || path.back() == '.')
    throw BadInput(fmt::format("{}: expected section.key=value, such as --set run.replicas=4", origin.where));

  const std::size_t dot = path.find('.');
  const std::string_view section = dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
  const std::string_view name = dot == std::string_view::npos ? path : path.substr(dot + 1);
  const Key* key = schema.find(path);
  if (key == nullptr) {
    if (!schema.rows.empty() && (section == schema.rows || path == schema.rows))
      throw BadInput(fmt::format("{}: [[{}]] tables cannot be set; set section.key=value, which holds for every row",
                                 origin.where, schema.rows));
    if (!section.empty() && !is_section(schema, section)) refuse_unknown_section(schema, section, origin);
    refuse_unknown_key(schema, section, name, origin);
  }
  const toml::table table = parsed_override(*key, trimmed(text.substr(equals + 1)), origin);
  document.shared[key->path()] = entry_of(*key, *table.get("value"), origin);
  for (Document::Row& row : document.rows) row.entries.erase(key->path());
  if (key->replaces_rows && !document.rows.empty()) {
    document.rows.clear();
    document.rows_dropped_by = origin.where;
  }
}

}  // namespace

Document read_document(const std::filesystem::path& file, std::span<const std::string> overrides,
                       const Schema& schema) {
  Document document;
  document.file = file.string();
  const toml::table root = parsed_file(document.file, file_text(file), schema);
  for (auto&& [key, node] : root) {
    const Origin origin{at_line(document.file, key.source())};
    if (const Key* known = schema.find(key.str()); known != nullptr && known->section.empty()) {
      document.shared[known->path()] = entry_of(*known, node, origin);
    } else if (!schema.rows.empty() && key.str() == schema.rows) {
      read_rows(node, origin, schema, document);
    } else if (is_section(schema, key.str())) {
      read_section(node, key.str(), origin, schema, document);
    } else if (node.is_table() || node.is_array_of_tables()) {
      refuse_unknown_section(schema, key.str(), origin);
    } else {
      refuse_unknown_key(schema, "", key.str(), origin);
    }
  }
  for (const std::string& text : overrides) apply_override(text, schema, document);
  return document;
}

Outline outline_of(const std::filesystem::path& file, std::string_view rows) {
  toml::table root;
  try {
    root = toml::parse(file_text(file));
  } catch (const toml::parse_error&) {
    return {};
  } catch (const BadInput&) {
    return {};
  }
  Outline outline;
  for (auto&& [key, node] : root)
    if (node.is_table()) outline.sections.emplace(key.str());
  if (const toml::array* tables = root[rows].as_array())
    for (const toml::node& table : *tables)
      if (table.is_table())
        for (auto&& [key, node] : *table.as_table()) outline.row_keys.emplace(key.str());
  return outline;
}

}  // namespace lucy::files
