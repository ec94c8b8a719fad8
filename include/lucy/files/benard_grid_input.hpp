// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input file of `lucy benard-grid`: which keys it has, and what the rows of the results are (schema.hpp does the
// reading, refusing, explaining and writing).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/benard_grid.hpp"
#include "lucy/files/schema.hpp"

namespace lucy::files {

/// An input with every list resolved: one point per row of the results, in the order of the file.
struct BenardGridInput {
  std::string title;
  std::vector<cases::BenardGridPoint> points;
  int threads = 0;                    ///< 0: all cores
  double checkpoint_interval = 10.0;  ///< seconds of wall time
};

/// Every key, in the order in which it is explained and written. The defaults are those of BenardGridPoint.
Schema benard_grid_schema();

/// The keys that may differ from row to row, and where each is stored.
std::vector<BoundKey<cases::BenardGridPoint>> benard_grid_keys();

/// Reads `file`, applies the overrides ("section.key=value", as after --set, the last one of a key wins), takes a row
/// for each Rayleigh number and mesh or the [[point]] tables, and passes every point to cases::validate. Throws
/// BadInput: one sentence that starts with "FILE:LINE: ", or with "--set ...: ".
BenardGridInput read_benard_grid(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same points as text that read_benard_grid accepts and that gives back the same bits; threads and
/// checkpoint_interval are left out.
std::string benard_grid_resolved_toml(const BenardGridInput& input);

}  // namespace lucy::files
