// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The second pass of SmoothParticles, and the same for who wants the whole gradients.
#include "lucy/spam/gradients.hpp"

#include <algorithm>
#include <variant>

#include "lucy/spam/smooth_particles.hpp"
#include "spam/pass_columns.hpp"

namespace lucy::spam {

namespace {

/// The pass: overwrites `into`.
template <int D, Gradients wanted>
void sum_gradients(const Fluid<D>& fluid, const Particles<D>& particles, const double* temperature,
                   const double* mean_factor, space::Columns& into, pairs::KeptPairs& slopes, const Team& team) {
  const auto pass = [&]<DensityMean mean, class Kernel>(const Kernel& kernel) {
    using Sum = GradientSum<D, Kernel, mean, wanted>;
    pairs::Pass<D, Sum> columns;
    columns.position = particles.position;
    std::copy_n(particles.velocity.begin(), D, columns.carried.begin());
    columns.carried[D] = temperature;
    columns.carried[D + 1] = mean_factor;
    for (int c = 0; c < Sum::given; ++c) {
      columns.given[c] = into[c];
      std::fill_n(into[c], particles.list.slots(), 0.0);
    }
    pairs::traverse<D>(particles.list, particles.images, kernel.range(), columns, Sum{kernel, particles.strain_rate},
                       team, slopes);
  };
  std::visit(
      [&](const auto& kernel) {
        if (fluid.mean == DensityMean::geometric) {
          pass.template operator()<DensityMean::geometric>(kernel);
        } else {
          pass.template operator()<DensityMean::arithmetic>(kernel);
        }
      },
      fluid.weight);
}

}  // namespace

template <int D>
void SmoothParticles<D>::find_deformation(const Particles<D>& particles, const Team& team) {
  sum_gradients<D, Gradients::deformation>(fluid_, particles, temperature_[0], mean_factor_[0], deformation_, slopes_,
                                           team);
}

template <int D>
space::Columns SmoothParticles<D>::gradients(const Particles<D>& particles, const Team& team) const {
  // rho^(-1/2) or rho from what is sorted along: mean_factor_ is not. Sorted, empty slots have no density.
  space::Columns factor(1, density_.slots());
  for (std::size_t slot = 0; slot < particles.list.slots(); ++slot)
    factor[0][slot] = particles.number[slot] == pairs::nobody ? 1.0 : mean_factor(fluid_.mean, density_[0][slot]);
  space::Columns gradients(D * D + D, density_.slots());
  pairs::KeptPairs none;
  sum_gradients<D, Gradients::whole>(fluid_, particles, temperature_[0], factor[0], gradients, none, team);
  return gradients;
}

template void SmoothParticles<1>::find_deformation(const Particles<1>&, const Team&);
template void SmoothParticles<2>::find_deformation(const Particles<2>&, const Team&);
template void SmoothParticles<3>::find_deformation(const Particles<3>&, const Team&);
template space::Columns SmoothParticles<1>::gradients(const Particles<1>&, const Team&) const;
template space::Columns SmoothParticles<2>::gradients(const Particles<2>&, const Team&) const;
template space::Columns SmoothParticles<3>::gradients(const Particles<3>&, const Team&) const;

}  // namespace lucy::spam
