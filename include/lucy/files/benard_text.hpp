// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Convecting fluids for people, at most 118 columns wide.
#pragma once

#include <span>
#include <string>

#include "lucy/cases/benard_table.hpp"

namespace lucy::files {

/// "ideal-gas, 5000 particles, Ra = 10000"; without viscosity "ideal-gas, 800 particles, eta = 0, k = 0.1".
std::string benard_label(const cases::BenardPoint& point);

/// Kinetic energies; Nusselt numbers with what conduction and work make of them; extremes: one line per row in each.
/// Below them a line on what does not explain itself, warnings, and why rows failed. Ends with a line feed.
std::string format_benard(std::span<const cases::BenardRow> rows);

}  // namespace lucy::files
