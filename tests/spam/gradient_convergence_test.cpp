// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the error of gradients falls, and where it stops: examples/gradient_convergence prints the whole table.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "smooth_crowd.hpp"

namespace lucy::spam {
namespace {

using testing::Evaluated;
using testing::SmoothCrowd;

constexpr std::array both_weights = {kernel::WeightName::lucy, kernel::WeightName::monaghan};

/// Root mean square of the error of grad T at the particles over that of grad T, T = 1 + sin(2 pi x/side)/2.
double relative_error(kernel::WeightName weight, double range, int side, double offset) {
  const space::Box<2> box({static_cast<double>(side), static_cast<double>(side)});
  SmoothCrowd<2> crowd = testing::lattice<2>(box, offset, 7);
  const double k = 2.0 * std::numbers::pi / side;
  for (std::size_t i = 0; i < crowd.position.size(); ++i)
    crowd.energy[i] = 1.0 + 0.5 * std::sin(k * crowd.position[i][0]);
  const Fluid<2> fluid{kernel::make_weight<2>(weight, range), IdealGas(), {.conductivity = 1.0}, {}, {}};
  const Evaluated<2> evaluated(fluid, crowd);
  const auto along_x = evaluated.gradient(4);
  const auto along_y = evaluated.gradient(5);
  double error = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < along_x.size(); ++i) {
    const double truth = 0.5 * k * std::cos(k * crowd.position[i][0]);
    error += std::pow(along_x[i] - truth, 2) + std::pow(along_y[i], 2);
    size += truth * truth;
  }
  return std::sqrt(error / size);
}

// Smoothing over h costs some (h/L)^2: with h = 6 on a lattice hardly anything else is seen.
TEST(GradientConvergence, OnALatticeIsOfSecondOrderInTheRangeOverTheLength) {
  for (const auto weight : both_weights) {
    const double coarse = relative_error(weight, 6.0, 48, 0.0);
    const double fine = relative_error(weight, 6.0, 96, 0.0);
    EXPECT_GT(coarse / fine, 3.5);
    EXPECT_LT(coarse / fine, 4.5);
  }
}

TEST(GradientConvergence, HasAFloorAtAFixedRangeOverTheSpacing) {
  for (const auto weight : both_weights) {
    for (const double offset : {0.1, 0.3}) {
      const double at_32 = relative_error(weight, 3.0, 96, offset);
      EXPECT_NEAR(relative_error(weight, 3.0, 48, offset) / at_32, 1.0, 0.1);
      EXPECT_GT(at_32, 0.1 * offset);
    }
  }
}

// More particles, each with more partners: h grows as the fourth root of N, L/h as much.
TEST(GradientConvergenceLong, FallsWhenRangeOverSpacingGrowsWithTheNumberOfParticles) {
  for (const auto weight : both_weights) {
    for (const double offset : {0.0, 0.1, 0.3}) {
      double before = 1.0;
      for (const int range : {2, 4, 6, 8}) {
        const double error = relative_error(weight, range, 4 * range * range, offset);
        EXPECT_LT(error, before) << "h = " << range << ", offset " << offset;
        before = error;
      }
      // Four times the range over the spacing, four times the length over the range: second order in both.
      if (offset == 0.0) continue;
      EXPECT_NEAR(relative_error(weight, 2.0, 16, offset) / before, 16.0, 4.0) << "offset " << offset;
    }
  }
}

}  // namespace
}  // namespace lucy::spam
