// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy sweep` from the input file to the printed table. On disk, in this order:
//
//     DIR, DIR/.lock, input.toml           whose sweep this is
//     checkpoints/                         while it runs; point_001.h5 ... as points end
//     replicas.csv, notes.txt, provenance.json
//     table.csv                            last of all: where it is, the sweep is finished
//     viscosity.png, .svg, configuration_001.png ...  drawn from the above; checkpoints/ goes
//
// A sweep killed anywhere on this way is taken up by the same command; one that has its table.csv is printed again.
#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "lucy/build_record.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/checkpoint.hpp"
#include "lucy/files/directory_lock.hpp"
#include "lucy/files/input.hpp"
#include "lucy/files/provenance.hpp"
#include "lucy/files/table_csv.hpp"
#include "lucy/files/table_text.hpp"
#include "program/build_identity.hpp"
#include "program/commands.hpp"
#include "program/data_directory.hpp"
#include "program/interrupt.hpp"
#include "program/output_directory.hpp"
#include "program/prediction.hpp"
#include "program/progress.hpp"
#include "program/python.hpp"
#include "program/scheduler.hpp"

namespace lucy::program {

namespace {

using files::format_plain;
namespace fs = std::filesystem;

// Below this the replicas contradict their own error bars.
constexpr double least_believable_p_value = 1e-3;

// Matplotlib draws in seconds; a script that takes this long hangs.
constexpr double longest_drawing = 300.0;

/// On standard output. A reader that goes away (`lucy sweep ... | head -1`) or a full disk there must not keep the
/// pictures from being drawn; the end of the program looks whether everything was written.
template <class... Values>
void print(fmt::format_string<Values...> format, Values&&... values) {
  std::fputs(fmt::format(format, std::forward<Values>(values)...).c_str(), stdout);
}

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
fs::path prepare_checkpoints(const fs::path& directory, const std::string& build, Console& console) {
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
                      "the sweep starts from the beginning\n  theirs: {}\n  this: {}",
                      checkpoints.string(), theirs, build));
      fs::remove_all(checkpoints, error);
      if (error) throw RunFailed(fmt::format("cannot remove {}: {}", checkpoints.string(), error.message()));
    }
  }
  make_directory(checkpoints);
  if (there != expected) files::write_file_atomically(record, expected);
  return checkpoints;
}

/// One line on what the watch over the energy saw, over all rows that did not fail.
std::string energy_note(const std::vector<PointResult>& results) {
  double worst = 0.0;
  double most = 0.0;
  std::int64_t steps = 0;
  std::int64_t subdivided = 0;
  for (const auto& result : results) {
    for (const auto& replica : result.replicas) {
      if (result.row.status == cases::RowStatus::failed) continue;
      worst = std::max(worst, replica.worst_energy_error);
      if (std::abs(replica.energy_rescaled) > std::abs(most)) most = replica.energy_rescaled;
      steps += replica.steps;
      subdivided += replica.subdivided_steps;
    }
  }
  if (steps == 0) return "";
  const std::string rescaled =
      most == 0.0
          ? "nothing was rescaled"
          : fmt::format("rescaling put back {} over the run of the replica that needed most", format_plain(most, 2));
  return fmt::format("Energy per particle: largest error of one step {};\n{}.\nSteps subdivided: {} of {}.",
                     format_plain(worst, 2), rescaled, subdivided, steps);
}

/// What a reader has to know beside the table, one or two lines each.
std::vector<std::string> notes_on(const std::vector<cases::CouettePoint>& points,
                                  const std::vector<PointResult>& results) {
  std::vector<std::string> notes;
  if (std::string note = energy_note(results); !note.empty()) notes.push_back(std::move(note));
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i].row.spread.p_value < least_believable_p_value)
      notes.push_back(
          fmt::format("Warning: {}: the replicas differ by more than their error bars allow (chi squared {} for "
                      "{} degrees\nof freedom, p = {}): do not believe the error bar, run longer.",
                      point_label(points[i]), format_plain(results[i].row.spread.chi_squared, 3),
                      results[i].row.spread.degrees_of_freedom, format_plain(results[i].row.spread.p_value, 2)));
  return notes;
}

/// notes.txt: reasons of failures ("Point 3 failed: ..."), then the other notes as they are printed.
std::string notes_file(const std::vector<PointResult>& results, const std::vector<std::string>& notes) {
  std::string text;
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i].row.status == cases::RowStatus::failed)
      text += fmt::format("Point {} failed: {}\n", i + 1, results[i].row.failure);
  for (const auto& note : notes) text += note + '\n';
  return text;
}

/// Gives the reasons in notes.txt back to the rows that failed; returns the other notes.
std::string read_notes(const fs::path& path, std::vector<cases::TableRow>& rows) {
  std::string notes;
  std::error_code error;
  if (!fs::exists(path, error)) return notes;
  std::istringstream lines(files::read_text_file(path));
  for (std::string line; std::getline(lines, line);) {
    std::size_t number = 0;
    int length = 0;
    if (std::sscanf(line.c_str(), "Point %zu failed: %n", &number, &length) == 1 && length > 0 && number >= 1 &&
        number <= rows.size() && rows[number - 1].status == cases::RowStatus::failed)
      rows[number - 1].failure = line.substr(static_cast<std::size_t>(length));
    else
      notes += line + '\n';
  }
  return notes;
}

/// Draws what is not drawn yet. Says what could not be drawn, and how to do it by hand; that is no failure of the
/// sweep.
void draw_pictures(const fs::path& directory, const std::vector<cases::CouettePoint>& points) {
  struct Drawing {
    std::vector<std::string> words;  // without the interpreter
    fs::path picture;
  };
  std::vector<Drawing> drawings;
  std::error_code error;
  fs::path scripts;
  try {
    scripts = data_directory() / "analysis";
  } catch (const RunFailed& failure) {
    print("\nNo pictures: {}.\n", failure.what());
    return;
  }
  if (const auto picture = directory / "viscosity.png"; !fs::exists(picture, error))
    drawings.push_back({{(scripts / "plot_viscosity.py").string(), directory.string()}, picture});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto series = directory / point_file_name(i);
    const auto picture = directory / fmt::format("configuration_{:03}.png", i + 1);
    if (points[i].frame_interval > 0.0 && fs::exists(series, error) && !fs::exists(picture, error))
      drawings.push_back({{(scripts / "plot_configuration.py").string(), series.string(), picture.string()}, picture});
  }
  if (drawings.empty()) return;

  const auto python = find_python(python_candidates(), {"numpy", "matplotlib", "h5py"});
  if (!python) {
    print(
        "\nNo pictures: there is no Python with numpy, matplotlib and h5py (Debian: python3-matplotlib,\n"
        "python3-h5py). With one, to draw them:\n");
    for (auto& drawing : drawings) {
      drawing.words.insert(drawing.words.begin(), "python3");
      print("  {}\n", shell_text(drawing.words));
    }
    return;
  }
  for (auto& drawing : drawings) {
    drawing.words.insert(drawing.words.begin(), {*python, "-B"});
    const ScriptResult result = run_command(drawing.words, longest_drawing);
    if (!result.output.empty()) print("\n{}", result.output);
    if (!result.succeeded)
      print("\nNo {}: {}\nTo draw it: {}\n", drawing.picture.filename().string(), result.complaint,
            shell_text(drawing.words));
  }
}

/// The files of a finished sweep that are there, by their names.
void print_files(const fs::path& directory, std::size_t points) {
  std::vector<std::string> names = {"table.csv",       "replicas.csv",  "notes.txt",    "input.toml",
                                    "provenance.json", "viscosity.png", "viscosity.svg"};
  for (std::size_t i = 0; i < points; ++i) {
    names.push_back(point_file_name(i));
    names.push_back(fmt::format("configuration_{:03}.png", i + 1));
  }
  std::error_code error;
  std::erase_if(names, [&](const std::string& name) { return !fs::exists(directory / name, error); });
  std::string line = fmt::format("In {}:", directory.string());
  print("\n");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string word = names[i] + (i + 1 < names.size() ? "," : "");
    if (line.size() + 1 + word.size() > 118) {
      print("{}\n", line);
      line = " ";
    }
    line += ' ' + word;
  }
  print("{}\n", line);
}

/// The end of every sweep that has its table.csv.
int print_results(const fs::path& directory, const std::vector<cases::CouettePoint>& points,
                  const std::vector<cases::TableRow>& rows, const std::string& notes, const std::string& closing,
                  bool draw) {
  print("{}", files::format_table(rows));
  if (!notes.empty()) print("\n{}", notes);
  print("\n{}\n", closing);
  std::fflush(stdout);
  if (draw) draw_pictures(directory, points);
  print_files(directory, points.size());
  const auto failed = std::count_if(rows.begin(), rows.end(),
                                    [](const cases::TableRow& row) { return row.status == cases::RowStatus::failed; });
  if (failed == 0) return 0;
  std::fflush(stdout);
  const std::string count =
      fmt::format("lucy: {} of {} point{} failed", failed, rows.size(), rows.size() == 1 ? "" : "s");
  std::fputs((count + "; the reason stands below the table, and the others are complete\n").c_str(), stderr);
  return 1;
}

/// What was finished before is read back, not run again.
int print_again(const fs::path& directory, const std::vector<cases::CouettePoint>& points) {
  const fs::path table = directory / "table.csv";
  std::vector<cases::TableRow> rows;
  try {
    rows = files::read_table_csv(table);
  } catch (const BadInput& refusal) {
    throw RunFailed(fmt::format("{} (remove {} to run the sweep again)", refusal.what(), table.string()));
  }
  const bool same = std::equal(rows.begin(), rows.end(), points.begin(), points.end(),
                               [](const cases::TableRow& row, const cases::CouettePoint& point) {
                                 return row.particles == point.particles && row.strain_rate == point.strain_rate &&
                                        row.energy_per_particle == point.energy_per_particle;
                               });
  if (!same)
    throw RunFailed(fmt::format("{} does not hold the rows of {} (remove it to run the sweep again)", table.string(),
                                (directory / "input.toml").string()));
  const std::string notes = read_notes(directory / "notes.txt", rows);
  bool draw = false;
  try {
    const files::DirectoryLock lock(directory);
    std::error_code error;  // what cannot be removed is in nobody's way
    fs::remove_all(directory / "checkpoints", error);
    draw = true;
  } catch (const std::runtime_error&) {
    // Somebody else's directory, or another lucy about to draw: the table can be read all the same.
  }
  return print_results(directory, points, rows, notes,
                       "This sweep was finished before; nothing was run. For a new run choose another --out, or remove "
                       "table.csv.",
                       draw);
}

void write_record(const fs::path& directory, const InputRequest& request, const files::SweepInput& input, int threads,
                  std::chrono::system_clock::time_point started, double seconds, bool resumed,
                  const std::vector<PointResult>& results) {
  const BuildRecord build = build_record();
  files::Provenance provenance;
  provenance.version = build.version;
  provenance.commit = build.commit;
  provenance.compiler = build.compiler;
  provenance.flags = build.flags;
  provenance.generator =
      "64-bit Mersenne twister (std::mt19937_64), one per replica, seeded from the seed, the replica's "
      "number, N, E/N and the strain rate";
  provenance.seed = input.points.front().seed;
  provenance.threads = threads;
  provenance.command_line = request.command_line;
  provenance.started = started;
  provenance.finished = std::chrono::system_clock::now();
  provenance.wall_seconds_of_this_session = seconds;
  for (const auto& result : results) provenance.wall_seconds_of_points.push_back(result.seconds);
  provenance.resumed = resumed;
  files::write_provenance(directory / "provenance.json", provenance);
}

}  // namespace

int sweep(const InputRequest& request) {
  const files::SweepInput input = files::read_sweep(request.input, request.overrides);
  const std::string resolved = files::resolved_toml(input);
  const fs::path directory = request.out.value_or(fs::path("runs") / request.input.stem());
  if (look_at_directory(directory, resolved) == DirectoryState::finished) return print_again(directory, input.points);

  make_directory(directory);
  const files::DirectoryLock lock(directory);
  // Another lucy may have come first.
  const DirectoryState state = look_at_directory(directory, resolved);
  if (state == DirectoryState::finished) return print_again(directory, input.points);
  if (state == DirectoryState::fresh) files::write_file_atomically(directory / "input.toml", resolved);

  note_interrupts();
  const auto started = std::chrono::system_clock::now();
  const auto clock_started = std::chrono::steady_clock::now();
  const auto elapsed = [clock_started] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - clock_started).count();
  };
  const int threads = input.threads > 0 ? input.threads : available_cores();
  Console console;
  const BuildRecord build = build_record();
  const std::string build_text = build_identity();

  Scheduler::Settings settings;
  settings.directory = directory;
  settings.checkpoints = prepare_checkpoints(directory, build_text, console);
  settings.threads = threads;
  settings.checkpoint_interval = input.checkpoint_interval;
  settings.build = build_text;
  settings.authorship = {user_name(), "lucy", fmt::format("{} ({})", build.version, build.commit)};
  settings.watched = console.can_redraw();
  settings.stop_asked = interrupt_noted;
  settings.say = [&console](const std::string& sentence) { console.say(sentence); };
  Scheduler scheduler(input.points, settings);
  const bool resumed = scheduler.resumes();
  if (resumed)
    console.say(fmt::format("resuming in {}: {} % of the work is done", directory.string(),
                            static_cast<int>(100.0 * scheduler.state().fraction)));
  bool done = false;
  try {
    const Progress progress(console, [&] { return status_line(scheduler.state(), elapsed(), console.width()); });
    done = scheduler.run();
  } catch (const RunFailed& failure) {
    throw RunFailed(fmt::format(
        "{}\nlucy: the sweep has stopped; the same command resumes it from its last checkpoints", failure.what()));
  }
  if (!done) {
    console.say("interrupted; the same command resumes");
    return 1;
  }

  const std::vector<PointResult> results = scheduler.results();
  std::vector<cases::TableRow> rows;
  std::vector<cases::ReplicaRow> replicas;
  for (const auto& result : results) {
    rows.push_back(result.row);
    replicas.insert(replicas.end(), result.replicas.begin(), result.replicas.end());
  }
  std::string notes;
  const auto note_list = notes_on(input.points, results);
  for (const auto& note : note_list) notes += note + '\n';
  const double seconds = elapsed();
  files::write_replicas_csv(directory / "replicas.csv", replicas);
  files::write_file_atomically(directory / "notes.txt", notes_file(results, note_list));
  write_record(directory, request, input, threads, started, seconds, resumed, results);
  files::write_table_csv(directory / "table.csv", rows);
  std::error_code error;  // what cannot be removed now goes when the table is printed again
  fs::remove_all(settings.checkpoints, error);

  const std::string closing = fmt::format("Took {} on {} thread{}{}.", duration_text(seconds), threads,
                                          threads == 1 ? "" : "s", resumed ? ", not counting what was resumed" : "");
  return print_results(directory, input.points, rows, notes, closing, true);
}

}  // namespace lucy::program
