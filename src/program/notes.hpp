// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// notes.txt: what a reader has to know beside a table of numbers and what the table's columns cannot say, so that a
// finished run can be printed again in full.
//
//     Point 3 failed: REASON
//     Point 2 warning: SENTENCE
//     any other line, as it is printed
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lucy::program {

struct Notes {
  std::map<std::size_t, std::string> failures;               ///< by row, from 0
  std::map<std::size_t, std::vector<std::string>> warnings;  ///< by row, from 0
  std::string others;                                        ///< lines, each with its end
};

/// Throws RunFailed when the disk refuses.
void write_notes(const std::filesystem::path& path, const Notes& notes);

/// None when there is no such file. Throws BadInput when it cannot be read.
Notes read_notes(const std::filesystem::path& path);

}  // namespace lucy::program
