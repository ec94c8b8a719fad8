// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the program knows of an experiment, whatever its physics: a list of state points, each run as independent
// replicas that advance in intervals until they reach a milestone, and are then concluded together. The scheduler runs
// any such list; run_experiment.hpp owns the directory around it. What all cases have in common is in case_point.hpp
// and case_experiment.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/cases/frame.hpp"
#include "lucy/files/frame_spool.hpp"
#include "lucy/files/h5md.hpp"
#include "lucy/statistics/pooling.hpp"

namespace lucy::program {

/// One replica on its way. Its state between calls can be saved; a loaded one goes on with the same bits.
class Replica {
 public:
  Replica() = default;
  Replica(const Replica&) = delete;
  Replica& operator=(const Replica&) = delete;
  virtual ~Replica() = default;

  /// Runs one interval. Throws RunFailed when the physics does not go on.
  virtual void advance() = 0;
  virtual std::int64_t intervals_done() const = 0;
  /// Whether a frame is to be recorded now, and that frame.
  virtual bool frame_due() const = 0;
  virtual cases::Frame frame() const = 0;
  virtual void save(ArchiveWriter& archive) const = 0;
  virtual void load(ArchiveReader& archive) = 0;
};

/// A replica that has arrived, with what was kept of it.
struct Arrived {
  const Replica* replica = nullptr;
  const files::FrameSpool* frames = nullptr;  ///< null: none were recorded
  double seconds = 0.0;                       ///< wall time spent on it
};

/// One row of the results. Its members are called by one thread at a time, except where it says otherwise.
class StatePoint {
 public:
  StatePoint() = default;
  StatePoint(const StatePoint&) = delete;
  StatePoint& operator=(const StatePoint&) = delete;
  virtual ~StatePoint() = default;

  /// "N = 1024, E/N = 1, rate 0.1"
  virtual std::string label() const = 0;
  /// Every key that can change a result, as text: states are interchangeable only between equal texts.
  virtual std::string identity() const = 0;
  virtual std::int64_t particles() const = 0;
  virtual int replicas() const = 0;
  virtual bool records_frames() const = 0;
  /// The numbers of intervals at which the point may end, increasing.
  virtual std::vector<std::int64_t> milestones() const = 0;
  /// Work of one interval, in particle-steps.
  virtual double interval_cost() const = 0;
  /// A replica at its start. Called by several threads at once. Throws RunFailed when the point has no start.
  virtual std::unique_ptr<Replica> start(int replica, int threads) const = 0;

  /// Takes note of how far a replica is, for estimate(); called by the thread that advances it.
  virtual void note(int number, const Replica& replica) = 0;
  /// The result as known from what was noted (value nan: not yet); may be called while replicas are noted.
  virtual statistics::Estimate estimate() const = 0;

  /// All replicas stand at milestones()[stage]: true when the point ends there and its result is on disk, false when it
  /// goes on to the next milestone (never from the last). Throws RunFailed when the disk refuses.
  virtual bool conclude(std::size_t stage, std::span<const Arrived> replicas) = 0;
  /// The point ends without a result.
  virtual void fail(int replica, const std::string& message) = 0;
  /// The notes are no longer needed.
  virtual void forget_notes() = 0;
};

/// A whole experiment: what one command runs, and what it leaves behind.
class Experiment {
 public:
  Experiment() = default;
  Experiment(const Experiment&) = delete;
  Experiment& operator=(const Experiment&) = delete;
  virtual ~Experiment() = default;

  /// In messages: "sweep", "Green-Kubo run".
  virtual std::string kind() const = 0;
  /// What input.toml of the results holds.
  virtual std::string resolved() const = 0;
  /// The file that is written last of all: where it is, the experiment is finished.
  virtual std::string results_file() const = 0;
  virtual int threads() const = 0;  ///< 0: all cores
  virtual double checkpoint_interval() const = 0;
  virtual std::uint64_t seed() const = 0;
  virtual std::string generator() const = 0;  ///< of random numbers, in words

  /// What the largest of the points takes while it runs on so many threads.
  struct Appetite {
    std::int64_t particles = 0;
    int replicas = 0;  ///< at a time
    double bytes = 0.0;
  };
  virtual Appetite appetite(int threads) const = 0;

  /// Makes the state points, which write into `directory`; they live as long as the experiment.
  virtual std::vector<StatePoint*> prepare(const std::filesystem::path& directory,
                                           const files::H5mdAuthorship& authorship) = 0;
  /// Wall time of every point, summed over replicas; nan where it failed.
  virtual std::vector<double> seconds_of_points() const = 0;
  /// Writes everything but the results file; then that one.
  virtual void write_companions(const std::filesystem::path& directory) = 0;
  virtual void write_results(const std::filesystem::path& directory) = 0;

  /// Takes in what a finished directory holds, as if it had just been run. Throws BadInput when it cannot be read.
  virtual void read_back(const std::filesystem::path& directory) = 0;
  /// Prints what was just finished or read back, ending with `closing`; draws pictures if `draw`. Returns the exit
  /// code.
  virtual int print(const std::filesystem::path& directory, const std::string& closing, bool draw) = 0;
};

}  // namespace lucy::program
