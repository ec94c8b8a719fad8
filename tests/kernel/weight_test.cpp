// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every weight function must be, in one, two and three dimensions.
#include "lucy/kernel/weight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>

#include "lucy/pairs/lanes.hpp"

namespace lucy::kernel {
namespace {

constexpr std::array<double, 5> ranges = {0.5, 1.0, 2.5, 3.0, 6.0};

template <class Kernel>
struct Weights : testing::Test {};

template <class Kernel>
constexpr int dimension = 0;
template <template <int> class Kernel, int D>
constexpr int dimension<Kernel<D>> = D;

using Kernels = testing::Types<Lucy<1>, Lucy<2>, Lucy<3>, Monaghan<1>, Monaghan<2>, Monaghan<3>>;
TYPED_TEST_SUITE(Weights, Kernels);

/// Integral of w over all space by Simpson's rule in r, with the surface of the unit sphere. Both weights are
/// polynomials on either half of the range, and so is the rule's grid cut.
template <class Kernel>
double integral(const Kernel& kernel) {
  constexpr int D = dimension<Kernel>;
  constexpr double pi = std::numbers::pi;
  constexpr int intervals = 2000;
  const double dr = kernel.range() / intervals;
  const auto integrand = [&](double r) {
    const double surface = D == 1 ? 2.0 : D == 2 ? 2.0 * pi * r : 4.0 * pi * r * r;
    return surface * kernel.weight(r);
  };
  double sum = 0.0;
  for (int i = 0; i < intervals; i += 2) {
    sum += dr / 3.0 * (integrand(i * dr) + 4.0 * integrand((i + 1) * dr) + integrand((i + 2) * dr));
  }
  return sum;
}

TYPED_TEST(Weights, IntegrateToOneOverAllSpace) {
  for (const double range : ranges) EXPECT_NEAR(integral(TypeParam(range)), 1.0, 1e-11) << "h = " << range;
}

TYPED_TEST(Weights, HaveTheirSelfTermAtTheOriginAndFallFromThere) {
  for (const double range : ranges) {
    const TypeParam kernel(range);
    EXPECT_NEAR(kernel.weight(0.0), kernel.weight_at_zero(), 1e-15 * kernel.weight_at_zero());
    for (int i = 0; i < 100; ++i) {
      EXPECT_GT(kernel.weight(0.01 * i * range), kernel.weight(0.01 * (i + 1) * range));
      EXPECT_GT(kernel.slope(0.01 * i * range), 0.0);
    }
  }
}

TYPED_TEST(Weights, SlopeIsMinusTheDerivativeOverTheDistance) {
  for (const double range : ranges) {
    const TypeParam kernel(range);
    const double d = 1e-5 * range;
    for (const double fraction : {0.02, 0.3, 0.49, 0.5, 0.51, 0.77, 0.95}) {
      const double r = fraction * range;
      const double slope = -(kernel.weight(r + d) - kernel.weight(r - d)) / (2.0 * d) / r;
      EXPECT_NEAR(kernel.slope(r), slope, 1e-8 * kernel.slope(0.0)) << "h = " << range << ", r/h = " << fraction;
    }
  }
}

// Both from the left and from the right, where the formula changes; beyond the range all three are zero.
TYPED_TEST(Weights, AreTwiceContinuouslyDifferentiable) {
  for (const double range : ranges) {
    const TypeParam kernel(range);
    const double half = 0.5 * range;
    const double d = 1e-7 * range;
    const auto first = [&](double r) { return -r * kernel.slope(r); };
    const double largest_first = range * kernel.slope(0.0);
    EXPECT_NEAR(kernel.weight(half - d), kernel.weight(half + d), 1e-6 * kernel.weight_at_zero());
    EXPECT_NEAR(first(half - d), first(half + d), 1e-6 * largest_first);
    const double left = (first(half) - first(half - d)) / d;
    const double right = (first(half + d) - first(half)) / d;
    EXPECT_NEAR(left, right, 1e-5 * kernel.slope(0.0));

    const double close = range * (1.0 - 1e-6);
    EXPECT_LT(kernel.weight(close), 1e-16 * kernel.weight_at_zero());
    EXPECT_LT(kernel.slope(close), 2e-11 * kernel.slope(0.0));
    EXPECT_LT(std::abs(first(close)) / (range - close), 2e-5 * kernel.slope(0.0));
  }
}

TYPED_TEST(Weights, AreExactlyZeroAtTheRange) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> between(0.1, 10.0);
  for (int i = 0; i < 1000; ++i) {
    const double range = between(generator);
    const TypeParam kernel(range);
    // As the pair loop presents a lane without a partner: the root of the squared range.
    const double distance = std::sqrt(range * range);
    EXPECT_EQ(kernel.weight(range), 0.0);
    EXPECT_EQ(kernel.slope(range), 0.0);
    EXPECT_EQ(kernel.weight(distance), 0.0) << "h = " << range;
    EXPECT_EQ(kernel.slope(distance), 0.0) << "h = " << range;
  }
}

TYPED_TEST(Weights, VectorLanesGiveTheBitsOfDoubles) {
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  std::mt19937_64 generator(2);
  for (const double range : ranges) {
    const TypeParam kernel(range);
    std::uniform_real_distribution<double> inside(0.0, range);
    for (int i = 0; i < 1000; ++i) {
      alignas(64) std::array<double, pairs::lane_count> r;
      for (double& distance : r) distance = inside(generator);
      r[0] = 0.0;
      r[1] = range;
      r[2] = 0.5 * range;
      r[3] = std::nextafter(0.5 * range, 0.0);
      const pairs::Lanes weight = kernel.weight(pairs::load(r.data()));
      const pairs::Lanes slope = kernel.slope(pairs::load(r.data()));
      for (std::size_t lane = 0; lane < r.size(); ++lane) {
        EXPECT_EQ(bits(weight[lane]), bits(kernel.weight(r[lane]))) << "r = " << r[lane] << ", h = " << range;
        EXPECT_EQ(bits(slope[lane]), bits(kernel.slope(r[lane]))) << "r = " << r[lane] << ", h = " << range;
      }
    }
  }
}

TYPED_TEST(Weights, RefuseARangeThatIsNotPositive) {
  EXPECT_THROW(TypeParam(0.0), BadInput);
  EXPECT_THROW(TypeParam(-3.0), BadInput);
  EXPECT_THROW(TypeParam(std::numeric_limits<double>::quiet_NaN()), BadInput);
}

TEST(WeightByName, IsTheOneThatWasAskedFor) {
  EXPECT_TRUE(std::holds_alternative<Lucy<2>>(make_weight<2>(WeightName::lucy, 3.0)));
  EXPECT_TRUE(std::holds_alternative<Monaghan<2>>(make_weight<2>(WeightName::monaghan, 3.0)));
  for (const auto& [name, which] : weight_names) EXPECT_EQ(range_of<3>(make_weight<3>(which, 2.5)), 2.5) << name;
  EXPECT_THROW(make_weight<1>(WeightName::monaghan, 0.0), BadInput);
}

}  // namespace
}  // namespace lucy::kernel
