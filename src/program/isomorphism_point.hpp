// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One case of an isomorphism run, as the scheduler runs it. What is found is whether anything differs: there is no
// estimate on the way.
#pragma once

#include <string>
#include <vector>

#include "lucy/cases/isomorphism.hpp"
#include "lucy/cases/isomorphism_table.hpp"
#include "program/case_point.hpp"

namespace lucy::program {

class IsomorphismStatePoint final
    : public CaseStatePoint<cases::IsomorphismPoint, cases::IsomorphismRun, cases::IsomorphismRow> {
 public:
  static constexpr double bytes_per_particle = 850.0;  // both systems

  using CaseStatePoint::CaseStatePoint;

  std::string label() const override;
  std::string identity() const override;
  std::vector<std::int64_t> milestones() const override { return {cases::interval_count(settings())}; }
  double interval_cost() const override;

 private:
  std::optional<cases::IsomorphismRow> result_at(std::size_t stage, std::span<const Arrived> replicas,
                                                 std::span<const Record> records) override;
  cases::IsomorphismRow failed_result(const std::string& reason) const override;
};

}  // namespace lucy::program
