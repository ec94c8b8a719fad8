// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy lammps export`: the states of a sweep as cases for LAMMPS; `lucy lammps run`: those cases, run by LAMMPS, and
// their table.csv. On disk:
//
//     DIR/input.toml, point_001/ ...   the resolved input and a case for each state
//     DIR/README.txt                   written last by export
//     point_001/nve.done               or sheared.done: what has been run; table.csv, written last by run
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/directory_lock.hpp"
#include "lucy/files/input.hpp"
#include "lucy/files/lammps_case.hpp"
#include "lucy/files/table_csv.hpp"
#include "lucy/files/table_text.hpp"
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

constexpr double temperature_duration = 200.0;  // kT is known to a part in a thousand then, at N = 1024

constexpr std::string_view readme =
    "Cases for LAMMPS, written by lucy lammps export; input.toml says what they are.\n"
    "\n"
    "Every folder point_NNN is one state of the table, with everything that LAMMPS needs:\n"
    "\n"
    "  lucy.table        the pair potential\n"
    "  start.data        the start: positions, peculiar velocities\n"
    "  single_point.in   energy, forces and pressure tensor of the start, by the table\n"
    "  exact_point.in    the same, exact to rounding\n"
    "  nve.in            motion at constant energy\n"
    "  sheared.in        steady shear at constant temperature (where the strain rate is not zero)\n"
    "\n"
    "Each script says in its first lines what it does and how it is run. In the folder of a state:\n"
    "\n"
    "  lmp -in sheared.in -log sheared.log\n"
    "  mpirun -np 64 lmp -in sheared.in -log sheared.log\n"
    "\n"
    "or all of them, ending in a table.csv with the columns of lucy sweep:\n"
    "\n"
    "  lucy lammps run THIS_DIRECTORY --ranks 2\n";

fs::path default_directory(const InputRequest& request) {
  return fs::path("runs") / (request.input.stem().string() + "_lammps");
}

/// LAMMPS has no ergostat: it keeps the temperature that this engine finds at the energy.
double temperature_of(const CouettePoint& point) {
  if (point.kinetic_temperature) return *point.kinetic_temperature;
  CouettePoint brief = point;
  brief.duration = std::min(point.duration, temperature_duration);
  brief.sample_interval = 0.0;
  cases::CouetteRun run(brief, 0, available_cores());
  if (point.thermostat != motion::Thermostat::isoenergetic) {
    const cases::Frame start = run.frame();
    double sum = 0.0;
    for (const double p : start.momentum) sum += 0.5 * p * p;
    return sum / static_cast<double>(point.particles - 1);
  }
  while (run.intervals_done() < run.intervals_needed(brief.duration)) {
    if (interrupt_noted()) return std::numeric_limits<double>::quiet_NaN();
    run.advance_one_sample();
  }
  const cases::TableRow row = cases::summarize(brief, brief.duration, std::span(&run.record(), 1));
  return row.estimates[cases::quantity("kinetic_temperature")].value;
}

void refuse_what_lammps_cannot(const CouettePoint& point) {
  if (point.strain_rate != 0.0 && point.thermostat == motion::Thermostat::none)
    throw BadInput(
        "shear.thermostat = \"none\": under shear LAMMPS keeps the temperature; \"isoenergetic\", \"isokinetic\" or "
        "\"nose-hoover\" is needed");
}

}  // namespace

std::string case_folder_name(std::size_t index) { return fmt::format("point_{:03}", index + 1); }

CouettePoint handed_over(const CouettePoint& point) {
  CouettePoint one = point;
  one.replicas = 1;
  one.frame_interval = 0.0;
  one.target_relative_error.reset();
  return one;
}

std::string script_of(const CouettePoint& point) { return point.strain_rate == 0.0 ? "nve" : "sheared"; }

void write_lammps_provenance(const fs::path& directory, const std::vector<std::string>& command_line,
                             const std::string& engine, int threads, std::uint64_t seed,
                             std::chrono::system_clock::time_point started, const std::vector<double>& seconds) {
  files::Provenance provenance = provenance_of(command_line);
  provenance.engine = engine;
  provenance.generator = "64-bit Mersenne twister (std::mt19937_64), for the start";
  provenance.seed = seed;
  provenance.threads = threads;
  provenance.started = started;
  provenance.finished = std::chrono::system_clock::now();
  provenance.wall_seconds_of_this_session = std::chrono::duration<double>(provenance.finished - started).count();
  provenance.wall_seconds_of_points = seconds;
  files::write_provenance(directory / "provenance.json", provenance);
}

int lammps_export(const InputRequest& request) {
  const files::SweepInput input = files::read_sweep(request.input, request.overrides);
  for (const CouettePoint& point : input.points) refuse_what_lammps_cannot(point);
  const std::string resolved = files::resolved_toml(input);
  const fs::path directory = request.out.value_or(default_directory(request));
  const auto look = [&] { return look_at_directory(directory, resolved, "LAMMPS case", "README.txt"); };
  const bool again = look() == DirectoryState::finished;
  if (!again) {
    make_directory(directory);
    const files::DirectoryLock lock(directory);
    if (look() == DirectoryState::fresh) files::write_file_atomically(directory / "input.toml", resolved);
    note_interrupts();
    Console console;
    SharedLine status;
    const Progress progress(console, [&] { return status.get(); });
    for (std::size_t i = 0; i < input.points.size(); ++i) {
      const CouettePoint point = handed_over(input.points[i]);
      status.set(fmt::format("{}/{} states  {}", i + 1, input.points.size(), point_label(point)));
      files::LammpsCase one;
      one.point = point;
      one.start = cases::CouetteRun(point, 0).frame();
      if (point.strain_rate != 0.0) one.temperature = temperature_of(point);
      if (interrupt_noted()) {
        console.say("interrupted; the same command resumes");
        return 1;
      }
      make_directory(directory / case_folder_name(i));
      files::write_lammps_case(directory / case_folder_name(i), one);
    }
    files::write_file_atomically(directory / "README.txt", readme);
  }
  print("{} state{} for LAMMPS in {}{}.\n", input.points.size(), input.points.size() == 1 ? "" : "s",
        directory.string(), again ? ", exported before; nothing was written" : "");
  print("Run them with: lucy lammps run {}\n", directory.string());
  return 0;
}

int lammps_run(const LammpsRunRequest& request) {
  const fs::path& directory = request.directory;
  std::error_code error;
  if (!fs::exists(directory / "README.txt", error) || !fs::exists(directory / "input.toml", error))
    throw BadInput(fmt::format("{} holds no finished `lucy lammps export` (README.txt and input.toml are missing)",
                               directory.string()));
  if (request.ranks < 1 || request.ranks > 100000)
    throw BadInput(fmt::format("--ranks = {} must be a whole number from 1 on", request.ranks));
  const files::SweepInput input = files::read_sweep(directory / "input.toml");
  const Lammps lammps(request.lammps);
  const files::DirectoryLock lock(directory);
  const auto started = std::chrono::system_clock::now();
  note_interrupts();
  Console console;
  SharedLine status;
  std::vector<cases::TableRow> rows;
  std::vector<double> seconds;
  {
    const Progress progress(console, [&] { return status.get(); });
    for (std::size_t i = 0; i < input.points.size(); ++i) {
      const CouettePoint point = handed_over(input.points[i]);
      const LammpsJob job{directory / case_folder_name(i), script_of(point), {}, request.ranks};
      const fs::path series = job.folder / (job.script + "_series.dat");
      const auto steps = static_cast<double>(files::lammps_steps(point));
      const auto begin = std::chrono::steady_clock::now();
      const auto watch = [&] {
        const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        status.set(fmt::format("{}/{} states  {}: {:.0f} %  {}", i + 1, input.points.size(), point_label(point),
                               100.0 * last_step_of(series) / steps, duration_text(elapsed)));
        return !interrupt_noted();
      };
      const bool done_here = fs::exists(job.folder / (job.script + ".done"), error);
      // On a cluster, say, by hand: the final state is written last of all.
      const bool done_elsewhere = !done_here && fs::exists(job.folder / (job.script + "_final.data"), error) &&
                                  last_step_of(series) > steps - files::series_steps(point);
      if (!done_here && !done_elsewhere) fs::remove(series, error);
      const auto took =
          done_elsewhere ? std::optional(std::numeric_limits<double>::quiet_NaN()) : lammps.run_once(job, watch);
      if (!took) {
        console.say("interrupted; the same command goes on with the state that was running");
        return 1;
      }
      const cases::CouetteRecord recorded = files::record_of(files::read_lammps_series(series), point);
      rows.push_back(cases::summarize(point, point.duration, std::span(&recorded, 1)));
      seconds.push_back(*took);
    }
  }
  write_lammps_provenance(
      directory, request.command_line,
      fmt::format("LAMMPS {}, {} rank{}", lammps.version(), request.ranks, request.ranks == 1 ? "" : "s"),
      request.ranks, input.points.front().seed, started, seconds);
  files::write_table_csv(directory / "table.csv", rows);
  print("{}\n", files::format_table(rows));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CouettePoint& point = input.points[i];
    if (std::isnan(seconds[i])) {
      print("{}: had been run elsewhere.\n", point_label(point));
      continue;
    }
    print("{}: {} steps in {}, {:.0f} ns per particle and step.\n", point_label(point), files::lammps_steps(point),
          duration_text(seconds[i]),
          1e9 * seconds[i] / static_cast<double>(files::lammps_steps(point)) / static_cast<double>(point.particles));
  }
  print("LAMMPS {} on {} rank{}. Energies are not fixed under shear: kT is.\n", lammps.version(), request.ranks,
        request.ranks == 1 ? "" : "s");
  print_files(directory, {"table.csv", "input.toml", "provenance.json", "README.txt"});
  return 0;
}

}  // namespace lucy::program
