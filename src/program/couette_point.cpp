// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/couette_point.hpp"

#include <fmt/format.h>

#include "lucy/files/input.hpp"
#include "lucy/files/table_text.hpp"
#include "program/prediction.hpp"

namespace lucy::program {

std::string point_label(const cases::CouettePoint& point) {
  return fmt::format("N = {}, E/N = {}, rate {}", point.particles, files::format_plain(point.energy_per_particle),
                     files::format_plain(point.strain_rate));
}

std::string CouetteStatePoint::label() const { return point_label(settings()); }

std::string CouetteStatePoint::identity() const {
  files::SweepInput alone;
  alone.points = {settings()};
  return files::resolved_toml(alone);
}

std::vector<std::int64_t> CouetteStatePoint::milestones() const {
  std::vector<std::int64_t> intervals;
  for (const double duration : recorded_durations(settings()))
    intervals.push_back(sample_intervals(settings(), duration));
  return intervals;
}

double CouetteStatePoint::interval_cost() const { return program::interval_cost(settings()); }

statistics::Estimate CouetteStatePoint::estimate() const {
  const std::vector<Record> records = noted([](const Record& record) { return !record.samples.empty(); });
  return records.empty() ? CaseStatePoint::estimate() : cases::current_viscosity(settings(), records);
}

std::optional<PointResult> CouetteStatePoint::result_at(std::size_t stage, std::span<const Arrived> replicas,
                                                        std::span<const Record> records) {
  const auto durations = recorded_durations(settings());
  const double duration = durations[stage];
  PointResult result;
  result.row = cases::summarize(settings(), duration, records);
  const auto& viscosity = result.row.estimates[cases::quantity("viscosity")];
  // Negated, so that an error that is not known counts as one too large.
  const bool wanting = !cases::target_reached(settings(), viscosity);
  if (wanting && stage + 1 < durations.size()) return std::nullopt;

  std::vector<files::H5mdReplica> series;
  for (std::size_t number = 0; number < replicas.size(); ++number) {
    result.replicas.push_back(cases::replica_row(settings(), static_cast<int>(number), records[number]));
    series.push_back({static_cast<int>(number), &records[number],
                      run_of(*replicas[number].replica).intervals_needed(0.0), replicas[number].frames});
  }
  // The file states the duration that was recorded; the sample interval stays that of the one asked for.
  cases::CouettePoint recorded = settings();
  recorded.sample_interval = cases::sample_steps(settings()) * settings().step;
  recorded.duration = duration;
  files::write_h5md(this->series(), recorded, series, authorship());
  return result;
}

PointResult CouetteStatePoint::failed_result(const std::string& reason) const {
  PointResult result;
  result.row = cases::failed_row(settings(), reason);
  for (int number = 0; number < replicas(); ++number) {
    cases::ReplicaRow row = cases::replica_row(settings(), number, {});
    row.energy_rescaled = not_a_number;
    row.worst_energy_error = not_a_number;
    result.replicas.push_back(row);
  }
  return result;
}

}  // namespace lucy::program
