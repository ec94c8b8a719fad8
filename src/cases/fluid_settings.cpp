// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/fluid_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "lucy/errors.hpp"
#include "lucy/motion/start.hpp"

namespace lucy::cases {

spam::Fluid<2> fluid_of(const FluidSettings& settings) {
  return {kernel::make_weight<2>(settings.weight, settings.range),
          spam::make_equation_of_state(settings.equation_of_state),
          {settings.viscosity, settings.bulk_viscosity, settings.conductivity},
          settings.density_mean,
          {}};
}

motion::FluidStart<2> fluid_start(const FluidSettings& settings, std::uint64_t seed) {
  motion::refuse_uneven_lattice(settings.particles);
  const auto sites = *motion::near_square(settings.particles);
  const double spacing = 1.0 / std::sqrt(settings.density);
  const auto count = static_cast<std::size_t>(settings.particles);
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> offset(-settings.disorder, settings.disorder);

  motion::FluidStart<2> start;
  start.lengths = {static_cast<double>(sites[0]) * spacing, static_cast<double>(sites[1]) * spacing};
  start.position.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t column = static_cast<std::int64_t>(i) % sites[0];
    const std::int64_t row = static_cast<std::int64_t>(i) / sites[0];
    start.position[i] = {(static_cast<double>(column) + 0.5 + offset(generator)) * spacing,
                         (static_cast<double>(row) + 0.5 + offset(generator)) * spacing};
  }
  start.velocity.assign(count, {});
  if (settings.noise > 0.0) {
    start.velocity =
        motion::random_velocities(count, settings.noise * static_cast<double>(settings.particles), generator);
  }

  // The densities at the particles are known once a trajectory stands on them.
  const spam::Fluid<2> fluid = fluid_of(settings);
  const auto energy_at = [&](double density, double temperature) {
    return std::visit([&](const auto& state) { return state.energy(density, temperature); }, fluid.state);
  };
  start.energy.assign(count, energy_at(settings.density, settings.temperature));
  const motion::FluidTrajectory<2> standing(fluid, start, 0.0, motion::Cooling::none, motion::Watch{}, Team(1));
  const std::vector<double> densities = standing.densities();
  for (std::size_t i = 0; i < count; ++i) {
    const double relative = densities[i] / settings.density;
    const double temperature = settings.temperature * (settings.uniform == UniformStart::entropy ? relative : 1.0);
    start.energy[i] = energy_at(densities[i], temperature);
  }
  return start;
}

void validate(const FluidSettings& settings) {
  motion::refuse_uneven_lattice(settings.particles);
  const auto sites = *motion::near_square(settings.particles);
  const double shortest = static_cast<double>(std::min(sites[0], sites[1])) / std::sqrt(settings.density);
  if (!(shortest >= 2.0 * settings.range)) {
    throw BadInput(
        fmt::format("system.particles = {} at density {} makes a box of height {:.6g}, which must be at least twice "
                    "kernel.range = {}",
                    settings.particles, settings.density, shortest, settings.range));
  }
  const spam::Fluid<2> fluid = fluid_of(settings);
  fluid.validate();
  if (settings.uniform == UniformStart::entropy && settings.equation_of_state != spam::EquationOfStateName::ideal_gas) {
    throw BadInput(
        "start.uniform = \"entropy\" is for fluid.equation_of_state = \"ideal-gas\" only; use "
        "\"temperature\"");
  }
  if (settings.equation_of_state == spam::EquationOfStateName::van_der_waals &&
      !(settings.density * spam::VanDerWaals::excluded < 0.8)) {
    throw BadInput(
        fmt::format("system.density = {} must be below {} for the van der Waals fluid, whose particles fill all space "
                    "at density {}",
                    settings.density, 0.8 / spam::VanDerWaals::excluded, 1.0 / spam::VanDerWaals::excluded));
  }
  if (settings.equation_of_state == spam::EquationOfStateName::van_der_waals) {
    const double spinodal = spam::VanDerWaals::spinodal_temperature(settings.density);
    if (!(settings.temperature > spinodal)) {
      throw BadInput(
          fmt::format("fluid.temperature = {} must be above {:.6g} for a van der Waals fluid of density {}: below, a "
                      "uniform one falls apart into liquid and gas",
                      settings.temperature, spinodal, settings.density));
    }
  }
}

}  // namespace lucy::cases
