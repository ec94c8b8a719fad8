// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the replicas of one Couette point recorded becomes one row of table.csv. Viscosity -P_xy/rate and normal stress
// (P_xx - P_yy)/rate^2 are formed sample by sample, so that their errors know how the parts move together.
//
// Equilibration (statistics/equilibration.hpp) is sought in P_xy, P_xx - P_yy and the potential energy per particle, in
// each replica alone and in the average over replicas, where a transient common to all stands out of the noise (only
// when all replicas are equally long). A replica loses the most that any of these asks for, at most half.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "lucy/cases/couette.hpp"
#include "lucy/cases/place_of.hpp"
#include "lucy/statistics/pooling.hpp"

namespace lucy::cases {

/// The columns of table.csv that have an error, in the order of the file.
inline constexpr std::array<std::string_view, 11> quantities = {
    "potential_energy", "kinetic_temperature", "pxy_kinetic", "pxy_potential", "pxx_kinetic",          "pxx_potential",
    "pyy_kinetic",      "pyy_potential",       "viscosity",   "normal_stress", "largest_kinetic_share"};

/// Place of a name in `quantities`; a wrong name does not compile.
consteval std::size_t quantity(std::string_view name) { return place_of(quantities, name); }

/// `too_short` (in files: short): some quantity could not be given an error bar (a sheared flow without a thermostat,
/// which heats up for ever, never has any), or a target_relative_error was asked for and not reached. `failed`: see
/// TableRow::failure.
enum class RowStatus { ok, too_short, failed };

/// The status as it stands in files: ok, short, failed.
std::string_view status_name(RowStatus status);

/// One row of table.csv (reduced units).
struct TableRow {
  std::int64_t particles = 0;
  double energy_per_particle = 0.0;
  double strain_rate = 0.0;
  double step = 0.0;
  double duration = 0.0;  ///< recorded time per replica
  int replicas = 0;
  std::array<statistics::Estimate, quantities.size()> estimates{};  ///< in the order of `quantities`
  double effective_samples = 0.0;        ///< of the viscosity; of P_xy at zero rate; nan when no error could be given
  double equilibration_discarded = 0.0;  ///< time, mean over replicas, beyond the unrecorded equilibration
  double worst_energy_error = 0.0;       ///< largest over replicas of |dE|/N of one step
  std::int64_t subdivided_steps = 0;     ///< sum over replicas
  RowStatus status = RowStatus::ok;
  statistics::ReplicaSpread spread;  ///< of the viscosity (P_xy at zero rate) over replicas; not in table.csv
  std::string failure;               ///< why, when status is failed; empty otherwise
};

/// Whether the viscosity is known as well as the point's target_relative_error asks, from 50 effective samples at
/// least: a run that stops where its error bar is small by chance would have too small an error bar. True without a
/// target and at zero rate.
bool target_reached(const CouettePoint& point, const statistics::Estimate& viscosity);

/// The row of a point from what its replicas recorded, `duration` being the recorded time per replica. Replicas may
/// differ in length; without any sample all values are nan and the status is too_short.
/// At zero rate viscosity and normal stress are nan, and a target_relative_error is not looked at.
TableRow summarize(const CouettePoint& point, double duration, std::span<const CouetteRecord> replicas);

/// The row of a point that could not be finished: every measured value nan, status failed.
TableRow failed_row(const CouettePoint& point, std::string message);

/// The viscosity as known from what has been recorded so far, the same as in `summarize`; nan at zero rate.
statistics::Estimate current_viscosity(const CouettePoint& point, std::span<const CouetteRecord> replicas);

/// One row of replicas.csv: one replica as if it were the only one (its own cut, blocks and Student's factor).
struct ReplicaRow {
  std::int64_t particles = 0;
  double energy_per_particle = 0.0;
  double strain_rate = 0.0;
  int replica = 0;               ///< from 0
  std::uint64_t seed = 0;        ///< of the point; the replica's number is the rest of its seed
  double viscosity = 0.0;        ///< nan at zero rate
  double viscosity_error = 0.0;  ///< nan when none could be given
  double energy_rescaled = 0.0;
  double worst_energy_error = 0.0;
  std::int64_t steps = 0;
  std::int64_t subdivided_steps = 0;
};

ReplicaRow replica_row(const CouettePoint& point, int replica, const CouetteRecord& record);

}  // namespace lucy::cases
