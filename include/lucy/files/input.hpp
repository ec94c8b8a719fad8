// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input file of `lucy sweep`: which keys it has, and what the rows of the table are.
// The machinery (reading, refusing, explaining, writing) is in schema.hpp; here is only the list of keys.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/cases/couette.hpp"
#include "lucy/files/schema.hpp"

namespace lucy::files {

/// A sweep with every key resolved: one point per row of the table, in the order of the table.
struct SweepInput {
  std::string title;
  std::vector<cases::CouettePoint> points;
  int threads = 0;                    ///< 0: all cores
  double checkpoint_interval = 10.0;  ///< seconds of wall time
};

/// Every key of a sweep, in the order in which it is explained and written. The defaults are those of CouettePoint.
Schema sweep_schema();

/// Reads `file`, applies the overrides ("section.key=value", as after --set, the last one of a key wins), multiplies
/// the lists (energies outermost, strain rates innermost) or takes the [[point]] tables, and passes every point to
/// cases::validate. Throws BadInput: one sentence that starts with "FILE:LINE: ", or with "--set ...: ".
SweepInput read_sweep(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same of a resolved input whose points have been run, or handed over: the files that system.start names need not
/// be there any more. Points with such a start have no start_frame and are not judged again; they cannot be run.
SweepInput read_sweep_without_starts(const std::filesystem::path& file);

/// The same points as text that read_sweep accepts and that gives back the same bits: what all points share in the
/// sections, the rest in one [[point]] table each. Threads and checkpoint_interval are left out: they change no result.
/// `what` was run with it, which no other command may take for its own.
std::string resolved_toml(const SweepInput& input, std::string_view what = "a sweep");

}  // namespace lucy::files
