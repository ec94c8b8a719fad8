// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The entropy that viscosity and conduction produce, pair by pair. With f_ij the viscous force of j on i and
// h_ij = slope (Q_i/rho_i^2 + Q_j/rho_j^2) . r_ij the heat that enters i from j (m = 1),
//
//     viscosity    to i: -(1/2) f_ij . (v_i - v_j)/T_i           to j: the same with T_j
//     conduction   to each: (1/2) h_ij (1/T_i - 1/T_j)
//
// Stress and heating use different discrete gradients than grad v and grad T do: on smooth fields the totals are
// positive, but single particles may lose.
#pragma once

#include <array>

#include "lucy/pairs/lanes.hpp"
#include "lucy/pairs/traverse.hpp"
#include "lucy/space/triangle.hpp"

namespace lucy::spam {

/// The pair sum. Carries velocities (peculiar), the lower triangle of the viscous P/rho^2, Q/rho^2 and 1/T; gives the
/// two productions.
template <int D, class Kernel>
struct EntropySum {
  static constexpr int stresses = space::triangle<D>;
  static constexpr int carried = D + stresses + D + 1;
  static constexpr int lab_velocity = -1;
  static constexpr int given = 2;
  static constexpr int totals = 0;
  static constexpr pairs::Keeping keeping = pairs::Keeping::nothing;

  Kernel kernel;
  double strain_rate = 0.0;

  void operator()(const pairs::Pair<D, carried>& pair, std::array<pairs::Lanes, given>& to_i,
                  std::array<pairs::Lanes, given>& to_j, std::array<pairs::Lanes, 0>&) const {
    constexpr int flux = D + stresses;
    constexpr int coldness = flux + D;
    const pairs::Lanes slope = kernel.slope(pair.distance);
    pairs::Lanes power = 0.0;
    pairs::Lanes heat = 0.0;
    for (int a = 0; a < D; ++a) {
      pairs::Lanes difference = pair.of_i[a] - pair.of_j[a];
      if constexpr (D > 1) {
        if (a == 0) difference += strain_rate * pair.displacement[1];
      }
      for (int b = 0; b < D; ++b) {
        const int s = D + space::in_triangle(a, b);
        power += (pair.of_i[s] + pair.of_j[s]) * pair.displacement[b] * difference;
      }
      heat += (pair.of_i[flux + a] + pair.of_j[flux + a]) * pair.displacement[a];
    }
    const pairs::Lanes heating = -0.5 * slope * power;
    to_i[0] = heating * pair.of_i[coldness];
    to_j[0] = heating * pair.of_j[coldness];
    to_i[1] = to_j[1] = 0.5 * slope * heat * (pair.of_i[coldness] - pair.of_j[coldness]);
  }
};

}  // namespace lucy::spam
