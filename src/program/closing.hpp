// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The last words of a run, and its pictures. These are drawn by the scripts in analysis/. One that cannot be drawn is
// told of, with the command that would draw it; that is no failure of the run.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "lucy/cases/couette_table.hpp"

namespace lucy::program {

struct Drawing {
  std::string script;                  ///< in analysis/
  std::vector<std::string> arguments;  ///< of the script
  std::filesystem::path picture;       ///< what it writes; draw() never asks whether it is there
};

/// Draws them one after the other; prints what scripts say, and what could not be drawn.
void draw(const std::vector<Drawing>& drawings);

/// On standard output. A reader that goes away (`lucy sweep ... | head -1`) or a full disk there must not keep the
/// pictures from being drawn; the end of the program looks whether everything was written.
template <class... Values>
void print(fmt::format_string<Values...> format, Values&&... values) {
  std::fputs(fmt::format(format, std::forward<Values>(values)...).c_str(), stdout);
}

/// "In DIR: table.csv, replicas.csv, ..." with those of `names` that are there, wrapped.
void print_files(const std::filesystem::path& directory, std::vector<std::string> names);

/// What follows the table of a run: `closing`, those of `drawings` whose pictures are not there yet, and print_files.
void print_closing(const std::filesystem::path& directory, const std::string& closing,
                   const std::vector<Drawing>& drawings, const std::vector<std::string>& names);

/// The exit code of a run of so many points: 0, or 1 after a word on standard error about those that failed.
int tell_failures(std::size_t failed, std::size_t points);

template <class Row>
int tell_failures(const std::vector<Row>& rows) {
  const auto failed =
      std::count_if(rows.begin(), rows.end(), [](const Row& row) { return row.status == cases::RowStatus::failed; });
  return tell_failures(static_cast<std::size_t>(failed), rows.size());
}

}  // namespace lucy::program
