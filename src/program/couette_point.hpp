// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One row of a sweep, as the scheduler runs it: its milestones are the recorded durations of prediction.hpp, of which a
// target_relative_error may ask for more than the first.
#pragma once

#include <string>
#include <vector>

#include "lucy/cases/couette.hpp"
#include "lucy/cases/couette_table.hpp"
#include "program/case_point.hpp"

namespace lucy::program {

struct PointResult {
  cases::TableRow row;
  std::vector<cases::ReplicaRow> replicas;
};

class CouetteStatePoint final : public NotingStatePoint<cases::CouettePoint, cases::CouetteRun, PointResult> {
 public:
  using NotingStatePoint::NotingStatePoint;

  std::string label() const override;
  std::string identity() const override;
  std::vector<std::int64_t> milestones() const override;
  double interval_cost() const override;
  statistics::Estimate estimate() const override;

 private:
  std::optional<PointResult> result_at(std::size_t stage, std::span<const Arrived> replicas,
                                       std::span<const Record> records) override;
  PointResult failed_result(const std::string& reason) const override;
};

/// "N = 1024, E/N = 1, rate 0.1"
std::string point_label(const cases::CouettePoint& point);

}  // namespace lucy::program
