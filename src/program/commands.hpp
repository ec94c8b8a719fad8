// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The commands of the program. Each prints its answer on standard output and returns the exit code: 0 done, 1 ran but
// failed (or disagreed). BadInput (2), RunFailed (1) and what else is thrown are for command_line.cpp to tell.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lucy::program {

/// The input of a command that reads one, with what the command line changes.
struct InputRequest {
  std::filesystem::path input;
  std::vector<std::string> overrides;             ///< "section.key=value"
  std::optional<std::filesystem::path> out = {};  ///< default: runs/STEM
  std::vector<std::string> command_line = {};     ///< as typed, for the record
};

/// Runs every point of a sweep, or goes on with it, and writes table.csv and its companions (sweep.cpp).
int sweep(const InputRequest& request);

/// Says what a sweep would do and cost; writes nothing (check.cpp).
int check(const InputRequest& request);

/// Prints the keys of an input file (explain.cpp). `filter`: a section or a key, or empty.
int explain(const std::string& filter);

/// A table.csv, or the directory that holds it, beside a published table: by name, or a file (compare.cpp).
int compare(const std::filesystem::path& table, const std::string& published);

}  // namespace lucy::program
