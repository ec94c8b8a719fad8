// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Monaghan's weight function, the cubic B-spline (J. J. Monaghan and J. C. Lattanzio, Astron. Astrophys. 149, 135
// (1985); Kum, Hoover and Posch, Phys. Rev. E 52, 4899 (1995), Sec. II), in D = 1, 2, 3 dimensions, with q = 2 r/h:
//
//     w(q < 1) = (A/4) [ (2 - q)^3 - 4 (1 - q)^3 ]      w(1 < q < 2) = (A/4) (2 - q)^3
//     A = 4/(3 h), 40/(7 pi h^2), 8/(pi h^3)            so that the integral of w over all space is one
//
//     -(1/r) dw/dr = (3 A/h^2) (4 - 3 q)  for q < 1,    (3 A/h^2) (2 - q)^2/q  beyond
//
// w, dw/dr and d^2w/dr^2 are continuous. w(0) = A. For h = 3 in two dimensions A = 40/(63 pi).
#pragma once

#include <algorithm>
#include <experimental/simd>
#include <numbers>
#include <string>

#include "lucy/errors.hpp"

namespace lucy::kernel {

template <int D>
class Monaghan {
  static_assert(D >= 1 && D <= 3);

 public:
  /// `range` is h, in units of sigma. Throws BadInput unless h > 0.
  explicit Monaghan(double range) : range_(range) {
    if (!(range > 0.0)) throw BadInput("kernel.range = " + std::to_string(range) + " must be above 0");
    constexpr double pi = std::numbers::pi;
    const double h = range;
    amplitude_ = D == 1 ? 4.0 / (3.0 * h) : D == 2 ? 40.0 / (7.0 * pi * h * h) : 8.0 / (pi * h * h * h);
    per_half_range_ = 2.0 / h;
    slope_constant_ = 3.0 * amplitude_ / (h * h);
  }

  double range() const { return range_; }

  /// w(0) = A: the self term, which sums over pairs leave out.
  double weight_at_zero() const { return amplitude_; }

  /// w(r), for r at most h. T is double or a vector of doubles.
  template <class T>
  T weight(const T& r) const {
    using std::experimental::max, std::max;
    const T outer = per_half_range_ * (range_ - r);  // 2 - q, exactly zero at the range
    const T inner = max(T(outer - 1.0), T(0.0));
    return (0.25 * amplitude_) * (outer * outer * outer - 4.0 * (inner * inner * inner));
  }

  /// -(1/r) dw/dr, for r at most h; zero at r = h.
  template <class T>
  T slope(const T& r) const {
    using std::experimental::max, std::max;
    // (4 - 3 q) q = (2 - q)^2 - 4 (1 - q)^2: one formula for both, but for the division by a q that may be zero.
    const T outer = per_half_range_ * (range_ - r);
    const T q = 2.0 - outer;
    const T far = outer * outer / max(q, T(1.0));
    const T near = 4.0 - 3.0 * q;
    return slope_constant_ * select(q, near, far);
  }

 private:
  static double select(double q, double near, double far) { return q < 1.0 ? near : far; }
  template <class T>
  static T select(const T& q, const T& near, const T& far) {
    T result = far;
    std::experimental::where(q < 1.0, result) = near;
    return result;
  }

  double range_;
  double amplitude_;
  double per_half_range_;
  double slope_constant_;
};

}  // namespace lucy::kernel
