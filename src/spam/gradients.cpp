// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The second pass of SmoothParticles.
#include "lucy/spam/gradients.hpp"

#include <algorithm>
#include <variant>

#include "lucy/spam/smooth_particles.hpp"

namespace lucy::spam {

template <int D>
void SmoothParticles<D>::find_gradients(const Particles<D>& particles, const Team& team) {
  const auto pass = [&]<DensityMean mean, class Kernel>(const Kernel& kernel) {
    using Sum = GradientSum<D, Kernel, mean>;
    pairs::Pass<D, Sum> columns;
    columns.position = particles.position;
    std::copy_n(particles.velocity.begin(), D, columns.carried.begin());
    columns.carried[D] = temperature_[0];
    columns.carried[D + 1] = mean_factor_[0];
    for (int c = 0; c < Sum::given; ++c) {
      columns.given[c] = gradients_[c];
      std::fill_n(gradients_[c], particles.list.slots(), 0.0);
    }
    pairs::traverse<D>(particles.list, particles.images, kernel.range(), columns, Sum{kernel, particles.strain_rate},
                       team, slopes_);
  };
  std::visit(
      [&](const auto& kernel) {
        if (fluid_.mean == DensityMean::geometric) {
          pass.template operator()<DensityMean::geometric>(kernel);
        } else {
          pass.template operator()<DensityMean::arithmetic>(kernel);
        }
      },
      fluid_.weight);
}

template void SmoothParticles<1>::find_gradients(const Particles<1>&, const Team&);
template void SmoothParticles<2>::find_gradients(const Particles<2>&, const Team&);
template void SmoothParticles<3>::find_gradients(const Particles<3>&, const Team&);

}  // namespace lucy::spam
