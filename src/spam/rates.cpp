// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The third pass of SmoothParticles.
#include "lucy/spam/rates.hpp"

#include <algorithm>
#include <variant>

#include "lucy/spam/smooth_particles.hpp"
#include "spam/pass_columns.hpp"

namespace lucy::spam {

template <int D>
void SmoothParticles<D>::find_rates(const Particles<D>& particles, const Team& team) {
  for (int d = 0; d < D; ++d) {
    const double gravity = fluid_.gravity[d];
    double* const column = acceleration_[d];
    for (std::size_t i = 0; i < particles.number.size(); ++i)
      column[i] = particles.number[i] == pairs::nobody ? 0.0 : gravity;
  }
  std::fill_n(energy_rate_[0], particles.list.slots(), 0.0);
  const auto pass = [&]<Carried contents, class Kernel>(const Kernel& kernel) {
    using Sum = RateSum<D, Kernel, contents>;
    pairs::Pass<D, Sum> columns;
    columns.position = particles.position;
    std::copy_n(particles.velocity.begin(), D, columns.carried.begin());
    for (int c = 0; c < Sum::stresses + Sum::fluxes; ++c) columns.carried[D + c] = stress_[c];
    for (int d = 0; d < D; ++d) columns.given[d] = acceleration_[d];
    columns.given[D] = energy_rate_[0];
    const auto totals = pairs::traverse<D>(particles.list, particles.images, kernel.range(), columns,
                                           Sum{kernel, particles.strain_rate}, team, slopes_);
    virial_xy_ = totals[0];
  };
  std::visit(
      [&](const auto& kernel) {
        if (fluid_.transport.none()) {
          pass.template operator()<Carried::scalar_pressure>(kernel);
        } else {
          pass.template operator()<Carried::tensor_and_flux>(kernel);
        }
      },
      fluid_.weight);
}

template void SmoothParticles<1>::find_rates(const Particles<1>&, const Team&);
template void SmoothParticles<2>::find_rates(const Particles<2>&, const Team&);
template void SmoothParticles<3>::find_rates(const Particles<3>&, const Team&);

}  // namespace lucy::spam
