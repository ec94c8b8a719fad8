// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Lucy fluid read as atoms: phi(r) = epsilon sigma^2 w(r), in reduced units phi = w
// (Posch, Hoover and Kum, Phys. Rev. E 52, 1711 (1995), Eq. (2)).
//
//     Phi = sum_{i<j} w(r_ij)                                 no self term
//     F_i = sum_j slope(r_ij) r_ij                            slope = -(1/r) dw/dr, r_ij = r_i - r_j
//     P^Phi V = sum_{i<j} r_ij F_ij                           potential part of the pressure tensor
#pragma once

#include <Eigen/Core>
#include <array>

#include "lucy/kernel/lucy.hpp"
#include "lucy/pairs/traverse.hpp"
#include "lucy/space/columns.hpp"

namespace lucy::md {

template <int D>
using Tensor = Eigen::Matrix<double, D, D>;

/// What a pass over the pairs adds up besides the forces.
enum class Wanted {
  shear_stress,  ///< the xy component of the virial alone: what the ergostat needs at every stage
  stress,        ///< the whole virial
  everything     ///< potential energy and the whole virial
};

/// The pair sum.
template <int D, Wanted wanted>
struct LucyForce {
  static constexpr int carried = 0;
  static constexpr int lab_velocity = -1;
  static constexpr int given = D;
  static constexpr int virials = D * (D + 1) / 2;
  static constexpr int totals = wanted == Wanted::everything ? virials + 1 : wanted == Wanted::stress ? virials : 1;

  kernel::Lucy<D> kernel;

  void operator()(const pairs::Pair<D, 0>& pair, std::array<pairs::Lanes, given>& to_i,
                  std::array<pairs::Lanes, given>& to_j, std::array<pairs::Lanes, totals>& sums) const {
    const pairs::Lanes slope = kernel.slope(pair.distance);
    for (int d = 0; d < D; ++d) {
      to_i[d] = slope * pair.displacement[d];
      to_j[d] = -to_i[d];
    }
    if constexpr (wanted != Wanted::shear_stress) {
      pairs::unrolled<D>([&](auto a) {
        pairs::unrolled<a + 1>([&](auto b) {
          pairs::Lanes& virial = sums[a * (a + 1) / 2 + b];
          virial = fma(to_i[a], pair.displacement[b], virial);
        });
      });
      if constexpr (wanted == Wanted::everything) sums[virials] += kernel.weight(pair.distance);
    } else if constexpr (D > 1) {
      sums[0] = fma(to_i[1], pair.displacement[0], sums[0]);
    }
  }
};

/// Sums over all pairs of one configuration.
template <int D>
struct PairTotals {
  double potential_energy = 0.0;         ///< Phi; nan unless everything was wanted
  Tensor<D> virial = Tensor<D>::Zero();  ///< sum_{i<j} r_ij F_ij, symmetric: V times the potential pressure tensor;
                                         ///< off the xy component nan when only the shear stress was wanted
};

/// Overwrites `force` (D columns, slots as the list arranged them) and returns the totals.
template <int D>
PairTotals<D> lucy_forces(const kernel::Lucy<D>& kernel, const pairs::ClusterList<D>& list,
                          const pairs::ImageTable<D>& images, const std::array<const double*, D>& position,
                          const std::array<double*, D>& force, Wanted wanted, const Team& team);

}  // namespace lucy::md
