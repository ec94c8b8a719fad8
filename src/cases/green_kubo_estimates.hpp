// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the blocks of a state to its transport coefficients and curves: the estimators that green_kubo_table.hpp
// describes, whether the blocks come from a run or from a series that was sampled elsewhere.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lucy/cases/green_kubo_table.hpp"
#include "lucy/statistics/pooling.hpp"

namespace lucy::cases {

using Blocks = std::vector<const CorrelationBlock*>;

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr statistics::Estimate unknown = {not_a_number, not_a_number, not_a_number, 0};

/// What the estimators have to know of a state, and how its settings are called where it came from.
struct State {
  double volume = 0.0;
  statistics::Estimate temperature;
  double sample_interval = 0.0;
  double cutoff = 0.0;    // 0: by the rule
  double duration = 0.0;  // per replica
  std::string length_key = "correlation.length";
  std::string interval_key = "output.sample_interval";
  std::string duration_key = "run.duration";
};

/// Everything that rests on the stresses.
void estimate_from_stress(const Blocks& blocks, const State& state, GreenKuboResult& result);

/// The further correlations of the point, and the coefficients among them.
void estimate_others(const GreenKuboPoint& point, const Blocks& blocks, const State& state, GreenKuboResult& result);

/// The viscosity alone.
statistics::Estimate estimate_viscosity(const Blocks& blocks, const State& state);

}  // namespace lucy::cases
