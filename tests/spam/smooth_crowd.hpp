// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Test fluids: particles with velocities and internal energies, and their rates through list and passes.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "lucy/spam/smooth_particles.hpp"
#include "pairs/crowd.hpp"

namespace lucy::spam::testing {

using pairs::testing::Arranged;
using pairs::testing::Crowd;

template <int D>
struct SmoothCrowd : Crowd<D> {
  std::vector<double> energy;  // per mass
};

/// One particle per unit volume: a lattice of unit spacing (whole-numbered box lengths), half a spacing from the walls,
/// with uniform offsets up to `offset` along each axis; at rest, with unit energy.
template <int D>
SmoothCrowd<D> lattice(const space::Box<D>& box, double offset = 0.0, std::uint64_t seed = 1) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(-offset, offset);
  SmoothCrowd<D> crowd;
  crowd.box = box;
  const auto sites = std::llround(box.volume());
  for (long long site = 0; site < sites; ++site) {
    space::Vector<D> position;
    long long rest = site;
    for (int d = 0; d < D; ++d) {
      const auto length = std::llround(box.lengths()[d]);
      position[d] = static_cast<double>(rest % length) + 0.5 + uniform(generator);
      rest /= length;
    }
    box.wrap(position);
    crowd.position.push_back(position);
  }
  crowd.velocity.assign(crowd.position.size(), space::Vector<D>{});
  crowd.energy.assign(crowd.position.size(), 1.0);
  return crowd;
}

/// Gaussian velocities of the given width, and energies between a half and one and a half.
template <int D>
void make_noisy(SmoothCrowd<D>& crowd, double speed, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> energy(0.5, 1.5);
  for (auto& velocity : crowd.velocity) {
    for (double& component : velocity) component = speed * normal(generator);
  }
  for (double& e : crowd.energy) e = energy(generator);
}

/// Smooth waves of one wavelength in velocity (every component, along every axis) and energy.
template <int D>
void make_wavy(SmoothCrowd<D>& crowd, double speed, double energy) {
  constexpr double turn = 2.0 * std::numbers::pi;
  for (std::size_t i = 0; i < crowd.position.size(); ++i) {
    double phase = 0.4;
    for (int d = 0; d < D; ++d) phase += turn * crowd.position[i][d] / crowd.box.lengths()[d];
    for (int d = 0; d < D; ++d) {
      const int along = (d + 1) % D;
      crowd.velocity[i][d] = speed * std::sin(turn * crowd.position[i][along] / crowd.box.lengths()[along] + d);
    }
    crowd.energy[i] = 1.0 + energy * std::sin(phase);
  }
}

/// The fluid's rates for a crowd, by the list.
template <int D>
struct Evaluated {
  Arranged<D> arranged;
  space::Columns energy;
  pairs::ImageTable<D> images;
  double strain_rate;
  SmoothParticles<D> fluid;
  space::Columns gradients;

  Evaluated(const Fluid<D>& made_of, const SmoothCrowd<D>& crowd, const Team& team = Team(1))
      : arranged(crowd),
        energy(1, arranged.list.capacity()),
        images(pairs::image_table(crowd.box, 0.0)),
        strain_rate(crowd.box.strain_rate()),
        fluid(made_of, arranged.list.capacity()) {
    arranged.build(crowd, kernel::range_of<D>(made_of.weight), 0.0, 0.0, team);
    for (std::size_t slot = 0; slot < arranged.number.size(); ++slot) {
      const auto number = arranged.number[slot];
      energy[0][slot] = number == pairs::nobody ? 0.0 : crowd.energy[static_cast<std::size_t>(number)];
    }
    fluid.evaluate(particles(), team);
    gradients = fluid.gradients(particles(), team);
  }

  Particles<D> particles() const {
    return {arranged.list,
            images,
            arranged.number,
            Arranged<D>::pointers(arranged.position),
            Arranged<D>::pointers(arranged.velocity),
            energy[0],
            strain_rate};
  }

  /// One column by particle number.
  std::vector<double> by_particle(const space::Columns& columns, int column = 0) const {
    std::vector<double> values(arranged.number.size(), 0.0);
    std::size_t count = 0;
    for (std::size_t slot = 0; slot < arranged.number.size(); ++slot) {
      if (arranged.number[slot] == pairs::nobody) continue;
      values[static_cast<std::size_t>(arranged.number[slot])] = columns[column][slot];
      ++count;
    }
    values.resize(count);
    return values;
  }
  std::vector<double> acceleration(int d) const { return by_particle(fluid.acceleration(), d); }
  /// Column a D + b: d v_a/d x_b; then d T/d x_b.
  std::vector<double> gradient(int column) const { return by_particle(gradients, column); }
  std::vector<double> energy_rate() const { return by_particle(fluid.energy_rate()); }
};

}  // namespace lucy::spam::testing
