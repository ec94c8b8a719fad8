// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The two readings of one sum, side by side:
//
//     a_i = - sum_j c_ij grad_i w(r_ij)
//
//     atoms              c_ij = epsilon sigma^2/m                      a pair potential phi(r) = epsilon sigma^2 w(r)
//     smooth particles   c_ij = m [ (P/rho^2)_i + (P/rho^2)_j ]        a fluid of density rho and scalar pressure P
//
// (W. G. Hoover, Smooth Particle Applied Mechanics, World Scientific (2006); Kum, Hoover and Posch, Phys. Rev. E 52,
// 4899 (1995), Sec. II). For P = (P0/2)(rho/rho0)^2 the second is P0 m/rho0^2 for every pair, whatever the densities:
// in reduced units both are one, and the motion is the same, to the bit. -grad_i w = slope(r) r_ij, slope = -(1/r)
// dw/dr.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <limits>

#include "lucy/kernel/lucy.hpp"
#include "lucy/pairs/lanes.hpp"
#include "lucy/pairs/traverse.hpp"
#include "lucy/space/triangle.hpp"
#include "lucy/team.hpp"

namespace lucy::pairs {

/// c_ij of atoms: one in reduced units.
struct AtomCoefficient {
  static constexpr int carried = 0;
  static constexpr bool finds_slopes = false;

  template <int D>
  double operator()(const Pair<D, carried>&) const {
    return 1.0;
  }
};

/// c_ij of smooth particles of unit mass. They carry P/rho^2, and the pass for their densities left the slopes.
struct SmoothCoefficient {
  static constexpr int carried = 1;
  static constexpr bool finds_slopes = true;

  template <int D>
  Lanes operator()(const Pair<D, carried>& pair) const {
    return pair.of_i[0] + pair.of_j[0];
  }
};

template <int D>
using Tensor = Eigen::Matrix<double, D, D>;

/// What a pass over the pairs adds up besides the forces.
enum class Wanted {
  shear_stress,  ///< the xy component of the virial alone: what the ergostat needs at every stage
  stress,        ///< the whole virial
  everything     ///< the sum of all w(r_ij) and the whole virial
};

/// The pair sum of either reading: gives c_ij slope r_ij to i and takes it from j; totals the virial sum r_ij F_ij
/// (lower triangle by rows, or xy alone) and the sum of w.
template <int D, Wanted wanted, class Coefficient>
struct PairForce {
  static constexpr int carried = Coefficient::carried;
  static constexpr int lab_velocity = -1;
  static constexpr int given = D;
  static constexpr int virials = space::triangle<D>;
  static constexpr int totals = wanted == Wanted::everything ? virials + 1 : wanted == Wanted::stress ? virials : 1;
  static constexpr Keeping keeping = Coefficient::finds_slopes && wanted != Wanted::everything
                                         ? Keeping::finds
                                         : Keeping::nothing;  // the weight needs the distance

  kernel::Lucy<D> kernel;
  Coefficient coefficient{};

  LUCY_INLINE void operator()(const Pair<D, carried>& pair, std::array<Lanes, given>& to_i,
                              std::array<Lanes, given>& to_j, std::array<Lanes, totals>& sums) const {
    Lanes slope = coefficient(pair);
    if constexpr (keeping == Keeping::finds) {
      slope *= pair.kept;
    } else {
      slope *= kernel.slope(pair.distance);
    }
    unrolled<D>([&](auto d) {
      to_i[d] = slope * pair.displacement[d];
      to_j[d] = -to_i[d];
    });
    if constexpr (wanted != Wanted::shear_stress) {
      unrolled<D>([&](auto a) {
        unrolled<a + 1>([&](auto b) {
          Lanes& virial = sums[space::in_triangle(a, b)];
          virial = multiply_add(to_i[a], pair.displacement[b], virial);
        });
      });
      if constexpr (wanted == Wanted::everything) sums[virials] += kernel.weight(pair.distance);
    } else if constexpr (D > 1) {
      sums[0] = multiply_add(to_i[1], pair.displacement[0], sums[0]);
    }
  }
};

/// Sums over all pairs of one configuration; nan where not wanted.
template <int D>
struct PairTotals {
  double potential_energy = 0.0;         ///< sum_{i<j} w(r_ij)
  Tensor<D> virial = Tensor<D>::Zero();  ///< sum_{i<j} r_ij F_ij, symmetric: V times the potential pressure tensor
};

/// One pass with either coefficient: overwrites `force` (D columns, slots as the list arranged them). `slopes`: for a
/// coefficient that finds them, as the pass for the densities left them.
template <int D, Wanted wanted, class Coefficient>
PairTotals<D> sum_forces(const kernel::Lucy<D>& kernel, const Coefficient& coefficient, const ClusterList<D>& list,
                         const ImageTable<D>& images, const std::array<const double*, D>& position,
                         const std::array<const double*, Coefficient::carried>& carried,
                         const std::array<double*, D>& force, const Team& team, KeptPairs& slopes) {
  using Sum = PairForce<D, wanted, Coefficient>;
  for (double* column : force) std::fill_n(column, list.slots(), 0.0);
  const Pass<D, Sum> pass{position, carried, force};
  const auto sums = traverse<D>(list, images, kernel.range(), pass, Sum{kernel, coefficient}, team, slopes);
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  PairTotals<D> totals;
  totals.potential_energy = unknown;
  if constexpr (wanted != Wanted::shear_stress) {
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b <= a; ++b) totals.virial(a, b) = totals.virial(b, a) = sums[space::in_triangle(a, b)];
    }
    if constexpr (wanted == Wanted::everything) totals.potential_energy = sums[Sum::virials];
  } else {
    totals.virial.setConstant(unknown);
    if constexpr (D > 1) totals.virial(0, 1) = totals.virial(1, 0) = sums[0];
  }
  return totals;
}

/// The same with `wanted` known at run time only.
template <int D, class Coefficient>
PairTotals<D> sum_forces(const kernel::Lucy<D>& kernel, const Coefficient& coefficient, const ClusterList<D>& list,
                         const ImageTable<D>& images, const std::array<const double*, D>& position,
                         const std::array<const double*, Coefficient::carried>& carried,
                         const std::array<double*, D>& force, Wanted wanted, const Team& team, KeptPairs& slopes) {
  const auto sum = [&]<Wanted w>() {
    return sum_forces<D, w, Coefficient>(kernel, coefficient, list, images, position, carried, force, team, slopes);
  };
  switch (wanted) {
    case Wanted::shear_stress:
      return sum.template operator()<Wanted::shear_stress>();
    case Wanted::stress:
      return sum.template operator()<Wanted::stress>();
    case Wanted::everything:
      break;
  }
  return sum.template operator()<Wanted::everything>();
}

}  // namespace lucy::pairs
