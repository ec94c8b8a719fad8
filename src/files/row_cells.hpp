// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows of results (table.csv, viscosity.csv), written and read back: cells by the name of their column, refused with
// file and line.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/cases/couette_table.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/csv.hpp"
#include "lucy/statistics/pooling.hpp"

namespace lucy::files {

/// Throws BadInput when the header of a file of that kind ("table.csv") lacks one of `columns`.
void require_columns(const CsvFile& file, std::span<const std::string> columns, std::string_view kind);

/// NAME and NAME_error.
void add_with_error(std::vector<std::string>& columns, std::string_view name);

/// The cells of two such columns.
void add(CsvLine& line, const statistics::Estimate& estimate);

/// Writes a line for each of `rows`, whose cells add_cells(line, row) adds. Throws RunFailed when the disk refuses.
template <class Row, class AddCells>
void write_rows(const std::filesystem::path& path, const std::vector<std::string>& columns, std::span<const Row> rows,
                const AddCells& add_cells) {
  std::string text = fmt::format("{}\n", fmt::join(columns, ","));
  CsvLine line;
  for (const Row& row : rows) {
    add_cells(line, row);
    text += line.end();
  }
  write_file_atomically(path, text);
}

/// The cells of one row; every function throws BadInput naming file, line and column.
class RowCells {
 public:
  RowCells(const CsvFile& file, const CsvFile::Row& row) : file_(file), row_(row) {}

  const std::string& text(std::string_view column) const { return row_.cells[file_.column(column)]; }
  double number(std::string_view column) const;
  std::int64_t integer(std::string_view column) const;
  int count(std::string_view column) const;
  /// From the columns NAME and NAME_error; effective samples and degrees of freedom are not in the file.
  statistics::Estimate estimate(std::string_view name) const;
  /// From the column "status".
  cases::RowStatus status() const;
  /// From a column that holds one of the words of a list such as motion::cooling_names.
  template <class Names>
  auto choice(std::string_view column, const Names& names) const {
    const std::string& cell = text(column);
    std::string known;
    for (const auto& [name, value] : names) {
      if (name == cell) return value;
      known += (known.empty() ? "" : ", ") + std::string(name);
    }
    refuse_choice(column, cell, known);
  }

  /// That `cell` is none of the words in `known`.
  [[noreturn]] void refuse_choice(std::string_view column, std::string_view cell, std::string_view known) const;

 private:
  const CsvFile& file_;
  const CsvFile::Row& row_;
};

/// Reads a file of that kind; read_cells(cells, row) fills a row. Throws BadInput as require_columns and RowCells do.
template <class Row, class ReadCells>
std::vector<Row> read_rows(const std::filesystem::path& path, const std::vector<std::string>& columns,
                           std::string_view kind, const ReadCells& read_cells) {
  const CsvFile file(path);
  require_columns(file, columns, kind);
  std::vector<Row> rows;
  for (const auto& line : file.rows()) read_cells(RowCells(file, line), rows.emplace_back());
  return rows;
}

}  // namespace lucy::files
