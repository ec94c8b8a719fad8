// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sentences that the validation of cases has in common. Every one throws BadInput, names the key `section.key` and the
// value, and says what is accepted.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "lucy/errors.hpp"

namespace lucy::cases {

inline constexpr double most_steps = 4e15;  // counted exactly by a double; no machine lives for so many

[[noreturn]] inline void refuse(const std::string& message) { throw BadInput(message); }

inline void refuse_unless_above_zero(const char* key, double value) {
  if (!(value > 0.0) || !std::isfinite(value))
    refuse(fmt::format("{} = {} must be {}", key, value, value > 0.0 ? "finite" : "above 0"));
}

inline void refuse_unless_at_least_zero(const char* key, double value) {
  if (!(value >= 0.0) || !std::isfinite(value))
    refuse(fmt::format("{} = {} must be {}", key, value, value > 0.0 ? "finite" : "0 or above"));
}

/// An interval of time that has to end with a step.
inline void refuse_unless_whole_steps(const char* key, double interval, double step) {
  const double steps = interval / step;
  if (steps < 0.5 || std::abs(steps - std::round(steps)) > 1e-6 * steps)
    refuse(fmt::format("{} = {} must be a whole number of steps of run.step = {}", key, interval, step));
}

/// A run that nobody could count.
inline void refuse_endless_run(double equilibration, double duration, double step) {
  const double steps = (equilibration + duration) / step;
  if (!(steps <= most_steps))
    refuse(
        fmt::format("run.duration = {} and run.equilibration = {} make {} steps of run.step = {}; at most {} are "
                    "possible",
                    duration, equilibration, steps, step, most_steps));
}

/// Steps so long that images pass each other.
inline void refuse_large_strain(double strain_rate, double step) {
  if (std::abs(strain_rate) * step > 0.5)
    refuse(fmt::format("run.step = {} at shear.strain_rate = {} strains the box by more than 0.5 in one step", step,
                       strain_rate));
}

/// When frames and samples are to be recorded; 0: not asked for.
inline void refuse_uneven_intervals(double sample_interval, double frame_interval, double step, double duration) {
  const auto steps_in = [step](double time) { return std::llround(time / step); };
  if (sample_interval > 0.0) {
    refuse_unless_whole_steps("output.sample_interval", sample_interval, step);
    if (sample_interval > duration)
      refuse(fmt::format("output.sample_interval = {} must be at most run.duration = {}", sample_interval, duration));
  }
  if (frame_interval > 0.0) {
    refuse_unless_whole_steps("output.frame_interval", frame_interval, step);
    if (sample_interval > 0.0 && steps_in(frame_interval) % steps_in(sample_interval) != 0)
      refuse(fmt::format("output.frame_interval = {} must be a multiple of output.sample_interval = {}", frame_interval,
                         sample_interval));
  }
}

}  // namespace lucy::cases
