// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/spam/entropy_production.hpp"

#include <algorithm>
#include <variant>

#include "lucy/errors.hpp"
#include "lucy/spam/smooth_particles.hpp"
#include "spam/pass_columns.hpp"

namespace lucy::spam {

namespace {

/// Pointers to `count` columns from `first` on, behind `begin` others.
template <std::size_t size>
void append(std::array<const double*, size>& to, std::size_t begin, const space::Columns& columns, int first,
            int count) {
  for (int c = 0; c < count; ++c) to[begin + static_cast<std::size_t>(c)] = columns[first + c];
}

}  // namespace

template <int D>
space::Columns SmoothParticles<D>::entropy_production(const Particles<D>& particles, const Team& team) const {
  if (!has_temperature(fluid_.state)) throw BadInput("an isentropic fluid produces no entropy: it has no temperature");
  const std::size_t slots = particles.list.slots();
  space::Columns produced(2, density_.slots());
  if (fluid_.transport.none()) return produced;
  // The viscous part of P/rho^2, Q/rho^2 and 1/T, from what is sorted along: stress_ is not.
  space::Columns viscous(triangle<D>, density_.slots());
  space::Columns flux(D, density_.slots());
  space::Columns coldness(1, density_.slots());
  for (std::size_t i = 0; i < slots; ++i) {
    if (particles.number[i] == pairs::nobody) continue;
    const double square = density_[0][i] * density_[0][i];
    std::array<double, triangle<D>> deformation;
    for (int c = 0; c < triangle<D>; ++c) deformation[c] = deformation_[c][i];
    const auto stress = viscous_stress<D>(fluid_.transport, deformation);
    for (int c = 0; c < triangle<D>; ++c) viscous[c][i] = stress[c] / square;
    for (int a = 0; a < D; ++a) flux[a][i] = -fluid_.transport.conductivity * deformation_[triangle<D> + a][i] / square;
    coldness[0][i] = 1.0 / temperature_[0][i];
  }
  std::visit(
      [&]<class Kernel>(const Kernel& kernel) {
        using Sum = EntropySum<D, Kernel>;
        pairs::Pass<D, Sum> columns;
        columns.position = particles.position;
        std::copy_n(particles.velocity.begin(), D, columns.carried.begin());
        append(columns.carried, D, viscous, 0, triangle<D>);
        append(columns.carried, D + triangle<D>, flux, 0, D);
        append(columns.carried, D + triangle<D> + D, coldness, 0, 1);
        columns.given = {produced[0], produced[1]};
        pairs::traverse<D>(particles.list, particles.images, kernel.range(), columns,
                           Sum{kernel, particles.strain_rate}, team);
      },
      fluid_.weight);
  return produced;
}

template space::Columns SmoothParticles<1>::entropy_production(const Particles<1>&, const Team&) const;
template space::Columns SmoothParticles<2>::entropy_production(const Particles<2>&, const Team&) const;
template space::Columns SmoothParticles<3>::entropy_production(const Particles<3>&, const Team&) const;

}  // namespace lucy::spam
