// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/python.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "program/process.hpp"

namespace lucy::program {

std::vector<std::string> python_candidates() { return {"/usr/bin/python3", "python3"}; }

std::optional<std::string> find_python(const std::vector<std::string>& candidates,
                                       const std::vector<std::string>& modules) {
  for (const auto& candidate : candidates)
    if (run_command({candidate, "-c", fmt::format("import {}", fmt::join(modules, ", "))}, 60.0).succeeded)
      return candidate;
  return std::nullopt;
}

}  // namespace lucy::program
