// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/isomorphism_point.hpp"

#include <fmt/format.h>

#include <limits>

#include "lucy/files/isomorphism_input.hpp"
#include "program/couette_point.hpp"

namespace lucy::program {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

class IsomorphismReplica final : public Replica {
 public:
  IsomorphismReplica(const cases::IsomorphismPoint& point, int number, int threads) : run_(point, number, threads) {}

  void advance() override { run_.advance_one_interval(); }
  std::int64_t intervals_done() const override { return run_.intervals_done(); }
  bool frame_due() const override { return false; }
  cases::Frame frame() const override { return {}; }
  void save(ArchiveWriter& archive) const override { run_.save(archive); }
  void load(ArchiveReader& archive) override { run_.load(archive); }

  const cases::IsomorphismRun& run() const { return run_; }

 private:
  cases::IsomorphismRun run_;
};

}  // namespace

std::string IsomorphismStatePoint::label() const { return point_label(cases::sweep_row(settings_)); }

std::string IsomorphismStatePoint::identity() const {
  files::IsomorphismInput alone;
  alone.points = {settings_};
  return files::isomorphism_resolved_toml(alone);
}

double IsomorphismStatePoint::interval_cost() const {
  return static_cast<double>(settings_.particles) * cases::sample_steps(settings_);
}

std::unique_ptr<Replica> IsomorphismStatePoint::start(int replica, int threads) const {
  return std::make_unique<IsomorphismReplica>(settings_, replica, threads);
}

statistics::Estimate IsomorphismStatePoint::estimate() const { return {not_a_number, not_a_number, not_a_number, 0}; }

bool IsomorphismStatePoint::conclude(std::size_t /*stage*/, std::span<const Arrived> replicas) {
  std::vector<cases::IsomorphismRecord> records;
  for (const Arrived& arrived : replicas) {
    records.push_back(static_cast<const IsomorphismReplica&>(*arrived.replica).run().record());
    seconds_ += arrived.seconds;
  }
  row_ = cases::summarize(settings_, records);
  return true;
}

void IsomorphismStatePoint::fail(int replica, const std::string& message) {
  row_ = cases::failed_row(settings_,
                           settings_.replicas > 1 ? fmt::format("replica {}: {}", replica + 1, message) : message);
  seconds_ = not_a_number;
}

}  // namespace lucy::program
