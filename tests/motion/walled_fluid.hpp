// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fluids between walls for tests: cells, fluids, disordered lattices, and a run of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "lucy/motion/fluid_trajectory.hpp"
#include "lucy/space/walls.hpp"

namespace lucy::motion::testing {

using space::WallKind;

inline constexpr spam::Transport all_transport{.viscosity = 0.5, .bulk_viscosity = 0.3, .conductivity = 0.4};
inline constexpr std::array kinds = {WallKind::mirror_images, WallKind::boundary_particles};

/// Walls at rest across the given axes, all at unit temperature.
template <int D>
space::Walls<D> walls_across(WallKind kind, const std::vector<std::size_t>& axes) {
  space::Walls<D> walls;
  walls.kind = kind;
  for (const std::size_t axis : axes) walls.across[axis].emplace();
  return walls;
}

/// The floor hot, the ceiling cold, and where there are side walls, these in between.
inline space::Walls<2> heated(WallKind kind, bool sides, double height, double hot = 1.5, double cold = 0.5) {
  auto walls = walls_across<2>(kind, {1});
  (*walls.across[1])[0].temperature = hot;
  (*walls.across[1])[1].temperature = cold;
  if (sides) {
    const space::Wall<2> side{{}, hot, {0.0, (cold - hot) / height}};
    walls.across[0] = {side, side};
  }
  return walls;
}

template <int D>
spam::Fluid<D> gas(const spam::Transport& transport = all_transport, double range = 2.5) {
  return {kernel::Lucy<D>(range), spam::IdealGas(), transport, spam::DensityMean::geometric, {}};
}

/// One particle per unit volume, half a spacing from the walls, with offsets up to `offset`, Gaussian velocities and
/// energies within `spread` of `energy`.
template <int D>
FluidStart<D> noisy_lattice(const space::Vector<D>& lengths, const space::Walls<D>& walls, std::uint64_t seed,
                            double offset = 0.3, double speed = 0.3, double energy = 1.0, double spread = 0.3) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<double> normal;
  FluidStart<D> start;
  start.lengths = lengths;
  start.walls = walls;
  const auto sites = std::llround(space::Box<D>(lengths).volume());
  for (long long site = 0; site < sites; ++site) {
    long long rest = site;
    space::Vector<D> position;
    space::Vector<D> velocity;
    for (int d = 0; d < D; ++d) {
      const auto along = std::llround(lengths[d]);
      position[d] = static_cast<double>(rest % along) + 0.5 + offset * uniform(generator);
      velocity[d] = speed * normal(generator);
      rest /= along;
    }
    start.position.push_back(position);
    start.velocity.push_back(velocity);
    start.energy.push_back(energy + spread * uniform(generator));
  }
  return start;
}

template <int D>
FluidTrajectory<D> flow(const spam::Fluid<D>& fluid, const FluidStart<D>& start, double energy_tolerance = 1e-3,
                        int threads = 1) {
  Watch watch;
  watch.energy_tolerance = energy_tolerance;
  return FluidTrajectory<D>(fluid, start, 0.0, Cooling::none, watch, Team(threads));
}

template <int D>
void run(FluidTrajectory<D>& trajectory, double time, double dt) {
  const auto steps = std::llround(time / dt);
  for (long long step = 0; step < steps; ++step) trajectory.advance(dt);
}

inline double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

inline double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

}  // namespace lucy::motion::testing
