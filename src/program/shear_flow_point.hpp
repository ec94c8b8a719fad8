// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One sheared fluid, as the scheduler runs it.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "lucy/cases/shear_flow.hpp"
#include "lucy/cases/shear_flow_table.hpp"
#include "program/experiment.hpp"

namespace lucy::program {

class ShearFlowStatePoint final : public StatePoint {
 public:
  /// `series`: where the point's H5MD file goes.
  ShearFlowStatePoint(const cases::ShearFlowPoint& settings, std::filesystem::path series,
                      const files::H5mdAuthorship& authorship);

  std::string label() const override;
  std::string identity() const override;
  std::int64_t particles() const override { return settings_.particles; }
  int replicas() const override { return settings_.replicas; }
  bool records_frames() const override { return settings_.frame_interval > 0.0; }
  std::vector<std::int64_t> milestones() const override { return {cases::interval_count(settings_)}; }
  double interval_cost() const override;
  std::unique_ptr<Replica> start(int replica, int threads) const override;
  void note(int number, const Replica& replica) override;
  statistics::Estimate estimate() const override;
  bool conclude(std::size_t stage, std::span<const Arrived> replicas) override;
  void fail(int replica, const std::string& message) override;
  void forget_notes() override;

  /// Once it is concluded or has failed.
  const cases::ShearFlowRow& row() const { return row_; }
  double seconds() const { return seconds_; }

 private:
  cases::ShearFlowPoint settings_;
  std::filesystem::path series_;
  files::H5mdAuthorship authorship_;
  cases::ShearFlowRow row_;
  double seconds_ = 0.0;
  mutable std::mutex notes_lock_;
  std::vector<cases::ShearFlowRecord> notes_;  // by replica
};

}  // namespace lucy::program
