// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the cases of smooth-particle fluids have in common: the fluid, and how it starts. Particles start from a nearly
// square lattice, displaced at random if asked for, at a uniform temperature or a uniform entropy, at rest or with
// random velocities. Reduced units (m = k = 1); names as in the input file.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "lucy/kernel/weight.hpp"
#include "lucy/motion/fluid_trajectory.hpp"
#include "lucy/spam/fluid.hpp"

namespace lucy::cases {

/// What is uniform at the start besides, nearly, the density.
enum class UniformStart { temperature, entropy };
inline constexpr std::array<std::pair<std::string_view, UniformStart>, 2> uniform_start_names = {{
    {"temperature", UniformStart::temperature},
    {"entropy", UniformStart::entropy},
}};

struct FluidSettings {
  // [system]
  std::int64_t particles = 0;
  double density = 1.0;  ///< number density n sigma^2
  int dimension = 2;
  // [kernel]
  kernel::WeightName weight = kernel::WeightName::lucy;
  double range = 3.0;  ///< h
  // [fluid]
  spam::EquationOfStateName equation_of_state = spam::EquationOfStateName::ideal_gas;
  double temperature = 1.0;     ///< kT of the start, at the stated density; without a meaning for the isentropic fluid
  double viscosity = 0.0;       ///< eta
  double bulk_viscosity = 0.0;  ///< eta_bulk
  double conductivity = 0.0;    ///< kappa
  spam::DensityMean density_mean = spam::DensityMean::geometric;
  // [start]
  double disorder = 0.0;  ///< offsets from the lattice are uniform in +- this many spacings along each axis
  double noise = 0.0;     ///< K/N of random velocities
  UniformStart uniform = UniformStart::temperature;
  // [run]
  double step = 0.2;
  double equilibration = 0.0;  ///< not recorded
  double duration = 0.0;       ///< recorded, per replica
  int replicas = 1;
  std::uint64_t seed = 1;
  double energy_tolerance = 1e-5;  ///< |dE|/N of one step above which it is subdivided
};

spam::Fluid<2> fluid_of(const FluidSettings& settings);

/// Of a lattice at rest there is one only: all replicas are the same, and their scatter is no error.
inline bool all_replicas_alike(const FluidSettings& settings) {
  return settings.disorder == 0.0 && settings.noise == 0.0;
}

/// One start for each seed (a 64-bit Mersenne twister). A uniform entropy is that of `temperature` and `density`: the
/// ideal gas gets e = kT rho/n, with rho the density at each particle.
motion::FluidStart<2> fluid_start(const FluidSettings& settings, std::uint64_t seed);

/// Refuses (BadInput, one sentence naming the key `section.key`, the value and the accepted range) what cannot be run.
void validate(const FluidSettings& settings);

}  // namespace lucy::cases
