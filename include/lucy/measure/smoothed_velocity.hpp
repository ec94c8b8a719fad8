// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The velocity field of a smooth-particle fluid at its own particles,
//
//     rho_i u_i = m sum_j v_j w(r_ij)          rho_i = m sum_j w(r_ij)          both with the particle's own term, m =
//     1
//
// (Kum, Hoover and Posch, Phys. Rev. E 52, 4899 (1995), Sec. II). u_i is the smoothed velocity; v_i, with which the
// particle moves, the individual one. Here both are peculiar, that is without the mean flow: an image then has the
// velocity of its owner, and under shear u is the field of the fluctuations alone.
#pragma once

#include <array>

#include "lucy/kernel/lucy.hpp"
#include "lucy/pairs/cluster_list.hpp"
#include "lucy/pairs/lanes.hpp"
#include "lucy/pairs/traverse.hpp"
#include "lucy/team.hpp"

namespace lucy::measure {

/// The pair sum: each partner gives the other its velocity, weighted.
template <int D>
struct WeightedVelocitySum {
  static constexpr int carried = D;
  static constexpr int lab_velocity = -1;
  static constexpr int given = D;
  static constexpr int totals = 0;
  static constexpr pairs::Keeping keeping = pairs::Keeping::nothing;

  kernel::Lucy<D> kernel;

  void operator()(const pairs::Pair<D, D>& pair, std::array<pairs::Lanes, D>& to_i, std::array<pairs::Lanes, D>& to_j,
                  std::array<pairs::Lanes, 0>&) const {
    const pairs::Lanes weight = kernel.weight(pair.distance);
    for (int d = 0; d < D; ++d) {
      to_i[d] = weight * pair.of_j[d];
      to_j[d] = weight * pair.of_i[d];
    }
  }
};

/// Overwrites `smoothed` (D columns; slots as the list arranged them). `velocity`: peculiar; `density`: self term
/// included. Where there is no density, in empty slots, u is zero.
template <int D>
void smoothed_velocities(const kernel::Lucy<D>& kernel, const pairs::ClusterList<D>& list,
                         const pairs::ImageTable<D>& images, const std::array<const double*, D>& position,
                         const std::array<const double*, D>& velocity, const double* density,
                         const std::array<double*, D>& smoothed, const Team& team);

}  // namespace lucy::measure
