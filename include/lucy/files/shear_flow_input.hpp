// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input file of `lucy shear-flow`: which keys it has, and what its rows are (schema.hpp does the reading, refusing,
// explaining and writing).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/shear_flow.hpp"
#include "lucy/files/schema.hpp"

namespace lucy::files {

/// An input with every key resolved: one point per row of shear_flow.csv, in the order of the file.
struct ShearFlowInput {
  std::string title;
  std::vector<cases::ShearFlowPoint> points;
  int threads = 0;                    ///< 0: all cores
  double checkpoint_interval = 10.0;  ///< seconds of wall time
};

/// Every key, in the order in which it is explained and written. The defaults are those of ShearFlowPoint.
Schema shear_flow_schema();

/// Reads `file`, applies the overrides ("section.key=value", as after --set, the last one of a key wins), takes one row
/// per strain rate or the [[point]] tables, and passes every row to cases::validate. Throws BadInput: one sentence that
/// starts with "FILE:LINE: ", or with "--set ...: ".
ShearFlowInput read_shear_flow(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same rows as text that read_shear_flow accepts and that gives back the same bits; threads and
/// checkpoint_interval are left out.
std::string shear_flow_resolved_toml(const ShearFlowInput& input);

}  // namespace lucy::files
