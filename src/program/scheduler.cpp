// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/scheduler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "lucy/errors.hpp"
#include "lucy/files/input.hpp"
#include "lucy/files/table_text.hpp"
#include "program/prediction.hpp"
#include "program/replica_task.hpp"

namespace lucy::program {

namespace {

using Clock = std::chrono::steady_clock;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// A state that takes longer than this to write is written less often than asked for: a hundredth of the time at most.
// Ten seconds, the default interval, is a hundred times this.
constexpr double quick_to_write = 0.1;

/// Work done and the time it took: their ratio is the speed of one task.
struct Measured {
  std::atomic<double> cost = 0.0;
  std::atomic<double> seconds = 0.0;
  double speed() const { return seconds > 0.0 ? cost / seconds : 0.0; }
};

struct Replica {
  ReplicaFiles files;
  std::unique_ptr<ReplicaTask> task;
  std::atomic<std::int64_t> intervals_done = 0;
  std::atomic<bool> at_work = false;
  std::atomic<bool> snapshot_wanted = false;
  std::mutex snapshot_lock;
  cases::CouetteRecord snapshot;

  void take_snapshot() {
    snapshot_wanted = false;
    const std::scoped_lock lock(snapshot_lock);
    snapshot = task->run().record();
  }
};

struct Point {
  cases::CouettePoint settings;
  std::vector<double> durations;
  double interval_cost = 0.0;
  std::vector<std::unique_ptr<Replica>> replicas;
  std::atomic<std::int32_t> stage = 0;  // changed only while no replica is at work
  int on_their_way = 0;                 // replicas that have not arrived at this stage
  std::atomic<bool> failed = false;
  std::atomic<bool> done = false;
  PointResult result;

  double cost_left(const Replica& replica) const {
    if (done) return 0.0;
    const auto needed = sample_intervals(settings, durations[static_cast<std::size_t>(stage.load())]);
    return static_cast<double>(std::max<std::int64_t>(0, needed - replica.intervals_done)) * interval_cost;
  }
};

struct Assignment {
  std::size_t point;
  std::size_t replica;
  double cost;
};

/// Longest first; but what needs no more work comes before everything, so that finished points are soon known as such.
bool comes_later(const Assignment& a, const Assignment& b) {
  const auto key = [](const Assignment& x) {
    return std::pair(x.cost <= 0.0 ? std::numeric_limits<double>::infinity() : x.cost,
                     -static_cast<double>(x.point) * 1e5 - static_cast<double>(x.replica));
  };
  return key(a) < key(b);
}

std::string point_text(const cases::CouettePoint& point) {
  files::SweepInput alone;
  alone.points = {point};
  return files::resolved_toml(alone);
}

}  // namespace

std::string checkpoint_name(std::size_t point, int replica) {
  return fmt::format("point_{:03}_replica_{:02}", point + 1, replica + 1);
}

std::string frames_name(std::size_t point, int replica) {
  return fmt::format("frames_{:03}_{:02}.bin", point + 1, replica + 1);
}

std::string point_file_name(std::size_t point) { return fmt::format("point_{:03}.h5", point + 1); }

std::string point_label(const cases::CouettePoint& point) {
  return fmt::format("N = {}, E/N = {}, rate {}", point.particles, files::format_plain(point.energy_per_particle),
                     files::format_plain(point.strain_rate));
}

struct Scheduler::Implementation {
  Settings settings;
  std::vector<std::unique_ptr<Point>> points;
  bool resumes = false;
  double cost_before = 0.0;

  std::mutex lock;
  std::condition_variable changed;
  std::vector<Assignment> waiting;  // a heap by comes_later
  int at_work = 0;
  std::exception_ptr fatal;
  std::atomic<bool> fatal_set = false;
  std::atomic<std::size_t> points_done = 0;
  Measured small_speed;
  Measured large_speed;

  // Of state(), which one thread calls.
  Clock::time_point next_estimate = Clock::now();
  std::size_t estimated_point = 0;
  statistics::Estimate estimate = {not_a_number, not_a_number, not_a_number, 0};

  explicit Implementation(Settings given) : settings(std::move(given)) {}

  bool stopping() const { return fatal_set || (settings.stop_asked && settings.stop_asked()); }

  void say(const std::string& sentence) const {
    if (settings.say) settings.say(sentence);
  }

  void add_point(const cases::CouettePoint& given) {
    const std::size_t index = points.size();
    auto point = std::make_unique<Point>();
    point->settings = given;
    point->durations = recorded_durations(given);
    point->interval_cost = program::interval_cost(given);
    const std::string text = point_text(given);
    std::int32_t stage = 0;
    for (int number = 0; number < given.replicas; ++number) {
      auto replica = std::make_unique<Replica>();
      replica->files.checkpoint = settings.checkpoints / checkpoint_name(index, number);
      // The first replica stands for all in pictures.
      if (given.frame_interval > 0.0 && number == 0)
        replica->files.frames = settings.checkpoints / frames_name(index, number);
      replica->files.identity = fmt::format("{}\nreplica {}\n{}", settings.build, number, text);
      const ReplicaHistory history = read_history(replica->files);
      for (const auto& sentence : history.rejected)
        say(sentence + (history.exists ? "; the one before it is taken" : "; this replica begins again"));
      if (history.exists) {
        resumes = true;
        replica->intervals_done = history.intervals_done;
        // One replica beyond a duration proves that the point was sent on from there.
        stage = std::max(stage, history.stage);
      }
      point->replicas.push_back(std::move(replica));
    }
    point->stage = std::clamp<std::int32_t>(stage, 0, static_cast<std::int32_t>(point->durations.size()) - 1);
    for (const auto& replica : point->replicas)
      cost_before += static_cast<double>(replica->intervals_done) * point->interval_cost;
    points.push_back(std::move(point));
  }

  /// Sends all replicas of a point towards its present stage; the lock is held.
  void send(std::size_t index) {
    Point& point = *points[index];
    point.on_their_way = static_cast<int>(point.replicas.size());
    for (std::size_t number = 0; number < point.replicas.size(); ++number) {
      waiting.push_back({index, number, point.cost_left(*point.replicas[number])});
      std::push_heap(waiting.begin(), waiting.end(), comes_later);
    }
  }

  std::optional<Assignment> next() {
    std::unique_lock hold(lock);
    for (;;) {
      if (stopping()) return std::nullopt;
      if (!waiting.empty()) {
        std::pop_heap(waiting.begin(), waiting.end(), comes_later);
        const Assignment assignment = waiting.back();
        waiting.pop_back();
        ++at_work;
        return assignment;
      }
      if (at_work == 0) return std::nullopt;
      // Whoever is at work may send a point on to its next duration. A signal wakes nobody: look now and then.
      changed.wait_for(hold, std::chrono::milliseconds(100));
    }
  }

  void returned() {
    const std::scoped_lock hold(lock);
    --at_work;
    changed.notify_all();
  }

  void stop_for(std::exception_ptr reason) {
    const std::scoped_lock hold(lock);
    if (!fatal) fatal = std::move(reason);
    fatal_set = true;
    changed.notify_all();
  }

  void run_points(bool large, int workers, int threads_inside) {
    {
      const std::scoped_lock hold(lock);
      for (std::size_t index = 0; index < points.size(); ++index)
        if (is_large(points[index]->settings) == large) send(index);
      if (waiting.empty()) return;
      workers = std::min<int>(workers, static_cast<int>(waiting.size()));
    }
    std::vector<std::jthread> pool;
    for (int worker = 0; worker < workers; ++worker)
      pool.emplace_back([this, threads_inside] {
        while (const auto assignment = next()) {
          try {
            work(*points[assignment->point], assignment->point, assignment->replica, threads_inside);
          } catch (...) {
            stop_for(std::current_exception());
          }
          returned();
        }
      });
  }

  /// Takes one replica to the present duration of its point. Throws what must end the whole sweep.
  void work(Point& point, std::size_t index, std::size_t number, int threads_inside) {
    Replica& replica = *point.replicas[number];
    if (point.failed) return;
    replica.at_work = true;
    struct AtWork {
      Replica& replica;
      ~AtWork() { replica.at_work = false; }
    } const at_work_here{replica};

    if (!replica.task) {
      try {
        replica.task =
            std::make_unique<ReplicaTask>(point.settings, static_cast<int>(number), threads_inside, replica.files);
      } catch (const RunFailed& failure) {
        fail(point, number, failure.what());
        return;
      }
      if (const auto told = replica.task->take_up()) say(fmt::format("{}: {}", point_label(point.settings), *told));
      replica.intervals_done = replica.task->run().intervals_done();
    }
    ReplicaTask& task = *replica.task;
    task.start_clock();
    const bool arrived = advance_to_stage(point, replica, number);
    task.stop_clock();
    if (point.failed) {
      replica.task.reset();
      return;
    }
    if (!arrived) {
      save_before_stopping(task, point.stage);
      return;
    }
    task.checkpoint(point.stage);
    if (settings.watched) replica.take_snapshot();
    bool last = false;
    {
      const std::scoped_lock hold(lock);
      last = --point.on_their_way == 0;
    }
    if (last) judge(point, index);
  }

  bool advance_to_stage(Point& point, Replica& replica, std::size_t number) {
    ReplicaTask& task = *replica.task;
    Measured& measured = is_large(point.settings) ? large_speed : small_speed;
    const double duration = point.durations[static_cast<std::size_t>(point.stage.load())];
    const std::int64_t needed = task.run().intervals_needed(duration);
    auto before = Clock::now();
    while (task.run().intervals_done() < needed) {
      if (stopping() || point.failed) return false;
      try {
        task.advance();
      } catch (const RunFailed& failure) {
        fail(point, number, failure.what());
        return false;
      }
      task.record_frame();
      ++replica.intervals_done;
      if (replica.snapshot_wanted.load(std::memory_order_relaxed)) replica.take_snapshot();
      const double write = task.seconds_to_write();
      const double due = std::max(settings.checkpoint_interval, write > quick_to_write ? 100.0 * write : 0.0);
      if (task.seconds_since_checkpoint() >= due) task.checkpoint(point.stage);
      const auto now = Clock::now();
      measured.cost += point.interval_cost;
      measured.seconds += std::chrono::duration<double>(now - before).count();
      before = now;
    }
    return true;
  }

  void save_before_stopping(ReplicaTask& task, std::int32_t stage) {
    try {
      task.checkpoint(stage);
    } catch (const RunFailed&) {
      // When the disk has already ended the sweep, its first complaint is the one to be heard.
      if (!fatal_set) throw;
    }
  }

  void fail(Point& point, std::size_t number, const std::string& message) {
    const std::scoped_lock hold(lock);
    if (point.failed.exchange(true)) return;
    point.result.row = cases::failed_row(
        point.settings, point.settings.replicas > 1 ? fmt::format("replica {}: {}", number + 1, message) : message);
    for (int replica = 0; replica < point.settings.replicas; ++replica) {
      cases::ReplicaRow row = cases::replica_row(point.settings, replica, {});
      row.energy_rescaled = not_a_number;
      row.worst_energy_error = not_a_number;
      point.result.replicas.push_back(row);
    }
    point.result.seconds = not_a_number;
    point.done = true;
    ++points_done;
  }

  /// All replicas of the point have arrived: it ends here, or goes on. No other thread touches the point.
  void judge(Point& point, std::size_t index) {
    std::vector<cases::CouetteRecord> records;
    for (const auto& replica : point.replicas) records.push_back(replica->task->run().record());
    const auto stage = static_cast<std::size_t>(point.stage.load());
    const double duration = point.durations[stage];
    cases::TableRow row = cases::summarize(point.settings, duration, records);
    const auto& viscosity = row.estimates[cases::quantity("viscosity")];
    // Negated, so that an error that is not known counts as one too large.
    const bool wanting = !cases::target_reached(point.settings, viscosity);
    if (wanting && stage + 1 < point.durations.size()) {
      const std::scoped_lock hold(lock);
      ++point.stage;
      send(index);
      changed.notify_all();
      return;
    }

    PointResult result;
    result.row = std::move(row);
    std::vector<files::H5mdReplica> series;
    for (std::size_t number = 0; number < point.replicas.size(); ++number) {
      const ReplicaTask& task = *point.replicas[number]->task;
      result.replicas.push_back(cases::replica_row(point.settings, static_cast<int>(number), records[number]));
      result.seconds += task.seconds();
      series.push_back({static_cast<int>(number), &records[number], task.run().intervals_needed(0.0), task.frames()});
    }
    // The file states the duration that was recorded; the sample interval stays that of the one asked for.
    cases::CouettePoint recorded = point.settings;
    recorded.sample_interval = cases::sample_steps(point.settings) * point.settings.step;
    recorded.duration = duration;
    files::write_h5md(settings.directory / point_file_name(index), recorded, series, settings.authorship);
    point.result = std::move(result);
    for (auto& replica : point.replicas) {
      replica->task.reset();
      const std::scoped_lock hold(replica->snapshot_lock);
      replica->snapshot = {};
    }
    point.done = true;
    ++points_done;
  }

  double seconds_left() const {
    std::vector<double> small;
    double large = 0.0;
    for (const auto& point : points) {
      for (const auto& replica : point->replicas) {
        const double cost = point->cost_left(*replica);
        if (cost <= 0.0) continue;
        if (is_large(point->settings))
          large += cost;
        else
          small.push_back(cost);
      }
    }
    // Where one kind has not run yet, the other tells: a team is about as fast as its threads apart.
    const double per_thread = small_speed.speed() > 0.0 ? small_speed.speed() : large_speed.speed() / settings.threads;
    const double of_team = large_speed.speed() > 0.0 ? large_speed.speed() : small_speed.speed() * settings.threads;
    if (!(per_thread > 0.0)) return not_a_number;
    return large / of_team + time_on_workers(small, settings.threads) / per_thread;
  }

  /// A point with a replica at work.
  std::optional<std::size_t> current_point() const {
    for (std::size_t index = 0; index < points.size(); ++index)
      if (!points[index]->done)
        for (const auto& replica : points[index]->replicas)
          if (replica->at_work) return index;
    return std::nullopt;
  }

  /// The estimate from the last snapshots, and a wish for new ones: at most once a second, and at most a hundredth of
  /// this thread's time.
  void renew_estimate(std::size_t index) {
    Point& point = *points[index];
    if (index != estimated_point) estimate = {not_a_number, not_a_number, not_a_number, 0};
    estimated_point = index;
    const auto begin = Clock::now();
    if (begin < next_estimate) return;
    std::vector<cases::CouetteRecord> records;
    for (const auto& replica : point.replicas) {
      const std::scoped_lock hold(replica->snapshot_lock);
      if (!replica->snapshot.samples.empty()) records.push_back(replica->snapshot);
      replica->snapshot_wanted = true;
    }
    if (!records.empty()) estimate = cases::current_viscosity(point.settings, records);
    const auto took = Clock::now() - begin;
    next_estimate = Clock::now() + std::max<Clock::duration>(std::chrono::seconds(1), 100 * took);
  }
};

Scheduler::Scheduler(std::span<const cases::CouettePoint> points, Settings settings)
    : self_(std::make_unique<Implementation>(std::move(settings))) {
  for (const auto& point : points) self_->add_point(point);
}

Scheduler::~Scheduler() = default;

bool Scheduler::resumes() const { return self_->resumes; }

bool Scheduler::run() {
  self_->run_points(true, 1, self_->settings.threads);
  if (!self_->fatal_set) self_->run_points(false, self_->settings.threads, 1);
  if (self_->fatal) std::rethrow_exception(self_->fatal);
  return self_->points_done == self_->points.size();
}

std::vector<PointResult> Scheduler::results() const {
  std::vector<PointResult> results;
  for (const auto& point : self_->points) results.push_back(point->result);
  return results;
}

SweepState Scheduler::state() {
  SweepState state;
  state.points = self_->points.size();
  state.points_done = self_->points_done;
  const double done = self_->cost_before + self_->small_speed.cost + self_->large_speed.cost;
  double left = 0.0;
  for (const auto& point : self_->points)
    for (const auto& replica : point->replicas) left += point->cost_left(*replica);
  state.fraction = done + left > 0.0 ? done / (done + left) : 0.0;
  state.seconds_left = self_->seconds_left();
  state.viscosity = {not_a_number, not_a_number, not_a_number, 0};
  if (const auto current = self_->current_point()) {
    state.label = point_label(self_->points[*current]->settings);
    if (self_->settings.watched) {
      self_->renew_estimate(*current);
      state.viscosity = self_->estimate;
    }
  }
  return state;
}

}  // namespace lucy::program
