// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Series that another program sampled: columns of numbers, separated by blanks or commas, one row per line. Lines that
// start with # are comments. Names of the columns stand in a line of their own before the first row, or in the last
// comment before it that has as many words as the row has numbers (LAMMPS, fix ave/time: "# TimeStep v_pxy v_diff").
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lucy::files {

struct ColumnFile {
  std::vector<std::string> names;            ///< one per column, or none at all
  std::vector<std::vector<double>> columns;  ///< all equally long, at least one number
};

/// Throws BadInput naming file and line: what is no finite number, a row longer or shorter than the first one, names
/// that are not as many as the numbers below them; a file without a row, a binary one, one that cannot be read.
ColumnFile read_columns(const std::filesystem::path& path);

/// The same of a text; `path` is for messages.
ColumnFile parse_columns(std::string_view text, const std::filesystem::path& path);

/// The place of a column by its name, or by its number, counted from 1. Throws BadInput with what there is; `path` is
/// for the message.
std::size_t find_column(const ColumnFile& file, std::string_view name_or_number, const std::filesystem::path& path);

}  // namespace lucy::files
