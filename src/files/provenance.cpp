// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/provenance.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <ctime>
#include <fstream>

#include "lucy/files/atomic_file.hpp"
#include "lucy/files/csv.hpp"

namespace lucy::files {

namespace {

/// Bytes of the UTF-8 character at the start of `text`; 0 when there is none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = byte(0) < 0x80       ? 1
                             : byte(0) >> 5 == 6  ? 2
                             : byte(0) >> 4 == 14 ? 3
                             : byte(0) >> 3 == 30 ? 4
                                                  : 0;
  if (length == 0 || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (byte(i) >> 6 != 2) return 0;
  const bool overlong = (length == 2 && byte(0) < 0xC2) || (length == 3 && byte(0) == 0xE0 && byte(1) < 0xA0) ||
                        (length == 4 && byte(0) == 0xF0 && byte(1) < 0x90);
  const bool beyond = (length == 3 && byte(0) == 0xED && byte(1) > 0x9F) ||
                      (length == 4 && (byte(0) > 0xF4 || (byte(0) == 0xF4 && byte(1) > 0x8F)));
  return overlong || beyond ? 0 : length;
}

std::string json_number(double value) { return std::isfinite(value) ? shortest_text(value) : "null"; }

}  // namespace

std::string processor_model() {
  std::ifstream information("/proc/cpuinfo");
  std::string line;
  while (std::getline(information, line)) {
    if (!line.starts_with("model name")) continue;
    const std::size_t start = line.find_first_not_of(" \t", line.find(':') + 1);
    if (line.find(':') != std::string::npos && start != std::string::npos) return line.substr(start);
  }
  return "unknown";
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string utc_text(std::chrono::system_clock::time_point time) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

std::string json_string(std::string_view text) {
  std::string json = "\"";
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const char c = text.front();
    if (length == 0) {
      json += "\uFFFD";
    } else if (c == '"' || c == '\\') {
      json += '\\';
      json += c;
    } else if (c == '\n') {
      json += "\\n";
    } else if (c == '\t') {
      json += "\\t";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      json += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      json += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return json + '"';
}

void write_provenance(const std::filesystem::path& path, const Provenance& provenance) {
  std::string command_line;
  for (const auto& word : provenance.command_line)
    command_line += (command_line.empty() ? "" : ", ") + json_string(word);
  std::string points;
  for (const double seconds : provenance.wall_seconds_of_points)
    points += (points.empty() ? "" : ", ") + json_number(seconds);

  std::string text = "{\n";
  const auto add = [&text](std::string_view key, const std::string& value, bool last = false) {
    text += fmt::format("  {}: {}{}\n", json_string(key), value, last ? "" : ",");
  };
  add("program", json_string("lucy"));
  add("version", json_string(provenance.version));
  add("commit", json_string(provenance.commit));
  add("compiler", json_string(provenance.compiler));
  add("flags", json_string(provenance.flags));
  if (!provenance.engine.empty()) add("engine", json_string(provenance.engine));
  add("processor", json_string(processor_model()));
  add("host", json_string(host_name()));
  add("threads", fmt::format("{}", provenance.threads));
  add("generator", json_string(provenance.generator));
  add("seed", fmt::format("{}", provenance.seed));
  add("command_line", fmt::format("[{}]", command_line));
  add("started", json_string(utc_text(provenance.started)));
  add("finished", json_string(utc_text(provenance.finished)));
  add("resumed", provenance.resumed ? "true" : "false");
  add("wall_seconds_of_this_session", json_number(provenance.wall_seconds_of_this_session));
  add("wall_seconds_of_points", fmt::format("[{}]", points));
  add("wall_seconds_note",
      json_string("of_this_session: since the program was started last; of_points: of all sessions, summed over the "
                  "replicas of each row of the results"),
      true);
  write_file_atomically(path, text + "}\n");
}

}  // namespace lucy::files
