// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a directory may take the results of a run: only an empty or new one, or one that holds the same run.
#pragma once

#include <filesystem>
#include <string>

namespace lucy::program {

enum class DirectoryState {
  fresh,       ///< not there, or empty (a lock and a half-written input.toml do not count)
  unfinished,  ///< holds this run, interrupted
  finished,    ///< holds this run and its results file, which is written last
};

/// Looks without touching anything. `resolved_input` is what input.toml of this run holds, `kind` what the run is
/// called in messages ("sweep"), `results_file` the file that is written last. Throws BadInput when the directory holds
/// anything else, or is none.
DirectoryState look_at_directory(const std::filesystem::path& directory, const std::string& resolved_input,
                                 const std::string& kind, const std::string& results_file);

/// Makes the directory and those above it. Throws BadInput, or RunFailed when the disk is full.
void make_directory(const std::filesystem::path& directory);

}  // namespace lucy::program
