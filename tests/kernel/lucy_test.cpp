// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/kernel/lucy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lucy::kernel {
namespace {

TEST(Lucy, HasTheValuesOfItsDefinition) {
  const Lucy<2> kernel(3.0);
  EXPECT_NEAR(kernel.weight_at_zero(), 5.0 / (9.0 * std::numbers::pi), 1e-16);
  EXPECT_NEAR(kernel.weight_at_zero(), 0.1768388, 5e-8);
  const double x = 0.4;
  EXPECT_NEAR(kernel.weight(1.2), kernel.weight_at_zero() * (1.0 + 3.0 * x) * std::pow(1.0 - x, 3), 1e-16);
}

TEST(Lucy, HasTheAmplitudesOfOneTwoAndThreeDimensions) {
  constexpr double pi = std::numbers::pi;
  EXPECT_NEAR(Lucy<1>(2.0).weight_at_zero(), 5.0 / 8.0, 1e-15);
  EXPECT_NEAR(Lucy<2>(2.0).weight_at_zero(), 5.0 / (4.0 * pi), 1e-15);
  EXPECT_NEAR(Lucy<3>(2.0).weight_at_zero(), 105.0 / (128.0 * pi), 1e-15);
}

}  // namespace
}  // namespace lucy::kernel
