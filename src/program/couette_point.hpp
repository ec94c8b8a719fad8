// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One row of a sweep, as the scheduler runs it: its milestones are the recorded durations of prediction.hpp, of which a
// target_relative_error may ask for more than the first.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "lucy/cases/couette.hpp"
#include "lucy/cases/couette_table.hpp"
#include "program/experiment.hpp"

namespace lucy::program {

struct PointResult {
  cases::TableRow row;
  std::vector<cases::ReplicaRow> replicas;
  double seconds = 0.0;  ///< wall time, summed over replicas; nan for a point that failed
};

class CouetteStatePoint final : public StatePoint {
 public:
  /// `series`: where the point's H5MD file goes.
  CouetteStatePoint(const cases::CouettePoint& settings, std::filesystem::path series,
                    const files::H5mdAuthorship& authorship);

  std::string label() const override;
  std::string identity() const override;
  std::int64_t particles() const override { return settings_.particles; }
  int replicas() const override { return settings_.replicas; }
  bool records_frames() const override { return settings_.frame_interval > 0.0; }
  std::vector<std::int64_t> milestones() const override;
  double interval_cost() const override;
  std::unique_ptr<Replica> start(int replica, int threads) const override;
  void note(int number, const Replica& replica) override;
  statistics::Estimate estimate() const override;
  bool conclude(std::size_t stage, std::span<const Arrived> replicas) override;
  void fail(int replica, const std::string& message) override;
  void forget_notes() override;

  /// Once it is concluded or has failed.
  const PointResult& result() const { return result_; }

 private:
  cases::CouettePoint settings_;
  std::filesystem::path series_;
  files::H5mdAuthorship authorship_;
  PointResult result_;
  mutable std::mutex notes_lock_;
  std::vector<cases::CouetteRecord> notes_;  // by replica
};

/// "N = 1024, E/N = 1, rate 0.1"
std::string point_label(const cases::CouettePoint& point);

}  // namespace lucy::program
