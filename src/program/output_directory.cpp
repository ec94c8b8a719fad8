// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/output_directory.hpp"

#include <fmt/format.h>

#include <sstream>
#include <system_error>

#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"

namespace lucy::program {

namespace {

/// Line and texts where two files part.
std::string first_difference(const std::string& there, const std::string& here) {
  std::istringstream there_lines(there);
  std::istringstream here_lines(here);
  std::string there_line;
  std::string here_line;
  for (int line = 1;; ++line) {
    const bool there_has = static_cast<bool>(std::getline(there_lines, there_line));
    const bool here_has = static_cast<bool>(std::getline(here_lines, here_line));
    if (!there_has && !here_has) return "it differs in its line ends";
    if (!there_has) return fmt::format("line {} is missing there, '{}' here", line, here_line);
    if (!here_has) return fmt::format("line {} is '{}' there, missing here", line, there_line);
    if (there_line != here_line) return fmt::format("line {} is '{}' there, '{}' here", line, there_line, here_line);
  }
}

}  // namespace

DirectoryState look_at_directory(const std::filesystem::path& directory, const std::string& resolved_input,
                                 const std::string& kind, const std::string& results_file) {
  std::error_code error;
  const auto status = std::filesystem::status(directory, error);
  if (status.type() == std::filesystem::file_type::not_found) return DirectoryState::fresh;
  if (error) throw BadInput(fmt::format("cannot look at {}: {}", directory.string(), error.message()));
  if (!std::filesystem::is_directory(status))
    throw BadInput(
        fmt::format("{} is a file: the results need a directory that is new, empty, or holds this same {} "
                    "(choose one with --out)",
                    directory.string(), kind));
  const auto input = directory / "input.toml";
  if (!std::filesystem::exists(input, error)) {
    std::filesystem::directory_iterator entries(directory, error);
    if (error) throw BadInput(fmt::format("cannot look into {}: {}", directory.string(), error.message()));
    for (const auto& entry : entries) {
      const auto name = entry.path().filename();
      if (name != ".lock" && name != files::temporary_beside(input).filename())
        throw BadInput(
            fmt::format("{} is not empty and holds no {} ({} is there, input.toml is not): choose a "
                        "directory that is new or empty with --out",
                        directory.string(), kind, name.string()));
    }
    return DirectoryState::fresh;
  }
  const std::string there = files::read_text_file(input);
  if (there != resolved_input)
    throw BadInput(
        fmt::format("{} holds the results of another input (its input.toml: {}): choose another directory with "
                    "--out",
                    directory.string(), first_difference(there, resolved_input)));
  return std::filesystem::exists(directory / results_file, error) ? DirectoryState::finished
                                                                  : DirectoryState::unfinished;
}

void make_directory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (!error) return;
  const std::string message = fmt::format("cannot make the directory {}: {}", directory.string(), error.message());
  if (error == std::errc::no_space_on_device) throw RunFailed(message);
  throw BadInput(message + " (choose another with --out)");
}

}  // namespace lucy::program
