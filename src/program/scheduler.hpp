// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sweep on the threads of this machine. A task is one replica of one point, on its way to one of the point's recorded
// durations (prediction.hpp); the longest tasks are taken first. Systems of large_system particles and more come first,
// one after the other, with all threads inside; the others then run one task per thread. When all replicas of a point
// have arrived, the point is summarised and ends there, or is sent on to its next duration when a
// target_relative_error asks for that. So neither the number of threads nor the order of tasks touches a result.
//
// Every task writes its state at each checkpoint_interval and when it arrives or is stopped; a scheduler made over
// these files goes on from them, with the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/cases/couette.hpp"
#include "lucy/cases/couette_table.hpp"
#include "lucy/files/h5md.hpp"

namespace lucy::program {

struct PointResult {
  cases::TableRow row;
  std::vector<cases::ReplicaRow> replicas;
  double seconds = 0.0;  ///< wall time, summed over replicas; nan for a point that failed
};

/// How far the sweep is; work in particle-steps.
struct SweepState {
  std::size_t points = 0;
  std::size_t points_done = 0;
  double fraction = 0.0;           ///< of the work known so far
  double seconds_left = 0.0;       ///< nan until a speed has been measured
  std::string label;               ///< the point that is being worked on; empty between points
  statistics::Estimate viscosity;  ///< of that point, from what has been recorded so far
};

class Scheduler {
 public:
  struct Settings {
    std::filesystem::path directory;    ///< for point_001.h5 ...
    std::filesystem::path checkpoints;  ///< must exist
    int threads = 1;
    double checkpoint_interval = 10.0;  ///< seconds
    std::string build;                  ///< see build_identity.hpp
    files::H5mdAuthorship authorship;
    bool watched = false;                              ///< state() will be asked for estimates
    std::function<bool()> stop_asked = {};             ///< asked often, by every thread
    std::function<void(const std::string&)> say = {};  ///< a sentence for the user; called by any thread
  };

  /// Reads which checkpoints there are; tells of those that cannot be used.
  Scheduler(std::span<const cases::CouettePoint> points, Settings settings);
  ~Scheduler();
  Scheduler(const Scheduler&) = delete;
  Scheduler& operator=(const Scheduler&) = delete;

  /// Whether there is any checkpoint to go on from, and which part of the work is done already.
  bool resumes() const;

  /// Runs until all points are done (true), or stop was asked for and all tasks are saved (false). A point that fails
  /// does not stop the others. Throws RunFailed when the disk refuses; what was saved before is intact.
  bool run();

  /// Of all points, in their order; only when run() has returned true.
  std::vector<PointResult> results() const;

  /// May be called while run() is running, by one thread.
  SweepState state();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

/// Stem of the checkpoints, and file of the frames, of one replica: point and replica count from 0, names from 1.
std::string checkpoint_name(std::size_t point, int replica);
std::string frames_name(std::size_t point, int replica);
/// "point_001.h5"
std::string point_file_name(std::size_t point);
/// "N = 1024, E/N = 1, rate 0.1"
std::string point_label(const cases::CouettePoint& point);

}  // namespace lucy::program
