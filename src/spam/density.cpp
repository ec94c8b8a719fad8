// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/spam/density.hpp"

#include <algorithm>
#include <variant>

namespace lucy::spam {

template <int D>
void densities(const kernel::Weight<D>& weight, const pairs::ClusterList<D>& list, const pairs::ImageTable<D>& images,
               const std::array<const double*, D>& position, double* density, pairs::KeptPairs& slopes,
               const Team& team) {
  std::visit(
      [&]<class Kernel>(const Kernel& kernel) {
        using Sum = DensitySum<D, Kernel>;
        std::fill_n(density, list.slots(), kernel.weight_at_zero());
        const pairs::Pass<D, Sum> pass{position, {}, {density}};
        pairs::traverse<D>(list, images, kernel.range(), pass, Sum{kernel}, team, slopes);
      },
      weight);
}

template void densities<1>(const kernel::Weight<1>&, const pairs::ClusterList<1>&, const pairs::ImageTable<1>&,
                           const std::array<const double*, 1>&, double*, pairs::KeptPairs&, const Team&);
template void densities<2>(const kernel::Weight<2>&, const pairs::ClusterList<2>&, const pairs::ImageTable<2>&,
                           const std::array<const double*, 2>&, double*, pairs::KeptPairs&, const Team&);
template void densities<3>(const kernel::Weight<3>&, const pairs::ClusterList<3>&, const pairs::ImageTable<3>&,
                           const std::array<const double*, 3>&, double*, pairs::KeptPairs&, const Team&);

}  // namespace lucy::spam
