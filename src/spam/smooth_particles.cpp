// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/spam/smooth_particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "lucy/errors.hpp"
#include "lucy/spam/density.hpp"
#include "spam/pass_columns.hpp"
#include "spam/wall_particles.hpp"

namespace lucy::spam {

using pairs::Lanes;

template <int D>
void Fluid<D>::validate() const {
  const auto refuse_negative = [](const char* name, double value) {
    if (!(value >= 0.0) || !std::isfinite(value))
      throw BadInput(fmt::format("fluid.{} = {} must be at least 0", name, value));
  };
  refuse_negative("viscosity", transport.viscosity);
  refuse_negative("bulk_viscosity", transport.bulk_viscosity);
  refuse_negative("conductivity", transport.conductivity);
  if (transport.conductivity > 0.0 && !has_temperature(state))
    throw BadInput(
        fmt::format("fluid.conductivity = {} needs an equation of state with a temperature, which "
                    "\"isentropic\" has not",
                    transport.conductivity));
}

template struct Fluid<1>;
template struct Fluid<2>;
template struct Fluid<3>;

template <int D>
SmoothParticles<D>::SmoothParticles(const Fluid<D>& fluid, std::size_t slots)
    : fluid_(fluid),
      density_(1, slots),
      temperature_(1, slots),
      pressure_(1, slots),
      acceleration_(D, slots),
      energy_rate_(1, slots) {
  fluid.validate();
  const bool plain = fluid.transport.none();
  deformation_ = space::Columns(plain ? 0 : triangle<D> + D, slots);
  mean_factor_ = space::Columns(plain ? 0 : 1, slots);
  stress_ = space::Columns(plain ? 1 : triangle<D> + D, slots);
}

template <int D>
void SmoothParticles<D>::evaluate(const Particles<D>& particles, const Team& team) {
  densities<D>(fluid_.weight, particles.list, particles.images, particles.position, density_[0], slopes_, team);
  give_to_images(density_, particles.walls);
  apply_equation_of_state(particles, team);
  if (!fluid_.transport.none()) {
    find_deformation(particles, team);
    give_to_images(deformation_, particles.walls);
    apply_transport(particles, team);
  }
  find_rates(particles, team);
  set_zero_at_walls(acceleration_, particles.walls);
  set_zero_at_walls(energy_rate_, particles.walls);
}

template <int D>
void SmoothParticles<D>::apply_equation_of_state(const Particles<D>& particles, const Team& team) {
  const bool plain = fluid_.transport.none();
  std::visit(
      [&](const auto& state) {
        for_clusters(particles.list.clusters(), team, [&](std::size_t cluster) {
          const std::size_t first = cluster * pairs::lane_count;
          const Lanes rho = pairs::load(density_[0] + first);
          const Lanes e = pairs::load(particles.energy + first);
          pairs::store(pressure_[0] + first, state.pressure(rho, e));
          pairs::store(temperature_[0] + first, state.temperature(rho, e));
          if (!plain) pairs::store(mean_factor_[0] + first, mean_factor(fluid_.mean, rho));
        });
      },
      fluid_.state);
  set_states_at_walls(fluid_.state, density_[0], pressure_[0], temperature_[0], particles.walls);
  if (!plain) return;
  for_clusters(particles.list.clusters(), team, [&](std::size_t cluster) {
    const std::size_t first = cluster * pairs::lane_count;
    const Lanes rho = pairs::load(density_[0] + first);
    pairs::store(stress_[0] + first, pairs::load(pressure_[0] + first) / (rho * rho));
  });
}

template <int D>
void SmoothParticles<D>::apply_transport(const Particles<D>& particles, const Team& team) {
  for_clusters(particles.list.clusters(), team, [&](std::size_t cluster) {
    const std::size_t first = cluster * pairs::lane_count;
    std::array<Lanes, triangle<D>> deformation;
    for (int c = 0; c < triangle<D>; ++c) deformation[c] = pairs::load(deformation_[c] + first);
    const Lanes rho = pairs::load(density_[0] + first);
    const Lanes square = rho * rho;
    const Lanes per_square = 1.0 / square;
    const Lanes specific =
        pairs::load(pressure_[0] + first) / square;  // a division: exactly 1/2 for the isentropic fluid
    const auto viscous = viscous_stress<D>(fluid_.transport, deformation);
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b <= a; ++b) {
        const int at = in_triangle(a, b);
        const Lanes stress = viscous[at] * per_square;
        pairs::store(stress_[at] + first, a == b ? stress + specific : stress);
      }
      const Lanes along = pairs::load(deformation_[triangle<D> + a] + first);
      pairs::store(stress_[triangle<D> + a] + first, -fluid_.transport.conductivity * along * per_square);
    }
  });
}

template <int D>
void SmoothParticles<D>::renew_walls(std::span<const WallParticle> walls) {
  for (space::Columns* const columns : {&density_, &pressure_, &deformation_}) give_to_images(*columns, walls);
  for (const WallParticle& at : walls) temperature_[0][at.slot] = at.temperature;
  set_zero_at_walls(acceleration_, walls);
  set_zero_at_walls(energy_rate_, walls);
}

template <int D>
double SmoothParticles<D>::viscous_stress_xy(std::size_t slots, std::span<const WallParticle> walls) const {
  double sum = 0.0;
  if constexpr (D > 1) {
    if (fluid_.transport.none()) return 0.0;
    const auto stress = [&](std::size_t i) { return fluid_.transport.viscosity * deformation_[1][i] / density_[0][i]; };
    for (std::size_t i = 0; i < slots; ++i)
      if (density_[0][i] > 0.0) sum -= stress(i);
    for (const WallParticle& at : walls) sum += stress(at.slot);
  }
  return sum;
}

template <int D>
void SmoothParticles<D>::save(ArchiveWriter& archive, std::size_t slots) const {
  for (const space::Columns* columns :
       {&density_, &temperature_, &pressure_, &deformation_, &acceleration_, &energy_rate_})
    columns->save(archive, slots);
  archive.put(virial_xy_);
}

template <int D>
void SmoothParticles<D>::load(ArchiveReader& archive, std::size_t slots) {
  for (space::Columns* columns : columns_to_sort()) columns->load(archive, slots);
  virial_xy_ = archive.get<double>();
}

template class SmoothParticles<1>;
template class SmoothParticles<2>;
template class SmoothParticles<3>;

}  // namespace lucy::spam
