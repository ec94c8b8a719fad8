// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One state of a Green-Kubo run, as the scheduler runs it.
#pragma once

#include <string>
#include <vector>

#include "lucy/cases/green_kubo.hpp"
#include "lucy/cases/green_kubo_table.hpp"
#include "program/case_point.hpp"

namespace lucy::program {

class GreenKuboStatePoint final
    : public NotingStatePoint<cases::GreenKuboPoint, cases::GreenKuboRun, cases::GreenKuboResult> {
 public:
  using NotingStatePoint::NotingStatePoint;

  /// "N = 1024, E/N = 1"
  std::string label() const override;
  std::string identity() const override;
  std::vector<std::int64_t> milestones() const override { return {cases::interval_count(settings())}; }
  double interval_cost() const override;
  statistics::Estimate estimate() const override;

 private:
  std::optional<cases::GreenKuboResult> result_at(std::size_t stage, std::span<const Arrived> replicas,
                                                  std::span<const Record> records) override;
  cases::GreenKuboResult failed_result(const std::string& reason) const override;
};

}  // namespace lucy::program
