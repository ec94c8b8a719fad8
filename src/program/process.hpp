// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Other programs: run, watched, ended.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lucy::program {

struct CommandResult {
  bool succeeded = false;
  std::string output;     ///< of standard output
  std::string errors;     ///< of standard error
  std::string complaint;  ///< why it did not succeed: the last line of its standard error with a word in it, or the
                          ///< signal, or the time
};

struct CommandSettings {
  std::filesystem::path folder = {};   ///< to run in; empty: this one
  std::function<bool()> goes_on = {};  ///< called several times a second; false: the command is asked to end
};

/// Runs a command and waits for it, at most `seconds`; never throws for what the command does. When this program is
/// killed the command is asked to end, too.
CommandResult run_command(const std::vector<std::string>& words, double seconds, const CommandSettings& settings = {});

/// Whether a line of a complaint says something: some programs frame theirs.
bool has_letter(std::string_view line);

/// `words` as one line for a shell.
std::string shell_text(const std::vector<std::string>& words);

}  // namespace lucy::program
