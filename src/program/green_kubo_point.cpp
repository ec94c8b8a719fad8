// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/green_kubo_point.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "lucy/files/green_kubo_input.hpp"
#include "lucy/files/h5md.hpp"
#include "lucy/files/table_text.hpp"

namespace lucy::program {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

class GreenKuboReplica final : public Replica {
 public:
  GreenKuboReplica(const cases::GreenKuboPoint& point, int number, int threads) : run_(point, number, threads) {}

  void advance() override { run_.advance_one_interval(); }
  std::int64_t intervals_done() const override { return run_.intervals_done(); }
  bool frame_due() const override { return run_.frame_due(); }
  cases::Frame frame() const override { return run_.frame(); }
  void save(ArchiveWriter& archive) const override { run_.save(archive); }
  void load(ArchiveReader& archive) override { run_.load(archive); }

  const cases::GreenKuboRun& run() const { return run_; }

 private:
  cases::GreenKuboRun run_;
};

const cases::GreenKuboRun& run_of(const Replica& replica) {
  return static_cast<const GreenKuboReplica&>(replica).run();
}

}  // namespace

std::string state_label(const cases::GreenKuboPoint& point) {
  return fmt::format("N = {}, E/N = {}", point.particles, files::format_plain(point.energy_per_particle));
}

GreenKuboStatePoint::GreenKuboStatePoint(const cases::GreenKuboPoint& settings, std::filesystem::path series,
                                         const files::H5mdAuthorship& authorship)
    : settings_(settings),
      series_(std::move(series)),
      authorship_(authorship),
      notes_(static_cast<std::size_t>(settings.replicas)) {}

std::string GreenKuboStatePoint::label() const { return state_label(settings_); }

std::string GreenKuboStatePoint::identity() const {
  files::GreenKuboInput alone;
  alone.points = {settings_};
  return files::green_kubo_resolved_toml(alone);
}

std::vector<std::int64_t> GreenKuboStatePoint::milestones() const { return {cases::interval_count(settings_)}; }

double GreenKuboStatePoint::interval_cost() const {
  return static_cast<double>(settings_.particles) * static_cast<double>(cases::interval_steps(settings_));
}

std::unique_ptr<Replica> GreenKuboStatePoint::start(int replica, int threads) const {
  return std::make_unique<GreenKuboReplica>(settings_, replica, threads);
}

void GreenKuboStatePoint::note(int number, const Replica& replica) {
  const std::scoped_lock lock(notes_lock_);
  notes_[static_cast<std::size_t>(number)] = run_of(replica).record();
}

statistics::Estimate GreenKuboStatePoint::estimate() const {
  std::vector<cases::GreenKuboRecord> records;
  {
    const std::scoped_lock lock(notes_lock_);
    for (const auto& record : notes_)
      if (!record.blocks.empty()) records.push_back(record);
  }
  return cases::current_viscosity(settings_, records);
}

void GreenKuboStatePoint::forget_notes() {
  const std::scoped_lock lock(notes_lock_);
  for (auto& record : notes_) record = {};
}

bool GreenKuboStatePoint::conclude(std::size_t /*stage*/, std::span<const Arrived> replicas) {
  std::vector<cases::GreenKuboRecord> records;
  std::vector<files::H5mdGreenKuboReplica> series;
  for (const Arrived& arrived : replicas) {
    const cases::GreenKuboRun& run = run_of(*arrived.replica);
    series.push_back(
        {static_cast<int>(series.size()), &run.record(), run.series(), run.first_recorded_step(), arrived.frames});
    records.push_back(run.record());
    seconds_ += arrived.seconds;
  }
  files::write_h5md(series_, settings_, series, authorship_);
  result_ = cases::summarize(settings_, records);
  return true;
}

void GreenKuboStatePoint::fail(int replica, const std::string& message) {
  result_ = {};
  result_.row = cases::failed_row(
      settings_, settings_.replicas > 1 ? fmt::format("replica {}: {}", replica + 1, message) : message);
  seconds_ = not_a_number;
}

}  // namespace lucy::program
