// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Synthetic series with a known answer: x_{i+1} = phi x_i + sqrt(1 - phi^2) xi_i has mean 0, variance 1, relaxation
// time -1/ln phi samples, and the mean of n samples of it (n large) has variance (1 + phi)/(1 - phi)/n.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace lucy::statistics {

class AutoregressiveSeries {
 public:
  explicit AutoregressiveSeries(double phi, std::uint64_t seed) : phi_(phi), generator_(seed) {}

  /// `length` samples that begin at `start`.
  std::vector<double> from(double start, std::size_t length) {
    std::vector<double> series(length);
    double value = start;
    for (double& sample : series) {
      sample = value;
      value = phi_ * value + std::sqrt(1.0 - phi_ * phi_) * normal_(generator_);
    }
    return series;
  }

  std::vector<double> stationary(std::size_t length) { return from(normal_(generator_), length); }

  /// Standard deviation of the mean of `length` samples, exactly.
  double error_of_mean(std::size_t length) const {
    const auto n = static_cast<double>(length);
    const double end_effect = 2.0 * phi_ * (1.0 - std::pow(phi_, n)) / (n * (1.0 - phi_) * (1.0 - phi_));
    return std::sqrt(((1.0 + phi_) / (1.0 - phi_) - end_effect) / n);
  }

 private:
  double phi_;
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

}  // namespace lucy::statistics
