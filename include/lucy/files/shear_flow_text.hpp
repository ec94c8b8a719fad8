// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sheared fluids for people, at most 118 columns wide.
#pragma once

#include <span>
#include <string>

#include "lucy/cases/shear_flow_table.hpp"

namespace lucy::files {

/// "ideal-gas, viscosity 0.5, rate 0.1"
std::string shear_flow_label(const cases::ShearFlowPoint& point);

/// Viscosities with their parts, temperatures and heat, entropy, one line per row in each; below them a line on what
/// does not explain itself, warnings, and why rows failed. Ends with a line feed.
std::string format_shear_flow(std::span<const cases::ShearFlowRow> rows);

}  // namespace lucy::files
