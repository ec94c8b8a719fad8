// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input file of `lucy green-kubo`: which keys it has, and what the rows of viscosity.csv are (schema.hpp does the
// reading, refusing, explaining and writing).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/green_kubo.hpp"
#include "lucy/files/schema.hpp"

namespace lucy::files {

/// An input with every key resolved: one state per row of the table, in the order of the table.
struct GreenKuboInput {
  std::string title;
  std::vector<cases::GreenKuboPoint> points;
  int threads = 0;                    ///< 0: all cores
  double checkpoint_interval = 10.0;  ///< seconds of wall time
};

/// Every key, in the order in which it is explained and written. The defaults are those of GreenKuboPoint.
Schema green_kubo_schema();

/// Reads `file`, applies the overrides ("section.key=value", as after --set, the last one of a key wins), multiplies
/// the lists (particle numbers outermost, energies innermost) or takes the [[point]] tables, and passes every state to
/// cases::validate. Throws BadInput: one sentence that starts with "FILE:LINE: ", or with "--set ...: ".
GreenKuboInput read_green_kubo(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same states as text that read_green_kubo accepts and that gives back the same bits; threads and
/// checkpoint_interval are left out.
std::string green_kubo_resolved_toml(const GreenKuboInput& input);

}  // namespace lucy::files
