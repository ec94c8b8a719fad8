// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy lammps export`: the states of a sweep as cases for LAMMPS; `lucy lammps run`: those cases, run by LAMMPS, and
// their table.csv. On disk:
//
//     DIR/input.toml, point_001/ ...   the resolved input and a case for each state
//     DIR/export.json                  who wrote it, when and with what
//     DIR/README.txt                   written last by export
//     point_001/nve.done               or sheared.done: by whom it was run; table.csv, written last by run
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
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

constexpr std::string_view exported = "cases for LAMMPS";
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
    "A run that was cut off goes on from its restart files; the script says how.\n"
    "\n"
    "All states, ending in a table.csv with the columns of lucy sweep:\n"
    "\n"
    "  lucy lammps run THIS_DIRECTORY --ranks 2\n";

fs::path default_directory(const InputRequest& request) {
  return fs::path("runs") / (request.input.stem().string() + "_lammps");
}

/// A temperature, and where it is from in half a sentence.
struct Temperature {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::string from;
};

/// LAMMPS has no ergostat: it keeps the temperature that this engine finds at the energy. Nothing when interrupted.
std::optional<Temperature> temperature_of(const CouettePoint& point) {
  if (point.kinetic_temperature) return Temperature{*point.kinetic_temperature, "system.kinetic_temperature"};
  CouettePoint brief = point;
  brief.duration = std::min(point.duration, temperature_duration);
  brief.sample_interval = brief.frame_interval = 0.0;
  cases::CouetteRun run(brief, 0, available_cores());
  if (point.thermostat != motion::Thermostat::isoenergetic) {
    const cases::Frame start = run.frame();
    double sum = 0.0;
    for (const double p : start.momentum) sum += 0.5 * p * p;
    return Temperature{sum / static_cast<double>(point.particles - 1), "that of the start"};
  }
  while (run.intervals_done() < run.intervals_needed(brief.duration)) {
    if (interrupt_noted()) return std::nullopt;
    run.advance_one_sample();
  }
  const cases::TableRow row = cases::summarize(brief, brief.duration, std::span(&run.record(), 1));
  const auto& estimate = row.estimates[cases::quantity("kinetic_temperature")];
  return Temperature{estimate.value,
                     fmt::format("{}, the mean of a run of Lucy's over {} time units with its ergostat",
                                 files::format_with_error(estimate.value, estimate.error), brief.duration)};
}

void refuse_what_lammps_cannot(const CouettePoint& point) {
  if (point.strain_rate != 0.0 && point.thermostat == motion::Thermostat::none)
    throw BadInput(
        "shear.thermostat = \"none\": under shear LAMMPS keeps the temperature; \"isoenergetic\", \"isokinetic\" or "
        "\"nose-hoover\" is needed");
}

/// Only cases of `lucy lammps export` end in a table: a directory of another command holds another one's.
files::SweepInput read_export(const fs::path& directory) {
  std::error_code error;
  for (const char* name : {"README.txt", "input.toml"})
    if (!fs::exists(directory / name, error))
      throw BadInput(fmt::format("{} holds no finished `lucy lammps export`: {} is missing", directory.string(), name));
  const fs::path file = directory / "input.toml";
  const std::string text = files::read_text_file(file);
  if (!text.starts_with(files::resolved_heading(exported)))
    throw BadInput(fmt::format("{}:1: a directory of `lucy lammps export` is expected, and this is another one's: '{}'",
                               file.string(), text.substr(0, text.find('\n'))));
  return files::read_sweep_without_starts(file);
}

/// "LAMMPS 29 Sep 2021 - Update 2, 2 ranks"
std::string engine_text(const FinishedJob& job) {
  if (job.ranks == 0) return fmt::format("LAMMPS {}, run elsewhere", job.version);
  return fmt::format("LAMMPS {}, {} rank{}", job.version, job.ranks, job.ranks == 1 ? "" : "s");
}

}  // namespace

LammpsJob main_job(const fs::path& folder, const CouettePoint& point, int ranks) {
  const std::string script = point.strain_rate == 0.0 ? "nve" : "sheared";
  return {folder, script, {}, ranks, files::lammps_steps(point), files::series_steps(point)};
}

std::string case_folder_name(std::size_t index) { return fmt::format("point_{:03}", index + 1); }

CouettePoint handed_over(const CouettePoint& point) {
  CouettePoint one = point;
  one.replicas = 1;
  one.target_relative_error.reset();
  return one;
}

void write_lammps_provenance(const fs::path& file, const std::vector<std::string>& command_line,
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
  files::write_provenance(file, provenance);
}

int lammps_export(const InputRequest& request) {
  const files::SweepInput input = files::read_sweep(request.input, request.overrides);
  for (const CouettePoint& point : input.points) refuse_what_lammps_cannot(point);
  const std::string resolved = files::resolved_toml(input, exported);
  const fs::path directory = request.out.value_or(default_directory(request));
  const auto look = [&] { return look_at_directory(directory, resolved, "LAMMPS case", "README.txt"); };
  const bool again = look() == DirectoryState::finished;
  const auto started = std::chrono::system_clock::now();
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
      const auto temperature = point.strain_rate == 0.0 ? Temperature{} : temperature_of(point);
      if (!temperature || interrupt_noted()) {
        console.say("interrupted; the same command resumes");
        return 1;
      }
      one.temperature = temperature->value;
      one.temperature_from = temperature->from;
      make_directory(directory / case_folder_name(i));
      files::write_lammps_case(directory / case_folder_name(i), one);
    }
    write_lammps_provenance(directory / "export.json", request.command_line, "", available_cores(),
                            input.points.front().seed, started, {});
    files::write_file_atomically(directory / "README.txt", readme);
  }
  print("{} state{} for LAMMPS in {}{}.\n", input.points.size(), input.points.size() == 1 ? "" : "s",
        directory.string(), again ? ", exported before; nothing was written" : "");
  if (std::ranges::any_of(input.points, [](const CouettePoint& point) { return point.replicas > 1; }))
    print("One replica of each: run.replicas counts for Lucy alone.\n");
  print("Run them with: lucy lammps run {}\n", directory.string());
  return 0;
}

int lammps_run(const LammpsRunRequest& request) {
  const fs::path& directory = request.directory;
  if (request.ranks < 1 || request.ranks > 100000)
    throw BadInput(fmt::format("--ranks = {} must be a whole number from 1 on", request.ranks));
  const files::SweepInput input = read_export(directory);
  const files::DirectoryLock lock(directory);
  const auto started = std::chrono::system_clock::now();
  note_interrupts();
  Console console;
  SharedLine status;
  std::optional<Lammps> lammps;  // needed only where something is left to run
  std::vector<cases::TableRow> rows;
  std::vector<FinishedJob> jobs;
  {
    const Progress progress(console, [&] { return status.get(); });
    for (std::size_t i = 0; i < input.points.size(); ++i) {
      const CouettePoint point = handed_over(input.points[i]);
      const LammpsJob job = main_job(directory / case_folder_name(i), point, request.ranks);
      std::optional<FinishedJob> finished = finished_job(job);
      if (!finished) {
        if (!lammps) lammps.emplace(request.lammps);
        const auto begin = std::chrono::steady_clock::now();
        finished = lammps->resume(job, [&] {
          const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
          const double done = last_step_of(job.series()) / static_cast<double>(job.steps);
          const std::string left = done > 0.0 ? ", " + duration_text(elapsed * (1.0 - done) / done) + " left" : "";
          status.set(fmt::format("{}/{} states  {}: {:.0f} %{}", i + 1, input.points.size(), point_label(point),
                                 100.0 * done, left));
          return !interrupt_noted();
        });
      }
      if (!finished) {
        console.say(
            "interrupted; the same command goes on from this state's last restart file, or else begins it again");
        return 1;
      }
      const cases::CouetteRecord recorded = files::record_of(files::read_lammps_series(job.series()), point);
      rows.push_back(cases::summarize(point, point.duration, std::span(&recorded, 1)));
      jobs.push_back(*finished);
    }
  }
  std::vector<double> seconds;
  std::vector<std::string> engines;
  for (const FinishedJob& job : jobs) {
    seconds.push_back(job.seconds);
    engines.push_back(engine_text(job));
  }
  std::ranges::sort(engines);
  engines.erase(std::unique(engines.begin(), engines.end()), engines.end());
  const std::string engine = fmt::format("{}", fmt::join(engines, "; "));
  write_lammps_provenance(directory / "provenance.json", request.command_line, engine, request.ranks,
                          input.points.front().seed, started, seconds);
  files::write_table_csv(directory / "table.csv", rows);
  print("{}\n", files::format_table(rows));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CouettePoint& point = input.points[i];
    const auto steps = static_cast<double>(files::lammps_steps(point));
    if (std::isnan(seconds[i]))
      print("{}: {}.\n", point_label(point),
            jobs[i].ranks == 0 ? "had been run elsewhere" : "went on after an interruption, its time is not known");
    else
      print("{}: {:.0f} steps in {}, {:.0f} ns per particle and step.\n", point_label(point), steps,
            duration_text(seconds[i]), 1e9 * seconds[i] / steps / static_cast<double>(point.particles));
  }
  print("{}. Energies are not fixed under shear: kT is.\n", engine);
  print_files(directory, {"table.csv", "input.toml", "provenance.json", "README.txt"});
  return 0;
}

}  // namespace lucy::program
