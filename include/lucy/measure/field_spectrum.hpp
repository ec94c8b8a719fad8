// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The power spectrum of a field f on a regular grid of M = n_x n_y nodes over a periodic box, sheared or not,
//
//     P(k) = |1/M sum_nodes f(r) exp(-i k.r)|^2          sum of P over all k but zero = variance of f on the grid
//
// averaged over rings of |k|. The images above the box are displaced along x by the offset s, f(x + s, y + L_y) =
// f(x, y), so the wave vectors that f is made of are those of the tilted box,
//
//     k = 2 pi ( a/L_x,  (b - a s/L_x)/L_y )            a, b integers
//
// found by transforming the rows, turning row y by the phase exp(2 pi i a s y/(L_x L_y)), which makes them periodic,
// and transforming the columns. k_y is taken between -pi n_y/L_y and pi n_y/L_y, as the grid cannot tell it from
// others.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "lucy/space/box.hpp"

namespace lucy::measure {

/// One ring: the wave vectors with (b - 1/2) dk <= |k| < (b + 1/2) dk, b = 1, 2, ...
struct SpectrumRing {
  double wave_number = 0.0;  ///< mean of |k|
  double modes = 0.0;        ///< wave vectors in the ring, k and -k counted both; over several spectra, the mean number
  double power = 0.0;        ///< mean of P(k): the sum of modes times power over the rings is the variance
};

/// Spectra of one field at one or more times, added up.
class FieldSpectrum {
 public:
  /// For fields on these nodes of a box with these edges; dk = 2 pi over the longer edge. From any thread. Throws
  /// BadInput for a grid of fewer than two nodes along an edge.
  FieldSpectrum(const std::array<int, 2>& nodes, const space::Vector<2>& lengths);

  /// `values`: one per node, counted along x first. `offset`: of the image above. A field that is not known everywhere
  /// (nan) has no spectrum: the rings then have power nan.
  void add(std::span<const double> values, double offset);

  /// Rings without any wave vector are left out; none before the first add().
  std::vector<SpectrumRing> rings() const;

  /// Rings up to this |k| are whole; beyond it the grid has only the corners of the square.
  double whole_up_to() const;

 private:
  std::array<int, 2> nodes_;
  space::Vector<2> lengths_;
  double width_;  // dk
  std::vector<SpectrumRing> sums_;
  double spectra_ = 0.0;
};

}  // namespace lucy::measure
