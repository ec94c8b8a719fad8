// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One fluid at one Rayleigh number on one mesh, as the scheduler runs it.
#pragma once

#include <string>
#include <vector>

#include "lucy/cases/benard_grid.hpp"
#include "lucy/cases/benard_grid_table.hpp"
#include "program/case_point.hpp"

namespace lucy::program {

class BenardGridStatePoint final
    : public CaseStatePoint<cases::BenardGridPoint, cases::BenardGridRun, cases::BenardGridRow> {
 public:
  using CaseStatePoint::CaseStatePoint;

  std::string label() const override;
  std::string identity() const override;
  std::vector<std::int64_t> milestones() const override { return {cases::interval_count(settings())}; }
  /// In node-steps.
  double interval_cost() const override;

 private:
  std::optional<cases::BenardGridRow> result_at(std::size_t stage, std::span<const Arrived> replicas,
                                                std::span<const Record> records) override;
  cases::BenardGridRow failed_result(const std::string& reason) const override;
};

}  // namespace lucy::program
