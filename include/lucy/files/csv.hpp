// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Comma-separated values with one header line; a cell may be quoted ("a, b", with "" for a quotation mark).
// Cells are kept as text, since the digits of a printed number say how well it is known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lucy::files {

class CsvFile {
 public:
  struct Row {
    int line = 0;  ///< of the file, from 1
    std::vector<std::string> cells;
  };

  /// Throws BadInput naming file and line: unreadable, empty, a column twice, a row longer or shorter than the header.
  explicit CsvFile(const std::filesystem::path& path);

  const std::string& path() const { return path_; }
  const std::vector<Row>& rows() const { return rows_; }
  bool has_column(std::string_view name) const;
  const std::vector<std::string>& columns() const { return columns_; }
  /// Throws BadInput when the header does not have the column.
  std::size_t column(std::string_view name) const;
  /// Throw BadInput naming file, line and column when the cell is not a number (nan and inf are numbers).
  double number(const Row& row, std::size_t column) const;
  std::int64_t integer(const Row& row, std::size_t column) const;

 private:
  std::string path_;
  std::vector<std::string> columns_;
  std::vector<Row> rows_;
};

/// Cells of a file that is written line by line.
class CsvLine {
 public:
  void add(double value);  ///< as shortest_text
  void add(std::int64_t value);
  void add(std::string_view cell);  ///< as it is: no comma, quotation mark or line feed
  /// The line with its line feed; the next one starts empty.
  std::string end();

 private:
  std::string text_;
  bool first_ = true;
};

/// The shortest decimal text that reads back as the same bits; nan is "nan".
std::string shortest_text(double value);

/// The whole of `text` as a number, or nothing.
std::optional<double> parse_number(std::string_view text);

/// One unit of the last digit written: 0.4849 gives 1e-4, 28 gives 1, 1.5e-3 gives 1e-4.
double unit_of_last_digit(std::string_view text);

}  // namespace lucy::files
