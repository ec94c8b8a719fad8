// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The amplitude of a wave in a state of particles, and the parts of its rate (lucy/cases/wave.hpp has the formulas).
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "lucy/cases/wave.hpp"
#include "lucy/motion/trajectory.hpp"

namespace lucy::cases {

/// sin(k y) and cos(k y) at particles whose positions are x0 y0 x1 y1 ...
class WaveShape {
 public:
  WaveShape(const std::vector<double>& positions, double wave_vector) {
    for (std::size_t i = 1; i < positions.size(); i += 2) {
      sine_.push_back(std::sin(wave_vector * positions[i]));
      cosine_.push_back(std::cos(wave_vector * positions[i]));
    }
  }

  std::size_t particles() const { return sine_.size(); }
  double sine(std::size_t i) const { return sine_[i]; }

  /// (2/N) sum_i value(i) sin(k y_i), and the same with the cosine.
  template <class Value>
  double along_sine(const Value& value) const {
    return along(sine_, value);
  }
  template <class Value>
  double along_cosine(const Value& value) const {
    return along(cosine_, value);
  }

 private:
  template <class Value>
  static double along(const std::vector<double>& shape, const Value& value) {
    double sum = 0.0;
    for (std::size_t i = 0; i < shape.size(); ++i) sum += value(i) * shape[i];
    return 2.0 * sum / static_cast<double>(shape.size());
  }

  std::vector<double> sine_;
  std::vector<double> cosine_;
};

/// s(rho, e) per mass by particle. The fluid has an entropy (spam/equation_of_state.hpp).
std::vector<double> entropies(const motion::FluidTrajectory<2>& fluid);

/// Everything that is sampled.
WaveSample wave_sample(WaveQuantity quantity, const motion::FluidTrajectory<2>& fluid, double wave_vector);
WaveSample wave_sample(WaveQuantity quantity, const motion::Trajectory<2>& atoms, double wave_vector);

}  // namespace lucy::cases
