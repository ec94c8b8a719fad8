// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/couette_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "lucy/statistics/equilibration.hpp"

namespace lucy::cases {

namespace {

using statistics::Estimate;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr Estimate unknown = {not_a_number, not_a_number, not_a_number, 0};

consteval std::size_t observable(std::string_view name) {
  for (std::size_t i = 0; i < observables.size(); ++i)
    if (observables[i] == name) return i;
  throw "no such observable";
}

double shear_stress(const Sample& sample) {
  return sample[observable("pxy_kinetic")] + sample[observable("pxy_potential")];
}

double stress_difference(const Sample& sample) {
  return (sample[observable("pxx_kinetic")] + sample[observable("pxx_potential")]) -
         (sample[observable("pyy_kinetic")] + sample[observable("pyy_potential")]);
}

double potential_energy(const Sample& sample) { return sample[observable("potential_energy")]; }

using Series = std::vector<std::vector<double>>;

/// What `of` makes of each sample after the cuts, one series per replica.
template <class Quantity>
Series series_of(std::span<const CouetteRecord> replicas, std::span<const std::size_t> cuts, Quantity of) {
  Series series(replicas.size());
  for (std::size_t r = 0; r < replicas.size(); ++r) {
    const std::span<const Sample> kept = std::span(replicas[r].samples).subspan(cuts[r]);
    series[r].reserve(kept.size());
    for (const Sample& sample : kept) series[r].push_back(of(sample));
  }
  return series;
}

std::vector<double> average(const Series& series) {
  std::vector<double> mean(series.front().size(), 0.0);
  for (const std::vector<double>& replica : series)
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += replica[i] / static_cast<double>(series.size());
  return mean;
}

/// Samples to drop from each replica, by the rule in the header.
std::vector<std::size_t> equilibration_cuts(std::span<const CouetteRecord> replicas) {
  std::vector<std::size_t> cuts(replicas.size(), 0);
  const bool equally_long = std::all_of(replicas.begin(), replicas.end(), [&](const CouetteRecord& record) {
    return record.samples.size() == replicas.front().samples.size();
  });
  const std::vector<std::size_t> all_samples(replicas.size(), 0);
  for (const auto key : {shear_stress, stress_difference, potential_energy}) {
    const Series series = series_of(replicas, all_samples, key);
    const std::size_t common = replicas.size() > 1 && equally_long ? statistics::equilibration_cut(average(series)) : 0;
    for (std::size_t r = 0; r < replicas.size(); ++r)
      cuts[r] = std::max({cuts[r], common, statistics::equilibration_cut(series[r])});
  }
  return cuts;
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

// The time that was recorded: the duration asked for, unless that is no whole number of samples.
double recorded_time(double duration, std::span<const CouetteRecord> replicas) {
  if (replicas.empty() || replicas[0].samples.empty()) return duration;
  const double recorded = replicas[0].sample_interval * static_cast<double>(replicas[0].samples.size());
  return std::abs(recorded - duration) > 1e-6 * duration ? recorded : duration;
}

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
  const std::vector<std::size_t> cuts = equilibration_cuts(replicas);
  double discarded = 0.0;
  for (std::size_t r = 0; r < replicas.size(); ++r) {
    discarded += static_cast<double>(cuts[r]) * replicas[r].sample_interval;
    row.worst_energy_error = std::max(row.worst_energy_error, replicas[r].worst_energy_error);
    row.subdivided_steps += replicas[r].subdivided_steps;
  }
  if (!replicas.empty()) row.equilibration_discarded = discarded / static_cast<double>(replicas.size());

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
  return statistics::pooled_mean(viscosity_series(point.strain_rate, replicas, equilibration_cuts(replicas)));
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
