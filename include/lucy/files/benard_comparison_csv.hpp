// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// benard_compare.csv: convection by particles beside that of the continuum and beside print; and the published kinetic
// energies themselves.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/benard_comparison.hpp"

namespace lucy::files {

/// One line for each number and each that stands beside it: what names the fluid, its cell and its particles; quantity
/// (cases::BenardComparedRow), value, value_error; beside (grid, effective-grid or published), beside_rayleigh (of the
/// flow there), beside_value, beside_error; difference (value less beside_value), per_cent (of beside_value), each with
/// its error; z, the difference in combined standard errors. What is not known is nan.
std::vector<std::string> benard_comparison_columns();

/// Throws RunFailed when the disk refuses; an earlier file is then untouched.
void write_benard_comparison_csv(const std::filesystem::path& path,
                                 std::span<const cases::BenardComparison> comparisons);

/// A CSV file with columns particles (0: of a continuum), equation_of_state, side, height, width, hot, cold, rayleigh,
/// kinetic_energy and source, the digits as printed. Throws BadInput naming file and line.
std::vector<cases::PublishedBenard> read_published_benard(const std::filesystem::path& path);

}  // namespace lucy::files
