// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/lammps_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <fstream>
#include <limits>
#include <system_error>

#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/csv.hpp"
#include "program/python.hpp"

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

/// The line of a log that tells of an error; empty when there is none.
std::string error_in(const fs::path& log) {
  std::ifstream file(log);
  std::string line;
  std::string found;
  while (std::getline(file, line))
    if (line.starts_with("ERROR")) found = line;
  return found;
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

}  // namespace

Lammps::Lammps(const std::optional<fs::path>& given) {
  const std::vector<std::string> candidates =
      given ? std::vector{given->string()} : std::vector<std::string>{"lmp", "lmp_mpi", "lmp_serial", "lammps"};
  for (const auto& candidate : candidates) {
    version_ = version_of(candidate);
    program_ = candidate;
    if (!version_.empty()) return;
  }
  if (given) throw RunFailed(fmt::format("{} is not LAMMPS: it does not say its version after -h", given->string()));
  throw RunFailed(fmt::format("LAMMPS is not installed (no lmp on PATH): {}", how_to_install));
}

std::optional<double> Lammps::run(const LammpsJob& job, const std::function<bool()>& goes_on) const {
  const auto words = command_of(program_, job);
  bool stopped = false;
  CommandSettings settings;
  settings.folder = job.folder;
  settings.goes_on = [&] {
    stopped = stopped || !goes_on();
    return !stopped;
  };
  std::error_code error;
  fs::remove(job.folder / (job.script + ".log"), error);  // an old error must not be taken for a new one
  const auto begin = std::chrono::steady_clock::now();
  const CommandResult result = run_command(words, std::numeric_limits<double>::infinity(), settings);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (result.succeeded) return seconds;
  if (stopped || !goes_on()) return std::nullopt;
  const std::string told = error_in(job.folder / (job.script + ".log"));
  throw RunFailed(fmt::format("LAMMPS could not run {}: {}", (job.folder / (job.script + ".in")).string(),
                              told.empty() ? result.complaint : told));
}

std::optional<double> Lammps::run_once(const LammpsJob& job, const std::function<bool()>& goes_on) const {
  const fs::path record = job.folder / (job.script + ".done");
  std::string what = fmt::format("LAMMPS {}\n{}\n", version_, shell_text(command_of("lmp", job)));
  std::error_code error;
  if (fs::exists(record, error)) {
    const std::string there = files::read_text_file(record);
    double seconds = 0.0;
    if (there.starts_with(what) &&
        std::from_chars(there.data() + what.size(), there.data() + there.size(), seconds).ec == std::errc())
      return seconds;
  }
  const auto seconds = run(job, goes_on);
  if (seconds) files::write_file_atomically(record, what + fmt::format("{} seconds\n", *seconds));
  return seconds;
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
