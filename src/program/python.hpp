// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Analysis scripts are written in Python; here is who finds an interpreter for them.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lucy::program {

/// The interpreters to try, in this order: Debian's own, then the first on PATH.
std::vector<std::string> python_candidates();

/// The first of `candidates` that can import all of `modules`, found by really importing them.
std::optional<std::string> find_python(const std::vector<std::string>& candidates,
                                       const std::vector<std::string>& modules);

}  // namespace lucy::program
