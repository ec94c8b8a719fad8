// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// point_NNN.h5 of `lucy benard-grid`:
//
//     /parameters          attributes: all settings
//     /history             time, kinetic_energy, nusselt_hot, nusselt_cold, nusselt_sides, largest_speed,
//                          roll_amplitude, mass_error, from the start on
//     /grid/x, /grid/y     nodes
//     /fields              density, temperature, velocity_x, velocity_y at the nodes, [y][x], at the last of the times
#pragma once

#include <filesystem>
#include <string_view>

#include "lucy/cases/benard_grid.hpp"

namespace lucy::files {

/// `program`: who wrote it, with its version. Throws RunFailed with path and reason.
void write_benard_grid_h5(const std::filesystem::path& path, const cases::BenardGridPoint& point,
                          const cases::BenardGridRecord& record, std::string_view program);

}  // namespace lucy::files
