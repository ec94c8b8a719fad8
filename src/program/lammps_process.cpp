// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/lammps_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <limits>
#include <span>
#include <sstream>
#include <system_error>

#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/checkpoint.hpp"
#include "lucy/files/csv.hpp"
#include "program/process.hpp"

namespace lucy::program {

namespace {

namespace fs = std::filesystem;

constexpr double longest_answer = 60.0;  // seconds; it says its version in a tenth of one
constexpr const char* how_to_install =
    "on Debian, `apt-get install lammps` installs it; another place is named with --lammps PROGRAM";

/// "29 Sep 2021 - Update 2" from the first line of `lmp -h`; empty when it is no LAMMPS.
std::string version_of(const std::string& program) {
  const CommandResult answer = run_command({program, "-h"}, longest_answer);
  constexpr std::string_view before = "Simulator - ";
  const std::size_t begin = answer.output.find(before);
  if (begin == std::string::npos) return "";
  const std::size_t first = begin + before.size();
  return answer.output.substr(first, answer.output.find('\n', first) - first);
}

fs::path log_of(const LammpsJob& job) { return job.folder / (job.script + ".log"); }

/// The line of a log that tells of an error; empty when there is none.
std::string error_in(const fs::path& log) {
  std::ifstream file(log);
  std::string line;
  std::string found;
  while (std::getline(file, line))
    if (line.starts_with("ERROR")) found = line;
  return found;
}

/// mpirun frames its complaints and says what matters first.
std::string first_paragraph(const std::string& text) {
  std::istringstream lines(text);
  std::string paragraph;
  for (std::string line; std::getline(lines, line);) {
    if (!has_letter(line) && !paragraph.empty()) break;
    if (has_letter(line)) paragraph += (paragraph.empty() ? "mpirun: " : " ") + line;
  }
  return paragraph;
}

std::vector<std::string> command_of(const std::string& program, const LammpsJob& job) {
  std::vector<std::string> words;
  // Open MPI refuses to start ranks for root, as who it runs in a container, unless told twice.
  if (job.ranks > 1)
    words = {"env", "OMPI_ALLOW_RUN_AS_ROOT=1",  "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1", "mpirun",
             "-np", fmt::format("{}", job.ranks)};
  for (const auto& word : {program, std::string("-in"), job.script + ".in", std::string("-log"), job.script + ".log",
                           std::string("-screen"), std::string("none"), std::string("-nocite")})
    words.push_back(word);
  for (const auto& [name, value] : job.variables)
    for (const auto& word : {std::string("-var"), name, value}) words.push_back(word);
  return words;
}

fs::path record_of(const LammpsJob& job) { return job.folder / (job.script + ".done"); }
fs::path final_state_of(const LammpsJob& job) { return job.folder / (job.script + "_final.data"); }

fs::path beginning_of(const LammpsJob& job) { return job.folder / (job.script + ".begun"); }
fs::path restart_file(const LammpsJob& job, const std::string& which) {
  return job.folder / (job.script + ".restart." + which);
}

/// Whether the last row of the series is that of the last step.
bool series_is_whole(const LammpsJob& job) {
  return job.steps == 0 || last_step_of(job.series()) > static_cast<double>(job.steps - job.series_steps);
}

/// Of all that determines what the job does.
std::string checksum_of(const LammpsJob& job) {
  std::uint64_t sum = 0;
  const auto add = [&](const std::string& text) { sum = files::crc64(std::as_bytes(std::span(text)), sum); };
  for (const auto& name : {job.script + ".in", std::string("start.data"), std::string("lucy.table")})
    add(files::read_text_file(job.folder / name));
  for (const auto& [name, value] : job.variables) add(fmt::format("-var {} {}\n", name, value));
  return fmt::format("CRC-64 {:016x}", sum);
}

std::string record_text(const FinishedJob& finished, const std::string& checksum) {
  return fmt::format("{}\n{}\n{} ranks\n{} seconds\n", finished.version, checksum, finished.ranks, finished.seconds);
}

/// "29 Sep 2021", from the title of a data file that LAMMPS wrote.
std::string version_in(const fs::path& data_file) {
  std::ifstream file(data_file);
  std::string title;
  std::getline(file, title);
  constexpr std::string_view before = "version ";
  const std::size_t begin = title.find(before);
  if (begin == std::string::npos) return "of a version that is not known";
  const std::size_t first = begin + before.size();
  return title.substr(first, title.find(',', first) - first);
}

/// "1" or "2", the newer restart file; empty when there is none of this very case. One that is shorter than the other
/// was being written when the run was cut off.
std::string restart_of(const LammpsJob& job) {
  std::error_code error;
  if (fs::exists(beginning_of(job), error) && files::read_text_file(beginning_of(job)) != checksum_of(job)) return "";
  std::string best;
  for (const std::string which : {"1", "2"}) {
    const fs::path file = restart_file(job, which);
    if (!fs::exists(file, error)) continue;
    if (!best.empty()) {
      const fs::path other = restart_file(job, best);
      const auto size = fs::file_size(file, error);
      const auto other_size = fs::file_size(other, error);
      if (size < other_size ||
          (size == other_size && fs::last_write_time(file, error) < fs::last_write_time(other, error)))
        continue;
    }
    best = which;
  }
  return best;
}

void forget_restarts(const LammpsJob& job) {
  std::error_code error;
  for (const fs::path& old : {beginning_of(job), restart_file(job, "1"), restart_file(job, "2"),
                              job.folder / (job.script + "_series_before.dat")})
    fs::remove(old, error);
}

}  // namespace

Lammps::Lammps(const std::optional<fs::path>& given) {
  const std::vector<std::string> candidates =
      given ? std::vector{given->string()} : std::vector<std::string>{"lmp", "lmp_mpi", "lmp_serial", "lammps"};
  for (const auto& candidate : candidates) {
    version_ = version_of(candidate);
    // Jobs run in folders of their own; a bare name is looked up on PATH.
    program_ = candidate.find('/') == std::string::npos ? candidate : fs::absolute(candidate).string();
    if (!version_.empty()) return;
  }
  if (given) throw RunFailed(fmt::format("{} is not LAMMPS: it does not say its version after -h", given->string()));
  throw RunFailed(fmt::format("LAMMPS is not installed (no lmp on PATH): {}", how_to_install));
}

std::optional<FinishedJob> finished_job(const LammpsJob& job) {
  std::error_code error;
  if (!series_is_whole(job)) return std::nullopt;
  if (!fs::exists(record_of(job), error)) {
    if (job.steps == 0 || !fs::exists(final_state_of(job), error)) return std::nullopt;
    return FinishedJob{version_in(final_state_of(job)), 0, std::numeric_limits<double>::quiet_NaN()};
  }
  FinishedJob finished;
  std::string checksum;
  std::ifstream file(record_of(job));
  std::string unit;
  std::string seconds;
  if (!std::getline(file, finished.version) || !std::getline(file, checksum) || checksum != checksum_of(job) ||
      !(file >> finished.ranks >> unit >> seconds))
    return std::nullopt;
  finished.seconds = files::parse_number(seconds).value_or(std::numeric_limits<double>::quiet_NaN());
  return finished;
}

std::optional<FinishedJob> Lammps::run(const LammpsJob& job, const std::function<bool()>& goes_on) const {
  forget_restarts(job);
  std::error_code error;
  fs::remove(job.series(), error);
  return run_from("", job, goes_on);
}

std::optional<FinishedJob> Lammps::resume(const LammpsJob& job, const std::function<bool()>& goes_on) const {
  const std::string restart = restart_of(job);
  return restart.empty() ? run(job, goes_on) : run_from(restart, job, goes_on);
}

std::optional<FinishedJob> Lammps::run_from(const std::string& restart, LammpsJob job,
                                            const std::function<bool()>& goes_on) const {
  const std::string checksum = checksum_of(job);
  if (!restart.empty()) job.variables.emplace_back("from", restart);
  bool stopped = false;
  CommandSettings settings;
  settings.folder = job.folder;
  settings.goes_on = [&] {
    stopped = stopped || !goes_on();
    return !stopped;
  };
  // What an earlier run left must not be taken for this one's.
  std::error_code error;
  for (const fs::path& old : {record_of(job), final_state_of(job), log_of(job)}) fs::remove(old, error);
  files::write_file_atomically(beginning_of(job), checksum);
  const auto begin = std::chrono::steady_clock::now();
  const CommandResult result =
      run_command(command_of(program_, job), std::numeric_limits<double>::infinity(), settings);
  const std::string script = (job.folder / (job.script + ".in")).string();
  if (!result.succeeded) {
    if (stopped || !goes_on()) return std::nullopt;
    std::string told = error_in(log_of(job));
    if (told.empty()) told = job.ranks > 1 ? first_paragraph(result.errors) : result.complaint;
    throw RunFailed(fmt::format("LAMMPS could not run {}{}: {}", script,
                                restart.empty() ? "" : " from " + restart_file(job, restart).filename().string(),
                                told.empty() ? result.complaint : told));
  }
  if (!series_is_whole(job))
    throw RunFailed(fmt::format("LAMMPS ran {} without complaint, but its series ends at step {:.0f} of {}", script,
                                last_step_of(job.series()), job.steps));
  FinishedJob finished;
  finished.version = version_;
  finished.ranks = job.ranks;
  finished.seconds = restart.empty() ? std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()
                                     : std::numeric_limits<double>::quiet_NaN();
  files::write_file_atomically(record_of(job), record_text(finished, checksum));
  forget_restarts(job);
  return finished;
}

double last_step_of(const fs::path& series) {
  std::ifstream file(series, std::ios::binary | std::ios::ate);
  if (!file) return 0.0;
  const auto size = static_cast<std::streamoff>(file.tellg());
  const std::streamoff tail = std::min<std::streamoff>(size, 2000);
  std::string text(static_cast<std::size_t>(tail), '\0');
  file.seekg(size - tail);
  file.read(text.data(), tail);
  const std::size_t end = text.rfind('\n');
  if (end == std::string::npos || end == 0) return 0.0;
  const std::size_t begin = text.rfind('\n', end - 1) + 1;
  return files::parse_number(std::string_view(text).substr(begin, text.find(' ', begin) - begin)).value_or(0.0);
}

}  // namespace lucy::program
