// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/spam/smooth_particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "lucy/errors.hpp"
#include "lucy/spam/density.hpp"
#include "lucy/spam/entropy_production.hpp"
#include "lucy/spam/rates.hpp"

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

/// Pointers to `count` columns from `first` on, behind `begin` others.
template <std::size_t size>
void append(std::array<const double*, size>& to, std::size_t begin, const space::Columns& columns, int first,
            int count) {
  for (int c = 0; c < count; ++c) to[begin + static_cast<std::size_t>(c)] = columns[first + c];
}

template <int D>
constexpr int triangle = D*(D + 1) / 2;

/// Newton's law without P_eq: the viscous stress of the particle at slot i, lower triangle by rows.
template <int D>
std::array<double, triangle<D>> viscous_stress(const Transport& transport, const space::Columns& gradients,
                                               std::size_t i) {
  double divergence = 0.0;
  for (int a = 0; a < D; ++a) divergence += gradients[a * D + a][i];
  const double spherical = (transport.bulk_viscosity - 2.0 / D * transport.viscosity) * divergence;
  std::array<double, triangle<D>> stress;
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b <= a; ++b) {
      const double shear = -transport.viscosity * (gradients[a * D + b][i] + gradients[b * D + a][i]);
      stress[a * (a + 1) / 2 + b] = a == b ? shear - spherical : shear;
    }
  }
  return stress;
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
                       team);
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
    append(columns.carried, D, stress_, 0, Sum::stresses + Sum::fluxes);
    for (int d = 0; d < D; ++d) columns.given[d] = acceleration_[d];
    columns.given[D] = energy_rate_[0];
    virial_xy_ = pairs::traverse<D>(particles.list, particles.images, kernel.range(), columns,
                                    Sum{kernel, particles.strain_rate}, team)[0];
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
    const auto stress = viscous_stress<D>(fluid_.transport, gradients_, i);
    for (int c = 0; c < triangle<D>; ++c) viscous[c][i] = stress[c] / square;
    for (int a = 0; a < D; ++a) flux[a][i] = -fluid_.transport.conductivity * gradients_[D * D + a][i] / square;
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
