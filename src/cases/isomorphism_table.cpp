// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/isomorphism_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "cases/recorded_series.hpp"

namespace lucy::cases {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr statistics::Estimate unknown = {not_a_number, not_a_number, not_a_number, 0};

double shear_stress(const IsomorphismSample& sample) {
  return sample[isomorphism_quantity("atoms_pxy_kinetic")] + sample[isomorphism_quantity("atoms_pxy_potential")];
}

double potential_energy(const IsomorphismSample& sample) {
  return sample[isomorphism_quantity("atoms_potential_energy")];
}

/// Kept by the motion at rest and by the isoenergetic thermostat: what little an integrator lets it drift is no
/// fluctuation about a mean, and has no error bar.
bool is_conserved(std::size_t quantity) {
  return quantity == isomorphism_quantity("atoms_energy") || quantity == isomorphism_quantity("smooth_energy");
}

IsomorphismRow row_head(const IsomorphismPoint& point) {
  const CouettePoint as_run = sweep_row(point);
  IsomorphismRow row;
  row.particles = point.particles;
  row.energy_per_particle = point.energy_per_particle;
  row.density = point.density;
  row.range = point.range;
  row.strain_rate = point.strain_rate;
  for (const auto& [name, thermostat] : motion::thermostat_names)
    if (thermostat == as_run.thermostat) row.thermostat = name;
  row.pressure = point.pressure;
  row.reference_density = point.reference_density;
  row.step = point.step;
  row.duration = point.duration;
  row.replicas = point.replicas;
  row.estimates.fill(unknown);
  return row;
}

}  // namespace

std::string_view IsomorphismRow::identical() const {
  if (status == RowStatus::failed) return "unknown";
  return difference ? "no" : "yes";
}

IsomorphismRow summarize(const IsomorphismPoint& point, std::span<const IsomorphismRecord> replicas) {
  IsomorphismRow row = row_head(point);
  for (std::size_t r = 0; r < replicas.size(); ++r) {
    const IsomorphismRecord& record = replicas[r];
    row.steps += record.steps;
    row.comparisons += record.comparisons;
    row.worst_energy_error = std::max(row.worst_energy_error, record.worst_energy_error);
    row.subdivided_steps += record.subdivided_steps;
    if (record.difference && !row.difference) {
      row.difference = record.difference;
      row.differing_replica = static_cast<int>(r);
    }
  }
  row.status = RowStatus::too_short;
  if (row.difference || replicas.empty()) return row;

  const std::vector<std::size_t> cuts = equilibration_cuts(replicas, shear_stress, potential_energy);
  row.equilibration_discarded = discarded_time(replicas, cuts);
  const bool heats_up = point.strain_rate != 0.0 && point.thermostat == motion::Thermostat::none;
  bool all_known = true;
  for (std::size_t q = 0; q < row.estimates.size(); ++q) {
    if (point.strain_rate == 0.0 && isomorphism_quantities[q].find("viscosity") != std::string_view::npos) continue;
    row.estimates[q] =
        statistics::pooled_mean(series_of(replicas, cuts, [q](const IsomorphismSample& sample) { return sample[q]; }));
    if (heats_up) row.estimates[q].error = not_a_number;
    all_known = all_known && (is_conserved(q) || !std::isnan(row.estimates[q].error));
  }
  if (all_known) row.status = RowStatus::ok;
  return row;
}

IsomorphismRow failed_row(const IsomorphismPoint& point, std::string message) {
  IsomorphismRow row = row_head(point);
  row.equilibration_discarded = not_a_number;
  row.worst_energy_error = not_a_number;
  row.status = RowStatus::failed;
  row.failure = std::move(message);
  return row;
}

}  // namespace lucy::cases
