// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input file of `lucy benard`: which keys it has, and what its rows are (schema.hpp does the reading, refusing,
// explaining and writing).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/benard.hpp"
#include "lucy/files/schema.hpp"

namespace lucy::files {

/// An input with every list resolved: one point per row of benard.csv, in the order of the file.
struct BenardInput {
  std::string title;
  std::vector<cases::BenardPoint> points;
  int threads = 0;                    ///< 0: all cores
  double checkpoint_interval = 10.0;  ///< seconds of wall time
};

/// Every key, in the order in which it is explained and written. The defaults are those of BenardPoint.
Schema benard_schema();

/// The keys that may differ from row to row, and where each is stored.
std::vector<BoundKey<cases::BenardPoint>> benard_keys();

/// Reads `file`, applies the overrides ("section.key=value", as after --set, the last one of a key wins), takes a row
/// for each number of particles, weight function, range and Rayleigh number or the [[point]] tables, and passes every
/// row to cases::validate. Throws BadInput: one sentence that starts with "FILE:LINE: ", or with "--set ...: ".
BenardInput read_benard(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same rows as text that read_benard accepts and that gives back the same bits; threads and checkpoint_interval
/// are left out.
std::string benard_resolved_toml(const BenardInput& input);

}  // namespace lucy::files
