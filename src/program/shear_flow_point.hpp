// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One sheared fluid, as the scheduler runs it.
#pragma once

#include <string>
#include <vector>

#include "lucy/cases/shear_flow.hpp"
#include "lucy/cases/shear_flow_table.hpp"
#include "program/case_point.hpp"

namespace lucy::program {

class ShearFlowStatePoint final
    : public NotingStatePoint<cases::ShearFlowPoint, cases::ShearFlowRun, cases::ShearFlowRow> {
 public:
  static constexpr double bytes_per_particle = 1150.0;  // the columns and kept pairs of a fluid

  using NotingStatePoint::NotingStatePoint;

  std::string label() const override;
  std::string identity() const override;
  std::vector<std::int64_t> milestones() const override { return {cases::interval_count(settings())}; }
  double interval_cost() const override;
  statistics::Estimate estimate() const override;

 private:
  std::optional<cases::ShearFlowRow> result_at(std::size_t stage, std::span<const Arrived> replicas,
                                               std::span<const Record> records) override;
  cases::ShearFlowRow failed_result(const std::string& reason) const override;
};

}  // namespace lucy::program
