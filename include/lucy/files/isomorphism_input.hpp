// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input file of `lucy isomorphism`: which keys it has, and what its cases are (schema.hpp does the reading,
// refusing, explaining and writing).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/isomorphism.hpp"
#include "lucy/files/schema.hpp"

namespace lucy::files {

/// An input with every key resolved: one case per row of isomorphism.csv, in the order of the file.
struct IsomorphismInput {
  std::string title;
  std::vector<cases::IsomorphismPoint> points;
  int threads = 0;                    ///< 0: all cores
  double checkpoint_interval = 10.0;  ///< seconds of wall time
};

/// Every key, in the order in which it is explained and written. The defaults are those of IsomorphismPoint.
Schema isomorphism_schema();

/// Reads `file`, applies the overrides ("section.key=value", as after --set, the last one of a key wins), multiplies
/// the lists (energies outermost, strain rates innermost) or takes the [[point]] tables, and passes every case to
/// cases::validate. Throws BadInput: one sentence that starts with "FILE:LINE: ", or with "--set ...: ".
IsomorphismInput read_isomorphism(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same cases as text that read_isomorphism accepts and that gives back the same bits; threads and
/// checkpoint_interval are left out.
std::string isomorphism_resolved_toml(const IsomorphismInput& input);

}  // namespace lucy::files
