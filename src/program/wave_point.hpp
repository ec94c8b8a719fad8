// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One point of a shear-wave or temperature-wave run, as the scheduler runs it.
#pragma once

#include <filesystem>
#include <string>

#include "lucy/cases/wave.hpp"
#include "lucy/cases/wave_table.hpp"
#include "program/experiment.hpp"

namespace lucy::program {

class WaveStatePoint final : public StatePoint {
 public:
  /// `frames`: where the point's H5MD file goes, if it records frames.
  WaveStatePoint(const cases::WavePoint& settings, std::filesystem::path frames,
                 const files::H5mdAuthorship& authorship);

  std::string label() const override;
  std::string identity() const override;
  std::int64_t particles() const override { return settings_.particles; }
  int replicas() const override { return settings_.replicas; }
  bool records_frames() const override { return settings_.frame_interval > 0.0; }
  std::vector<std::int64_t> milestones() const override { return {cases::wave_schedule(settings_).intervals()}; }
  /// In particle-steps of atoms with range 3, as which the steps of smooth particles count several times.
  double interval_cost() const override;
  std::unique_ptr<Replica> start(int replica, int threads) const override;
  /// What is found is a curve: there is no estimate on the way.
  void note(int /*number*/, const Replica& /*replica*/) override {}
  statistics::Estimate estimate() const override;
  bool conclude(std::size_t stage, std::span<const Arrived> replicas) override;
  void fail(int replica, const std::string& message) override;
  void forget_notes() override {}

  /// Once it is concluded or has failed.
  const cases::WaveResult& result() const { return result_; }
  double seconds() const { return seconds_; }

 private:
  cases::WavePoint settings_;
  std::filesystem::path frames_;
  files::H5mdAuthorship authorship_;
  cases::WaveResult result_;
  double seconds_ = 0.0;
};

}  // namespace lucy::program
