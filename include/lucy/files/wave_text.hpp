// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Decaying waves for people, at most 118 columns wide.
#pragma once

#include <span>
#include <string>

#include "lucy/cases/wave_table.hpp"

namespace lucy::files {

/// "N = 4096, lucy, h = 3, ideal-gas, kT = 1, eta = 0.3, A = 0.05, disorder 0.3"
std::string wave_label(const cases::WavePoint& point);

/// In what a point differs from another, "eta 0.1, h 5"; atoms by their state, "atoms E/N 1, N 1024". Empty when
/// they are physically the same.
std::string wave_difference(const cases::WavePoint& point, const cases::WavePoint& from);

/// The points in three tables: how fast the wave decays, by what parts, and the parameters of the preferred form; below
/// them what the columns mean, warnings, and why points failed. Ends with a line feed.
std::string format_waves(std::span<const cases::WaveRow> rows);

}  // namespace lucy::files
