// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lucy's weight function (L. B. Lucy, Astron. J. 82, 1013 (1977)), in D = 1, 2, 3 dimensions:
//
//     w(r < h) = A (1 + 3 r/h) (1 - r/h)^3          A = 5/(4 h), 5/(pi h^2), 105/(16 pi h^3)
//     -(1/r) dw/dr = (12 A / h^2) (1 - r/h)^2
//
// The integral of w over all space is one. Read as a pair potential, phi(r) = epsilon sigma^2 w(r) (Posch, Hoover and
// Kum, Phys. Rev. E 52, 1711 (1995), Eq. (2)). The gradient, -(1/r) dw/dr times the displacement, needs no division:
// at r = 0 it is finite and the force is zero.
#pragma once

#include <numbers>
#include <string>

#include "lucy/errors.hpp"

namespace lucy::kernel {

template <int D>
class Lucy {
  static_assert(D >= 1 && D <= 3);

 public:
  /// `range` is h, in units of sigma. Throws BadInput unless h > 0.
  explicit Lucy(double range) : range_(range) {
    if (!(range > 0.0)) throw BadInput("kernel.range = " + std::to_string(range) + " must be above 0");
    constexpr double pi = std::numbers::pi;
    const double h = range;
    amplitude_ = D == 1 ? 5.0 / (4.0 * h) : D == 2 ? 5.0 / (pi * h * h) : 105.0 / (16.0 * pi * h * h * h);
    weight_constant_ = amplitude_ / (h * h * h * h);
    slope_constant_ = 12.0 * weight_constant_;
  }

  double range() const { return range_; }

  /// w(0) = A: the self term, which sums over pairs leave out.
  double weight_at_zero() const { return amplitude_; }

  /// w(r), for r at most h. T is double or a vector of doubles.
  template <class T>
  T weight(const T& r) const {
    const T s = range_ - r;
    return weight_constant_ * (s * s * s) * (4.0 * range_ - 3.0 * s);
  }

  /// -(1/r) dw/dr, for r at most h; zero at r = h.
  template <class T>
  T slope(const T& r) const {
    const T s = range_ - r;
    return slope_constant_ * (s * s);
  }

 private:
  double range_;
  double amplitude_;
  double weight_constant_;
  double slope_constant_;
};

}  // namespace lucy::kernel
