// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One replica of one point with what it keeps on disk while it runs: its state in two generations, its frames.
//
//     payload of a checkpoint: stage (4 bytes), frames in the spool (8), intervals done (8), wall seconds spent so far
//                              (8), then what the replica saves
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lucy/files/frame_spool.hpp"
#include "program/experiment.hpp"

namespace lucy::program {

/// Where a replica keeps what, and the text that says whose state it is.
struct ReplicaFiles {
  std::filesystem::path checkpoint;             ///< stem of the two generations
  std::optional<std::filesystem::path> frames;  ///< none: no frames are recorded
  std::string identity;
};

/// What is known of a replica from its newest valid checkpoint.
struct ReplicaHistory {
  bool exists = false;
  std::int32_t stage = 0;  ///< of StatePoint::milestones, that it had been asked to reach
  std::int64_t intervals_done = 0;
  std::vector<std::string> rejected;  ///< one sentence per generation that cannot be used
};

ReplicaHistory read_history(const ReplicaFiles& files);

class ReplicaTask {
 public:
  /// At the start of the run. Throws RunFailed when the point has no start.
  ReplicaTask(const StatePoint& point, int number, int threads, ReplicaFiles files);

  /// Goes on from the newest checkpoint that can be used, else from the start. Returns what has to be told: one
  /// sentence when a valid checkpoint could not be taken up after all. Throws RunFailed when the disk refuses.
  std::optional<std::string> take_up();

  /// One interval; throws RunFailed when the physics does not go on.
  void advance() { replica_->advance(); }

  /// Records a frame when one is due. Throws RunFailed when the disk refuses.
  void record_frame();

  /// Writes the state, unless it has not changed since it was written. Throws RunFailed when the disk refuses.
  void checkpoint(std::int32_t stage);

  /// Seconds of wall time from the end of the last checkpoint, or from taking up; and what the last one took to write.
  double seconds_since_checkpoint() const;
  double seconds_to_write() const { return seconds_to_write_; }

  /// The clock of this replica runs while it is being worked on.
  void start_clock();
  void stop_clock();
  double seconds() const;

  const Replica& replica() const { return *replica_; }
  const files::FrameSpool* frames() const { return frames_ ? &*frames_ : nullptr; }

 private:
  using Clock = std::chrono::steady_clock;
  void load(const std::vector<std::byte>& payload);

  const StatePoint& point_;
  int number_;
  int threads_;
  ReplicaFiles files_;
  std::unique_ptr<Replica> replica_;
  std::optional<files::FrameSpool> frames_;
  std::int64_t saved_intervals_ = -1;
  std::int32_t saved_stage_ = -1;
  double seconds_ = 0.0;
  std::optional<Clock::time_point> clock_started_;
  Clock::time_point last_checkpoint_ = Clock::now();
  double seconds_to_write_ = 0.0;
};

}  // namespace lucy::program
