// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A configuration for people to look at, of any two-dimensional case, by particle number.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace lucy::cases {

struct Frame {
  std::int64_t step = 0;
  double time = 0.0;
  double offset = 0.0;  ///< x-shift of the image above, in [0, L_x)
  std::array<double, 2> box{};
  std::vector<double> position;         ///< x0 y0 x1 y1 ..., in [0, L)
  std::vector<double> momentum;         ///< peculiar, same order
  std::vector<double> internal_energy;  ///< e per mass, one per particle; empty for atoms
};

}  // namespace lucy::cases
