// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/motion/start.hpp"

#include <fmt/format.h>

#include <cmath>
#include <random>

#include "lucy/errors.hpp"

namespace lucy::motion {

namespace {

constexpr double least_excess = 2e-5;

// Phi of particles on, or a little off, their lattice sites: a plain double loop over sites within reach, run once.
double configuration_energy(const kernel::Lucy<2>& kernel, const std::array<std::int64_t, 2>& sites, double spacing,
                            const std::vector<space::Vector<2>>& position) {
  const auto reach = static_cast<std::int64_t>(std::ceil(kernel.range() / spacing)) + 1;
  const double range_squared = kernel.range() * kernel.range();
  double energy = 0.0;
  for (std::int64_t row = 0; row < sites[1]; ++row) {
    for (std::int64_t column = 0; column < sites[0]; ++column) {
      const space::Vector<2>& mine = position[static_cast<std::size_t>(row * sites[0] + column)];
      for (std::int64_t up = 0; up <= reach; ++up) {
        for (std::int64_t right = up == 0 ? 1 : -reach; right <= reach; ++right) {
          const std::int64_t other_row = (row + up) % sites[1];
          const std::int64_t other_column = ((column + right) % sites[0] + sites[0]) % sites[0];
          const space::Vector<2>& other = position[static_cast<std::size_t>(other_row * sites[0] + other_column)];
          // The image whose site is (right, up) spacings away.
          const double x = other[0] - mine[0] + static_cast<double>(column + right - other_column) * spacing;
          const double y = other[1] - mine[1] + static_cast<double>(row + up - other_row) * spacing;
          const double squared = x * x + y * y;
          if (squared < range_squared) energy += kernel.weight(std::sqrt(squared));
        }
      }
    }
  }
  return energy;
}

}  // namespace

std::optional<std::array<std::int64_t, 2>> near_square(std::int64_t particles) {
  for (std::int64_t rows = std::llround(std::sqrt(static_cast<double>(particles))); rows >= 1; --rows) {
    if (particles % rows != 0) continue;
    const std::int64_t columns = particles / rows;
    if (2 * std::max(columns, rows) > 3 * std::min(columns, rows)) return std::nullopt;
    return std::array{std::max(columns, rows), std::min(columns, rows)};
  }
  return std::nullopt;
}

void refuse_uneven_lattice(std::int64_t particles) {
  if (near_square(particles)) return;
  std::int64_t below = particles - 1;
  while (below > 1 && !near_square(below)) --below;
  std::int64_t above = particles + 1;
  while (!near_square(above)) ++above;
  throw BadInput(
      fmt::format("system.particles = {} does not fill a nearly square lattice (sides within a factor of "
                  "1.5); the nearest numbers that do are {} and {}",
                  particles, below, above));
}

std::vector<space::Vector<2>> random_velocities(std::size_t count, double kinetic_energy, std::mt19937_64& generator) {
  const auto n = static_cast<double>(count);
  std::normal_distribution<double> normal;
  std::vector<space::Vector<2>> velocity(count);
  space::Vector<2> total{};
  for (auto& v : velocity) {
    v = {normal(generator), normal(generator)};
    for (int d = 0; d < 2; ++d) total[d] += v[d];
  }
  double kinetic = 0.0;
  for (auto& v : velocity) {
    for (int d = 0; d < 2; ++d) {
      v[d] -= total[d] / n;
      kinetic += 0.5 * v[d] * v[d];
    }
  }
  const double factor = std::sqrt(kinetic_energy / kinetic);
  for (auto& v : velocity) {
    for (double& component : v) component *= factor;
  }
  return velocity;
}

double lattice_energy(const kernel::Lucy<2>& kernel, double density) {
  const double spacing = 1.0 / std::sqrt(density);
  const auto reach = static_cast<int>(kernel.range() / spacing) + 1;
  double energy = 0.0;
  for (int row = -reach; row <= reach; ++row) {
    for (int column = -reach; column <= reach; ++column) {
      const double distance = spacing * std::hypot(row, column);
      if ((row != 0 || column != 0) && distance < kernel.range()) energy += 0.5 * kernel.weight(distance);
    }
  }
  return energy;
}

void refuse_impossible_start(const kernel::Lucy<2>& kernel, std::int64_t particles, double density,
                             double energy_per_particle) {
  refuse_uneven_lattice(particles);
  // A start needs some kinetic energy: what would be lost in rounding the lattice's energy for print is too little.
  const double coldest = lattice_energy(kernel, density) * (1.0 + least_excess);
  if (!(energy_per_particle > coldest)) {
    throw BadInput(
        fmt::format("system.energy_per_particle = {} must be above {:.9g}, the potential energy per "
                    "particle of the start lattice",
                    energy_per_particle, coldest));
  }
}

Start<2> lattice_start(const kernel::Lucy<2>& kernel, std::int64_t particles, double density,
                       double energy_per_particle, std::uint64_t seed) {
  refuse_impossible_start(kernel, particles, density, energy_per_particle);
  const auto sites = near_square(particles);
  const double coldest = lattice_energy(kernel, density);
  std::mt19937_64 generator(seed);
  const double spacing = 1.0 / std::sqrt(density);
  Start<2> start;
  start.lengths = {static_cast<double>((*sites)[0]) * spacing, static_cast<double>((*sites)[1]) * spacing};
  const auto count = static_cast<std::size_t>(particles);
  start.position.resize(count);
  std::vector<space::Vector<2>> offset(count);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (auto& o : offset) o = {uniform(generator), uniform(generator)};

  const double n = static_cast<double>(particles);
  double amplitude = 0.1 * spacing;
  double potential = 0.0;
  do {
    for (std::size_t i = 0; i < count; ++i) {
      const auto column = static_cast<std::int64_t>(i) % (*sites)[0];
      const auto row = static_cast<std::int64_t>(i) / (*sites)[0];
      start.position[i] = {(static_cast<double>(column) + 0.5) * spacing + amplitude * offset[i][0],
                           (static_cast<double>(row) + 0.5) * spacing + amplitude * offset[i][1]};
    }
    potential = configuration_energy(kernel, *sites, spacing, start.position);
    amplitude /= 2.0;
  } while (energy_per_particle * n - potential < 0.5 * (energy_per_particle - coldest) * n);

  start.momentum = random_velocities(count, energy_per_particle * n - potential, generator);
  return start;
}

}  // namespace lucy::motion
