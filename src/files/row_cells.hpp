// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows of results (table.csv, viscosity.csv) read back: cells by the name of their column, refused with file and line.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lucy/cases/couette_table.hpp"
#include "lucy/files/csv.hpp"
#include "lucy/statistics/pooling.hpp"

namespace lucy::files {

/// Throws BadInput when the header of a file of that kind ("table.csv") lacks one of `columns`.
void require_columns(const CsvFile& file, std::span<const std::string> columns, std::string_view kind);

/// The cells of one row; every function throws BadInput naming file, line and column.
class RowCells {
 public:
  RowCells(const CsvFile& file, const CsvFile::Row& row) : file_(file), row_(row) {}

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
    const std::string& cell = row_.cells[file_.column(column)];
    std::string known;
    for (const auto& [name, value] : names) {
      if (name == cell) return value;
      known += (known.empty() ? "" : ", ") + std::string(name);
    }
    refuse_choice(column, cell, known);
  }

 private:
  [[noreturn]] void refuse_choice(std::string_view column, std::string_view cell, std::string_view known) const;

  const CsvFile& file_;
  const CsvFile::Row& row_;
};

}  // namespace lucy::files
