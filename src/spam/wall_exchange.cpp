// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/spam/wall_exchange.hpp"

#include <algorithm>
#include <variant>

#include "lucy/spam/smooth_particles.hpp"
#include "spam/pass_columns.hpp"

namespace lucy::spam {

template <int D>
std::array<WallExchange, 2 * D> SmoothParticles<D>::wall_exchange(const Particles<D>& particles,
                                                                  const Team& team) const {
  const std::size_t slots = particles.list.slots();
  constexpr int walls = triangle<D> + D;
  // Stresses of the last evaluation may have been sorted away: they are made again from what is sorted along.
  space::Columns carried(triangle<D> + D + 1, density_.slots());
  const bool plain = fluid_.transport.none();
  for (std::size_t i = 0; i < slots; ++i) {
    if (particles.number[i] == pairs::nobody) continue;
    const double square = density_[0][i] * density_[0][i];
    for (int a = 0; a < D; ++a) carried[a * (a + 1) / 2 + a][i] = pressure_[0][i] / square;
    if (plain) continue;
    std::array<double, triangle<D>> deformation;
    for (int c = 0; c < triangle<D>; ++c) deformation[c] = deformation_[c][i];
    const auto viscous = viscous_stress<D>(fluid_.transport, deformation);
    for (int c = 0; c < triangle<D>; ++c) carried[c][i] += viscous[c] / square;
    for (int a = 0; a < D; ++a)
      carried[triangle<D> + a][i] = -fluid_.transport.conductivity * deformation_[triangle<D> + a][i] / square;
  }
  for (const WallParticle& at : particles.walls) carried[walls][at.slot] = 1.0 + at.wall;

  std::array<WallExchange, 2 * D> result{};
  std::visit(
      [&]<class Kernel>(const Kernel& kernel) {
        using Sum = WallExchangeSum<D, Kernel>;
        pairs::Pass<D, Sum> columns;
        columns.position = particles.position;
        std::copy_n(particles.velocity.begin(), D, columns.carried.begin());
        for (int c = 0; c < carried.count(); ++c) columns.carried[static_cast<std::size_t>(D + c)] = carried[c];
        const auto totals =
            pairs::traverse<D>(particles.list, particles.images, kernel.range(), columns, Sum{kernel}, team);
        for (std::size_t wall = 0; wall < result.size(); ++wall)
          result[wall] = {totals[2 * wall], totals[2 * wall + 1]};
      },
      fluid_.weight);
  return result;
}

template std::array<WallExchange, 2> SmoothParticles<1>::wall_exchange(const Particles<1>&, const Team&) const;
template std::array<WallExchange, 4> SmoothParticles<2>::wall_exchange(const Particles<2>&, const Team&) const;
template std::array<WallExchange, 6> SmoothParticles<3>::wall_exchange(const Particles<3>&, const Team&) const;

}  // namespace lucy::spam
