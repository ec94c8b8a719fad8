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

#include <algorithm>
#include <array>

#include "lucy/pairs/lanes.hpp"
#include "lucy/pairs/traverse.hpp"
#include "lucy/spam/rates.hpp"

namespace lucy::spam {

/// Energies per time, into the fluid.
struct WallExchange {
  double conduction = 0.0;
  double work = 0.0;

  double both() const { return conduction + work; }
};

/// The pair sum: that of the rates, from which it takes force and heat. Carries what that carries, and 0 for a particle
/// of the fluid, 1 + its number for that of a wall; totals conduction and work wall by wall.
template <int D, class Kernel, Carried contents>
struct WallExchangeSum {
  using Rates = RateSum<D, Kernel, contents>;
  static constexpr int wall = Rates::carried;
  static constexpr int carried = Rates::carried + 1;
  static constexpr int lab_velocity = -1;
  static constexpr int given = 0;
  static constexpr int totals = 4 * D;
  static constexpr pairs::Keeping keeping = pairs::Keeping::finds;  // the slope

  Rates rates;

  void operator()(const pairs::Pair<D, carried>& pair, std::array<pairs::Lanes, 0>&, std::array<pairs::Lanes, 0>&,
                  std::array<pairs::Lanes, totals>& sums) const {
    // Far from walls there is nothing to do.
    const pairs::Lanes& of_i = pair.of_i[wall];
    const pairs::Lanes& of_j = pair.of_j[wall];
    pairs::Lanes into_fluid = 0.0;  // the sign of what i gets
    pairs::simd::where(of_i == 0.0 && of_j > 0.0, into_fluid) = 1.0;
    pairs::simd::where(of_j == 0.0 && of_i > 0.0, into_fluid) = -1.0;
    if (pairs::simd::none_of(into_fluid != 0.0)) return;

    pairs::Pair<D, Rates::carried> of_rates;
    of_rates.displacement = pair.displacement;
    of_rates.kept = pair.kept;
    std::copy_n(pair.of_i.begin(), Rates::carried, of_rates.of_i.begin());
    std::copy_n(pair.of_j.begin(), Rates::carried, of_rates.of_j.begin());
    std::array<pairs::Lanes, Rates::given> to_i;
    std::array<pairs::Lanes, Rates::given> to_j;
    std::array<pairs::Lanes, Rates::totals> virial;
    virial.fill(0.0);
    rates(of_rates, to_i, to_j, virial);

    // The energy rates are -f_ij . (v_i - v_j)/2 + h_ij and the same with -h_ij.
    const pairs::Lanes heat = into_fluid * 0.5 * (to_i[D] - to_j[D]);
    pairs::Lanes work = 0.5 * (to_i[D] + to_j[D]);
    for (int d = 0; d < D; ++d) work += to_i[d] * pair.of_i[d];
    work *= into_fluid;
    for (int number = 0; number < 2 * D; ++number) {
      const auto of_this_wall = of_i + of_j == pairs::Lanes(1.0 + number);
      pairs::simd::where(of_this_wall, sums[2 * number]) += heat;
      pairs::simd::where(of_this_wall, sums[2 * number + 1]) += work;
    }
  }
};

}  // namespace lucy::spam
