// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What happens between the passes to particles that stand for walls: an image takes what belongs to it from its parent,
// and all take from the wall what belongs to the wall.
#pragma once

#include <span>
#include <variant>

#include "lucy/space/columns.hpp"
#include "lucy/spam/equation_of_state.hpp"
#include "lucy/spam/smooth_particles.hpp"

namespace lucy::spam {

inline void give_to_images(space::Columns& columns, std::span<const WallParticle> walls) {
  for (int c = 0; c < columns.count(); ++c)
    for (const WallParticle& at : walls)
      if (at.has_parent()) columns[c][at.slot] = columns[c][at.parent];
}

/// Pressures and temperatures at walls, where densities are known.
inline void set_states_at_walls(const EquationOfState& any_state, const double* density, double* pressure,
                                double* temperature, std::span<const WallParticle> walls) {
  std::visit(
      [&](const auto& state) {
        for (const WallParticle& at : walls) {
          const double rho = density[at.slot];
          pressure[at.slot] =
              at.has_parent() ? pressure[at.parent] : state.pressure(rho, state.energy(rho, at.temperature));
          temperature[at.slot] = at.temperature;
        }
      },
      any_state);
}

inline void set_zero_at_walls(space::Columns& columns, std::span<const WallParticle> walls) {
  for (int c = 0; c < columns.count(); ++c)
    for (const WallParticle& at : walls) columns[c][at.slot] = 0.0;
}

}  // namespace lucy::spam
