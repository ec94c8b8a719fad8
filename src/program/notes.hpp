// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// notes.txt: what a reader has to know beside a table of numbers and what the table's columns cannot say, so that a
// finished run can be printed again in full.
//
//     Point 3 failed: REASON
//     Point 2 warning: SENTENCE
//     any other line, as it is printed
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "lucy/cases/couette_table.hpp"
#include "lucy/errors.hpp"

namespace lucy::program {

struct Notes {
  std::map<std::size_t, std::string> failures;               ///< by row, from 0
  std::map<std::size_t, std::vector<std::string>> warnings;  ///< by row, from 0
  std::string others;                                        ///< lines, each with its end
};

/// Throws RunFailed when the disk refuses.
void write_notes(const std::filesystem::path& path, const Notes& notes);

/// None when there is no such file. Throws BadInput when it cannot be read.
Notes read_notes(const std::filesystem::path& path);

/// Why rows of a table failed.
template <class Row>
std::map<std::size_t, std::string> failures_of(const std::vector<Row>& rows) {
  std::map<std::size_t, std::string> failures;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].status == cases::RowStatus::failed) failures[i] = rows[i].failure;
  return failures;
}

/// Of rows that have warnings.
template <class Row>
std::map<std::size_t, std::vector<std::string>> warnings_of(const std::vector<Row>& rows) {
  std::map<std::size_t, std::vector<std::string>> warnings;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!rows[i].warnings.empty()) warnings[i] = rows[i].warnings;
  return warnings;
}

/// The notes beside a table that was read back; rows get their warnings again, and those that failed are told why.
/// Throws BadInput when these are not the rows of `points`, each of which is_of(row, point).
template <class Row, class Point, class IsOf>
Notes notes_beside(const std::filesystem::path& table, std::vector<Row>& rows, const std::vector<Point>& points,
                   IsOf is_of) {
  const std::filesystem::path directory = table.parent_path();
  if (!std::equal(rows.begin(), rows.end(), points.begin(), points.end(), is_of))
    throw BadInput(fmt::format("{} does not hold the rows of {}", table.string(), (directory / "input.toml").string()));
  Notes notes = read_notes(directory / "notes.txt");
  for (const auto& [row, reason] : notes.failures)
    if (row < rows.size() && rows[row].status == cases::RowStatus::failed) rows[row].failure = reason;
  if constexpr (requires(Row row) { row.warnings; })
    for (const auto& [row, sentences] : notes.warnings)
      if (row < rows.size()) rows[row].warnings = sentences;
  return notes;
}

}  // namespace lucy::program
