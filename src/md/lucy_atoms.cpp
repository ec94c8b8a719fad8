// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/md/lucy_atoms.hpp"

namespace lucy::md {

template <int D>
pairs::PairTotals<D> lucy_forces(const kernel::Lucy<D>& kernel, const pairs::ClusterList<D>& list,
                                 const pairs::ImageTable<D>& images, const std::array<const double*, D>& position,
                                 const std::array<double*, D>& force, pairs::Wanted wanted, const Team& team) {
  pairs::KeptPairs none;  // atoms have one pass only
  return pairs::sum_forces<D>(kernel, pairs::AtomCoefficient{}, list, images, position, {}, force, wanted, team, none);
}

template pairs::PairTotals<1> lucy_forces<1>(const kernel::Lucy<1>&, const pairs::ClusterList<1>&,
                                             const pairs::ImageTable<1>&, const std::array<const double*, 1>&,
                                             const std::array<double*, 1>&, pairs::Wanted, const Team&);
template pairs::PairTotals<2> lucy_forces<2>(const kernel::Lucy<2>&, const pairs::ClusterList<2>&,
                                             const pairs::ImageTable<2>&, const std::array<const double*, 2>&,
                                             const std::array<double*, 2>&, pairs::Wanted, const Team&);
template pairs::PairTotals<3> lucy_forces<3>(const kernel::Lucy<3>&, const pairs::ClusterList<3>&,
                                             const pairs::ImageTable<3>&, const std::array<const double*, 3>&,
                                             const std::array<double*, 3>&, pairs::Wanted, const Team&);

}  // namespace lucy::md
