// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/spam/isentropic_forces.hpp"

#include "lucy/spam/density.hpp"

namespace lucy::spam {

template <int D>
pairs::PairTotals<D> isentropic_forces(const kernel::Lucy<D>& kernel, const Isentropic& state,
                                       const pairs::ClusterList<D>& list, const pairs::ImageTable<D>& images,
                                       const std::array<const double*, D>& position,
                                       const std::array<double*, D>& force, double* density, double* specific_pressure,
                                       pairs::KeptPairs& slopes, pairs::Wanted wanted, const Team& team) {
  densities<D>(kernel, list, images, position, density, slopes, team);
  for (std::size_t slot = 0; slot < list.slots(); ++slot) {
    const double rho = density[slot];
    specific_pressure[slot] = state.pressure(rho) / (rho * rho);
  }
  return pairs::sum_forces<D>(kernel, pairs::SmoothCoefficient{}, list, images, position, {specific_pressure}, force,
                              wanted, team, slopes);
}

template pairs::PairTotals<1> isentropic_forces<1>(const kernel::Lucy<1>&, const Isentropic&,
                                                   const pairs::ClusterList<1>&, const pairs::ImageTable<1>&,
                                                   const std::array<const double*, 1>&, const std::array<double*, 1>&,
                                                   double*, double*, pairs::KeptPairs&, pairs::Wanted, const Team&);
template pairs::PairTotals<2> isentropic_forces<2>(const kernel::Lucy<2>&, const Isentropic&,
                                                   const pairs::ClusterList<2>&, const pairs::ImageTable<2>&,
                                                   const std::array<const double*, 2>&, const std::array<double*, 2>&,
                                                   double*, double*, pairs::KeptPairs&, pairs::Wanted, const Team&);
template pairs::PairTotals<3> isentropic_forces<3>(const kernel::Lucy<3>&, const Isentropic&,
                                                   const pairs::ClusterList<3>&, const pairs::ImageTable<3>&,
                                                   const std::array<const double*, 3>&, const std::array<double*, 3>&,
                                                   double*, double*, pairs::KeptPairs&, pairs::Wanted, const Team&);

}  // namespace lucy::spam
