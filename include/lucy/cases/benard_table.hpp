// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the replicas of one convecting fluid recorded becomes one row of benard.csv. After the equilibration asked for,
// more is cut where the kinetic energy still drifts (statistics/equilibration.hpp). Means of series have errors from
// blocking, pooled over replicas; the kinetic energy of the averaged flow, which is no mean of a series, has one from
// leaving out one block of time after another (statistics/jackknife.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/cases/benard.hpp"
#include "lucy/cases/couette_table.hpp"
#include "lucy/cases/place_of.hpp"
#include "lucy/statistics/pooling.hpp"

namespace lucy::cases {

/// The columns of benard.csv that have an error, in the order of the file. Nusselt numbers are conduction and work
/// together: into the fluid by the floor (hot) and by the side walls, out of it by the ceiling (cold).
/// energy_imbalance: what walls gave less what the fluid's total energy grew by, over heat_at_rest(): zero but for what
/// the sampling of the walls' power misses.
inline constexpr std::size_t benard_derived = 5;
inline constexpr auto benard_quantities = [] {
  std::array<std::string_view, benard_derived + benard_averages.size() + benard_instants.size()> names = {
      "kinetic_energy_field", "nusselt_hot", "nusselt_cold", "nusselt_sides", "energy_imbalance"};
  std::size_t place = benard_derived;
  for (const auto name : benard_averages) names[place++] = name;
  for (const auto name : benard_instants) names[place++] = name;
  return names;
}();

consteval std::size_t benard_quantity(std::string_view name) { return place_of(benard_quantities, name); }

struct BenardRow {
  BenardPoint settings;   ///< resolved
  double duration = 0.0;  ///< averaged over, per replica
  std::array<statistics::Estimate, benard_quantities.size()> estimates{};
  double effective_samples = 0.0;        ///< of the total kinetic energy; nan when no error could be given
  double equilibration_discarded = 0.0;  ///< time, mean over replicas, beyond the equilibration asked for
  double worst_energy_error = 0.0;
  double energy_drift = 0.0;
  std::int64_t subdivided_steps = 0;
  std::int64_t reflections = 0;
  RowStatus status = RowStatus::ok;   ///< failed: a replica ended early; what it had recorded is in the row
  std::string failure;                ///< not in the file
  std::vector<std::string> warnings;  ///< not in the file

  const statistics::Estimate& operator[](std::size_t quantity) const { return estimates[quantity]; }
};

BenardRow summarize(const BenardPoint& point, std::span<const BenardRecord> replicas);
BenardRow failed_row(const BenardPoint& point, std::string message);

/// The total kinetic energy as known so far.
statistics::Estimate current_kinetic_energy(const BenardPoint& point, std::span<const BenardRecord> replicas);

/// The mean moments of all blocks of all replicas: those of the flow averaged over time.
measure::Moments<2> averaged_moments(const BenardPoint& point, std::span<const BenardRecord> replicas);

/// Sum |<rho v>|^2/(2 <rho>) over sum <rho>.
double kinetic_energy_of_mean_flow(const measure::Moments<2>& moments);

}  // namespace lucy::cases
