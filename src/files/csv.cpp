// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/csv.hpp"

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

/// The cells of one line; nothing when a quotation mark is not closed.
std::optional<std::vector<std::string>> split(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += '"';
      ++i;
    } else if (c == '"' && (quoted || cells.back().empty())) {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  if (quoted) return std::nullopt;
  return cells;
}

}  // namespace

CsvFile::CsvFile(const std::filesystem::path& path) : path_(path.string()) {
  const std::string text = read_text_file(path);
  if (text.find('\0') != std::string::npos) throw BadInput(fmt::format("{} is not a CSV file: it is binary", path_));
  int number = 0;
  std::string_view rest = text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // what spreadsheets put first
  while (!rest.empty()) {
    ++number;
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty()) continue;
    auto cells = split(line);
    if (!cells) throw BadInput(fmt::format("{}:{}: a quotation mark is not closed", path_, number));
    if (columns_.empty()) {
      columns_ = std::move(*cells);
      for (auto column = columns_.begin(); column != columns_.end(); ++column)
        if (std::find(columns_.begin(), column, *column) != column)
          throw BadInput(fmt::format("{}:{}: the column {} stands twice in the header", path_, number, *column));
      continue;
    }
    if (cells->size() != columns_.size())
      throw BadInput(fmt::format("{}:{}: {} cells were found where the header has {} columns", path_, number,
                                 cells->size(), columns_.size()));
    rows_.push_back({number, std::move(*cells)});
  }
  if (columns_.empty()) throw BadInput(fmt::format("{} is empty where a CSV file with a header was expected", path_));
}

bool CsvFile::has_column(std::string_view name) const {
  return std::find(columns_.begin(), columns_.end(), name) != columns_.end();
}

std::size_t CsvFile::column(std::string_view name) const {
  const auto found = std::find(columns_.begin(), columns_.end(), name);
  if (found == columns_.end())
    throw BadInput(fmt::format("{}:1: the header has no column {}; it has {}", path_, name, fmt::join(columns_, ", ")));
  return static_cast<std::size_t>(found - columns_.begin());
}

double CsvFile::number(const Row& row, std::size_t column) const {
  const auto value = parse_number(row.cells[column]);
  if (!value)
    throw BadInput(fmt::format("{}:{}: {} is \"{}\" where a number was expected", path_, row.line, columns_[column],
                               row.cells[column]));
  return *value;
}

std::int64_t CsvFile::integer(const Row& row, std::size_t column) const {
  const std::string& cell = row.cells[column];
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size())
    throw BadInput(
        fmt::format("{}:{}: {} is \"{}\" where a whole number was expected", path_, row.line, columns_[column], cell));
  return value;
}

void CsvLine::add(double value) { add(shortest_text(value)); }

void CsvLine::add(std::int64_t value) { add(fmt::format("{}", value)); }

void CsvLine::add(std::string_view cell) {
  if (!first_) text_ += ',';
  first_ = false;
  text_ += cell;
}

std::string CsvLine::end() {
  first_ = true;
  return std::exchange(text_, {}) + '\n';
}

std::string shortest_text(double value) { return std::isnan(value) ? "nan" : fmt::format("{}", value); }

std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

double unit_of_last_digit(std::string_view text) {
  const std::size_t exponent_mark = std::min(text.find_first_of("eE"), text.size());
  const std::string_view mantissa = text.substr(0, exponent_mark);
  const std::size_t point = mantissa.find('.');
  int power = point == std::string_view::npos ? 0 : -static_cast<int>(mantissa.size() - point - 1);
  if (exponent_mark < text.size())
    power += static_cast<int>(parse_number(text.substr(exponent_mark + 1)).value_or(0.0));
  // From text, since 1e-4 as a decimal constant is nearer to the truth than a power computed in steps.
  return parse_number(fmt::format("1e{}", power)).value_or(0.0);
}

}  // namespace lucy::files
