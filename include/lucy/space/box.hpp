// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The periodic box, sheared or not. Images above the box (y direction) slide along x with the mean flow u_x = rate y
// (Lees and Edwards, J. Phys. C 5, 1921 (1972)):
//
//     image n of a particle at r with lab velocity v:   r + shift(n),   v + streaming(n)
//     shift(n)     = (n_x L_x + n_y offset,  n_y L_y, ...)       offset = rate L_y t  (mod L_x)
//     streaming(n) = (n_y rate L_y, 0, ...)
//
// Displacement and streaming velocity come from one function, so that nobody shifts the one and forgets the other.
// At zero rate (and always in one dimension) this is the plain periodic box.
#pragma once

#include <array>
#include <cmath>

namespace lucy::space {

template <int D>
using Vector = std::array<double, D>;

/// What one image adds to its owner's position and laboratory velocity.
template <int D>
struct ImageShift {
  Vector<D> position{};
  Vector<D> velocity{};
};

template <int D>
class Box {
 public:
  Box() = default;
  /// Edge lengths in sigma; strain rate d u_x/d y in inverse time; offset of the image above, any sign.
  explicit Box(const Vector<D>& lengths, double strain_rate = 0.0, double offset = 0.0)
      : lengths_(lengths), strain_rate_(D > 1 ? strain_rate : 0.0) {
    set_offset(offset);
  }

  const Vector<D>& lengths() const { return lengths_; }
  double strain_rate() const { return strain_rate_; }
  /// x-shift of the image above, in [0, L_x).
  double offset() const { return offset_; }
  double volume() const {
    double product = 1.0;
    for (double length : lengths_) product *= length;
    return product;
  }

  /// The shift of image n, `age` time units after the moment that the offset belongs to. Not folded back: it is
  /// continuous in `age`, as the motion of the particles is.
  ImageShift<D> image(const std::array<int, D>& n, double age) const {
    ImageShift<D> shift;
    for (int d = 0; d < D; ++d) shift.position[d] = n[d] * lengths_[d];
    if constexpr (D > 1) {
      const double sliding = strain_rate_ * lengths_[1];
      shift.position[0] += n[1] * (offset_ + sliding * age);
      shift.velocity[0] = n[1] * sliding;
    }
    return shift;
  }

  /// Lets the images slide on for `age`, and folds the offset back into [0, L_x).
  void advance(double age) {
    if constexpr (D > 1) set_offset(offset_ + strain_rate_ * lengths_[1] * age);
  }

  /// The image of `position` inside [0, L)^D. Crossing +y by L_y shifts x by -offset.
  void wrap(Vector<D>& position) const {
    for (int d = D - 1; d >= 0; --d) {
      double crossings = std::floor(position[d] / lengths_[d]);
      if (crossings == 0.0) continue;
      position[d] -= crossings * lengths_[d];
      if (position[d] >= lengths_[d]) {  // -1e-17 + L rounds to L: the next image's zero
        position[d] = 0.0;
        crossings += 1.0;
      }
      if constexpr (D > 1) {
        if (d == 1) position[0] -= crossings * offset_;
      }
    }
  }

 private:
  void set_offset(double offset) {
    if constexpr (D > 1) {
      offset_ = offset - std::floor(offset / lengths_[0]) * lengths_[0];
      if (offset_ >= lengths_[0]) offset_ = 0.0;
    }
  }

  Vector<D> lengths_{};
  double strain_rate_ = 0.0;
  double offset_ = 0.0;
};

}  // namespace lucy::space
