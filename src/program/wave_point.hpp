// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One point of a shear-wave or temperature-wave run, as the scheduler runs it. What is found is a curve: there is no
// estimate on the way.
#pragma once

#include <string>
#include <vector>

#include "lucy/cases/wave.hpp"
#include "lucy/cases/wave_table.hpp"
#include "program/case_point.hpp"

namespace lucy::program {

class WaveStatePoint final : public CaseStatePoint<cases::WavePoint, cases::WaveRun, cases::WaveResult> {
 public:
  static constexpr double bytes_per_particle = 1150.0;  // the columns and kept pairs of a fluid

  using CaseStatePoint::CaseStatePoint;

  std::string label() const override;
  std::string identity() const override;
  std::vector<std::int64_t> milestones() const override { return {cases::wave_schedule(settings()).intervals()}; }
  /// In particle-steps of atoms with range 3, as which the steps of smooth particles count several times.
  double interval_cost() const override;

 private:
  std::optional<cases::WaveResult> result_at(std::size_t stage, std::span<const Arrived> replicas,
                                             std::span<const Record> records) override;
  cases::WaveResult failed_result(const std::string& reason) const override;
};

}  // namespace lucy::program
