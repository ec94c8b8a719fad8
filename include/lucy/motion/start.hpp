// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a run starts: a square (cubic) lattice with small random offsets, Maxwell-Boltzmann momenta of zero total
// momentum, scaled so that the total energy is exact (Posch, Hoover and Kum, Phys. Rev. E 52, 1711 (1995), Sec. III).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "lucy/kernel/lucy.hpp"
#include "lucy/space/box.hpp"

namespace lucy::motion {

template <int D>
struct Start {
  space::Vector<D> lengths{};
  std::vector<space::Vector<D>> position;
  std::vector<space::Vector<D>> momentum;  ///< peculiar
  double offset = 0.0;                     ///< x-shift of the image above
};

/// Columns and rows of the most nearly square lattice of `particles` sites; nothing if its sides differ by more than
/// a factor of 1.5.
std::optional<std::array<std::int64_t, 2>> near_square(std::int64_t particles);

/// Throws BadInput, naming system.particles, if there is none.
void refuse_uneven_lattice(std::int64_t particles);

/// Velocities (or momenta, m = 1) from a normal distribution, of zero total momentum and exactly this kinetic energy in
/// all.
std::vector<space::Vector<2>> random_velocities(std::size_t count, double kinetic_energy, std::mt19937_64& generator);

/// Phi/N of the perfect square lattice at number density `density`, no self term. For the Lucy weight with h = 3 at
/// unit density: 0.41305.
double lattice_energy(const kernel::Lucy<2>& kernel, double density);

/// Throws BadInput if the particle number has no near-square lattice or the energy is at or below the lattice's.
void refuse_impossible_start(const kernel::Lucy<2>& kernel, std::int64_t particles, double density,
                             double energy_per_particle);

/// A start with total energy `energy_per_particle` N (no self term). Offsets are uniform in +-0.1 spacings along each
/// axis, less where that would leave too little kinetic energy. The generator is a 64-bit Mersenne twister.
/// Refuses what refuse_impossible_start() refuses.
Start<2> lattice_start(const kernel::Lucy<2>& kernel, std::int64_t particles, double density,
                       double energy_per_particle, std::uint64_t seed);

}  // namespace lucy::motion
