// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/shear_flow_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cases/recorded_series.hpp"

namespace lucy::cases {

namespace {

using statistics::Estimate;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr Estimate unknown = {not_a_number, not_a_number, not_a_number, 0};

double average(const ShearFlowSample& sample, std::size_t place) { return sample.averages[place]; }

double shear_stress(const ShearFlowSample& sample) {
  return average(sample, shear_flow_average("pxy_carried")) + average(sample, shear_flow_average("pxy_pressure")) +
         average(sample, shear_flow_average("pxy_newtonian"));
}

double kinetic_temperature(const ShearFlowSample& sample) {
  return average(sample, shear_flow_average("kinetic_temperature"));
}

double entropy_surplus(const ShearFlowSample& sample) {
  return sample.instants[shear_flow_instant("entropy_viscosity")] +
         sample.instants[shear_flow_instant("entropy_conduction")] -
         sample.instants[shear_flow_instant("entropy_removed")];
}

double value_of(const ShearFlowPoint& point, const ShearFlowSample& sample, std::size_t quantity) {
  const double rate = point.strain_rate;
  switch (quantity) {
    case shear_flow_quantity("viscosity"):
      return -shear_stress(sample) / rate;
    case shear_flow_quantity("viscosity_excess"):
      return -shear_stress(sample) / rate - point.viscosity;
    case shear_flow_quantity("viscosity_carried"):
      return -average(sample, shear_flow_average("pxy_carried")) / rate;
    case shear_flow_quantity("viscosity_pressure"):
      return -average(sample, shear_flow_average("pxy_pressure")) / rate;
    case shear_flow_quantity("viscosity_newtonian"):
      return -average(sample, shear_flow_average("pxy_newtonian")) / rate;
    case shear_flow_quantity("entropy_surplus"):
      return entropy_surplus(sample);
    default:
      break;
  }
  const std::size_t place = quantity - shear_flow_derived;
  return place < shear_flow_averages.size() ? sample.averages[place]
                                            : sample.instants[place - shear_flow_averages.size()];
}

/// Whether a quantity says anything of this fluid.
bool has_meaning(const ShearFlowPoint& point, std::size_t quantity) {
  const spam::Fluid<2> fluid = fluid_of(point);
  switch (quantity) {
    case shear_flow_quantity("velocity_gradient"):
      return !fluid.transport.none();
    case shear_flow_quantity("temperature"):
    case shear_flow_quantity("entropy_surplus"):
    case shear_flow_quantity("entropy_viscosity"):
    case shear_flow_quantity("entropy_conduction"):
    case shear_flow_quantity("entropy_removed"):
    case shear_flow_quantity("least_entropy_production"):
      return spam::has_temperature(fluid.state);
    default:
      return true;
  }
}

/// By the rule in the header.
std::vector<std::size_t> cuts_of(std::span<const ShearFlowRecord> replicas) {
  return equilibration_cuts(replicas, shear_stress, kinetic_temperature);
}

Series series_of_quantity(const ShearFlowPoint& point, std::span<const ShearFlowRecord> replicas,
                          std::span<const std::size_t> cuts, std::size_t quantity) {
  return series_of(replicas, cuts, [&](const ShearFlowSample& sample) { return value_of(point, sample, quantity); });
}

ShearFlowRow row_head(const ShearFlowPoint& point, double duration) {
  ShearFlowRow row;
  row.settings = point;
  row.duration = duration;
  row.estimates.fill(unknown);
  row.effective_samples = not_a_number;
  return row;
}

std::vector<std::string> warnings_of(const ShearFlowRow& row, const statistics::ReplicaSpread& spread) {
  std::vector<std::string> warnings;
  if (row[shear_flow_quantity("density_wave")].value > homogeneous_density_wave)
    warnings.push_back(
        fmt::format("the flow is not homogeneous: it has fallen into bands, a dense, cool one that is sheared slowly "
                    "and a thin, hot one that is sheared fast (density_wave {:.2f}); the values are those of the whole",
                    row[shear_flow_quantity("density_wave")].value));
  if (spread.contradicts_errors()) warnings.push_back(spread_warning(spread));
  const statistics::Estimate& made = row[shear_flow_quantity("heating")];
  const statistics::Estimate& removed = row[shear_flow_quantity("heat_removed")];
  const double apart = std::abs(made.value - removed.value);
  if (const double error = std::hypot(made.error, removed.error); error > 0.0 && apart > 4.0 * error)
    warnings.push_back(
        fmt::format("heat made and heat removed differ by {:.2g} errors: the flow is not steady yet, so do not believe "
                    "the error bars; lengthen run.equilibration",
                    apart / error));
  return warnings;
}

}  // namespace

ShearFlowRow summarize(const ShearFlowPoint& point, std::span<const ShearFlowRecord> all_replicas) {
  const bool alike = all_replicas.size() > 1 && all_replicas_alike(point);
  const auto replicas = alike ? all_replicas.first(1) : all_replicas;
  ShearFlowRow row = row_head(point, recorded_time(point.duration, replicas));
  for (const ShearFlowRecord& record : replicas) {
    row.worst_energy_error = std::max(row.worst_energy_error, record.worst_energy_error);
    if (std::abs(record.energy_drift) > std::abs(row.energy_drift)) row.energy_drift = record.energy_drift;
    row.subdivided_steps += record.subdivided_steps;
  }
  const std::vector<std::size_t> cuts = cuts_of(replicas);
  row.equilibration_discarded = discarded_time(replicas, cuts);

  // The work of the flow stays in without cooling: the fluid heats up for ever, and no average has an error bar.
  const bool steady = point.cooling != motion::Cooling::none;
  bool all_known = true;
  for (std::size_t q = 0; q < row.estimates.size(); ++q) {
    if (!has_meaning(point, q)) continue;
    row.estimates[q] = statistics::pooled_mean(series_of_quantity(point, replicas, cuts, q));
    if (!steady) row.estimates[q].error = not_a_number;
    all_known = all_known && !std::isnan(row.estimates[q].error);
  }
  row.status = all_known ? RowStatus::ok : RowStatus::too_short;
  statistics::ReplicaSpread spread = {not_a_number, 0, not_a_number};
  if (steady) {
    row.effective_samples = row[shear_flow_quantity("viscosity")].effective_samples;
    spread = statistics::replica_spread(series_of_quantity(point, replicas, cuts, shear_flow_quantity("viscosity")));
  }
  row.warnings = warnings_of(row, spread);
  if (alike)
    row.warnings.emplace_back(
        "all replicas are the same, since start.disorder and start.noise are 0: the first alone counts");
  return row;
}

ShearFlowRow failed_row(const ShearFlowPoint& point, std::string message) {
  ShearFlowRow row = row_head(point, point.duration);
  row.equilibration_discarded = not_a_number;
  row.worst_energy_error = not_a_number;
  row.energy_drift = not_a_number;
  row.status = RowStatus::failed;
  row.failure = std::move(message);
  return row;
}

Estimate current_viscosity(const ShearFlowPoint& point, std::span<const ShearFlowRecord> replicas) {
  if (replicas.empty()) return unknown;
  return statistics::pooled_mean(
      series_of_quantity(point, replicas, cuts_of(replicas), shear_flow_quantity("viscosity")));
}

}  // namespace lucy::cases
