// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the replicas of one sheared fluid recorded becomes one row of shear_flow.csv. Viscosities, -P_xy/rate and its
// parts, and the surplus of entropy made over entropy removed are formed sample by sample, so that their errors know
// how the parts move together.
//
// Equilibration (statistics/equilibration.hpp) is sought in P_xy and in the kinetic temperature, whose rise to the
// steady state is the slowest of all, in each replica alone and in the average over replicas.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/cases/couette_table.hpp"
#include "lucy/cases/place_of.hpp"
#include "lucy/cases/shear_flow.hpp"
#include "lucy/statistics/pooling.hpp"

namespace lucy::cases {

/// The columns of shear_flow.csv that have an error, in the order of the file: what is made of the samples, then the
/// samples themselves (shear_flow_averages, shear_flow_instants). viscosity_excess: over the prescribed one.
/// entropy_surplus: made by viscosity and conduction, less what leaves with the heat.
inline constexpr std::size_t shear_flow_derived = 6;
inline constexpr auto shear_flow_quantities = [] {
  std::array<std::string_view, shear_flow_derived + shear_flow_averages.size() + shear_flow_instants.size()> names = {
      "viscosity",          "viscosity_excess",    "viscosity_carried",
      "viscosity_pressure", "viscosity_newtonian", "entropy_surplus"};
  std::size_t place = shear_flow_derived;
  for (const auto name : shear_flow_averages) names[place++] = name;
  for (const auto name : shear_flow_instants) names[place++] = name;
  return names;
}();

/// Place of a name in `shear_flow_quantities`; a wrong name does not compile.
consteval std::size_t shear_flow_quantity(std::string_view name) { return place_of(shear_flow_quantities, name); }

/// One row of shear_flow.csv (reduced units): the settings that tell rows apart, then what was measured.
struct ShearFlowRow {
  ShearFlowPoint settings;
  double duration = 0.0;  ///< recorded time per replica
  std::array<statistics::Estimate, shear_flow_quantities.size()> estimates{};
  double effective_samples = 0.0;        ///< of the viscosity; nan when no error could be given
  double equilibration_discarded = 0.0;  ///< time, mean over replicas, beyond the unrecorded equilibration
  double worst_energy_error = 0.0;       ///< largest over replicas of |dE|/N of one step
  double energy_drift = 0.0;             ///< of the replica with the largest, signed: sum of these errors
  std::int64_t subdivided_steps = 0;     ///< sum over replicas
  /// too_short: something that has a meaning could not be given an error; without cooling, nothing ever can.
  RowStatus status = RowStatus::ok;
  std::string failure;                ///< why, when status is failed; not in the file
  std::vector<std::string> warnings;  ///< what a reader has to know besides; not in the file

  const statistics::Estimate& operator[](std::size_t quantity) const { return estimates[quantity]; }
};

/// A flow whose density_wave is larger has fallen into bands.
inline constexpr double homogeneous_density_wave = 0.25;

/// The row of a point from what its replicas recorded.
ShearFlowRow summarize(const ShearFlowPoint& point, std::span<const ShearFlowRecord> replicas);

/// The row of a point that could not be finished: every measured value nan, status failed.
ShearFlowRow failed_row(const ShearFlowPoint& point, std::string message);

/// The viscosity as known from what has been recorded so far, the same as in `summarize`.
statistics::Estimate current_viscosity(const ShearFlowPoint& point, std::span<const ShearFlowRecord> replicas);

}  // namespace lucy::cases
