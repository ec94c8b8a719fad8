// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/series_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"

namespace lucy::files {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

void skip_blanks(std::string_view& text) {
  std::size_t blanks = 0;
  while (blanks < text.size() && is_blank(text[blanks])) ++blanks;
  text.remove_prefix(blanks);
}

/// Takes the first word off a text that does not start with a blank, with its comma and the blanks around that.
std::string_view take_word(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && !is_blank(text[end]) && text[end] != ',') ++end;
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end);
  skip_blanks(text);
  if (text.starts_with(',')) {
    text.remove_prefix(1);
    skip_blanks(text);
  }
  return word;
}

std::size_t count_words(std::string_view line) {
  std::size_t count = 0;
  for (; !line.empty(); ++count) take_word(line);
  return count;
}

/// The names of columns that a line holds; between commas they may have blanks.
std::vector<std::string> names_in(std::string_view line) {
  const bool commas = line.find(',') != std::string_view::npos;
  std::vector<std::string> names;
  skip_blanks(line);
  while (!line.empty()) {
    std::string_view name;
    if (commas) {
      name = line.substr(0, line.find(','));
      line.remove_prefix(std::min(name.size() + 1, line.size()));
      while (!name.empty() && is_blank(name.back())) name.remove_suffix(1);
      skip_blanks(line);
    } else {
      name = take_word(line);
    }
    if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    names.emplace_back(name);
  }
  return names;
}

/// The whole of `word` as a number (nan and infinity are numbers), or false.
bool read_number(std::string_view word, double& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

bool starts_with_number(std::string_view line) {
  double ignored = 0.0;
  return read_number(take_word(line), ignored);
}

/// A word from outside, fit for one line of a message.
std::string shown(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text(word.substr(0, longest));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
  return word.size() > longest ? text + "..." : text;
}

class ColumnReader {
 public:
  explicit ColumnReader(const std::filesystem::path& path) : path_(path.string()) {}

  ColumnFile read(std::string_view text) {
    if (text.find('\0') != std::string_view::npos)
      throw BadInput(fmt::format("{} is not a file of columns of numbers: it is binary", path_));
    const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
    std::string_view rest = text;
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // what spreadsheets put first
    while (!rest.empty()) {
      ++line_;
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      std::string_view line = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      if (line.ends_with('\r')) line.remove_suffix(1);
      skip_blanks(line);
      if (line.empty()) continue;
      if (line.front() == '#') {
        if (file_.columns.empty()) comments_.push_back(names_in(line.substr(1)));
      } else if (!file_.columns.empty()) {
        read_row(line);
      } else if (file_.names.empty() && !starts_with_number(line)) {
        file_.names = names_in(line);
        line_of_names_ = line_;
      } else {
        read_first_row(line, lines);
      }
    }
    if (file_.columns.empty()) throw BadInput(fmt::format("{} has no row of numbers", path_));
    return std::move(file_);
  }

 private:
  void read_first_row(std::string_view line, std::size_t lines) {
    const std::size_t count = count_words(line);
    file_.columns.resize(count);
    for (auto& column : file_.columns) column.reserve(lines);
    read_row(line);
    if (!file_.names.empty() && file_.names.size() != count)
      throw BadInput(fmt::format("{}:{}: {} numbers were found where line {} has {} names of columns", path_, line_,
                                 count, line_of_names_, file_.names.size()));
    const auto header = std::find_if(comments_.rbegin(), comments_.rend(),
                                     [&](const std::vector<std::string>& names) { return names.size() == count; });
    if (file_.names.empty() && header != comments_.rend()) file_.names = *header;
  }

  void read_row(std::string_view line) {
    std::size_t place = 0;
    for (; !line.empty(); ++place) {
      const std::string_view word = take_word(line);
      double value = 0.0;
      if (!read_number(word, value) || !std::isfinite(value))
        throw BadInput(fmt::format("{}:{}: \"{}\" was found in column {} where a finite number was expected", path_,
                                   line_, shown(word), place + 1));
      if (place < file_.columns.size()) file_.columns[place].push_back(value);
    }
    if (place != file_.columns.size())
      throw BadInput(fmt::format("{}:{}: {} numbers were found where the first row has {}", path_, line_, place,
                                 file_.columns.size()));
  }

  std::string path_;
  ColumnFile file_;
  std::vector<std::vector<std::string>> comments_;
  std::size_t line_ = 0;
  std::size_t line_of_names_ = 0;
};

}  // namespace

ColumnFile parse_columns(std::string_view text, const std::filesystem::path& path) {
  return ColumnReader(path).read(text);
}

ColumnFile read_columns(const std::filesystem::path& path) { return parse_columns(read_text_file(path), path); }

std::size_t find_column(const ColumnFile& file, std::string_view name_or_number, const std::filesystem::path& path) {
  const auto found = std::ranges::count(file.names, name_or_number);
  if (found == 1) return static_cast<std::size_t>(std::ranges::find(file.names, name_or_number) - file.names.begin());
  if (found > 1)
    throw BadInput(fmt::format("{}: the column {} stands there {} times; name it by its number, counted from 1",
                               path.string(), name_or_number, found));
  std::size_t number = 0;
  const char* last = name_or_number.data() + name_or_number.size();
  const auto [end, error] = std::from_chars(name_or_number.data(), last, number);
  if (error == std::errc() && end == last && number >= 1 && number <= file.columns.size()) return number - 1;
  const std::string what =
      fmt::format("{}: there is no column {}; it has {}", path.string(), shown(name_or_number), file.columns.size());
  if (file.names.empty()) throw BadInput(fmt::format("{} columns without names, numbered from 1", what));
  throw BadInput(fmt::format("{} columns, numbered from 1: {}", what, fmt::join(file.names, ", ")));
}

}  // namespace lucy::files
