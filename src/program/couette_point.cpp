// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/couette_point.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "lucy/files/input.hpp"
#include "lucy/files/table_text.hpp"
#include "program/prediction.hpp"

namespace lucy::program {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

class CouetteReplica final : public Replica {
 public:
  CouetteReplica(const cases::CouettePoint& point, int number, int threads) : run_(point, number, threads) {}

  void advance() override { run_.advance_one_sample(); }
  std::int64_t intervals_done() const override { return run_.intervals_done(); }
  bool frame_due() const override { return run_.frame_due(); }
  cases::Frame frame() const override { return run_.frame(); }
  void save(ArchiveWriter& archive) const override { run_.save(archive); }
  void load(ArchiveReader& archive) override { run_.load(archive); }

  const cases::CouetteRun& run() const { return run_; }

 private:
  cases::CouetteRun run_;
};

const cases::CouetteRun& run_of(const Replica& replica) { return static_cast<const CouetteReplica&>(replica).run(); }

}  // namespace

std::string point_label(const cases::CouettePoint& point) {
  return fmt::format("N = {}, E/N = {}, rate {}", point.particles, files::format_plain(point.energy_per_particle),
                     files::format_plain(point.strain_rate));
}

CouetteStatePoint::CouetteStatePoint(const cases::CouettePoint& settings, std::filesystem::path series,
                                     const files::H5mdAuthorship& authorship)
    : settings_(settings),
      series_(std::move(series)),
      authorship_(authorship),
      notes_(static_cast<std::size_t>(settings.replicas)) {}

std::string CouetteStatePoint::label() const { return point_label(settings_); }

std::string CouetteStatePoint::identity() const {
  files::SweepInput alone;
  alone.points = {settings_};
  return files::resolved_toml(alone);
}

std::vector<std::int64_t> CouetteStatePoint::milestones() const {
  std::vector<std::int64_t> intervals;
  for (const double duration : recorded_durations(settings_))
    intervals.push_back(sample_intervals(settings_, duration));
  return intervals;
}

double CouetteStatePoint::interval_cost() const { return program::interval_cost(settings_); }

std::unique_ptr<Replica> CouetteStatePoint::start(int replica, int threads) const {
  return std::make_unique<CouetteReplica>(settings_, replica, threads);
}

void CouetteStatePoint::note(int number, const Replica& replica) {
  const std::scoped_lock lock(notes_lock_);
  notes_[static_cast<std::size_t>(number)] = run_of(replica).record();
}

statistics::Estimate CouetteStatePoint::estimate() const {
  std::vector<cases::CouetteRecord> records;
  {
    const std::scoped_lock lock(notes_lock_);
    for (const auto& record : notes_)
      if (!record.samples.empty()) records.push_back(record);
  }
  if (records.empty()) return {not_a_number, not_a_number, not_a_number, 0};
  return cases::current_viscosity(settings_, records);
}

void CouetteStatePoint::forget_notes() {
  const std::scoped_lock lock(notes_lock_);
  for (auto& record : notes_) record = {};
}

bool CouetteStatePoint::conclude(std::size_t stage, std::span<const Arrived> replicas) {
  std::vector<cases::CouetteRecord> records;
  for (const Arrived& arrived : replicas) records.push_back(run_of(*arrived.replica).record());
  const auto durations = recorded_durations(settings_);
  const double duration = durations[stage];
  cases::TableRow row = cases::summarize(settings_, duration, records);
  const auto& viscosity = row.estimates[cases::quantity("viscosity")];
  // Negated, so that an error that is not known counts as one too large.
  const bool wanting = !cases::target_reached(settings_, viscosity);
  if (wanting && stage + 1 < durations.size()) return false;

  PointResult result;
  result.row = std::move(row);
  std::vector<files::H5mdReplica> series;
  for (std::size_t number = 0; number < replicas.size(); ++number) {
    result.replicas.push_back(cases::replica_row(settings_, static_cast<int>(number), records[number]));
    result.seconds += replicas[number].seconds;
    series.push_back({static_cast<int>(number), &records[number],
                      run_of(*replicas[number].replica).intervals_needed(0.0), replicas[number].frames});
  }
  // The file states the duration that was recorded; the sample interval stays that of the one asked for.
  cases::CouettePoint recorded = settings_;
  recorded.sample_interval = cases::sample_steps(settings_) * settings_.step;
  recorded.duration = duration;
  files::write_h5md(series_, recorded, series, authorship_);
  result_ = std::move(result);
  return true;
}

void CouetteStatePoint::fail(int replica, const std::string& message) {
  result_.row = cases::failed_row(
      settings_, settings_.replicas > 1 ? fmt::format("replica {}: {}", replica + 1, message) : message);
  for (int number = 0; number < settings_.replicas; ++number) {
    cases::ReplicaRow row = cases::replica_row(settings_, number, {});
    row.energy_rescaled = not_a_number;
    row.worst_energy_error = not_a_number;
    result_.replicas.push_back(row);
  }
  result_.seconds = not_a_number;
}

}  // namespace lucy::program
