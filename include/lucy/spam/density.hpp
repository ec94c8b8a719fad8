// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pass one: the density at every smooth particle, self term included,
//
//     rho(r_i) = m sum_j w(r_ij) = m w(0) + m sum_{j != i} w(r_ij)          m = 1
//
// (Lucy (1977); Kum, Hoover and Posch, Phys. Rev. E 52, 4899 (1995), Eq. (1)).
#pragma once

#include <array>

#include "lucy/kernel/weight.hpp"
#include "lucy/pairs/lanes.hpp"
#include "lucy/pairs/traverse.hpp"
#include "lucy/team.hpp"

namespace lucy::spam {

/// The pair sum: each partner gives the other its weight. Leaves the slope, -(1/r) dw/dr.
template <int D, class Kernel>
struct DensitySum {
  static constexpr int carried = 0;
  static constexpr int lab_velocity = -1;
  static constexpr int given = 1;
  static constexpr int totals = 0;
  static constexpr pairs::Keeping keeping = pairs::Keeping::leaves;

  Kernel kernel;

  LUCY_INLINE pairs::Lanes operator()(const pairs::Pair<D, 0>& pair, std::array<pairs::Lanes, 1>& to_i,
                                      std::array<pairs::Lanes, 1>& to_j, std::array<pairs::Lanes, 0>&) const {
    to_i[0] = kernel.weight(pair.distance);
    to_j[0] = to_i[0];
    return kernel.slope(pair.distance);
  }
};

/// Overwrites `density`; slots as the list arranged them, empty ones hold w(0). Leaves the slopes of the
/// weight for further passes.
template <int D>
void densities(const kernel::Weight<D>& weight, const pairs::ClusterList<D>& list, const pairs::ImageTable<D>& images,
               const std::array<const double*, D>& position, double* density, pairs::KeptPairs& slopes,
               const Team& team);

}  // namespace lucy::spam
