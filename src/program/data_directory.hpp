// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the files are that Lucy reads beside its input: analysis/, reference/ and inputs/.
#pragma once

#include <filesystem>

namespace lucy::program {

/// The folder that holds analysis/, reference/ and inputs/: ../share/lucy as seen from the running program when that
/// exists (an installed Lucy, wherever its prefix was moved), else the source tree it was built from.
/// Throws RunFailed when neither is there.
std::filesystem::path data_directory();

}  // namespace lucy::program
