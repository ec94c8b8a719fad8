// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/closing.hpp"

#include <system_error>

#include "lucy/errors.hpp"
#include "program/data_directory.hpp"
#include "program/process.hpp"
#include "program/python.hpp"

namespace lucy::program {

namespace {

// Matplotlib draws in seconds; a script that takes this long hangs.
constexpr double longest_drawing = 300.0;

constexpr std::size_t widest_line = 118;

}  // namespace

void draw(const std::vector<Drawing>& drawings) {
  if (drawings.empty()) return;
  std::filesystem::path scripts;
  try {
    scripts = data_directory() / "analysis";
  } catch (const RunFailed& failure) {
    print("\nNo pictures: {}.\n", failure.what());
    return;
  }
  const auto words = [&](const Drawing& drawing, const std::vector<std::string>& interpreter) {
    std::vector<std::string> command = interpreter;
    command.push_back((scripts / drawing.script).string());
    command.insert(command.end(), drawing.arguments.begin(), drawing.arguments.end());
    return command;
  };
  const auto python = find_python(python_candidates(), {"numpy", "matplotlib", "h5py"});
  if (!python) {
    print(
        "\nNo pictures: there is no Python with numpy, matplotlib and h5py (Debian: python3-matplotlib,\n"
        "python3-h5py). With one, to draw them:\n");
    for (const auto& drawing : drawings) print("  {}\n", shell_text(words(drawing, {"python3"})));
    return;
  }
  for (const auto& drawing : drawings) {
    const auto command = words(drawing, {*python, "-B"});
    const CommandResult result = run_command(command, longest_drawing);
    if (!result.output.empty()) print("\n{}", result.output);
    if (!result.succeeded)
      print("\nNo {}: {}\nTo draw it: {}\n", drawing.picture.filename().string(), result.complaint,
            shell_text(command));
  }
}

void print_files(const std::filesystem::path& directory, std::vector<std::string> names) {
  std::error_code error;
  std::erase_if(names, [&](const std::string& name) { return !std::filesystem::exists(directory / name, error); });
  std::string line = fmt::format("In {}:", directory.string());
  print("\n");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string word = names[i] + (i + 1 < names.size() ? "," : "");
    if (line.size() + 1 + word.size() > widest_line) {
      print("{}\n", line);
      line = " ";
    }
    line += ' ' + word;
  }
  print("{}\n", line);
}

void print_closing(const std::filesystem::path& directory, const std::string& closing,
                   const std::vector<Drawing>& drawings, const std::vector<std::string>& names) {
  print("\n{}\n", closing);
  std::fflush(stdout);
  std::vector<Drawing> missing = drawings;
  std::error_code error;
  std::erase_if(missing, [&](const Drawing& drawing) { return std::filesystem::exists(drawing.picture, error); });
  draw(missing);
  print_files(directory, names);
}

int tell_failures(std::size_t failed, std::size_t points) {
  if (failed == 0) return 0;
  std::fflush(stdout);
  const std::string count = fmt::format("lucy: {} of {} point{} failed", failed, points, points == 1 ? "" : "s");
  std::fputs((count + "; the reason stands below the table, and the others are complete\n").c_str(), stderr);
  return 1;
}

}  // namespace lucy::program
