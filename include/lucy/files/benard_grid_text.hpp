// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The results of `lucy benard-grid` as a person reads them.
#pragma once

#include <span>
#include <string>

#include "lucy/cases/benard_grid_table.hpp"

namespace lucy::files {

/// "ideal-gas, Ra = 5000, 20 cells"; what is not usual is named: "walls", "kinematic".
std::string benard_grid_label(const cases::BenardGridPoint& point);

/// The steady flows and the growth rates, their extrapolations, the critical Rayleigh numbers; what words mean, and why
/// rows failed. Ends with a line feed.
std::string format_benard_grid(std::span<const cases::BenardGridRow> rows);

}  // namespace lucy::files
