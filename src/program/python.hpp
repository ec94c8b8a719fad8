// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plots are Python scripts; here is who finds an interpreter for them, and who runs them and other commands.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace lucy::program {

struct CommandResult {
  bool succeeded = false;
  std::string output;     ///< of standard output
  std::string complaint;  ///< why it did not succeed: the last line of its standard error, or the signal, or the time
};

/// The interpreters to try, in this order: Debian's own, then the first on PATH.
std::vector<std::string> python_candidates();

/// The first of `candidates` that can import all of `modules`, found by really importing them.
std::optional<std::string> find_python(const std::vector<std::string>& candidates,
                                       const std::vector<std::string>& modules);

struct CommandSettings {
  std::filesystem::path folder = {};   ///< to run in; empty: this one
  std::function<bool()> goes_on = {};  ///< called several times a second; false: the command is asked to end
};

/// Runs a command and waits for it, at most `seconds`; never throws for what the command does.
CommandResult run_command(const std::vector<std::string>& words, double seconds, const CommandSettings& settings = {});

/// `words` as one line for a shell.
std::string shell_text(const std::vector<std::string>& words);

}  // namespace lucy::program
