// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// shear_flow.csv: one line per sheared fluid, with the settings that tell it from others and every value with its
// error. Numbers are the shortest text that reads back as the same bits, so equal results are equal files; nothing that
// varies between repetitions stands in them. What is not known, or has no meaning, is nan.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/shear_flow_table.hpp"

namespace lucy::files {

/// The names of the columns, in order: settings (those of the start and of the constitutive law with "prescribed_" or
/// "start_" before them), then NAME and NAME_error of every quantity, then how the run went.
std::vector<std::string> shear_flow_columns();

/// Throws RunFailed when the disk refuses; an earlier file is then untouched.
void write_shear_flow_csv(const std::filesystem::path& path, std::span<const cases::ShearFlowRow> rows);

/// Reads it back; columns are found by name, further ones are passed over. Settings that have no column keep their
/// defaults; degrees of freedom, warnings and the text of a failure are not in the file. Throws BadInput naming file,
/// line and column.
std::vector<cases::ShearFlowRow> read_shear_flow_csv(const std::filesystem::path& path);

}  // namespace lucy::files
