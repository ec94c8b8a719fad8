// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// This engine and LAMMPS timed in turn on the same states: per force evaluation and particle, and per particle and unit
// of simulated time at equal energy error. A table for docs/results/lammps.md goes to standard output.
//
//     build/bench/against_lammps [repetitions] [largest number of particles] [smallest]     (5, 262144, 1024)
//
// LAMMPS's time is that of its loop, without starting up; it computes stresses only where its own algorithm needs them,
// while Lucy's Runge-Kutta steps include energy, stress and the watch over the energy error. Both are timed at the step
// that they are credited with: longer steps have shorter-lived lists.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "lucy/cases/start_state.hpp"
#include "lucy/files/lammps_case.hpp"
#include "lucy/files/provenance.hpp"
#include "prepared_flow.hpp"
#include "program/lammps_process.hpp"

namespace {

using namespace lucy;
namespace fs = std::filesystem;

constexpr double evaluations_in_all = 4e6;  // particles times force evaluations of one timing
constexpr double step = 0.05;
constexpr double watched_time = 100.0;  // over which the energy error is the largest
constexpr std::array<double, 2> energy_errors = {1e-5, 1e-6};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double seconds_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The loop times of a log, added up.
double loop_seconds(const fs::path& log) {
  std::ifstream file(log);
  double sum = 0.0;
  for (std::string line; std::getline(file, line);) {
    double seconds = 0.0;
    if (std::sscanf(line.c_str(), "Loop time of %lf", &seconds) == 1) sum += seconds;
  }
  return sum;
}

cases::CouettePoint point_of(std::int64_t particles, double rate) {
  cases::CouettePoint point;
  point.particles = particles;
  point.energy_per_particle = 1.0;
  point.strain_rate = rate;
  point.thermostat = rate == 0.0 ? motion::Thermostat::none : motion::Thermostat::isoenergetic;
  point.step = step;
  point.equilibration = 0.0;
  point.duration = watched_time;
  return point;
}

motion::Trajectory<2> trajectory_of(const cases::Frame& frame, const cases::CouettePoint& point,
                                    motion::Integrator integrator, int threads) {
  motion::Watch watch;
  watch.rescale = false;
  const motion::Shear shear{.strain_rate = point.strain_rate, .thermostat = point.thermostat};
  return {kernel::Lucy<2>(point.range), cases::start_of(frame), shear, integrator, watch, Team(threads)};
}

cases::Frame frame_of(const motion::Trajectory<2>& trajectory) {
  cases::Frame frame;
  frame.box = trajectory.box().lengths();
  frame.offset = trajectory.box().offset();
  frame.position = trajectory.positions();
  frame.momentum = trajectory.momenta();
  return frame;
}

/// Largest |E - E(0)|/N of Lucy over `watched_time`.
double energy_error_here(const cases::Frame& frame, motion::Integrator integrator, double dt) {
  auto motion = trajectory_of(frame, point_of(1024, 0.0), integrator, 1);
  const double start = motion.energy();
  double largest = 0.0;
  while (motion.time() < watched_time - 0.5 * dt) {
    motion.advance(dt);
    largest = std::max(largest, std::abs(motion.energy() - start));
  }
  return largest / 1024.0;
}

double energy_error_there(const program::Lammps& lammps, const fs::path& folder, double dt) {
  lammps.run({folder,
              "nve",
              {{"step", fmt::format("{}", dt)},
               {"steps", fmt::format("{}", std::llround(watched_time / dt))},
               {"every", "1"}}},
             [] { return true; });
  const auto series = files::read_lammps_series(folder / "nve_series.dat");
  double largest = 0.0;
  for (const double energy : series.energy) largest = std::max(largest, std::abs(energy - series.energy.front()));
  return largest / 1024.0;
}

/// The step at which the error is `wanted`, by a power law through the two steps nearest to it.
double step_for(const std::vector<std::pair<double, double>>& errors, double wanted) {
  std::size_t i = 0;
  while (i + 2 < errors.size() && errors[i + 1].second > wanted) ++i;  // steps fall, and so do errors
  const double power =
      std::log(errors[i].second / errors[i + 1].second) / std::log(errors[i].first / errors[i + 1].first);
  return errors[i].first * std::pow(wanted / errors[i].second, 1.0 / power);
}

struct Steps {
  double fourth_order, verlet, lammps;
};

/// One program's cost with one step.
struct Timing {
  double step;
  std::vector<double> seconds = {};  ///< per force evaluation and particle
};

/// At the step of the comparison per evaluation, and at those for the energy errors, where these are others: a longer
/// step has shorter-lived neighbour lists.
std::vector<Timing> timings_at(std::initializer_list<double> steps) {
  std::vector<Timing> timings = {{step}};
  for (const double dt : steps)
    if (std::abs(dt - step) > 0.05 * step) timings.push_back({dt});
  return timings;
}

double median_at(const std::vector<Timing>& timings, double dt) {
  const auto nearest = std::ranges::min_element(timings, {}, [&](const Timing& t) { return std::abs(t.step - dt); });
  return median(nearest->seconds);
}

}  // namespace

int main(int count, char** words) {
  const int repetitions = count > 1 ? std::atoi(words[1]) : 5;
  const std::int64_t most = count > 2 ? std::atoll(words[2]) : 262144;
  const std::int64_t fewest = count > 3 ? std::atoll(words[3]) : 1024;
  const program::Lammps lammps;
  const fs::path folder = fs::temp_directory_path() / fmt::format("lucy_against_lammps_{}", ::getpid());
  fs::create_directories(folder);
  fmt::print("{}, LAMMPS {}, medians of {}.\n\n", files::processor_model(), lammps.version(), repetitions);

  const cases::Frame small = frame_of(bench::prepared_flow(1024, 1.0, 0.0, 1, 50.0));
  files::write_lammps_case(folder, {point_of(1024, 0.0), small, 0.0});
  std::vector<std::pair<double, double>> by_fourth_order;
  std::vector<std::pair<double, double>> by_verlet;
  std::vector<std::pair<double, double>> by_lammps;
  fmt::print("| step | Runge-Kutta, largest error of E/N in {} | Verlet | LAMMPS |\n|---|---|---|---|\n", watched_time);
  for (const double dt : {0.2, 0.1, 0.05, 0.025, 0.0125}) {
    by_fourth_order.emplace_back(dt, energy_error_here(small, motion::Integrator::runge_kutta_4, dt));
    by_verlet.emplace_back(dt, energy_error_here(small, motion::Integrator::velocity_verlet, dt));
    by_lammps.emplace_back(dt, energy_error_there(lammps, folder, dt));
    fmt::print("| {} | {:.1e} | {:.1e} | {:.1e} |\n", dt, by_fourth_order.back().second, by_verlet.back().second,
               by_lammps.back().second);
  }
  std::array<Steps, energy_errors.size()> steps{};
  fmt::print("\n");
  for (std::size_t i = 0; i < steps.size(); ++i) {
    steps[i] = {step_for(by_fourth_order, energy_errors[i]), step_for(by_verlet, energy_errors[i]),
                step_for(by_lammps, energy_errors[i])};
    fmt::print("Steps for an error of {}: Runge-Kutta {:.3f}, Verlet {:.4f}, LAMMPS {:.4f}.\n", energy_errors[i],
               steps[i].fourth_order, steps[i].verlet, steps[i].lammps);
  }

  fmt::print(
      "\n| N | rate | cores | Lucy, ns per evaluation | Lucy Verlet | LAMMPS | ratio | Lucy, us per time at 1e-5 | "
      "LAMMPS | "
      "Lucy at 1e-6 | LAMMPS |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::int64_t particles : {1024, 16384, 262144}) {
    if (particles < fewest || particles > most) continue;
    const auto n = static_cast<double>(particles);
    const auto evaluations = static_cast<std::int64_t>(std::max(40.0, evaluations_in_all / n));
    for (const double rate : {0.0, 0.1}) {
      const cases::CouettePoint point = point_of(particles, rate);
      const cases::Frame frame = frame_of(bench::prepared_flow(particles, 1.0, rate, 2, 20.0));
      files::write_lammps_case(folder, {point, frame, 0.5424});
      for (const int cores : {1, 2}) {
        auto fourth_order = timings_at({steps[0].fourth_order, steps[1].fourth_order});
        auto verlet = timings_at({steps[0].verlet, steps[1].verlet});
        auto there = timings_at({steps[0].lammps, steps[1].lammps});
        if (rate != 0.0) verlet.clear();
        const auto motions = [&](const std::vector<Timing>& timings, motion::Integrator integrator) {
          std::vector<motion::Trajectory<2>> made;
          for (std::size_t i = 0; i < timings.size(); ++i)
            made.push_back(trajectory_of(frame, point, integrator, cores));
          return made;
        };
        auto runge_kutta = motions(fourth_order, motion::Integrator::runge_kutta_4);
        auto newton = motions(verlet, motion::Integrator::velocity_verlet);
        for (int repetition = 0; repetition < repetitions; ++repetition) {
          for (std::size_t i = 0; i < fourth_order.size(); ++i)
            fourth_order[i].seconds.push_back(seconds_of([&] {
                                                for (std::int64_t k = 0; k < evaluations / 4; ++k)
                                                  runge_kutta[i].advance(fourth_order[i].step);
                                              }) /
                                              static_cast<double>(evaluations / 4 * 4) / n);
          for (std::size_t i = 0; i < verlet.size(); ++i)
            verlet[i].seconds.push_back(seconds_of([&] {
                                          for (std::int64_t k = 0; k < evaluations; ++k)
                                            newton[i].advance(verlet[i].step, k % 10 == 0
                                                                                  ? pairs::Wanted::everything
                                                                                  : pairs::Wanted::shear_stress);
                                        }) /
                                        static_cast<double>(evaluations) / n);
          const std::string script = rate == 0.0 ? "nve" : "sheared";
          for (Timing& timing : there) {
            lammps.run({folder,
                        script,
                        {{"steps", fmt::format("{}", evaluations)},
                         {"every", fmt::format("{}", 100 * evaluations)},
                         {"step", fmt::format("{}", timing.step)}},
                        cores},
                       [] { return true; });
            timing.seconds.push_back(loop_seconds(folder / (script + ".log")) / static_cast<double>(evaluations) / n);
          }
        }
        const double ours = median_at(fourth_order, step);
        const double theirs = median_at(there, step);
        fmt::print("| {} | {} | {} | {:.1f} | {} | {:.0f} | {:.1f} |", particles, rate, cores, 1e9 * ours,
                   rate == 0.0 ? fmt::format("{:.1f}", 1e9 * median_at(verlet, step)) : "", 1e9 * theirs,
                   theirs / ours);
        for (const Steps& at : steps)
          fmt::print(" {:.2f} | {:.2f} |",
                     1e6 * std::min(4.0 * median_at(fourth_order, at.fourth_order) / at.fourth_order,
                                    rate == 0.0 ? median_at(verlet, at.verlet) / at.verlet
                                                : std::numeric_limits<double>::infinity()),
                     1e6 * median_at(there, at.lammps) / at.lammps);
        fmt::print("\n");
        std::fflush(stdout);
      }
    }
  }
  fs::remove_all(folder);
  return 0;
}
