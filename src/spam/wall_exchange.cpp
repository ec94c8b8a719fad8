// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/spam/wall_exchange.hpp"

#include <algorithm>
#include <variant>

#include "lucy/spam/smooth_particles.hpp"

namespace lucy::spam {

template <int D>
std::array<WallExchange, 2 * D> SmoothParticles<D>::wall_exchange(const Particles<D>& particles, const Team& team) {
  if (wall_.count() == 0) wall_ = space::Columns(1, density_.slots());
  std::fill_n(wall_[0], particles.list.slots(), 0.0);
  for (const WallParticle& at : particles.walls) wall_[0][at.slot] = 1.0 + at.wall;

  std::array<WallExchange, 2 * D> result{};
  const auto pass = [&]<Carried contents, class Kernel>(const Kernel& kernel) {
    using Sum = WallExchangeSum<D, Kernel, contents>;
    pairs::Pass<D, Sum> columns;
    columns.position = particles.position;
    std::copy_n(particles.velocity.begin(), D, columns.carried.begin());
    for (int c = 0; c < stress_.count(); ++c) columns.carried[D + c] = stress_[c];
    columns.carried[Sum::wall] = wall_[0];
    const auto totals = pairs::traverse<D>(particles.list, particles.images, kernel.range(), columns,
                                           Sum{{kernel, particles.strain_rate}}, team, slopes_);
    for (std::size_t number = 0; number < result.size(); ++number)
      result[number] = {totals[2 * number], totals[2 * number + 1]};
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
  return result;
}

template std::array<WallExchange, 2> SmoothParticles<1>::wall_exchange(const Particles<1>&, const Team&);
template std::array<WallExchange, 4> SmoothParticles<2>::wall_exchange(const Particles<2>&, const Team&);
template std::array<WallExchange, 6> SmoothParticles<3>::wall_exchange(const Particles<3>&, const Team&);

}  // namespace lucy::spam
