// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// When a run samples and when it records frames: after whole intervals of steps, frames after whole numbers of these.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "lucy/cases/frame.hpp"
#include "lucy/motion/fluid_trajectory.hpp"

namespace lucy::cases {

inline constexpr std::int64_t most_interval_steps = 1000000000;

inline std::int64_t steps_in(double time, double step) { return std::llround(time / step); }

/// Steps of an interval of about `interval`, at least one: with frames, a divisor of the steps between them.
inline int interval_steps(double interval, double frame_interval, double step) {
  auto steps = std::clamp<std::int64_t>(steps_in(interval, step), 1, most_interval_steps);
  if (frame_interval > 0.0) {
    const std::int64_t between = std::max<std::int64_t>(1, steps_in(frame_interval, step));
    steps = std::min(steps, between);
    while (between % steps != 0) --steps;
  }
  return static_cast<int>(steps);
}

/// Intervals of so many steps that cover `time`.
inline std::int64_t intervals_in(double time, int steps, double step) {
  return static_cast<std::int64_t>(std::ceil(time / (steps * step) - 1e-6));
}

/// Whether a frame is due after so many intervals from the first frame on.
inline bool frame_falls_on(std::int64_t intervals, double frame_interval, int steps, double step) {
  return frame_interval > 0.0 && intervals >= 0 && intervals % (steps_in(frame_interval, step) / steps) == 0;
}

/// The present state of a fluid, after so many steps.
inline Frame frame_of(const motion::FluidTrajectory<2>& trajectory, std::int64_t steps, double step) {
  Frame frame;
  frame.step = steps;
  frame.time = static_cast<double>(steps) * step;
  frame.offset = trajectory.box().offset();
  frame.box = trajectory.cell().lengths();
  frame.position = trajectory.positions();
  frame.momentum = trajectory.velocities();
  frame.internal_energy = trajectory.energies();
  return frame;
}

}  // namespace lucy::cases
