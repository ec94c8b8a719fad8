// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a directory may take the results of a sweep: only an empty or new one, or one that holds the same sweep.
#pragma once

#include <filesystem>
#include <string>

namespace lucy::program {

enum class DirectoryState {
  fresh,       ///< not there, or empty (a lock and a half-written input.toml do not count)
  unfinished,  ///< holds this sweep, interrupted
  finished,    ///< holds this sweep and its table.csv, which is written last
};

/// Looks without touching anything. `resolved_input` is what input.toml of this sweep holds.
/// Throws BadInput when the directory holds anything else, or is none.
DirectoryState look_at_directory(const std::filesystem::path& directory, const std::string& resolved_input);

/// Makes the directory and those above it. Throws BadInput, or RunFailed when the disk is full.
void make_directory(const std::filesystem::path& directory);

}  // namespace lucy::program
