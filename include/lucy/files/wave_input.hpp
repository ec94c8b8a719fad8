// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input files of `lucy shear-wave` and `lucy temperature-wave`: which keys they have, and what the rows of their
// results are (schema.hpp does the reading, refusing, explaining and writing).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/cases/wave.hpp"
#include "lucy/files/schema.hpp"

namespace lucy::files {

/// An input with every key resolved: one point per row of the results, in the order of the file.
struct WaveInput {
  cases::WaveQuantity quantity = cases::WaveQuantity::shear;
  std::string title;
  std::vector<cases::WavePoint> points;
  int threads = 0;                    ///< 0: all cores
  double checkpoint_interval = 10.0;  ///< seconds of wall time
};

/// "shear-wave" or "temperature-wave".
std::string_view command_name(cases::WaveQuantity quantity);

/// Every key, in the order in which it is explained and written. The defaults are those of WavePoint.
Schema wave_schema(cases::WaveQuantity quantity);

/// The keys that may differ from row to row, and where each is stored.
std::vector<BoundKey<cases::WavePoint>> wave_point_keys(cases::WaveQuantity quantity);

/// Reads `file`, applies the overrides ("section.key=value", as after --set, the last one of a key wins), takes a row
/// for each number of particles or the [[point]] tables, and passes every point to cases::validate. Throws BadInput:
/// one sentence that starts with "FILE:LINE: ", or with "--set ...: ".
WaveInput read_wave(cases::WaveQuantity quantity, const std::filesystem::path& file,
                    std::span<const std::string> overrides = {});

/// The same points as text that read_wave accepts and that gives back the same bits; threads and checkpoint_interval
/// are left out.
std::string wave_resolved_toml(const WaveInput& input);

}  // namespace lucy::files
