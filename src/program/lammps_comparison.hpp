// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The states that `lucy lammps check` runs in both engines, each in folders of its own: what is run, and which of the
// comparisons of cases/engine_verdict.hpp are made of it.
#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "lucy/cases/couette.hpp"
#include "lucy/cases/couette_table.hpp"
#include "lucy/cases/engine_verdict.hpp"
#include "program/lammps_commands.hpp"
#include "program/lammps_process.hpp"

namespace lucy::program {

/// Of the four sheared states.
inline constexpr std::array<double, 2> sheared_energies = {1.0, 0.5};
inline constexpr std::array<double, 2> sheared_rates = {0.1, 0.5};

/// Somebody asked to stop, or another task failed.
struct Interrupted {};

/// Each engine's row, and how both compare.
struct TaskResult {
  std::vector<cases::VerdictLine> lines;
  std::vector<cases::TableRow> lucy;
  std::vector<cases::TableRow> lammps;

  void append(const TaskResult& more) {
    lines.insert(lines.end(), more.lines.begin(), more.lines.end());
    lucy.insert(lucy.end(), more.lucy.begin(), more.lucy.end());
    lammps.insert(lammps.end(), more.lammps.begin(), more.lammps.end());
  }
};

/// Throws BadInput where one of the states that will be run is impossible.
void refuse_impossible_states(const cases::CouettePoint& base);

/// Its member functions may be called from several threads at once.
class LammpsComparison {
 public:
  /// Of the first state of an input; results go into `directory`, which exists when one is asked for.
  LammpsComparison(const cases::CouettePoint& base, std::filesystem::path directory, const Lammps& lammps);

  /// A configuration of a free and one of a sheared fluid, by the table and by the exact form.
  TaskResult single_points();
  /// Trajectories, averages and Green-Kubo from one start at constant energy.
  TaskResult constant_energy();
  /// Averages, and heat over work, at the temperature that Lucy's ergostat run has.
  TaskResult shear(double energy, double rate);

  /// Makes all that is running throw Interrupted.
  void stop() { stopped_ = true; }

  /// What runs in LAMMPS, and the seconds that it took in all.
  std::string status() const { return status_.get(); }
  double lammps_seconds() const { return lammps_seconds_; }

 private:
  LammpsJob case_of(const std::string& name, const cases::CouettePoint& point, const cases::Frame& start,
                    double temperature) const;
  void run_lammps(const LammpsJob& job);
  cases::EngineSeries series_of(const LammpsJob& job);
  bool given_up() const;
  void advance(cases::CouetteRun& run, double duration, const std::function<void()>& look = {}) const;
  cases::CouetteRecord run_here(const cases::CouettePoint& point) const;
  std::vector<cases::Frame> frames_here(cases::CouettePoint point, motion::Integrator integrator,
                                        double duration) const;
  std::vector<cases::VerdictLine> stay_together(const cases::CouettePoint& point);

  cases::CouettePoint base_;
  std::filesystem::path directory_;
  const Lammps& lammps_;
  SharedLine status_;
  std::atomic<bool> stopped_ = false;
  std::mutex lock_;
  double lammps_seconds_ = 0.0;
};

}  // namespace lucy::program
