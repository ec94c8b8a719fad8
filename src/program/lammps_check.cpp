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
// which LAMMPS runs; table.csv of both engines in lucy/ and lammps/; verdict.csv, written last of all. What LAMMPS has
// finished is not run again when the command is given again.
#include <fmt/format.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "lucy/cases/engine_verdict.hpp"
#include "lucy/cases/green_kubo_table.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/directory_lock.hpp"
#include "lucy/files/input.hpp"
#include "lucy/files/lammps_case.hpp"
#include "lucy/files/particle_file.hpp"
#include "lucy/files/table_csv.hpp"
#include "lucy/files/table_text.hpp"
#include "lucy/files/verdict_file.hpp"
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
constexpr double parting_tolerance = 0.15;
constexpr double longest_together = 300.0;
constexpr double heat_tolerance = 2e-3;  // work by trapezoids between rows of a series, an integrator with a step
constexpr double free_durations = 3.0;   // a run at constant energy is so many times as long as the input's
constexpr double flip_durations = 0.1;   // a run with box flips
constexpr double prepared_time = 21.3;   // of single points: a tilt of no round number

/// Somebody asked to stop.
struct Interrupted {};

/// What the input says, for one state at another energy and rate.
CouettePoint state_of(const CouettePoint& base, double energy, double rate) {
  CouettePoint point = handed_over(base);
  point.density = 1.0;
  point.range = 3.0;
  point.kinetic_temperature.reset();
  point.start.clear();
  point.start_frame.reset();
  point.sample_interval = 0.0;
  point.integrator = motion::Integrator::runge_kutta_4;
  point.reading = motion::Reading::md;
  point.energy_per_particle = energy;
  point.strain_rate = rate;
  point.thermostat = rate == 0.0 ? motion::Thermostat::none : motion::Thermostat::isoenergetic;
  cases::validate(point);
  return point;
}

cases::CouetteRecord run_here(const CouettePoint& point) {
  cases::CouetteRun run(point, 0);
  while (run.intervals_done() < run.intervals_needed(point.duration)) {
    if (interrupt_noted()) throw Interrupted();
    run.advance_one_sample();
  }
  return run.record();
}

/// Each engine's row, and how both compare.
struct TaskResult {
  std::vector<VerdictLine> lines;
  std::vector<cases::TableRow> lucy;
  std::vector<cases::TableRow> lammps;
};

class Check {
 public:
  Check(const CouettePoint& base, fs::path directory, const Lammps& lammps)
      : base_(base), directory_(std::move(directory)), lammps_(lammps) {}

  /// The seconds that LAMMPS took in all.
  double lammps_seconds() const { return lammps_seconds_; }

  TaskResult single_points() {
    TaskResult result;
    for (const double rate : {0.0, 0.5}) {
      CouettePoint point = state_of(base_, 1.0, rate);
      point.equilibration = 0.0;
      point.duration = prepared_time;
      point.sample_interval = point.step;
      cases::CouetteRun run(point, 0);
      while (run.intervals_done() < run.intervals_needed(prepared_time)) run.advance_one_sample();
      const std::string state = rate == 0.0 ? "free" : "sheared";
      const fs::path folder = case_of(state + "_point", point, run.frame(), 1.0);
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
        run_lammps({folder, script});
        append(result.lines, cases::compare_points(fmt::format("Single point of a {} fluid {}", state, how), lucy,
                                                   files::read_lammps_point(folder, script), allowed));
      }
    }
    return result;
  }

  TaskResult constant_energy() {
    CouettePoint point = state_of(base_, base_.energy_per_particle, 0.0);
    point.duration = free_durations * base_.duration;
    point.sample_interval = point.step * files::series_steps(point);  // as fine as the series of LAMMPS: for Green-Kubo
    const fs::path folder = case_of("constant_energy", point, cases::CouetteRun(point, 0).frame(), 0.0);
    TaskResult result;
    append(result.lines, stay_together(point));

    const cases::CouetteRecord lucy = run_here(point);
    run_lammps({folder, "nve"});
    const cases::CouetteRecord other = files::record_of(files::read_lammps_series(folder / "nve_series.dat"), point);
    result.lucy = {cases::summarize(point, point.duration, std::span(&lucy, 1))};
    result.lammps = {cases::summarize(point, point.duration, std::span(&other, 1))};
    constexpr std::array<std::string_view, 6> names = {"potential_energy", "kinetic_temperature", "pxx_kinetic",
                                                       "pxx_potential",    "pyy_kinetic",         "pyy_potential"};
    append(result.lines, cases::compare_rows(fmt::format("Averages at constant energy E/N = {}",
                                                         format_plain(point.energy_per_particle)),
                                             result.lucy.front(), result.lammps.front(), names));
    append(result.lines, green_kubo(point, lucy, result.lucy.front(), other, result.lammps.front()));
    return result;
  }

  TaskResult shear(double energy, double rate) {
    const CouettePoint point = state_of(base_, energy, rate);
    const cases::CouetteRecord lucy = run_here(point);
    TaskResult result;
    result.lucy = {cases::summarize(point, point.duration, std::span(&lucy, 1))};
    const cases::TableRow& row = result.lucy.front();
    const double temperature = row.estimates[cases::quantity("kinetic_temperature")].value;
    const std::string name = fmt::format("shear_{}_{}", energy, rate);
    const cases::Frame start = cases::CouetteRun(point, 0).frame();
    const fs::path folder = case_of(name, point, start, temperature);
    run_lammps({folder, "sheared"});
    const auto series = files::read_lammps_series(folder / "sheared_series.dat");
    const cases::CouetteRecord other = files::record_of(series, point);
    result.lammps = {cases::summarize(point, point.duration, std::span(&other, 1))};

    const std::string part = fmt::format("Shear at E/N = {} and rate {}", energy, rate);
    constexpr std::array<std::string_view, 6> names = {"pxy_kinetic",   "pxy_potential", "pxx_kinetic",
                                                       "pxx_potential", "pyy_kinetic",   "pyy_potential"};
    append(result.lines, cases::compare_rows(part, row, result.lammps.front(), names));
    VerdictLine heat = heat_line(part, "heat removed over work", heat_over_work(point, series));
    heat.lucy = heat_over_work_here(point, lucy, row);
    result.lines.push_back(heat);

    CouettePoint brief = point;
    brief.equilibration = flip_durations * point.equilibration;
    brief.duration = flip_durations * point.duration;
    const fs::path flips = case_of(name + "_with_flips", brief, start, temperature);
    run_lammps({flips, "sheared", {{"flip", "yes"}}});
    VerdictLine flipped = heat_line(part, "the same with LAMMPS's own box flips",
                                    heat_over_work(brief, files::read_lammps_series(flips / "sheared_series.dat")));
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

  fs::path case_of(const std::string& name, const CouettePoint& point, const cases::Frame& start, double temperature) {
    fs::path folder = directory_ / name;
    make_directory(folder);
    files::write_lammps_case(folder, {point, start, temperature});
    return folder;
  }

  void run_lammps(const LammpsJob& job) {
    const auto watch = [&] {
      status_.set(fmt::format("LAMMPS: {} of {}", job.script, job.folder.filename().string()));
      return !interrupt_noted();
    };
    const auto seconds = lammps_.run_once(job, watch);
    if (!seconds) throw Interrupted();
    const std::scoped_lock lock(lock_);
    lammps_seconds_ += *seconds;
  }

  /// Frames of Lucy's motion at every time unit from the start on.
  static std::vector<cases::Frame> frames_here(CouettePoint point, motion::Integrator integrator, double duration) {
    point.integrator = integrator;
    point.equilibration = 0.0;
    point.duration = duration;
    point.sample_interval = std::round(1.0 / point.step) * point.step;
    point.rescale = false;
    cases::CouetteRun run(point, 0);
    std::vector<cases::Frame> frames = {run.frame()};
    while (run.intervals_done() < run.intervals_needed(duration)) {
      if (interrupt_noted()) throw Interrupted();
      run.advance_one_sample();
      frames.push_back(run.frame());
    }
    return frames;
  }

  std::vector<VerdictLine> stay_together(const CouettePoint& point) {
    const auto steps = static_cast<std::int64_t>(std::round(1.0 / point.step));
    const double interval = static_cast<double>(steps) * point.step;
    const double duration = std::min(longest_together, point.duration);
    const fs::path folder = case_of("trajectory", point, cases::CouetteRun(point, 0).frame(), 0.0);
    run_lammps({folder,
                "nve",
                {{"frame_steps", fmt::format("{}", steps)},
                 {"steps", fmt::format("{}", std::llround(duration / point.step))}}});
    const files::ParticleReader dump(folder / "nve.dump");
    const auto fourth_order = frames_here(point, motion::Integrator::runge_kutta_4, duration);
    const auto verlet = frames_here(point, motion::Integrator::velocity_verlet, duration);
    std::vector<double> by_integrator;
    std::vector<double> other_by_integrator;
    std::vector<double> same_integrator;
    for (std::size_t i = 0; i < std::min({fourth_order.size(), verlet.size(), dump.frames()}); ++i) {
      const cases::Frame other = dump.state(i).frame;
      by_integrator.push_back(cases::separation(fourth_order[i], verlet[i]));
      other_by_integrator.push_back(cases::separation(fourth_order[i], other));
      same_integrator.push_back(cases::separation(verlet[i], other));
    }
    const auto parting = [&](const std::vector<double>& separations) {
      return cases::parting_time(separations, interval, parting_distance);
    };
    const std::string part = fmt::format("Trajectories from one start with step {}: time until {} apart (r.m.s.)",
                                         format_plain(point.step), parting_distance);
    VerdictLine integrators = {part, "from Lucy's Runge-Kutta: Lucy's Verlet; LAMMPS's"};
    integrators.lucy = parting(by_integrator);
    integrators.other = parting(other_by_integrator);
    integrators.difference = integrators.other / integrators.lucy - 1.0;
    integrators.allowed = parting_tolerance;
    VerdictLine same = {part, "from Lucy's Verlet: LAMMPS's (which is to be longer)"};
    same.lucy = std::numeric_limits<double>::quiet_NaN();
    same.other = parting(same_integrator);
    same.difference = std::min(0.0, same.other / integrators.lucy - 1.0);
    same.allowed = parting_tolerance;
    return {integrators, same};
  }

  /// One estimator on both series; the stresses of Lucy are averages over as little as the rows of LAMMPS lie apart.
  static std::vector<VerdictLine> green_kubo(const CouettePoint& point, const cases::CouetteRecord& lucy,
                                             const cases::TableRow& lucy_row, const cases::CouetteRecord& other,
                                             const cases::TableRow& other_row) {
    const auto estimate = [&](const cases::CouetteRecord& record, const cases::TableRow& row) {
      cases::SampledSeries series;
      constexpr std::size_t first = 2;  // of cases::observables: pxy, pxx and pyy, kinetic and potential
      for (const auto& sample : record.samples) {
        series.pxy.push_back(sample[first] + sample[first + 1]);
        series.stress_difference.push_back(
            0.5 * (sample[first + 2] + sample[first + 3] - sample[first + 4] - sample[first + 5]));
      }
      series.sample_interval = record.sample_interval;
      series.volume = static_cast<double>(point.particles) / point.density;
      series.kinetic_temperature = row.estimates[cases::quantity("kinetic_temperature")].value;
      return cases::summarize_series(series).row;
    };
    const auto here = estimate(lucy, lucy_row);
    const auto there = estimate(other, other_row);
    const std::string part = fmt::format("Green-Kubo at E/N = {}", format_plain(point.energy_per_particle));
    std::vector<VerdictLine> lines;
    for (const auto& [name, place] :
         {std::pair("viscosity", cases::green_kubo_quantity("viscosity")),
          std::pair("viscosity by the spectrum", cases::green_kubo_quantity("viscosity_spectrum"))})
      lines.push_back(cases::compare_estimates(part, name, here.estimates[place], there.estimates[place]));
    return lines;
  }

  static VerdictLine heat_line(const std::string& part, const std::string& quantity, double ratio) {
    VerdictLine line = {part, quantity};
    line.lucy = std::numeric_limits<double>::quiet_NaN();
    line.other = ratio;
    line.difference = ratio - 1.0;
    line.allowed = heat_tolerance;
    return line;
  }

  /// (heat + change of energy)/work after the equilibration, the work by trapezoids.
  static double heat_over_work(const CouettePoint& point, const files::LammpsSeries& series) {
    const double volume = static_cast<double>(point.particles) / point.density;
    constexpr std::size_t pxy = 2;
    std::size_t first = 0;
    while (first + 1 < series.time.size() && series.time[first] < point.equilibration) ++first;
    double work = 0.0;
    for (std::size_t i = first + 1; i < series.time.size(); ++i) {
      const auto stress = [&](std::size_t row) { return series.instants[row][pxy] + series.instants[row][pxy + 1]; };
      work -= point.strain_rate * volume * 0.5 * (stress(i) + stress(i - 1)) * (series.time[i] - series.time[i - 1]);
    }
    const double heat = series.heat.back() - series.heat[first];
    return (heat + series.energy.back() - series.energy[first]) / work;
  }

  /// The ergostat keeps the energy: heat is work, but for what rescaling put back.
  static double heat_over_work_here(const CouettePoint& point, const cases::CouetteRecord& record,
                                    const cases::TableRow& row) {
    const double power = point.strain_rate * point.strain_rate * row.estimates[cases::quantity("viscosity")].value;
    const double work = power / point.density * static_cast<double>(record.steps) * point.step;  // per particle
    return 1.0 - record.energy_rescaled / work;
  }

  CouettePoint base_;
  fs::path directory_;
  const Lammps& lammps_;
  SharedLine status_;
  std::mutex lock_;
  double lammps_seconds_ = 0.0;
};

int tell(const fs::path& directory, const std::vector<VerdictLine>& lines, const std::string& closing) {
  print("{}\n{}\n", files::format_verdict(lines, "LAMMPS"), closing);
  print_files(directory, {"verdict.csv", "input.toml", "provenance.json"});
  return std::ranges::all_of(lines, &VerdictLine::agrees) ? 0 : 1;
}

}  // namespace

int lammps_check(const InputRequest& request, const std::optional<fs::path>& program) {
  const files::SweepInput input = files::read_sweep(request.input, request.overrides);
  const std::string resolved = files::resolved_toml(input);
  const fs::path directory = request.out.value_or(fs::path("runs") / (request.input.stem().string() + "_lammps_check"));
  const auto look = [&] { return look_at_directory(directory, resolved, "LAMMPS check", "verdict.csv"); };
  if (look() == DirectoryState::finished)
    return tell(directory, files::read_verdict_csv(directory / "verdict.csv"),
                "This check was finished before; nothing was run.");
  const CouettePoint& base = input.points.front();
  for (const double energy : {1.0, 0.5}) state_of(base, energy, 0.5);  // refused before anything is written
  const Lammps lammps(program);
  make_directory(directory);
  const files::DirectoryLock lock(directory);
  if (look() == DirectoryState::fresh) files::write_file_atomically(directory / "input.toml", resolved);

  note_interrupts();
  const auto started = std::chrono::system_clock::now();
  const int threads = input.threads > 0 ? input.threads : available_cores();
  Check check(base, directory, lammps);
  const std::vector<std::function<TaskResult()>> tasks = {
      [&] { return check.single_points(); }, [&] { return check.constant_energy(); },
      [&] { return check.shear(1.0, 0.1); }, [&] { return check.shear(1.0, 0.5); },
      [&] { return check.shear(0.5, 0.1); }, [&] { return check.shear(0.5, 0.5); }};
  std::vector<TaskResult> results(tasks.size());
  std::exception_ptr failure;
  std::mutex failing;
  std::atomic<std::size_t> next = 0;
  std::atomic<std::size_t> done = 0;
  Console console;
  {
    const Progress progress(console, [&] {
      return fmt::format(
          "{}/{} tasks done  {}  {}", done.load(), tasks.size(), check.status(),
          duration_text(std::chrono::duration<double>(std::chrono::system_clock::now() - started).count()));
    });
    std::vector<std::jthread> workers;
    for (int i = 0; i < threads; ++i)
      workers.emplace_back([&] {
        for (std::size_t task = next++; task < tasks.size(); task = next++) {
          try {
            results[task] = tasks[task]();
            ++done;
          } catch (...) {
            const std::scoped_lock turn(failing);
            if (!failure) failure = std::current_exception();
            next = tasks.size();
          }
        }
      });
  }
  try {
    if (failure) std::rethrow_exception(failure);
  } catch (const Interrupted&) {
    console.say("interrupted; the same command resumes");
    return 1;
  }

  TaskResult all;
  for (const TaskResult& result : results) {
    all.lines.insert(all.lines.end(), result.lines.begin(), result.lines.end());
    all.lucy.insert(all.lucy.end(), result.lucy.begin(), result.lucy.end());
    all.lammps.insert(all.lammps.end(), result.lammps.begin(), result.lammps.end());
  }
  for (const auto& [name, rows] : {std::pair("lucy", &all.lucy), std::pair("lammps", &all.lammps)}) {
    make_directory(directory / name);
    files::write_table_csv(directory / name / "table.csv", *rows);
  }
  write_lammps_provenance(directory, request.command_line, fmt::format("LAMMPS {}", lammps.version()), threads,
                          base.seed, started, {});
  files::write_verdict_csv(directory / "verdict.csv", all.lines);
  const double seconds = std::chrono::duration<double>(std::chrono::system_clock::now() - started).count();
  return tell(
      directory, all.lines,
      fmt::format("LAMMPS {}. Took {} on {} thread{}, {} of it LAMMPS's.", lammps.version(), duration_text(seconds),
                  threads, threads == 1 ? "" : "s", duration_text(check.lammps_seconds())));
}

}  // namespace lucy::program
