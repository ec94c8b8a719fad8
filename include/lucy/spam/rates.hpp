// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pass three: the rates of velocity and internal energy of every smooth particle, m = 1,
//
//     dv_i/dt = - m sum_j [ (P/rho^2)_i + (P/rho^2)_j ] . grad_i w(r_ij)
//     de_i/dt = - (m/2) sum_j [ (P/rho^2)_i + (P/rho^2)_j ] : (v_j - v_i) grad_i w(r_ij)
//               - m sum_j [ (Q/rho^2)_i + (Q/rho^2)_j ] . grad_i w(r_ij)
//
// (Kum, Hoover and Posch, Phys. Rev. E 52, 4899 (1995), Eqs. (5) and (6); print sums the last term over i.) With f_ij
// the force of j on i, the second line is -f_ij . (v_i - v_j)/2, the same for both partners: what the pair's kinetic
// energy loses is gained half by each, and what heat leaves one enters the other. So momentum and total energy are
// conserved pair by pair, to rounding.
//
// With a scalar pressure [..] is the coefficient c_ij of pairs/pair_force.hpp.
#pragma once

#include <array>

#include "lucy/pairs/lanes.hpp"
#include "lucy/pairs/pair_force.hpp"
#include "lucy/pairs/traverse.hpp"
#include "lucy/space/triangle.hpp"

namespace lucy::spam {

/// What the particles of a pass three carry besides their velocities.
enum class Carried {
  scalar_pressure,  ///< P/rho^2: no viscosity, no conduction
  tensor_and_flux   ///< the lower triangle of P/rho^2 by rows (xx, yx, yy, ...), then Q/rho^2
};

/// The pair sum. Carries velocities (peculiar), then what `contents` says; gives acceleration and energy rate; totals
/// sum_{i<j} f_x,ij y_ij, V times the xy component of the pairs' share of the pressure tensor (in one dimension zero).
template <int D, class Kernel, Carried contents>
struct RateSum {
  static constexpr int stresses = contents == Carried::scalar_pressure ? 1 : space::triangle<D>;
  static constexpr int fluxes = contents == Carried::scalar_pressure ? 0 : D;
  static constexpr int carried = D + stresses + fluxes;
  static constexpr int lab_velocity = -1;
  static constexpr int given = D + 1;
  static constexpr int totals = 1;
  static constexpr pairs::Keeping keeping = pairs::Keeping::finds;  // the slope

  Kernel kernel;
  double strain_rate = 0.0;

  LUCY_INLINE void operator()(const pairs::Pair<D, carried>& pair, std::array<pairs::Lanes, given>& to_i,
                              std::array<pairs::Lanes, given>& to_j, std::array<pairs::Lanes, totals>& sums) const {
    const pairs::Lanes& slope = pair.kept;
    std::array<pairs::Lanes, D> along;  // -grad_i w
    pairs::unrolled<D>([&](auto b) { along[b] = slope * pair.displacement[b]; });
    std::array<pairs::Lanes, D> force;
    if constexpr (contents == Carried::scalar_pressure) {
      const pairs::Lanes coefficient = pair.of_i[D] + pair.of_j[D];
      pairs::unrolled<D>([&](auto a) { force[a] = coefficient * along[a]; });
    } else {
      std::array<pairs::Lanes, stresses> stress;
      pairs::unrolled<stresses>([&](auto s) { stress[s] = pair.of_i[D + s] + pair.of_j[D + s]; });
      pairs::unrolled<D>([&](auto a) {
        force[a] = stress[space::in_triangle(a, 0)] * along[0];
        pairs::unrolled<D - 1>([&](auto b) {
          force[a] = pairs::multiply_add(stress[space::in_triangle(a, b + 1)], along[b + 1], force[a]);
        });
      });
    }
    pairs::Lanes power = 0.0;  // f_ij . (v_i - v_j)
    pairs::unrolled<D>([&](auto a) {
      pairs::Lanes difference = pair.of_i[a] - pair.of_j[a];
      if constexpr (D > 1 && a == 0) difference = pairs::multiply_add(strain_rate, pair.displacement[1], difference);
      power = pairs::multiply_add(force[a], difference, power);
      to_i[a] = force[a];
      to_j[a] = -force[a];
    });
    if constexpr (fluxes > 0) {
      pairs::Lanes heat = 0.0;  // from j to i
      pairs::unrolled<D>([&](auto b) {
        heat = pairs::multiply_add(pair.of_i[D + stresses + b] + pair.of_j[D + stresses + b], along[b], heat);
      });
      to_i[D] = pairs::multiply_add(-0.5, power, heat);
      to_j[D] = pairs::multiply_add(-0.5, power, -heat);
    } else {
      to_i[D] = to_j[D] = -0.5 * power;
    }
    if constexpr (D > 1) sums[0] = pairs::multiply_add(force[0], pair.displacement[1], sums[0]);
  }
};

}  // namespace lucy::spam
