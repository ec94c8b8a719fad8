// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One fluid of smooth particles between a hot floor and a cold ceiling, as the scheduler runs it.
#pragma once

#include <string>
#include <vector>

#include "lucy/cases/benard.hpp"
#include "lucy/cases/benard_table.hpp"
#include "program/case_point.hpp"

namespace lucy::program {

class BenardStatePoint final : public NotingStatePoint<cases::BenardPoint, cases::BenardRun, cases::BenardRow> {
 public:
  static constexpr double bytes_per_particle = 1400.0;  // the columns and kept pairs of a fluid, and its last state

  using NotingStatePoint::NotingStatePoint;

  std::string label() const override;
  std::string identity() const override;
  std::vector<std::int64_t> milestones() const override { return {cases::interval_count(settings())}; }
  double interval_cost() const override;
  statistics::Estimate estimate() const override;

 private:
  std::optional<cases::BenardRow> result_at(std::size_t stage, std::span<const Arrived> replicas,
                                            std::span<const Record> records) override;
  cases::BenardRow failed_result(const std::string& reason) const override;
};

}  // namespace lucy::program
