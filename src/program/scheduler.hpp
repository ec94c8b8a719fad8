// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// State points on the threads of this machine. A task is one replica of one point, on its way to one of the point's
// milestones; the longest tasks are taken first. Systems of large_system particles and more come first, one after the
// other, with all threads inside; the others then run one task per thread. When all replicas of a point have arrived,
// the point is concluded and ends there, or is sent on to its next milestone. So neither the number of threads nor the
// order of tasks touches a result.
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

#include "lucy/statistics/pooling.hpp"
#include "program/experiment.hpp"

namespace lucy::program {

/// How far the experiment is; work in particle-steps.
struct RunState {
  std::size_t points = 0;
  std::size_t points_done = 0;
  double fraction = 0.0;          ///< of the work known so far
  double seconds_left = 0.0;      ///< nan until a speed has been measured
  std::string label;              ///< the point that is being worked on; empty between points
  statistics::Estimate estimate;  ///< of that point's viscosity, from what has been recorded so far
};

class Scheduler {
 public:
  struct Settings {
    std::filesystem::path checkpoints;  ///< must exist
    int threads = 1;
    double checkpoint_interval = 10.0;                 ///< seconds
    std::string build;                                 ///< see build_identity.hpp
    bool watched = false;                              ///< state() will be asked for estimates
    std::function<bool()> stop_asked = {};             ///< asked often, by every thread
    std::function<void(const std::string&)> say = {};  ///< a sentence for the user; called by any thread
  };

  /// Reads which checkpoints there are; tells of those that cannot be used.
  Scheduler(std::span<StatePoint* const> points, Settings settings);
  ~Scheduler();
  Scheduler(const Scheduler&) = delete;
  Scheduler& operator=(const Scheduler&) = delete;

  /// Whether there is any checkpoint to go on from, and which part of the work is done already.
  bool resumes() const;

  /// Runs until all points are done (true), or stop was asked for and all tasks are saved (false). A point that fails
  /// does not stop the others. Throws RunFailed when the disk refuses; what was saved before is intact.
  bool run();

  /// May be called while run() is running, by one thread.
  RunState state();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

/// Stem of the checkpoints, and file of the frames, of one replica: point and replica count from 0, names from 1.
std::string checkpoint_name(std::size_t point, int replica);
std::string frames_name(std::size_t point, int replica);
/// "point_001.h5"
std::string point_file_name(std::size_t point);

}  // namespace lucy::program
