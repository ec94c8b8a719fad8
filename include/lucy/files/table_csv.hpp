// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// table.csv and replicas.csv: what a sweep measured. Numbers are the shortest text that reads back as the same bits, so
// equal results are equal files; nothing that varies between repetitions stands in them.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/couette_table.hpp"

namespace lucy::files {

/// The names of the columns of table.csv, in order.
std::vector<std::string> table_columns();

/// Throws RunFailed when the disk refuses; an earlier file is then untouched.
void write_table_csv(const std::filesystem::path& path, std::span<const cases::TableRow> rows);
void write_replicas_csv(const std::filesystem::path& path, std::span<const cases::ReplicaRow> rows);

/// Reads a table.csv back; columns are found by name, further ones are passed over. Degrees of freedom, spread and the
/// text of a failure are not in the file. Throws BadInput naming file, line and column.
std::vector<cases::TableRow> read_table_csv(const std::filesystem::path& path);

}  // namespace lucy::files
