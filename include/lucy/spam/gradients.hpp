// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pass two: the rate of deformation and the gradient of the temperature at every smooth particle, where a gradient is
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
#include "lucy/space/triangle.hpp"

namespace lucy::spam {

enum class DensityMean { geometric, arithmetic };

/// What a pass for the gradients gives.
enum class Gradients {
  deformation,  ///< of the velocity the symmetric part alone, which is what viscosity needs
  whole         ///< of the velocity the rotation too
};

/// The pair sum. Carries velocities (peculiar), temperature, and rho^(-1/2) (geometric mean) or rho (arithmetic). Gives
/// the rate of deformation, lower triangle by rows (d v_a/d x_a on the diagonal, d v_a/d x_b + d v_b/d x_a below it),
/// or the whole d v_a/d x_b in row a (a D + b); then d T/d x_b.
template <int D, class Kernel, DensityMean mean, Gradients wanted>
struct GradientSum {
  static constexpr int of_velocity = wanted == Gradients::deformation ? space::triangle<D> : D * D;
  static constexpr int carried = D + 2;
  static constexpr int lab_velocity = -1;
  static constexpr int given = of_velocity + D;
  static constexpr int totals = 0;
  static constexpr pairs::Keeping keeping =
      wanted == Gradients::deformation ? pairs::Keeping::finds : pairs::Keeping::nothing;  // the slope

  Kernel kernel;
  double strain_rate = 0.0;

  LUCY_INLINE void operator()(const pairs::Pair<D, carried>& pair, std::array<pairs::Lanes, given>& to_i,
                              std::array<pairs::Lanes, given>& to_j, std::array<pairs::Lanes, 0>&) const {
    using pairs::Lanes, pairs::unrolled, pairs::multiply_add;
    Lanes factor;
    if constexpr (mean == DensityMean::geometric) {
      factor = pair.of_i[D + 1] * pair.of_j[D + 1];
    } else {
      factor = 2.0 / (pair.of_i[D + 1] + pair.of_j[D + 1]);
    }
    if constexpr (keeping == pairs::Keeping::finds) {
      factor *= pair.kept;
    } else {
      factor *= kernel.slope(pair.distance);
    }
    std::array<Lanes, D> along;  // -grad_i w / rho_ij
    unrolled<D>([&](auto b) { along[b] = factor * pair.displacement[b]; });
    std::array<Lanes, D + 1> difference;  // of v, then T
    unrolled<D + 1>([&](auto a) { difference[a] = pair.of_i[a] - pair.of_j[a]; });
    if constexpr (D > 1) difference[0] = multiply_add(strain_rate, pair.displacement[1], difference[0]);
    unrolled<D>([&](auto a) {
      if constexpr (wanted == Gradients::deformation) {
        unrolled<a>([&](auto b) {
          to_i[space::in_triangle(a, b)] = multiply_add(difference[a], along[b], difference[b] * along[a]);
        });
        to_i[space::in_triangle(a, a)] = difference[a] * along[a];
      } else {
        unrolled<D>([&](auto b) { to_i[a * D + b] = difference[a] * along[b]; });
      }
      to_i[of_velocity + a] = difference[D] * along[a];
    });
    to_j = to_i;
  }
};

}  // namespace lucy::spam
