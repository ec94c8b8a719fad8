// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/errors.hpp"
#include "lucy/files/all_inputs.hpp"
#include "program/commands.hpp"

namespace lucy::program {

namespace {

/// The commands whose inputs know "section", "[section]", "section.key" or "key".
std::vector<std::string> commands_that_know(std::string_view filter) {
  while (!filter.empty() && filter.front() == '[') filter.remove_prefix(1);
  while (!filter.empty() && filter.back() == ']') filter.remove_suffix(1);
  if (const auto dot = filter.find('.'); dot != std::string_view::npos)
    return files::commands_with(filter.substr(0, dot), filter.substr(dot + 1));
  const auto commands = files::commands_with(filter, "");
  return commands.empty() ? files::commands_with("", filter) : commands;
}

}  // namespace

int explain(const std::string& filter, files::InputKind kind) {
  const auto* const named =
      std::ranges::find(files::command_names, kind, [](const auto& known) { return known.second; });
  const std::string_view command = named->first;
  const auto others = commands_that_know(filter);
  if (!filter.empty() && !others.empty() && std::ranges::find(others, command) == others.end()) {
    throw BadInput(fmt::format("an input of `lucy {}` has no '{}'; say whose is meant: --for {}", command, filter,
                               fmt::join(others, " or --for ")));
  }
  fmt::print("{}", files::explain(files::schema_of(kind), filter));
  return 0;
}

}  // namespace lucy::program
