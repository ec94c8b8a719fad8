// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One case of an isomorphism run, as the scheduler runs it.
#pragma once

#include <string>
#include <vector>

#include "lucy/cases/isomorphism.hpp"
#include "lucy/cases/isomorphism_table.hpp"
#include "program/experiment.hpp"

namespace lucy::program {

class IsomorphismStatePoint final : public StatePoint {
 public:
  explicit IsomorphismStatePoint(const cases::IsomorphismPoint& settings) : settings_(settings) {}

  std::string label() const override;
  std::string identity() const override;
  std::int64_t particles() const override { return settings_.particles; }
  int replicas() const override { return settings_.replicas; }
  bool records_frames() const override { return false; }
  std::vector<std::int64_t> milestones() const override { return {cases::interval_count(settings_)}; }
  double interval_cost() const override;
  std::unique_ptr<Replica> start(int replica, int threads) const override;
  /// What is found is whether anything differs: there is no estimate on the way.
  void note(int /*number*/, const Replica& /*replica*/) override {}
  statistics::Estimate estimate() const override;
  bool conclude(std::size_t stage, std::span<const Arrived> replicas) override;
  void fail(int replica, const std::string& message) override;
  void forget_notes() override {}

  /// Once it is concluded or has failed.
  const cases::IsomorphismRow& row() const { return row_; }
  double seconds() const { return seconds_; }

 private:
  cases::IsomorphismPoint settings_;
  cases::IsomorphismRow row_;
  double seconds_ = 0.0;
};

}  // namespace lucy::program
