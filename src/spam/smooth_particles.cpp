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

namespace lucy::spam {

namespace {

constexpr std::size_t chunk_slots = 512;

/// work(slot) for every slot, shared in chunks.
template <class Work>
void for_slots(std::size_t slots, const Team& team, const Work& work) {
  const auto chunks = static_cast<std::ptrdiff_t>((slots + chunk_slots - 1) / chunk_slots);
  team.share(chunks, [&](std::ptrdiff_t chunk) {
    const std::size_t begin = static_cast<std::size_t>(chunk) * chunk_slots;
    const std::size_t end = std::min(begin + chunk_slots, slots);
    for (std::size_t slot = begin; slot < end; ++slot) work(slot);
  });
}

}  // namespace

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
  mean_factor_ = space::Columns(plain ? 0 : 1, slots);
  gradients_ = space::Columns(plain ? 0 : D * D + D, slots);
  stress_ = space::Columns(plain ? 1 : triangle<D> + D, slots);
}

template <int D>
void SmoothParticles<D>::evaluate(const Particles<D>& particles, const Team& team) {
  densities<D>(fluid_.weight, particles.list, particles.images, particles.position, density_[0], team);
  apply_equation_of_state(particles, team);
  if (!fluid_.transport.none()) {
    find_gradients(particles, team);
    apply_transport(particles, team);
  }
  find_rates(particles, team);
}

template <int D>
void SmoothParticles<D>::apply_equation_of_state(const Particles<D>& particles, const Team& team) {
  const double* const rho = density_[0];
  const double* const e = particles.energy;
  double* const pressure = pressure_[0];
  double* const temperature = temperature_[0];
  std::visit(
      [&](const auto& state) {
        for_slots(particles.list.slots(), team, [&](std::size_t i) {
          pressure[i] = state.pressure(rho[i], e[i]);
          temperature[i] = state.temperature(rho[i], e[i]);
        });
      },
      fluid_.state);
  if (fluid_.transport.none()) {
    double* const specific = stress_[0];
    for_slots(particles.list.slots(), team, [&](std::size_t i) { specific[i] = pressure[i] / (rho[i] * rho[i]); });
  } else if (fluid_.mean == DensityMean::geometric) {
    double* const factor = mean_factor_[0];
    for_slots(particles.list.slots(), team, [&](std::size_t i) { factor[i] = 1.0 / std::sqrt(rho[i]); });
  } else {
    std::copy_n(rho, particles.list.slots(), mean_factor_[0]);
  }
}

template <int D>
void SmoothParticles<D>::apply_transport(const Particles<D>& particles, const Team& team) {
  const double* const rho = density_[0];
  const double* const pressure = pressure_[0];
  for_slots(particles.list.slots(), team, [&](std::size_t i) {
    const double square = rho[i] * rho[i];
    const double per_square = 1.0 / square;
    const auto viscous = viscous_stress<D>(fluid_.transport, gradients_, i);
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b <= a; ++b) {
        const int at = a * (a + 1) / 2 + b;
        stress_[at][i] = viscous[at] * per_square;
        if (a == b) stress_[at][i] += pressure[i] / square;  // a division: exactly 1/2 for the isentropic fluid
      }
      stress_[triangle<D> + a][i] = -fluid_.transport.conductivity * gradients_[D * D + a][i] * per_square;
    }
  });
}

template <int D>
double SmoothParticles<D>::viscous_stress_xy(std::size_t slots) const {
  double sum = 0.0;
  if constexpr (D > 1) {
    if (fluid_.transport.none()) return 0.0;
    for (std::size_t i = 0; i < slots; ++i)
      if (density_[0][i] > 0.0)
        sum -= fluid_.transport.viscosity * (gradients_[1][i] + gradients_[D][i]) / density_[0][i];
  }
  return sum;
}

template <int D>
void SmoothParticles<D>::save(ArchiveWriter& archive, std::size_t slots) const {
  for (const space::Columns* columns :
       {&density_, &temperature_, &pressure_, &gradients_, &acceleration_, &energy_rate_})
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
