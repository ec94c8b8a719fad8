// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// verdict.csv, and the same for people: two engines line by line (cases/engine_verdict.hpp).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/engine_verdict.hpp"

namespace lucy::files {

/// Throws RunFailed when the disk refuses.
void write_verdict_csv(const std::filesystem::path& path, std::span<const cases::VerdictLine> lines);

/// Throws BadInput naming file, line and column.
std::vector<cases::VerdictLine> read_verdict_csv(const std::filesystem::path& path);

/// The lines under the headings of their parts, and how many agree. `other`: the name of the other engine.
std::string format_verdict(std::span<const cases::VerdictLine> lines, const std::string& other);

}  // namespace lucy::files
