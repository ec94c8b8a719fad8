// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a person types, and what happens when it goes wrong.
#pragma once

namespace lucy::program {

/// The whole program: reads the command line, runs the command, tells of errors on standard error in one to three
/// lines. Returns the exit code: 0 done, 1 ran but failed (or a comparison disagreed), 2 bad input or usage.
int run_program(int argument_count, const char* const* arguments);

}  // namespace lucy::program
