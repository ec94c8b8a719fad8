// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Velocity Verlet for Newtonian motion, x' = p/m, p' = F(x), m = 1 (Swope, Andersen, Berens and Wilson, J. Chem. Phys.
// 76, 637 (1982)):
//
//     p(t + dt/2) = p + F dt/2      x(t + dt) = x + p(t + dt/2) dt      p(t + dt) = p(t + dt/2) + F(t + dt) dt/2
#pragma once

#include <cmath>
#include <cstddef>

#include "lucy/space/columns.hpp"

namespace lucy::motion {

/// Columns 0 .. D-1 are positions, D .. 2D-1 momenta. Writes the state a step on to `next`; `force` holds F(x(t)) at
/// the call and F(x(t + dt)) at the end, through `evaluate(next)`.
template <int D, class Evaluate>
void velocity_verlet(const space::Columns& now, double dt, std::size_t slots, space::Columns& next,
                     const space::Columns& force, const Evaluate& evaluate) {
  for (int d = 0; d < D; ++d) {
    for (std::size_t i = 0; i < slots; ++i) {
      next[D + d][i] = std::fma(0.5 * dt, force[d][i], now[D + d][i]);
      next[d][i] = std::fma(dt, next[D + d][i], now[d][i]);
    }
  }
  evaluate(next);
  for (int d = 0; d < D; ++d) {
    for (std::size_t i = 0; i < slots; ++i) next[D + d][i] = std::fma(0.5 * dt, force[d][i], next[D + d][i]);
  }
}

}  // namespace lucy::motion
