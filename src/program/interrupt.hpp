// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ctrl-C and its relatives as a wish: the first one is noted, so that the work can be saved; the second one kills.
#pragma once

namespace lucy::program {

/// From now on the first SIGINT, SIGTERM or SIGHUP is only noted, each of them; a second one of the same kind has its
/// usual effect. Writing to a file that may not grow further becomes an error instead of a signal (SIGXFSZ).
/// A hang-up that was being ignored (nohup) stays ignored.
void note_interrupts();

/// Whether one was noted.
bool interrupt_noted();

}  // namespace lucy::program
