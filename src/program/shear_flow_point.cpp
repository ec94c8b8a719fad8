// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/shear_flow_point.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "lucy/files/shear_flow_h5md.hpp"
#include "lucy/files/shear_flow_input.hpp"
#include "lucy/files/shear_flow_text.hpp"

namespace lucy::program {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

class ShearFlowReplica final : public Replica {
 public:
  ShearFlowReplica(const cases::ShearFlowPoint& point, int number, int threads) : run_(point, number, threads) {}

  void advance() override { run_.advance_one_interval(); }
  std::int64_t intervals_done() const override { return run_.intervals_done(); }
  bool frame_due() const override { return run_.frame_due(); }
  cases::Frame frame() const override { return run_.frame(); }
  void save(ArchiveWriter& archive) const override { run_.save(archive); }
  void load(ArchiveReader& archive) override { run_.load(archive); }

  const cases::ShearFlowRun& run() const { return run_; }

 private:
  cases::ShearFlowRun run_;
};

const cases::ShearFlowRun& run_of(const Replica& replica) {
  return static_cast<const ShearFlowReplica&>(replica).run();
}

}  // namespace

ShearFlowStatePoint::ShearFlowStatePoint(const cases::ShearFlowPoint& settings, std::filesystem::path series,
                                         const files::H5mdAuthorship& authorship)
    : settings_(settings),
      series_(std::move(series)),
      authorship_(authorship),
      notes_(static_cast<std::size_t>(settings.replicas)) {}

std::string ShearFlowStatePoint::label() const { return files::shear_flow_label(settings_); }

std::string ShearFlowStatePoint::identity() const {
  files::ShearFlowInput alone;
  alone.points = {settings_};
  return files::shear_flow_resolved_toml(alone);
}

double ShearFlowStatePoint::interval_cost() const {
  return static_cast<double>(settings_.particles) * cases::sample_steps(settings_);
}

std::unique_ptr<Replica> ShearFlowStatePoint::start(int replica, int threads) const {
  return std::make_unique<ShearFlowReplica>(settings_, replica, threads);
}

void ShearFlowStatePoint::note(int number, const Replica& replica) {
  const std::scoped_lock lock(notes_lock_);
  notes_[static_cast<std::size_t>(number)] = run_of(replica).record();
}

statistics::Estimate ShearFlowStatePoint::estimate() const {
  std::vector<cases::ShearFlowRecord> records;
  {
    const std::scoped_lock lock(notes_lock_);
    for (const auto& record : notes_)
      if (!record.samples.empty()) records.push_back(record);
  }
  return cases::current_viscosity(settings_, records);
}

void ShearFlowStatePoint::forget_notes() {
  const std::scoped_lock lock(notes_lock_);
  for (auto& record : notes_) record = {};
}

bool ShearFlowStatePoint::conclude(std::size_t /*stage*/, std::span<const Arrived> replicas) {
  std::vector<cases::ShearFlowRecord> records;
  std::vector<files::H5mdShearFlowReplica> series;
  for (const Arrived& arrived : replicas) {
    const cases::ShearFlowRecord& record = run_of(*arrived.replica).record();
    series.push_back({static_cast<int>(series.size()), &record, arrived.frames});
    records.push_back(record);
    seconds_ += arrived.seconds;
  }
  files::write_h5md(series_, settings_, series, authorship_);
  row_ = cases::summarize(settings_, records);
  return true;
}

void ShearFlowStatePoint::fail(int replica, const std::string& message) {
  row_ = cases::failed_row(settings_,
                           settings_.replicas > 1 ? fmt::format("replica {}: {}", replica + 1, message) : message);
  seconds_ = not_a_number;
}

}  // namespace lucy::program
