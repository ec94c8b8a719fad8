// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/notes.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <optional>
#include <sstream>
#include <system_error>

#include "lucy/files/atomic_file.hpp"

namespace lucy::program {

namespace {

struct Line {
  std::size_t row;
  std::string text;
};

/// "Point 3 failed: REASON" with `format` "Point %zu failed: %n".
std::optional<Line> row_line(const std::string& line, const char* format) {
  std::size_t number = 0;
  int length = 0;
  if (std::sscanf(line.c_str(), format, &number, &length) != 1 || length == 0 || number == 0) return std::nullopt;
  return Line{number - 1, line.substr(static_cast<std::size_t>(length))};
}

}  // namespace

void write_notes(const std::filesystem::path& path, const Notes& notes) {
  std::string text;
  for (const auto& [row, reason] : notes.failures) text += fmt::format("Point {} failed: {}\n", row + 1, reason);
  for (const auto& [row, sentences] : notes.warnings)
    for (const auto& sentence : sentences) text += fmt::format("Point {} warning: {}\n", row + 1, sentence);
  files::write_file_atomically(path, text + notes.others);
}

Notes read_notes(const std::filesystem::path& path) {
  Notes notes;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return notes;
  std::istringstream lines(files::read_text_file(path));
  for (std::string line; std::getline(lines, line);) {
    if (const auto failed = row_line(line, "Point %zu failed: %n")) {
      notes.failures[failed->row] = failed->text;
    } else if (const auto warning = row_line(line, "Point %zu warning: %n")) {
      notes.warnings[warning->row].push_back(warning->text);
    } else {
      notes.others += line + '\n';
    }
  }
  return notes;
}

}  // namespace lucy::program
