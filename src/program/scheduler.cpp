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

struct Runner {
  ReplicaFiles files;
  std::unique_ptr<ReplicaTask> task;
  std::atomic<std::int64_t> intervals_done = 0;
  std::atomic<bool> at_work = false;
  std::atomic<bool> note_wanted = false;
};

struct Entry {
  StatePoint* point = nullptr;
  std::vector<std::int64_t> milestones;
  double interval_cost = 0.0;
  bool large = false;
  std::vector<std::unique_ptr<Runner>> runners;
  std::atomic<std::int32_t> stage = 0;  // changed only while no replica is at work
  int on_their_way = 0;                 // replicas that have not arrived at this stage
  std::atomic<bool> failed = false;
  std::atomic<bool> done = false;

  std::int64_t milestone() const { return milestones[static_cast<std::size_t>(stage.load())]; }

  double cost_left(const Runner& runner) const {
    if (done) return 0.0;
    return static_cast<double>(std::max<std::int64_t>(0, milestone() - runner.intervals_done)) * interval_cost;
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

}  // namespace

std::string checkpoint_name(std::size_t point, int replica) {
  return fmt::format("point_{:03}_replica_{:02}", point + 1, replica + 1);
}

std::string frames_name(std::size_t point, int replica) {
  return fmt::format("frames_{:03}_{:02}.bin", point + 1, replica + 1);
}

std::string point_file_name(std::size_t point) { return fmt::format("point_{:03}.h5", point + 1); }

struct Scheduler::Implementation {
  Settings settings;
  std::vector<std::unique_ptr<Entry>> points;
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

  void add_point(StatePoint& given) {
    const std::size_t index = points.size();
    auto entry = std::make_unique<Entry>();
    entry->point = &given;
    entry->milestones = given.milestones();
    entry->interval_cost = given.interval_cost();
    entry->large = is_large(given.particles());
    const std::string text = given.identity();
    std::int32_t stage = 0;
    for (int number = 0; number < given.replicas(); ++number) {
      auto runner = std::make_unique<Runner>();
      runner->files.checkpoint = settings.checkpoints / checkpoint_name(index, number);
      // The first replica stands for all in pictures.
      if (given.records_frames() && number == 0)
        runner->files.frames = settings.checkpoints / frames_name(index, number);
      runner->files.identity = fmt::format("{}\nreplica {}\n{}", settings.build, number, text);
      const ReplicaHistory history = read_history(runner->files);
      for (const auto& sentence : history.rejected)
        say(sentence + (history.exists ? "; the one before it is taken" : "; this replica begins again"));
      if (history.exists) {
        resumes = true;
        runner->intervals_done = history.intervals_done;
        // One replica beyond a milestone proves that the point was sent on from there.
        stage = std::max(stage, history.stage);
      }
      entry->runners.push_back(std::move(runner));
    }
    entry->stage = std::clamp<std::int32_t>(stage, 0, static_cast<std::int32_t>(entry->milestones.size()) - 1);
    for (const auto& runner : entry->runners)
      cost_before += static_cast<double>(runner->intervals_done) * entry->interval_cost;
    points.push_back(std::move(entry));
  }

  /// Sends all replicas of a point towards its present milestone; the lock is held.
  void send(std::size_t index) {
    Entry& entry = *points[index];
    entry.on_their_way = static_cast<int>(entry.runners.size());
    for (std::size_t number = 0; number < entry.runners.size(); ++number) {
      waiting.push_back({index, number, entry.cost_left(*entry.runners[number])});
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
      // Whoever is at work may send a point on to its next milestone. A signal wakes nobody: look now and then.
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
        if (points[index]->large == large) send(index);
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

  /// Takes one replica to the present milestone of its point. Throws what must end the whole run.
  void work(Entry& entry, std::size_t index, std::size_t number, int threads_inside) {
    Runner& runner = *entry.runners[number];
    if (entry.failed) return;
    runner.at_work = true;
    struct AtWork {
      Runner& runner;
      ~AtWork() { runner.at_work = false; }
    } const at_work_here{runner};

    if (!runner.task) {
      try {
        runner.task =
            std::make_unique<ReplicaTask>(*entry.point, static_cast<int>(number), threads_inside, runner.files);
      } catch (const RunFailed& failure) {
        fail(entry, number, failure.what());
        return;
      }
      if (const auto told = runner.task->take_up()) say(fmt::format("{}: {}", entry.point->label(), *told));
      runner.intervals_done = runner.task->replica().intervals_done();
    }
    ReplicaTask& task = *runner.task;
    task.start_clock();
    const bool arrived = advance_to_milestone(entry, runner, number);
    task.stop_clock();
    if (entry.failed) {
      runner.task.reset();
      return;
    }
    if (!arrived) {
      save_before_stopping(task, entry.stage);
      return;
    }
    task.checkpoint(entry.stage);
    if (settings.watched) entry.point->note(static_cast<int>(number), task.replica());
    bool last = false;
    {
      const std::scoped_lock hold(lock);
      last = --entry.on_their_way == 0;
    }
    if (last) conclude(entry, index);
  }

  bool advance_to_milestone(Entry& entry, Runner& runner, std::size_t number) {
    ReplicaTask& task = *runner.task;
    Measured& measured = entry.large ? large_speed : small_speed;
    const std::int64_t needed = entry.milestone();
    auto before = Clock::now();
    while (task.replica().intervals_done() < needed) {
      if (stopping() || entry.failed) return false;
      try {
        task.advance();
      } catch (const RunFailed& failure) {
        fail(entry, number, failure.what());
        return false;
      }
      task.record_frame();
      ++runner.intervals_done;
      if (runner.note_wanted.load(std::memory_order_relaxed)) {
        runner.note_wanted = false;
        entry.point->note(static_cast<int>(number), task.replica());
      }
      const double write = task.seconds_to_write();
      const double due = std::max(settings.checkpoint_interval, write > quick_to_write ? 100.0 * write : 0.0);
      if (task.seconds_since_checkpoint() >= due) task.checkpoint(entry.stage);
      const auto now = Clock::now();
      measured.cost += entry.interval_cost;
      measured.seconds += std::chrono::duration<double>(now - before).count();
      before = now;
    }
    return true;
  }

  void save_before_stopping(ReplicaTask& task, std::int32_t stage) {
    try {
      task.checkpoint(stage);
    } catch (const RunFailed&) {
      // When the disk has already ended the run, its first complaint is the one to be heard.
      if (!fatal_set) throw;
    }
  }

  void fail(Entry& entry, std::size_t number, const std::string& message) {
    const std::scoped_lock hold(lock);
    if (entry.failed.exchange(true)) return;
    entry.point->fail(static_cast<int>(number), message);
    entry.done = true;
    ++points_done;
  }

  /// All replicas of the point have arrived: it ends here, or goes on. No other thread touches the point.
  void conclude(Entry& entry, std::size_t index) {
    std::vector<Arrived> arrived;
    for (const auto& runner : entry.runners)
      arrived.push_back({&runner->task->replica(), runner->task->frames(), runner->task->seconds()});
    if (!entry.point->conclude(static_cast<std::size_t>(entry.stage.load()), arrived)) {
      const std::scoped_lock hold(lock);
      ++entry.stage;
      send(index);
      changed.notify_all();
      return;
    }
    for (auto& runner : entry.runners) runner->task.reset();
    entry.point->forget_notes();
    entry.done = true;
    ++points_done;
  }

  double seconds_left() const {
    std::vector<double> small;
    double large = 0.0;
    for (const auto& entry : points) {
      for (const auto& runner : entry->runners) {
        const double cost = entry->cost_left(*runner);
        if (cost <= 0.0) continue;
        if (entry->large)
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
        for (const auto& runner : points[index]->runners)
          if (runner->at_work) return index;
    return std::nullopt;
  }

  /// The estimate from the last notes, and a wish for new ones: at most once a second, and at most a hundredth of this
  /// thread's time.
  void renew_estimate(std::size_t index) {
    const Entry& entry = *points[index];
    if (index != estimated_point) estimate = {not_a_number, not_a_number, not_a_number, 0};
    estimated_point = index;
    const auto begin = Clock::now();
    if (begin < next_estimate) return;
    for (const auto& runner : entry.runners) runner->note_wanted = true;
    estimate = entry.point->estimate();
    const auto took = Clock::now() - begin;
    next_estimate = Clock::now() + std::max<Clock::duration>(std::chrono::seconds(1), 100 * took);
  }
};

Scheduler::Scheduler(std::span<StatePoint* const> points, Settings settings)
    : self_(std::make_unique<Implementation>(std::move(settings))) {
  for (StatePoint* point : points) self_->add_point(*point);
}

Scheduler::~Scheduler() = default;

bool Scheduler::resumes() const { return self_->resumes; }

bool Scheduler::run() {
  self_->run_points(true, 1, self_->settings.threads);
  if (!self_->fatal_set) self_->run_points(false, self_->settings.threads, 1);
  if (self_->fatal) std::rethrow_exception(self_->fatal);
  return self_->points_done == self_->points.size();
}

RunState Scheduler::state() {
  RunState state;
  state.points = self_->points.size();
  state.points_done = self_->points_done;
  const double done = self_->cost_before + self_->small_speed.cost + self_->large_speed.cost;
  double left = 0.0;
  for (const auto& entry : self_->points)
    for (const auto& runner : entry->runners) left += entry->cost_left(*runner);
  state.fraction = done + left > 0.0 ? done / (done + left) : 0.0;
  state.seconds_left = self_->seconds_left();
  state.estimate = {not_a_number, not_a_number, not_a_number, 0};
  if (const auto current = self_->current_point()) {
    state.label = self_->points[*current]->point->label();
    if (self_->settings.watched) {
      self_->renew_estimate(*current);
      state.estimate = self_->estimate;
    }
  }
  return state;
}

}  // namespace lucy::program
