// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the replicas of one isomorphism case found becomes one row of isomorphism.csv: how much was compared, what
// differed first if anything did, and the mean of every sampled quantity with its error.
//
// A replica loses the samples that statistics/equilibration.hpp asks for in P_xy or in the potential energy. A case
// with a difference has no means: the run ended there.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "lucy/cases/couette_table.hpp"
#include "lucy/cases/isomorphism.hpp"
#include "lucy/statistics/pooling.hpp"

namespace lucy::cases {

/// One row of isomorphism.csv (reduced units).
struct IsomorphismRow {
  std::int64_t particles = 0;
  double energy_per_particle = 0.0;
  double density = 0.0;
  double range = 0.0;
  double strain_rate = 0.0;
  std::string thermostat;          ///< as in the input; "none" at rest
  double pressure = 0.0;           ///< P0
  double reference_density = 0.0;  ///< rho0
  double step = 0.0;
  double duration = 0.0;  ///< per replica
  int replicas = 0;
  std::int64_t steps = 0;        ///< compared, of all replicas
  std::int64_t comparisons = 0;  ///< numbers whose bits were compared, of all replicas
  std::optional<Difference> difference;
  int differing_replica = 0;  ///< the first one with a difference, from 0
  std::array<statistics::Estimate, isomorphism_quantities.size()> estimates{};  ///< in the order of the quantities
  double equilibration_discarded = 0.0;  ///< time, mean over replicas, beyond the equilibration that was not sampled
  double worst_energy_error = 0.0;       ///< largest over replicas of |dE|/N of one step
  std::int64_t subdivided_steps = 0;     ///< sum over replicas
  /// too_short: some mean has no error (a sheared flow without a thermostat, which heats up for ever, never has). The
  /// total energy needs none.
  RowStatus status = RowStatus::ok;
  std::string failure;  ///< why, when status is failed; not in the file

  /// Whether all bits were the same: "yes", "no"; "unknown" of a case that failed.
  std::string_view identical() const;
};

/// The row of a case from its replicas.
IsomorphismRow summarize(const IsomorphismPoint& point, std::span<const IsomorphismRecord> replicas);

/// The row of a case that could not be finished: nothing compared, every mean nan, status failed.
IsomorphismRow failed_row(const IsomorphismPoint& point, std::string message);

}  // namespace lucy::cases
