// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace lucy {

/// What was asked for cannot be done as it was asked. The program ends with exit code 2 before anything is run or
/// written. The message is one sentence naming the file, the line or key, what was found and what is accepted.
struct BadInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A run that had started could not go on. The program ends with exit code 1; what was finished before stays on disk.
struct RunFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lucy
