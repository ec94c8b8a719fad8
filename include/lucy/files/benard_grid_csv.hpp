// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// benard_grid.csv, one row per Rayleigh number and mesh; extrapolated.csv, one row per Rayleigh number; critical.csv,
// one row per mesh and one for their limit.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/benard_grid_table.hpp"

namespace lucy::files {

std::vector<std::string> benard_grid_columns();

/// Throw RunFailed when the disk refuses. The last two write nothing when there are no rows.
void write_benard_grid_csv(const std::filesystem::path& path, std::span<const cases::BenardGridRow> rows);
void write_benard_limits_csv(const std::filesystem::path& path, std::span<const cases::BenardGridLimit> limits);
void write_critical_csv(const std::filesystem::path& path, std::span<const cases::CriticalRayleigh> found);

/// Without the reasons of failures. Throws BadInput naming file and line.
std::vector<cases::BenardGridRow> read_benard_grid_csv(const std::filesystem::path& path);

}  // namespace lucy::files
