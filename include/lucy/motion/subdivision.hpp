// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Steps that may be refused: one that errs by more than the tolerance is undone and done again in two halves, and they
// in halves again. How finely the last step had to be cut is where the next one begins; when all went much better than
// asked, it begins with half as many pieces.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace lucy::motion {

struct Watch {
  double energy_tolerance = 1e-5;  ///< |dE|/N of one step above which it is done again in halves
  double energy_band = 0.01;       ///< of velocity Verlet: |E - E_0|/N beyond which the run has failed
  bool rescale = true;             ///< with RK4; isoenergetic: E back to its start, isokinetic: K; others: no effect
  int most_halvings = 12;
};

/// What the watch saw.
struct WatchReport {
  std::int64_t steps = 0;
  std::int64_t subdivided_steps = 0;
  double worst_energy_error = 0.0;  ///< |dE|/N of one accepted (sub)step, before rescaling
  double energy_rescaled = 0.0;     ///< sum of what rescaling put back, per particle, signed
};

/// Advances by `dt` in 2^halvings pieces or more, and counts the step. try_step(piece) returns the error of the
/// accepted piece (nan: not watched), or nothing when it is refused and undone; stuck(piece) is called, and must throw,
/// when even the smallest is.
template <class TryStep, class Stuck>
void advance_in_pieces(double dt, const Watch& watch, int& halvings, WatchReport& report, const TryStep& try_step,
                       const Stuck& stuck) {
  // A fourth-order step twice as long errs 32 times as much.
  constexpr double ease_factor = 1.0 / 64.0;
  bool subdivided = halvings > 0;
  std::int64_t pieces = std::int64_t{1} << halvings;
  double piece = dt / static_cast<double>(pieces);
  double worst = 0.0;
  while (pieces > 0) {
    if (const std::optional<double> error = try_step(piece)) {
      worst = std::isfinite(*error) ? std::max(worst, *error) : watch.energy_tolerance;
      --pieces;
      continue;
    }
    if (halvings == watch.most_halvings) stuck(piece);
    ++halvings;
    subdivided = true;
    pieces *= 2;
    piece /= 2.0;
  }
  ++report.steps;
  if (subdivided) ++report.subdivided_steps;
  if (halvings > 0 && worst < ease_factor * watch.energy_tolerance) --halvings;
}

}  // namespace lucy::motion
