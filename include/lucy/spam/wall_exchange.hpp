// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The energy that walls give to a fluid of smooth particles. With f_ij the force on particle i of a wall's particle j,
// which moves with the wall's velocity u, and h_ij the heat that enters i from j (rates.hpp), the total energy of i
// changes, m = 1, by
//
//     f_ij . v_i - f_ij . (v_i - u)/2 + h_ij = h_ij + f_ij . (v_i + u)/2
//
// the first term in its kinetic energy and the other two in its internal one. Conduction is the sum of h_ij, work the
// rest. A wall at rest does work, too: its particles have the pressures of the fluid in front of it, and half of what
// they do to its motion is heat. The energy of the fluid balances only with both.
#pragma once

#include <array>

#include "lucy/pairs/lanes.hpp"
#include "lucy/pairs/traverse.hpp"

namespace lucy::spam {

/// Energies per time, into the fluid.
struct WallExchange {
  double conduction = 0.0;
  double work = 0.0;

  double both() const { return conduction + work; }
};

/// The pair sum. Carries velocities, the lower triangle of P/rho^2, Q/rho^2, and 0 for a particle of the fluid, 1 + its
/// number for that of a wall; totals conduction and work wall by wall.
template <int D, class Kernel>
struct WallExchangeSum {
  static constexpr int stresses = D * (D + 1) / 2;
  static constexpr int carried = D + stresses + D + 1;
  static constexpr int lab_velocity = -1;
  static constexpr int given = 0;
  static constexpr int totals = 4 * D;
  static constexpr pairs::Keeping keeping = pairs::Keeping::nothing;

  Kernel kernel;

  void operator()(const pairs::Pair<D, carried>& pair, std::array<pairs::Lanes, 0>&, std::array<pairs::Lanes, 0>&,
                  std::array<pairs::Lanes, totals>& sums) const {
    constexpr int flux = D + stresses;
    constexpr int wall = flux + D;
    // Far from walls there is nothing to do.
    const pairs::Lanes& of_i = pair.of_i[wall];
    const pairs::Lanes& of_j = pair.of_j[wall];
    pairs::Lanes sign = 0.0;
    pairs::simd::where(of_i == 0.0 && of_j > 0.0, sign) = 1.0;
    pairs::simd::where(of_j == 0.0 && of_i > 0.0, sign) = -1.0;
    if (pairs::simd::none_of(sign != 0.0)) return;

    const pairs::Lanes slope = sign * kernel.slope(pair.distance);
    pairs::Lanes heat = 0.0;   // from j to i
    pairs::Lanes power = 0.0;  // f_ij . (v_i + v_j)
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < D; ++b) {
        const int s = D + (a >= b ? a * (a + 1) / 2 + b : b * (b + 1) / 2 + a);
        power += (pair.of_i[s] + pair.of_j[s]) * pair.displacement[b] * (pair.of_i[a] + pair.of_j[a]);
      }
      heat += (pair.of_i[flux + a] + pair.of_j[flux + a]) * pair.displacement[a];
    }
    for (int number = 0; number < 2 * D; ++number) {
      const auto of_this_wall = of_i + of_j == pairs::Lanes(1.0 + number);
      pairs::simd::where(of_this_wall, sums[2 * number]) += slope * heat;
      pairs::simd::where(of_this_wall, sums[2 * number + 1]) += 0.5 * slope * power;
    }
  }
};

}  // namespace lucy::spam
