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

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/directory_lock.hpp"
#include "lucy/files/input.hpp"
#include "lucy/files/table_csv.hpp"
#include "lucy/files/verdict_file.hpp"
#include "program/build_identity.hpp"
#include "program/closing.hpp"
#include "program/interrupt.hpp"
#include "program/lammps_commands.hpp"
#include "program/lammps_comparison.hpp"
#include "program/output_directory.hpp"
#include "program/prediction.hpp"
#include "program/progress.hpp"

namespace lucy::program {

namespace {

namespace fs = std::filesystem;
using cases::CouettePoint;
using cases::VerdictLine;

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
std::vector<TaskResult> run_tasks(const std::vector<Task>& tasks, const FinishedTasks& kept, int threads,
                                  LammpsComparison& comparison, std::atomic<std::size_t>& done) {
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
        comparison.stop();
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
  refuse_impossible_states(base);
  const Lammps lammps(program);
  LammpsComparison comparison(base, directory, lammps);
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
  std::vector<Task> tasks = {{"single_points", [&] { return comparison.single_points(); }},
                             {"constant_energy", [&] { return comparison.constant_energy(); }}};
  for (const double energy : sheared_energies)
    for (const double rate : sheared_rates)
      tasks.push_back(
          {fmt::format("shear_{}_{}", energy, rate), [&, energy, rate] { return comparison.shear(energy, rate); }});
  std::atomic<std::size_t> done = 0;
  Console console;
  TaskResult all;
  try {
    const Progress progress(console, [&] {
      return fmt::format("{}/{} tasks done  {}  {}", done.load(), tasks.size(), comparison.status(),
                         duration_text(elapsed()));
    });
    for (const TaskResult& result : run_tasks(tasks, kept, threads, comparison, done)) all.append(result);
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
                  threads, threads == 1 ? "" : "s", duration_text(comparison.lammps_seconds())));
}

}  // namespace lucy::program
