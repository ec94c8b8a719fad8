// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Convection by particles, of the continuum and of print side by side, on a terminal of 120 columns.
#pragma once

#include <span>
#include <string>

#include "lucy/cases/benard_comparison.hpp"

namespace lucy::files {

/// "ideal-gas, N = 5000, Ra = 10000; lucy, h = 3; 50 x 100, mirror-images": which particles. Without viscosity eta and
/// k stand in the place of Ra.
std::string benard_particles_text(const cases::BenardPoint& point);

/// A table for each row of particles, every number with what stands beside it, and below that by how much it differs;
/// then what the columns are. Ends with a line feed.
std::string format_benard_comparison(std::span<const cases::BenardComparison> comparisons);

}  // namespace lucy::files
