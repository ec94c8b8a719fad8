// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How much work a sweep is, and how long it takes: work in particle-steps, wall time from a measured speed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lucy/cases/couette.hpp"

namespace lucy::program {

/// From this many particles on, a system runs alone with all threads inside; smaller ones run one replica per thread.
inline constexpr std::int64_t large_system = 32768;

inline bool is_large(std::int64_t particles) { return particles >= large_system; }

/// The recorded durations per replica at which a point may end, increasing: `duration` alone, or with a
/// target_relative_error its doubles up to maximum_duration (0: ten times `duration`). Whether to go on is decided at
/// these and nowhere else, so that no interruption and no number of threads can change the result.
std::vector<double> recorded_durations(const cases::CouettePoint& point);

/// Sample intervals of one replica: equilibration and recorded duration.
std::int64_t sample_intervals(const cases::CouettePoint& point, double duration);

/// Particle-steps of one sample interval.
double interval_cost(const cases::CouettePoint& point);

/// Wall time of tasks that `workers` take one by one, the longest first: in the unit of the costs.
double time_on_workers(std::vector<double> costs, int workers);

/// The cores that this process may use.
int available_cores();

/// "0.4 s", "43 s", "2 min 05 s", "3 h 12 min", "2 d 04 h".
std::string duration_text(double seconds);

/// "350 kB", "12 MB", "3.4 GB" (powers of ten).
std::string size_text(double bytes);

}  // namespace lucy::program
