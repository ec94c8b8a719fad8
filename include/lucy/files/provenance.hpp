// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// provenance.json: everything about a run that is not its result: who, where, with what, how long.
// Of a sweep that was interrupted and resumed, command line, threads, started, finished and
// wall_seconds_of_this_session are those of the last session alone; wall_seconds_of_points covers all sessions, except
// what was lost when one was killed after its last checkpoint.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lucy::files {

struct Provenance {
  std::string version;
  std::string commit;
  std::string compiler;
  std::string flags;
  std::string engine = {};  ///< another program that did the work; empty: none did, and nothing is said
  std::string generator;    ///< of random numbers
  std::uint64_t seed = 0;
  int threads = 0;
  std::vector<std::string> command_line;
  std::chrono::system_clock::time_point started;
  std::chrono::system_clock::time_point finished;
  double wall_seconds_of_this_session = 0.0;
  /// Of all sessions, summed over replicas, in the order of table.csv; nan (null in the file): not measured.
  std::vector<double> wall_seconds_of_points;
  bool resumed = false;
};

/// The model of this machine's processor ("unknown" when it does not say), and its name in the network.
std::string processor_model();
std::string host_name();

/// 2026-02-03T04:05:06Z
std::string utc_text(std::chrono::system_clock::time_point time);

/// Adds processor and host. Throws RunFailed when the disk refuses.
void write_provenance(const std::filesystem::path& path, const Provenance& provenance);

/// `text` as a JSON string, quotation marks included; bytes that are not UTF-8 become U+FFFD.
std::string json_string(std::string_view text);

}  // namespace lucy::files
