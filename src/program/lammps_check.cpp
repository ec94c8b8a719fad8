// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy lammps check`: the same states in both engines, and one table of verdicts. Four things are compared:
//
//     single points   a configuration of a free and one of a sheared fluid, by the table and by the exact form
//     constant energy from one start: how long the trajectories stay together; averages
//     shear           E = N and N/2, rates 0.1 and 0.5, whatever the input sweeps: LAMMPS at the temperature that the
//                     ergostat run of Lucy has; stresses, and the heat that was removed over the work done
//     Green-Kubo      both engines' stresses at constant energy, by one estimator
//
// The last three are five tasks on the threads of the input. On disk, beside input.toml, a folder for each task, in
// which LAMMPS runs; tasks/, what finished tasks found; table.csv of both engines in lucy/ and lammps/; verdict.csv,
// written last of all. Finished tasks, and what LAMMPS has finished, are not run again when the command is given again.
#include <fmt/format.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "lucy/cases/engine_verdict.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/directory_lock.hpp"
#include "lucy/files/input.hpp"
#include "lucy/files/lammps_case.hpp"
#include "lucy/files/particle_file.hpp"
#include "lucy/files/table_csv.hpp"
#include "lucy/files/table_text.hpp"
#include "lucy/files/verdict_file.hpp"
#include "program/build_identity.hpp"
#include "program/closing.hpp"
#include "program/couette_point.hpp"
#include "program/interrupt.hpp"
#include "program/lammps_commands.hpp"
#include "program/output_directory.hpp"
#include "program/prediction.hpp"
#include "program/progress.hpp"

namespace lucy::program {

namespace {

namespace fs = std::filesystem;
using cases::CouettePoint;
using cases::VerdictLine;
using files::format_plain;

constexpr double exact_tolerance = 1e-10;
// Sums of interpolation errors are known for a fluid without structure; this one is nearly that.
constexpr double structure_allowance = 3.0;
// A particle with two neighbours at the worst distance.
constexpr double worst_neighbours = 2.0;
constexpr double parting_distance = 0.01;
constexpr double longest_together = 300.0;
constexpr double free_durations = 3.0;  // a run at constant energy is so many times as long as the input's
constexpr double flip_durations = 0.1;  // a run with box flips
constexpr double prepared_time = 21.3;  // of single points: a tilt of no round number
constexpr double single_point_rate = 0.5;
constexpr std::array<double, 2> sheared_energies = {1.0, 0.5};
constexpr std::array<double, 2> sheared_rates = {0.1, 0.5};

/// Somebody asked to stop, or another task failed.
struct Interrupted {};

/// What the input says, for a state at rest or, as the ergostat drives it, sheared.
CouettePoint driven(CouettePoint point, double rate) {
  point = handed_over(point);
  point.kinetic_temperature.reset();
  point.sample_interval = 0.0;
  point.integrator = motion::Integrator::runge_kutta_4;
  point.reading = motion::Reading::md;
  point.rescale = true;
  point.strain_rate = rate;
  point.thermostat = rate == 0.0 ? motion::Thermostat::none : motion::Thermostat::isoenergetic;
  cases::validate(point);
  return point;
}

/// One of the four sheared states, which are the same whatever the input sweeps.
CouettePoint sheared_state(CouettePoint point, double energy, double rate) {
  point.density = 1.0;
  point.range = 3.0;
  point.start.clear();
  point.start_frame.reset();
  point.energy_per_particle = energy;
  return driven(point, rate);
}

/// Each engine's row, and how both compare.
struct TaskResult {
  std::vector<VerdictLine> lines;
  std::vector<cases::TableRow> lucy;
  std::vector<cases::TableRow> lammps;

  void append(const TaskResult& more) {
    lines.insert(lines.end(), more.lines.begin(), more.lines.end());
    lucy.insert(lucy.end(), more.lucy.begin(), more.lucy.end());
    lammps.insert(lammps.end(), more.lammps.begin(), more.lammps.end());
  }
};

class Check {
 public:
  Check(const CouettePoint& base, fs::path directory, const Lammps& lammps)
      : base_(base), directory_(std::move(directory)), lammps_(lammps) {}

  /// The seconds that LAMMPS took in all.
  double lammps_seconds() const { return lammps_seconds_; }

  /// Makes all tasks that are running give up.
  void stop() { stopped_ = true; }

  TaskResult single_points() {
    TaskResult result;
    for (const double rate : {0.0, single_point_rate}) {
      CouettePoint point = driven(base_, rate);
      point.equilibration = 0.0;
      point.duration = prepared_time;
      point.sample_interval = point.step;
      cases::CouetteRun run(point, 0);
      advance(run, prepared_time);
      const std::string state = rate == 0.0 ? "free" : "sheared";
      const fs::path folder = case_of(state + "_point", point, run.frame(), 1.0).folder;
      const kernel::Lucy<2> kernel(point.range);
      const cases::PointSums lucy = cases::evaluate(kernel, run.frame());
      const auto error = files::table_error(kernel, point.density);
      const cases::PointAllowance by_table = {structure_allowance * error.energy, worst_neighbours * error.pair_force,
                                              structure_allowance * error.force, exact_tolerance,
                                              structure_allowance * error.pressure};
      const cases::PointAllowance exact = {exact_tolerance, exact_tolerance, exact_tolerance, exact_tolerance,
                                           exact_tolerance};
      for (const auto& [script, allowed, how] : {std::tuple("single_point", by_table, "by the table"),
                                                 std::tuple("exact_point", exact, "by LAMMPS's exact form")}) {
        run_lammps(LammpsJob{folder, script});
        append(result.lines, cases::compare_points(fmt::format("Single point of a {} fluid {}", state, how), lucy,
                                                   files::read_lammps_point(folder, script), allowed));
      }
    }
    return result;
  }

  TaskResult constant_energy() {
    CouettePoint point = driven(base_, 0.0);
    point.duration = free_durations * base_.duration;
    point.sample_interval = point.step * files::series_steps(point);  // as fine as the series of LAMMPS: for Green-Kubo
    TaskResult result;
    result.lines = stay_together(point);

    const LammpsJob job = case_of("constant_energy", point, cases::CouetteRun(point, 0).frame(), 0.0);
    const cases::CouetteRecord lucy = run_here(point);
    const cases::CouetteRecord other = files::record_of(series_of(job), point);
    result.lucy = {cases::summarize(point, point.duration, std::span(&lucy, 1))};
    result.lammps = {cases::summarize(point, point.duration, std::span(&other, 1))};
    constexpr std::array<std::string_view, 6> names = {"potential_energy", "kinetic_temperature", "pxx_kinetic",
                                                       "pxx_potential",    "pyy_kinetic",         "pyy_potential"};
    append(result.lines, cases::compare_rows(fmt::format("Averages at constant energy E/N = {}",
                                                         format_plain(point.energy_per_particle)),
                                             result.lucy.front(), result.lammps.front(), names));
    append(result.lines, cases::compare_green_kubo(point, lucy, result.lucy.front(), other, result.lammps.front()));
    return result;
  }

  TaskResult shear(double energy, double rate) {
    const CouettePoint point = sheared_state(base_, energy, rate);
    const cases::CouetteRecord lucy = run_here(point);
    TaskResult result;
    result.lucy = {cases::summarize(point, point.duration, std::span(&lucy, 1))};
    const cases::TableRow& row = result.lucy.front();
    const double temperature = row.estimates[cases::quantity("kinetic_temperature")].value;
    const std::string name = fmt::format("shear_{}_{}", energy, rate);
    const cases::Frame start = cases::CouetteRun(point, 0).frame();
    const cases::EngineSeries series = series_of(case_of(name, point, start, temperature));
    const cases::CouetteRecord other = files::record_of(series, point);
    result.lammps = {cases::summarize(point, point.duration, std::span(&other, 1))};

    const bool elsewhere = base_.density != point.density || base_.range != point.range;
    const std::string part =
        fmt::format("Shear at E/N = {} and rate {}{}", energy, rate, elsewhere ? " (density 1 and range 3)" : "");
    constexpr std::array<std::string_view, 8> names = {"kinetic_temperature", "potential_energy", "pxy_kinetic",
                                                       "pxy_potential",       "pxx_kinetic",      "pxx_potential",
                                                       "pyy_kinetic",         "pyy_potential"};
    append(result.lines, cases::compare_rows(part, row, result.lammps.front(), names));
    result.lines.push_back(cases::compare_heat(part, "heat removed over work", cases::heat_over_work(point, lucy, row),
                                               cases::heat_over_work(point, series)));

    CouettePoint brief = point;
    brief.equilibration = flip_durations * point.equilibration;
    brief.duration = flip_durations * point.duration;
    LammpsJob flips = case_of(name + "_with_flips", brief, start, temperature);
    flips.variables = {{"flip", "yes"}};
    VerdictLine flipped = cases::compare_heat(part, "the same with LAMMPS's own box flips", std::nullopt,
                                              cases::heat_over_work(brief, series_of(flips)));
    flipped.judged = false;
    result.lines.push_back(flipped);
    return result;
  }

  /// What every task tells of its LAMMPS.
  std::string status() const { return status_.get(); }

 private:
  static void append(std::vector<VerdictLine>& lines, std::vector<VerdictLine> more) {
    lines.insert(lines.end(), more.begin(), more.end());
  }

  /// A case in a folder of its own, and its main run.
  LammpsJob case_of(const std::string& name, const CouettePoint& point, const cases::Frame& start,
                    double temperature) const {
    const fs::path folder = directory_ / name;
    make_directory(folder);
    files::write_lammps_case(folder, {point, start, temperature});
    return main_job(folder, point);
  }

  /// Unless this LAMMPS has run the job before.
  void run_lammps(const LammpsJob& job) {
    auto finished = finished_job(job);
    if (!finished || finished->version != lammps_.version() || finished->ranks != job.ranks)
      finished = lammps_.run(job, [&] {
        status_.set(fmt::format("LAMMPS: {} of {}", job.script, job.folder.filename().string()));
        return !given_up();
      });
    if (!finished) throw Interrupted();
    const std::scoped_lock lock(lock_);
    lammps_seconds_ += finished->seconds;
  }

  cases::EngineSeries series_of(const LammpsJob& job) {
    run_lammps(job);
    return files::read_lammps_series(job.series());
  }

  bool given_up() const { return stopped_ || interrupt_noted(); }

  /// To the end of `duration`, looking at what comes by in between.
  void advance(cases::CouetteRun& run, double duration, const std::function<void()>& look = {}) const {
    while (run.intervals_done() < run.intervals_needed(duration)) {
      if (given_up()) throw Interrupted();
      run.advance_one_sample();
      if (look) look();
    }
  }

  cases::CouetteRecord run_here(const CouettePoint& point) const {
    cases::CouetteRun run(point, 0);
    advance(run, point.duration);
    return run.record();
  }

  /// Frames of Lucy's motion at every time unit from the start on.
  std::vector<cases::Frame> frames_here(CouettePoint point, motion::Integrator integrator, double duration) const {
    point.integrator = integrator;
    point.equilibration = 0.0;
    point.duration = duration;
    point.sample_interval = std::round(1.0 / point.step) * point.step;
    point.rescale = false;
    cases::CouetteRun run(point, 0);
    std::vector<cases::Frame> frames = {run.frame()};
    advance(run, duration, [&] { frames.push_back(run.frame()); });
    return frames;
  }

  std::vector<VerdictLine> stay_together(const CouettePoint& point) {
    const auto between = static_cast<std::int64_t>(std::round(1.0 / point.step));
    const double duration = std::min(longest_together, point.duration);
    LammpsJob job = case_of("trajectory", point, cases::CouetteRun(point, 0).frame(), 0.0);
    job.steps = std::llround(duration / point.step);
    job.variables = {{"frame_steps", fmt::format("{}", between)}, {"steps", fmt::format("{}", job.steps)}};
    run_lammps(job);
    const files::ParticleReader dump(job.folder / "nve.dump");
    std::vector<cases::Frame> other;
    for (std::size_t i = 0; i < dump.frames(); ++i) other.push_back(dump.state(i).frame);
    const auto runge_kutta = frames_here(point, motion::Integrator::runge_kutta_4, duration);
    const auto verlet = frames_here(point, motion::Integrator::velocity_verlet, duration);
    const std::string part = fmt::format("Trajectories from one start with step {}: time until {} apart (r.m.s.)",
                                         format_plain(point.step), parting_distance);
    return cases::compare_trajectories(part, {static_cast<double>(between) * point.step, runge_kutta, verlet, other},
                                       parting_distance);
  }

  CouettePoint base_;
  fs::path directory_;
  const Lammps& lammps_;
  SharedLine status_;
  std::atomic<bool> stopped_ = false;
  std::mutex lock_;
  double lammps_seconds_ = 0.0;
};

/// What a task found, kept for a check that goes on: a folder for each task, verdict.csv written last.
class FinishedTasks {
 public:
  /// Those of another build of Lucy, or of another LAMMPS, are forgotten.
  FinishedTasks(fs::path folder, const std::string& engines) : folder_(std::move(folder)) {
    const fs::path record = folder_ / "engines.txt";
    std::error_code error;
    if (fs::exists(record, error) && files::read_text_file(record) == engines) return;
    fs::remove_all(folder_, error);
    make_directory(folder_);
    files::write_file_atomically(record, engines);
  }

  std::optional<TaskResult> find(const std::string& name) const {
    std::error_code error;
    if (!fs::exists(folder_ / name / "verdict.csv", error)) return std::nullopt;
    return TaskResult{files::read_verdict_csv(folder_ / name / "verdict.csv"),
                      files::read_table_csv(folder_ / name / "lucy.csv"),
                      files::read_table_csv(folder_ / name / "lammps.csv")};
  }

  void keep(const std::string& name, const TaskResult& result) const {
    make_directory(folder_ / name);
    files::write_table_csv(folder_ / name / "lucy.csv", result.lucy);
    files::write_table_csv(folder_ / name / "lammps.csv", result.lammps);
    files::write_verdict_csv(folder_ / name / "verdict.csv", result.lines);
  }

 private:
  fs::path folder_;
};

struct Task {
  std::string name;
  std::function<TaskResult()> run;
};

/// Runs the tasks on threads of their own, in this order; the first that fails ends all.
std::vector<TaskResult> run_tasks(const std::vector<Task>& tasks, const FinishedTasks& kept, int threads, Check& check,
                                  std::atomic<std::size_t>& done) {
  std::vector<TaskResult> results(tasks.size());
  std::exception_ptr failure;
  std::mutex failing;
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t task = next++; task < tasks.size(); task = next++) {
      try {
        auto result = kept.find(tasks[task].name);
        if (!result) {
          result = tasks[task].run();
          kept.keep(tasks[task].name, *result);
        }
        results[task] = std::move(*result);
        ++done;
      } catch (...) {
        const std::scoped_lock turn(failing);
        if (!failure) failure = std::current_exception();
        next = tasks.size();
        check.stop();
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int i = 0; i < threads; ++i) workers.emplace_back(work);
  }
  try {
    if (failure) std::rethrow_exception(failure);
  } catch (const BadInput& unreadable) {  // what an engine wrote, not what the user did
    throw RunFailed(unreadable.what());
  }
  return results;
}

int tell(const fs::path& directory, const std::vector<VerdictLine>& lines, const std::string& closing) {
  print("{}\n{}\n", files::format_verdict(lines, "LAMMPS"), closing);
  print_files(directory, {"verdict.csv", "input.toml", "provenance.json"});
  return std::ranges::all_of(lines, &VerdictLine::agrees) ? 0 : 1;
}

}  // namespace

int lammps_check(const InputRequest& request, const std::optional<fs::path>& program) {
  const files::SweepInput input = files::read_sweep(request.input, request.overrides);
  const std::string resolved = files::resolved_toml(input, "a comparison with LAMMPS");
  const fs::path directory = request.out.value_or(fs::path("runs") / (request.input.stem().string() + "_lammps_check"));
  const auto look = [&] { return look_at_directory(directory, resolved, "comparison with LAMMPS", "verdict.csv"); };
  if (look() == DirectoryState::finished)
    return tell(directory, files::read_verdict_csv(directory / "verdict.csv"),
                "This check was finished before; nothing was run.");
  const CouettePoint& base = input.points.front();
  // Refused before anything is written.
  for (const double rate : {0.0, single_point_rate}) driven(base, rate);
  for (const double energy : sheared_energies)
    for (const double rate : sheared_rates) sheared_state(base, energy, rate);
  const Lammps lammps(program);
  make_directory(directory);
  const files::DirectoryLock lock(directory);
  if (look() == DirectoryState::fresh) files::write_file_atomically(directory / "input.toml", resolved);
  const FinishedTasks kept(directory / "tasks", fmt::format("{}\nLAMMPS {}\n", build_identity(), lammps.version()));

  note_interrupts();
  const auto started = std::chrono::system_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::system_clock::now() - started).count();
  };
  const int threads = input.threads > 0 ? input.threads : available_cores();
  Check check(base, directory, lammps);
  std::vector<Task> tasks = {{"single_points", [&] { return check.single_points(); }},
                             {"constant_energy", [&] { return check.constant_energy(); }}};
  for (const double energy : sheared_energies)
    for (const double rate : sheared_rates)
      tasks.push_back(
          {fmt::format("shear_{}_{}", energy, rate), [&, energy, rate] { return check.shear(energy, rate); }});
  std::atomic<std::size_t> done = 0;
  Console console;
  TaskResult all;
  try {
    const Progress progress(console, [&] {
      return fmt::format("{}/{} tasks done  {}  {}", done.load(), tasks.size(), check.status(),
                         duration_text(elapsed()));
    });
    for (const TaskResult& result : run_tasks(tasks, kept, threads, check, done)) all.append(result);
  } catch (const Interrupted&) {
    console.say("interrupted; the same command resumes");
    return 1;
  }
  for (const auto& [name, rows] : {std::pair("lucy", &all.lucy), std::pair("lammps", &all.lammps)}) {
    make_directory(directory / name);
    files::write_table_csv(directory / name / "table.csv", *rows);
  }
  write_lammps_provenance(directory / "provenance.json", request.command_line,
                          fmt::format("LAMMPS {}", lammps.version()), threads, base.seed, started, {});
  files::write_verdict_csv(directory / "verdict.csv", all.lines);
  return tell(
      directory, all.lines,
      fmt::format("LAMMPS {}. Took {} on {} thread{}, {} of it LAMMPS's.", lammps.version(), duration_text(elapsed()),
                  threads, threads == 1 ? "" : "s", duration_text(check.lammps_seconds())));
}

}  // namespace lucy::program
