// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// isomorphism.csv: one line per case, with its settings, how much was compared, the first difference, and every mean
// with its error. Numbers are the shortest text that reads back as the same bits; nothing that varies between
// repetitions stands in it. What is not known is nan.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/isomorphism_table.hpp"

namespace lucy::files {

/// The names of the columns, in order. The columns difference_... say where the first difference was found: replica and
/// particle count from 0; particle is nan for a sum over all particles, and so is everything where all bits are the
/// same (the component is then "none").
std::vector<std::string> isomorphism_columns();

/// Throws RunFailed when the disk refuses; an earlier file is then untouched.
void write_isomorphism_csv(const std::filesystem::path& path, std::span<const cases::IsomorphismRow> rows);

/// Reads it back; columns are found by name, further ones are passed over. Degrees of freedom and the text of a failure
/// are not in the file. Throws BadInput naming file, line and column.
std::vector<cases::IsomorphismRow> read_isomorphism_csv(const std::filesystem::path& path);

}  // namespace lucy::files
