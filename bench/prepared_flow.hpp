// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sheared flow in its steady state to time things on: E = N, rate 0.1, or what is asked for.
#pragma once

#include <cstdint>

#include "lucy/motion/trajectory.hpp"

namespace lucy::bench {

inline motion::Trajectory<2> prepared_flow(std::int64_t particles, double energy, double rate, int threads,
                                           double equilibration) {
  const kernel::Lucy<2> kernel(3.0);
  const motion::Shear shear{.strain_rate = rate, .thermostat = motion::Thermostat::isoenergetic};
  motion::Trajectory<2> trajectory(kernel, motion::lattice_start(kernel, particles, 1.0, energy, 1), shear,
                                   motion::Integrator::runge_kutta_4, motion::Watch{}, Team(threads));
  while (trajectory.time() < equilibration) trajectory.advance(0.05);
  return trajectory;
}

}  // namespace lucy::bench
