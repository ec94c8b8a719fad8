// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// benard.csv: one line per convecting fluid, with the settings that tell it from others and every value with its error.
// Numbers are the shortest text that reads back as the same bits, so equal results are equal files; nothing that varies
// between repetitions stands in them. What is not known is nan; the Rayleigh number of a fluid without viscosity is
// inf.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/benard_table.hpp"

namespace lucy::files {

/// The names of the columns, in order: settings, then NAME and NAME_error of every quantity, then how the run went.
std::vector<std::string> benard_columns();

/// Throws RunFailed when the disk refuses; an earlier file is then untouched.
void write_benard_csv(const std::filesystem::path& path, std::span<const cases::BenardRow> rows);

/// Reads it back; columns are found by name, further ones are passed over. Settings that have no column keep their
/// defaults; warnings and the text of a failure are not in the file. Throws BadInput naming file, line and column.
std::vector<cases::BenardRow> read_benard_csv(const std::filesystem::path& path);

}  // namespace lucy::files
