// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/run_experiment.hpp"

#include <fmt/format.h>
#include <pwd.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "lucy/build_record.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/checkpoint.hpp"
#include "lucy/files/directory_lock.hpp"
#include "lucy/files/provenance.hpp"
#include "program/build_identity.hpp"
#include "program/interrupt.hpp"
#include "program/output_directory.hpp"
#include "program/prediction.hpp"
#include "program/progress.hpp"
#include "program/scheduler.hpp"

namespace lucy::program {

namespace {

namespace fs = std::filesystem;

std::string user_name() {
  const passwd* entry = ::getpwuid(::geteuid());
  return entry != nullptr && entry->pw_name[0] != '\0' ? entry->pw_name : "unknown";
}

/// checkpoints/build.txt: the build in one line, and in a second one a checksum of the first.
std::string build_record_text(const std::string& build) {
  return fmt::format("{}\nCRC-64 {:016x}\n", build, files::crc64(std::as_bytes(std::span(build))));
}

/// Checkpoints of another build are of no use: its arithmetic may differ in the last bit. Each of them knows its build
/// and is judged by it; the record says it once for all. Where it is gone or damaged, it is written anew.
fs::path prepare_checkpoints(const fs::path& directory, const std::string& kind, const std::string& build,
                             Console& console) {
  fs::path checkpoints = directory / "checkpoints";
  const fs::path record = checkpoints / "build.txt";
  const std::string expected = build_record_text(build);
  std::error_code error;
  std::string there;
  if (fs::exists(record, error)) {
    try {
      there = files::read_text_file(record);
    } catch (const BadInput&) {
      there.clear();  // as damaged as can be
    }
    const std::string theirs = there.substr(0, there.find('\n'));
    if (there != build_record_text(theirs)) {
      console.say(
          fmt::format("{} is damaged and is written anew; the checkpoints are judged one by one", record.string()));
    } else if (theirs != build) {
      console.say(
          fmt::format("the checkpoints in {} are of another build of Lucy, whose bits this one cannot promise: "
                      "the {} starts from the beginning\n  theirs: {}\n  this: {}",
                      checkpoints.string(), kind, theirs, build));
      fs::remove_all(checkpoints, error);
      if (error) throw RunFailed(fmt::format("cannot remove {}: {}", checkpoints.string(), error.message()));
    }
  }
  make_directory(checkpoints);
  if (there != expected) files::write_file_atomically(record, expected);
  return checkpoints;
}

/// What was finished before is read back, not run again.
int print_again(const fs::path& directory, Experiment& experiment) {
  try {
    experiment.read_back(directory);
  } catch (const BadInput& refusal) {
    throw RunFailed(fmt::format("{} (remove {} to run the {} again)", refusal.what(),
                                (directory / experiment.results_file()).string(), experiment.kind()));
  }
  bool draw = false;
  try {
    const files::DirectoryLock lock(directory);
    std::error_code error;  // what cannot be removed is in nobody's way
    fs::remove_all(directory / "checkpoints", error);
    draw = true;
  } catch (const std::runtime_error&) {
    // Somebody else's directory, or another lucy about to draw: the results can be read all the same.
  }
  return experiment.print(directory,
                          fmt::format("This {} was finished before; nothing was run. For a new run choose another "
                                      "--out, or remove {}.",
                                      experiment.kind(), experiment.results_file()),
                          draw);
}

struct Session {
  int threads = 1;
  std::chrono::system_clock::time_point started;
  double seconds = 0.0;
  bool resumed = false;
};

void write_record(const fs::path& directory, const InputRequest& request, const Experiment& experiment,
                  const Session& session) {
  files::Provenance provenance = provenance_of(request.command_line);
  provenance.generator = experiment.generator();
  provenance.seed = experiment.seed();
  provenance.threads = session.threads;
  provenance.started = session.started;
  provenance.finished = std::chrono::system_clock::now();
  provenance.wall_seconds_of_this_session = session.seconds;
  provenance.wall_seconds_of_points = experiment.seconds_of_points();
  provenance.resumed = session.resumed;
  files::write_provenance(directory / "provenance.json", provenance);
}

/// What this machine has, or the process is allowed, in bytes.
double memory_at_hand() {
  const double physical =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  rlimit allowed{};
  if (::getrlimit(RLIMIT_AS, &allowed) != 0 || allowed.rlim_cur == RLIM_INFINITY) return physical;
  return std::min(physical, static_cast<double>(allowed.rlim_cur));
}

void refuse_what_memory_cannot_hold(const Experiment& experiment) {
  const int threads = experiment.threads() > 0 ? experiment.threads() : available_cores();
  const auto [particles, replicas, bytes] = experiment.appetite(threads);
  const double memory = memory_at_hand();
  if (bytes > memory) {
    throw BadInput(
        fmt::format("system.particles = {} takes about {:.0f} GB of memory with {} replica{} at a time, and there are "
                    "{:.0f} GB",
                    particles, 1e-9 * bytes, replicas, replicas == 1 ? "" : "s", 1e-9 * memory));
  }
}

}  // namespace

int run_experiment(const InputRequest& request, Experiment& experiment) {
  const std::string resolved = experiment.resolved();
  const std::string kind = experiment.kind();
  const fs::path directory = request.out.value_or(fs::path("runs") / request.input.stem());
  const auto look = [&] { return look_at_directory(directory, resolved, kind, experiment.results_file()); };
  if (look() == DirectoryState::finished) return print_again(directory, experiment);
  refuse_what_memory_cannot_hold(experiment);

  make_directory(directory);
  const files::DirectoryLock lock(directory);
  // Another lucy may have come first.
  const DirectoryState state = look();
  if (state == DirectoryState::finished) return print_again(directory, experiment);
  if (state == DirectoryState::fresh) files::write_file_atomically(directory / "input.toml", resolved);

  note_interrupts();
  Session session;
  session.started = std::chrono::system_clock::now();
  const auto clock_started = std::chrono::steady_clock::now();
  const auto elapsed = [clock_started] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - clock_started).count();
  };
  session.threads = experiment.threads() > 0 ? experiment.threads() : available_cores();
  Console console;
  const BuildRecord build = build_record();

  Scheduler::Settings settings;
  settings.build = build_identity();
  settings.checkpoints = prepare_checkpoints(directory, kind, settings.build, console);
  settings.threads = session.threads;
  settings.checkpoint_interval = experiment.checkpoint_interval();
  settings.watched = console.can_redraw();
  settings.stop_asked = interrupt_noted;
  settings.say = [&console](const std::string& sentence) { console.say(sentence); };
  const std::vector<StatePoint*> points =
      experiment.prepare(directory, {user_name(), "lucy", fmt::format("{} ({})", build.version, build.commit)});
  Scheduler scheduler(points, settings);
  session.resumed = scheduler.resumes();
  if (session.resumed)
    console.say(fmt::format("resuming in {}: {} % of the work is done", directory.string(),
                            static_cast<int>(100.0 * scheduler.state().fraction)));
  bool done = false;
  try {
    const Progress progress(console, [&] { return status_line(scheduler.state(), elapsed(), console.width()); });
    done = scheduler.run();
  } catch (const RunFailed& failure) {
    throw RunFailed(fmt::format("{}\nlucy: the {} has stopped; the same command resumes it from its last checkpoints",
                                failure.what(), kind));
  }
  if (!done) {
    console.say("interrupted; the same command resumes");
    return 1;
  }

  session.seconds = elapsed();
  experiment.write_companions(directory);
  write_record(directory, request, experiment, session);
  experiment.write_results(directory);
  std::error_code error;  // what cannot be removed now goes when the results are printed again
  fs::remove_all(settings.checkpoints, error);

  return experiment.print(
      directory,
      fmt::format("Took {} on {} thread{}{}.", duration_text(session.seconds), session.threads,
                  session.threads == 1 ? "" : "s", session.resumed ? ", not counting what was resumed" : ""),
      true);
}

}  // namespace lucy::program
