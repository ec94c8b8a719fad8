// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/md/heat_flux.hpp"

namespace lucy::md {

namespace {

/// sum_i (v_i^2/2) v_i, slot after slot.
template <int D>
std::array<double, D> kinetic_heat_flux(const std::array<const double*, D>& velocity, std::size_t slots) {
  std::array<pairs::Lanes, D> sums;
  sums.fill(0.0);
  for (std::size_t i = 0; i < slots; i += pairs::lane_count) {
    std::array<pairs::Lanes, D> v;
    pairs::Lanes square = 0.0;
    for (int d = 0; d < D; ++d) {
      v[d] = pairs::load(velocity[d] + i);
      square = fma(v[d], v[d], square);
    }
    for (int d = 0; d < D; ++d) sums[d] = fma(0.5 * square, v[d], sums[d]);
  }
  std::array<double, D> flux;
  for (int d = 0; d < D; ++d) flux[d] = reduce(sums[d]);
  return flux;
}

}  // namespace

template <int D>
HeatFlux<D> heat_flux(const kernel::Lucy<D>& kernel, const pairs::ClusterList<D>& list,
                      const pairs::ImageTable<D>& images, const std::array<const double*, D>& position,
                      const std::array<const double*, D>& velocity, const Team& team) {
  using Sum = PairHeatFlux<D>;
  const pairs::Pass<D, Sum> pass{position, velocity, {}};
  const auto sums = pairs::traverse<D>(list, images, kernel.range(), pass, Sum{kernel}, team);
  HeatFlux<D> flux;
  flux.kinetic = kinetic_heat_flux<D>(velocity, list.slots());
  for (int d = 0; d < D; ++d) {
    flux.potential[d] = sums[d];
    flux.work[d] = sums[D + d];
  }
  return flux;
}

template HeatFlux<1> heat_flux<1>(const kernel::Lucy<1>&, const pairs::ClusterList<1>&, const pairs::ImageTable<1>&,
                                  const std::array<const double*, 1>&, const std::array<const double*, 1>&,
                                  const Team&);
template HeatFlux<2> heat_flux<2>(const kernel::Lucy<2>&, const pairs::ClusterList<2>&, const pairs::ImageTable<2>&,
                                  const std::array<const double*, 2>&, const std::array<const double*, 2>&,
                                  const Team&);
template HeatFlux<3> heat_flux<3>(const kernel::Lucy<3>&, const pairs::ClusterList<3>&, const pairs::ImageTable<3>&,
                                  const std::array<const double*, 3>&, const std::array<const double*, 3>&,
                                  const Team&);

}  // namespace lucy::md
