// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/md/lucy_atoms.hpp"

#include <algorithm>
#include <limits>

namespace lucy::md {

namespace {

template <int D, Wanted wanted>
PairTotals<D> sum_forces(const kernel::Lucy<D>& kernel, const pairs::ClusterList<D>& list,
                         const pairs::ImageTable<D>& images, const std::array<const double*, D>& position,
                         const std::array<double*, D>& force, const Team& team) {
  using Sum = LucyForce<D, wanted>;
  for (double* column : force) std::fill_n(column, list.slots(), 0.0);
  const pairs::Pass<D, Sum> pass{position, {}, force};
  const auto sums = pairs::traverse<D>(list, images, kernel.range(), pass, Sum{kernel}, team);
  PairTotals<D> totals;
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  totals.potential_energy = unknown;
  if constexpr (wanted != Wanted::shear_stress) {
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b <= a; ++b) totals.virial(a, b) = totals.virial(b, a) = sums[a * (a + 1) / 2 + b];
    }
    if constexpr (wanted == Wanted::everything) totals.potential_energy = sums[Sum::virials];
  } else {
    totals.virial.setConstant(unknown);
    if constexpr (D > 1) totals.virial(0, 1) = totals.virial(1, 0) = sums[0];
  }
  return totals;
}

}  // namespace

template <int D>
PairTotals<D> lucy_forces(const kernel::Lucy<D>& kernel, const pairs::ClusterList<D>& list,
                          const pairs::ImageTable<D>& images, const std::array<const double*, D>& position,
                          const std::array<double*, D>& force, Wanted wanted, const Team& team) {
  switch (wanted) {
    case Wanted::shear_stress:
      return sum_forces<D, Wanted::shear_stress>(kernel, list, images, position, force, team);
    case Wanted::stress:
      return sum_forces<D, Wanted::stress>(kernel, list, images, position, force, team);
    case Wanted::everything:
      break;
  }
  return sum_forces<D, Wanted::everything>(kernel, list, images, position, force, team);
}

template PairTotals<1> lucy_forces<1>(const kernel::Lucy<1>&, const pairs::ClusterList<1>&, const pairs::ImageTable<1>&,
                                      const std::array<const double*, 1>&, const std::array<double*, 1>&, Wanted,
                                      const Team&);
template PairTotals<2> lucy_forces<2>(const kernel::Lucy<2>&, const pairs::ClusterList<2>&, const pairs::ImageTable<2>&,
                                      const std::array<const double*, 2>&, const std::array<double*, 2>&, Wanted,
                                      const Team&);
template PairTotals<3> lucy_forces<3>(const kernel::Lucy<3>&, const pairs::ClusterList<3>&, const pairs::ImageTable<3>&,
                                      const std::array<const double*, 3>&, const std::array<double*, 3>&, Wanted,
                                      const Team&);

}  // namespace lucy::md
