// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/measure/smoothed_velocity.hpp"

namespace lucy::measure {

template <int D>
void smoothed_velocities(const kernel::Lucy<D>& kernel, const pairs::ClusterList<D>& list,
                         const pairs::ImageTable<D>& images, const std::array<const double*, D>& position,
                         const std::array<const double*, D>& velocity, const double* density,
                         const std::array<double*, D>& smoothed, const Team& team) {
  using Sum = WeightedVelocitySum<D>;
  for (int d = 0; d < D; ++d)
    for (std::size_t slot = 0; slot < list.slots(); ++slot)
      smoothed[d][slot] = kernel.weight_at_zero() * velocity[d][slot];
  const pairs::Pass<D, Sum> pass{position, velocity, smoothed};
  pairs::traverse<D>(list, images, kernel.range(), pass, Sum{kernel}, team);
  for (int d = 0; d < D; ++d)
    for (std::size_t slot = 0; slot < list.slots(); ++slot)
      smoothed[d][slot] = density[slot] > 0.0 ? smoothed[d][slot] / density[slot] : 0.0;
}

template void smoothed_velocities<1>(const kernel::Lucy<1>&, const pairs::ClusterList<1>&, const pairs::ImageTable<1>&,
                                     const std::array<const double*, 1>&, const std::array<const double*, 1>&,
                                     const double*, const std::array<double*, 1>&, const Team&);
template void smoothed_velocities<2>(const kernel::Lucy<2>&, const pairs::ClusterList<2>&, const pairs::ImageTable<2>&,
                                     const std::array<const double*, 2>&, const std::array<const double*, 2>&,
                                     const double*, const std::array<double*, 2>&, const Team&);
template void smoothed_velocities<3>(const kernel::Lucy<3>&, const pairs::ClusterList<3>&, const pairs::ImageTable<3>&,
                                     const std::array<const double*, 3>&, const std::array<const double*, 3>&,
                                     const double*, const std::array<double*, 3>&, const Team&);

}  // namespace lucy::measure
