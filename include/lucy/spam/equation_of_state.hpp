// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Equations of state, one small type each.
//
//     isentropic     P = (P0/2) (rho/rho0)^2        a two-dimensional ideal gas at constant entropy; e = P0 rho/(2
//     rho0^2)
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "lucy/errors.hpp"

namespace lucy::spam {

/// P = (P0/2)(rho/rho0)^2, of the density alone.
class Isentropic {
 public:
  /// P0 and rho0 are powers of two, so that P/(rho rho) is exactly P0/(2 rho0^2) for every density.
  /// Throws BadInput otherwise.
  explicit Isentropic(double pressure = 1.0, double density = 1.0) : half_pressure_(0.5 * pressure), density_(density) {
    const auto power_of_two = [](double x) {
      int exponent = 0;
      return x > 0.0 && std::isfinite(x) && std::frexp(x, &exponent) == 0.5;
    };
    if (!power_of_two(pressure)) throw BadInput(fmt::format("P0 = {} must be a power of two", pressure));
    if (!power_of_two(density)) throw BadInput(fmt::format("rho0 = {} must be a power of two", density));
  }

  double pressure(double density) const {
    const double ratio = density / density_;
    return half_pressure_ * (ratio * ratio);
  }

  /// Internal energy per mass: de = P/rho^2 drho, zero at zero density.
  double energy(double density) const { return half_pressure_ * density / (density_ * density_); }

 private:
  double half_pressure_;
  double density_;
};

}  // namespace lucy::spam
