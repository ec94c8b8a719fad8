// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/lammps_comparison.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include "lucy/files/lammps_case.hpp"
#include "lucy/files/particle_file.hpp"
#include "lucy/files/table_text.hpp"
#include "program/interrupt.hpp"
#include "program/output_directory.hpp"

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

/// What the input says, for a state at rest or, as the ergostat drives it, sheared.
CouettePoint driven(CouettePoint point, double rate) {
  point = handed_over(point);
  point.kinetic_temperature.reset();
  point.sample_interval = point.frame_interval = 0.0;
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
  point.start_checksum.clear();
  point.start_frame.reset();
  point.energy_per_particle = energy;
  return driven(point, rate);
}

void append(std::vector<VerdictLine>& lines, std::vector<VerdictLine> more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

}  // namespace

void refuse_impossible_states(const CouettePoint& base) {
  for (const double rate : {0.0, single_point_rate}) driven(base, rate);
  for (const double energy : sheared_energies)
    for (const double rate : sheared_rates) sheared_state(base, energy, rate);
}

LammpsComparison::LammpsComparison(const CouettePoint& base, fs::path directory, const Lammps& lammps)
    : base_(base), directory_(std::move(directory)), lammps_(lammps) {}

TaskResult LammpsComparison::single_points() {
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

TaskResult LammpsComparison::constant_energy() {
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
  append(result.lines, cases::compare_rows(
                           fmt::format("Averages at constant energy E/N = {}", format_plain(point.energy_per_particle)),
                           result.lucy.front(), result.lammps.front(), names));
  append(result.lines, cases::compare_green_kubo(point, lucy, result.lucy.front(), other, result.lammps.front()));
  return result;
}

TaskResult LammpsComparison::shear(double energy, double rate) {
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

/// A case in a folder of its own, and its main run.
LammpsJob LammpsComparison::case_of(const std::string& name, const CouettePoint& point, const cases::Frame& start,
                                    double temperature) const {
  const fs::path folder = directory_ / name;
  make_directory(folder);
  files::write_lammps_case(folder, {point, start, temperature, "the mean of Lucy's run with its ergostat"});
  return main_job(folder, point);
}

/// Unless this LAMMPS has run the job before.
void LammpsComparison::run_lammps(const LammpsJob& job) {
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

cases::EngineSeries LammpsComparison::series_of(const LammpsJob& job) {
  run_lammps(job);
  return files::read_lammps_series(job.series());
}

bool LammpsComparison::given_up() const { return stopped_ || interrupt_noted(); }

/// To the end of `duration`, looking at what comes by in between.
void LammpsComparison::advance(cases::CouetteRun& run, double duration, const std::function<void()>& look) const {
  while (run.intervals_done() < run.intervals_needed(duration)) {
    if (given_up()) throw Interrupted();
    run.advance_one_sample();
    if (look) look();
  }
}

cases::CouetteRecord LammpsComparison::run_here(const CouettePoint& point) const {
  cases::CouetteRun run(point, 0);
  advance(run, point.duration);
  return run.record();
}

/// Frames of Lucy's motion at every time unit from the start on.
std::vector<cases::Frame> LammpsComparison::frames_here(CouettePoint point, motion::Integrator integrator,
                                                        double duration) const {
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

std::vector<VerdictLine> LammpsComparison::stay_together(const CouettePoint& point) {
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

}  // namespace lucy::program
