// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pass two: gradients of velocity and temperature at every smooth particle,
//
//     (grad f)_i = m sum_j (f_j - f_i) grad_i w(r_ij) / rho_ij
//     rho_ij = (rho_i rho_j)^(1/2) or (rho_i + rho_j)/2
//
// (Kum, Hoover and Posch, Phys. Rev. E 52, 4899 (1995), Sec. II). grad_i w = -slope r_ij. A constant has no gradient,
// exactly. A linear field on a lattice has the right one times a factor near one that depends on h over the spacing:
// 0.99790 for Lucy's weight with h = 3 on the unit square lattice. A wave has less by some (h/length)^2: 0.99406 at 64
// spacings. To converge, refine h over the spacing too.
//
// Velocities are the laboratory's: v = p + rate y e_x with p relative to the mean flow. The difference of two
// particles, v_i - v_j = p_i - p_j + rate y_ij e_x, needs no image's streaming velocity beyond the displacement.
#pragma once

#include <array>

#include "lucy/pairs/lanes.hpp"
#include "lucy/pairs/traverse.hpp"

namespace lucy::spam {

enum class DensityMean { geometric, arithmetic };

/// The pair sum. Carries velocities (peculiar), temperature, and rho^(-1/2) (geometric mean) or rho (arithmetic); gives
/// d v_a/d x_b in row a (a D + b), then d T/d x_b.
template <int D, class Kernel, DensityMean mean>
struct GradientSum {
  static constexpr int carried = D + 2;
  static constexpr int lab_velocity = -1;
  static constexpr int given = D * D + D;
  static constexpr int totals = 0;
  static constexpr pairs::Keeping keeping = pairs::Keeping::finds;  // the slope

  Kernel kernel;
  double strain_rate = 0.0;

  LUCY_INLINE void operator()(const pairs::Pair<D, carried>& pair, std::array<pairs::Lanes, given>& to_i,
                              std::array<pairs::Lanes, given>& to_j, std::array<pairs::Lanes, 0>&) const {
    const pairs::Lanes& slope = pair.kept;
    pairs::Lanes factor;
    if constexpr (mean == DensityMean::geometric) {
      factor = slope * (pair.of_i[D + 1] * pair.of_j[D + 1]);
    } else {
      factor = slope * (2.0 / (pair.of_i[D + 1] + pair.of_j[D + 1]));
    }
    std::array<pairs::Lanes, D + 1> difference;  // of v, then T
    pairs::unrolled<D + 1>([&](auto a) { difference[a] = pair.of_i[a] - pair.of_j[a]; });
    if constexpr (D > 1) difference[0] = pairs::multiply_add(strain_rate, pair.displacement[1], difference[0]);
    pairs::unrolled<D>([&](auto b) {
      const pairs::Lanes along = factor * pair.displacement[b];
      pairs::unrolled<D + 1>([&](auto a) { to_i[a * D + b] = to_j[a * D + b] = difference[a] * along; });
    });
  }
};

}  // namespace lucy::spam
