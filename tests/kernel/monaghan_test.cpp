// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/kernel/monaghan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lucy::kernel {
namespace {

constexpr double pi = std::numbers::pi;

// Kum, Hoover and Posch (1995), Sec. II, for h = 3 in two dimensions.
double printed(double r) {
  if (r < 1.5) return 40.0 / (63.0 * pi) * (1.0 - 2.0 / 3.0 * r * r + 2.0 / 9.0 * r * r * r);
  return 80.0 / (63.0 * pi) * std::pow(1.0 - r / 3.0, 3);
}

TEST(Monaghan, HasThePrintedValuesForRangeThreeInTwoDimensions) {
  const Monaghan<2> kernel(3.0);
  EXPECT_NEAR(kernel.weight_at_zero(), 40.0 / (63.0 * pi), 1e-16);
  for (int i = 0; i <= 300; ++i) EXPECT_NEAR(kernel.weight(0.01 * i), printed(0.01 * i), 1e-15) << "r = " << 0.01 * i;
}

TEST(Monaghan, HasTheAmplitudesOfOneTwoAndThreeDimensions) {
  EXPECT_NEAR(Monaghan<1>(2.0).weight_at_zero(), 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(Monaghan<2>(2.0).weight_at_zero(), 10.0 / (7.0 * pi), 1e-15);
  EXPECT_NEAR(Monaghan<3>(2.0).weight_at_zero(), 1.0 / pi, 1e-15);
}

}  // namespace
}  // namespace lucy::kernel
