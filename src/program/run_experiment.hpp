// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An experiment and its directory, from the first look to the last file. On disk, in this order:
//
//     DIR, DIR/.lock, input.toml           whose results these are
//     checkpoints/                         while it runs; point_001.h5 ... as points end
//     what the experiment writes beside its results, provenance.json
//     its results file                     last of all: where it is, the experiment is finished
//     pictures                             drawn from the above; checkpoints/ goes
//
// One that was killed anywhere on this way is taken up by the same command; one that has its results is printed again.
#pragma once

#include "program/commands.hpp"
#include "program/experiment.hpp"

namespace lucy::program {

/// Runs it, goes on with it, or prints it again. Returns the exit code; throws BadInput and RunFailed.
int run_experiment(const InputRequest& request, Experiment& experiment);

}  // namespace lucy::program
