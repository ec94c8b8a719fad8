// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/couette_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "cases/recorded_series.hpp"
#include "lucy/cases/place_of.hpp"

namespace lucy::cases {

namespace {

using statistics::Estimate;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr Estimate unknown = {not_a_number, not_a_number, not_a_number, 0};

consteval std::size_t observable(std::string_view name) { return place_of(observables, name); }

double shear_stress(const Sample& sample) {
  return sample[observable("pxy_kinetic")] + sample[observable("pxy_potential")];
}

double stress_difference(const Sample& sample) {
  return (sample[observable("pxx_kinetic")] + sample[observable("pxx_potential")]) -
         (sample[observable("pyy_kinetic")] + sample[observable("pyy_potential")]);
}

double potential_energy(const Sample& sample) { return sample[observable("potential_energy")]; }

/// By the rule in the header.
std::vector<std::size_t> cuts_of(std::span<const CouetteRecord> replicas) {
  return equilibration_cuts(replicas, shear_stress, stress_difference, potential_energy);
}

Series viscosity_series(double strain_rate, std::span<const CouetteRecord> replicas,
                        std::span<const std::size_t> cuts) {
  return series_of(replicas, cuts, [strain_rate](const Sample& sample) { return -shear_stress(sample) / strain_rate; });
}

TableRow row_head(const CouettePoint& point, double duration, int replicas) {
  TableRow row;
  row.particles = point.particles;
  row.energy_per_particle = point.energy_per_particle;
  row.strain_rate = point.strain_rate;
  row.step = point.step;
  row.duration = duration;
  row.replicas = replicas;
  row.estimates.fill(unknown);
  row.effective_samples = not_a_number;
  row.spread = {not_a_number, std::max(0, replicas - 1), not_a_number};
  return row;
}

// A run that goes on until its error bar is small stops where the bar is small by chance: only bars that rest on many
// effective samples count, for they scatter little.
constexpr double fewest_samples_of_a_target = 50.0;

}  // namespace

std::string_view status_name(RowStatus status) {
  switch (status) {
    case RowStatus::ok:
      return "ok";
    case RowStatus::too_short:
      return "short";
    case RowStatus::failed:
      return "failed";
  }
  return "failed";
}

bool target_reached(const CouettePoint& point, const Estimate& viscosity) {
  if (!point.target_relative_error || point.strain_rate == 0.0) return true;
  return viscosity.effective_samples >= fewest_samples_of_a_target &&
         viscosity.error <= *point.target_relative_error * std::abs(viscosity.value);
}

TableRow summarize(const CouettePoint& point, double duration, std::span<const CouetteRecord> replicas) {
  TableRow row = row_head(point, recorded_time(duration, replicas), static_cast<int>(replicas.size()));
  const std::vector<std::size_t> cuts = cuts_of(replicas);
  for (const CouetteRecord& record : replicas) {
    if (!std::isnan(row.worst_energy_error) && !(record.worst_energy_error <= row.worst_energy_error))
      row.worst_energy_error = record.worst_energy_error;  // not known of one: not known of all
    row.subdivided_steps += record.subdivided_steps;
  }
  row.equilibration_discarded = discarded_time<CouetteRecord>(replicas, cuts);

  for (std::size_t i = 0; i < observables.size(); ++i) {
    const auto place = std::find(quantities.begin(), quantities.end(), observables[i]) - quantities.begin();
    row.estimates[static_cast<std::size_t>(place)] =
        statistics::pooled_mean(series_of(replicas, cuts, [i](const Sample& sample) { return sample[i]; }));
  }

  const double rate = point.strain_rate;
  const Series key = rate != 0.0 ? viscosity_series(rate, replicas, cuts) : series_of(replicas, cuts, shear_stress);
  const Estimate estimate = statistics::pooled_mean(key);
  row.effective_samples = estimate.effective_samples;
  row.spread = statistics::replica_spread(key);
  if (rate != 0.0) {
    row.estimates[quantity("viscosity")] = estimate;
    row.estimates[quantity("normal_stress")] = statistics::pooled_mean(
        series_of(replicas, cuts, [rate](const Sample& sample) { return stress_difference(sample) / (rate * rate); }));
  }
  bool all_known = !std::isnan(estimate.error);
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const bool needs_a_rate = i == quantity("viscosity") || i == quantity("normal_stress");
    if (rate != 0.0 || !needs_a_rate) all_known = all_known && !std::isnan(row.estimates[i].error);
  }
  row.status = all_known && target_reached(point, estimate) ? RowStatus::ok : RowStatus::too_short;
  if (rate == 0.0) return row;
  if (point.thermostat == motion::Thermostat::none) {
    // The work of the flow stays in: the fluid heats up for ever, and no average has an error bar.
    for (Estimate& each : row.estimates) each.error = std::numeric_limits<double>::quiet_NaN();
    row.effective_samples = std::numeric_limits<double>::quiet_NaN();
    row.status = RowStatus::too_short;
  }
  return row;
}

TableRow failed_row(const CouettePoint& point, std::string message) {
  TableRow row = row_head(point, point.duration, point.replicas);
  row.equilibration_discarded = not_a_number;
  row.worst_energy_error = not_a_number;
  row.status = RowStatus::failed;
  row.failure = std::move(message);
  return row;
}

Estimate current_viscosity(const CouettePoint& point, std::span<const CouetteRecord> replicas) {
  if (point.strain_rate == 0.0) return unknown;
  return statistics::pooled_mean(viscosity_series(point.strain_rate, replicas, cuts_of(replicas)));
}

ReplicaRow replica_row(const CouettePoint& point, int replica, const CouetteRecord& record) {
  const Estimate viscosity = current_viscosity(point, std::span(&record, 1));
  ReplicaRow row;
  row.particles = point.particles;
  row.energy_per_particle = point.energy_per_particle;
  row.strain_rate = point.strain_rate;
  row.replica = replica;
  row.seed = point.seed;
  row.viscosity = viscosity.value;
  row.viscosity_error = viscosity.error;
  row.energy_rescaled = record.energy_rescaled;
  row.worst_energy_error = record.worst_energy_error;
  row.steps = record.steps;
  row.subdivided_steps = record.subdivided_steps;
  return row;
}

}  // namespace lucy::cases
