// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/kernel/lucy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace lucy::kernel {
namespace {

// Integral of w over all space by Simpson's rule in r, with the surface of the unit sphere.
template <int D>
double integral(const Lucy<D>& kernel) {
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

template <int D>
void expect_smooth(double range) {
  const Lucy<D> kernel(range);
  constexpr double d = 1e-5;
  for (double fraction : {0.05, 0.3, 0.5, 0.77, 0.95}) {
    const double r = fraction * range;
    const double slope = -(kernel.weight(r + d) - kernel.weight(r - d)) / (2.0 * d) / r;
    EXPECT_NEAR(kernel.slope(r), slope, 1e-8 * kernel.slope(0.0)) << "r/h = " << fraction;
  }
  // w, w' and w'' vanish at the range, so that all three are continuous there.
  EXPECT_EQ(kernel.weight(range), 0.0);
  EXPECT_EQ(kernel.slope(range), 0.0);
  const double close = range * (1.0 - 1e-6);
  EXPECT_LT(kernel.slope(close), 2e-12 * kernel.slope(0.0));
  EXPECT_LT(kernel.weight(close), 1e-17 * kernel.weight_at_zero() + 1e-17);
}

TEST(Lucy, IsNormalisedInOneTwoAndThreeDimensions) {
  for (double range : {1.0, 3.0, 6.0}) {
    EXPECT_NEAR(integral(Lucy<1>(range)), 1.0, 1e-10);
    EXPECT_NEAR(integral(Lucy<2>(range)), 1.0, 1e-10);
    EXPECT_NEAR(integral(Lucy<3>(range)), 1.0, 1e-10);
  }
}

TEST(Lucy, SlopeIsMinusTheDerivativeOverTheDistanceAndAllIsSmoothAtTheRange) {
  expect_smooth<1>(2.0);
  expect_smooth<2>(3.0);
  expect_smooth<3>(1.5);
}

TEST(Lucy, HasTheValuesOfItsDefinition) {
  const Lucy<2> kernel(3.0);
  EXPECT_NEAR(kernel.weight_at_zero(), 5.0 / (9.0 * std::numbers::pi), 1e-16);
  EXPECT_NEAR(kernel.weight_at_zero(), 0.1768388, 5e-8);
  const double x = 0.4;
  EXPECT_NEAR(kernel.weight(1.2), kernel.weight_at_zero() * (1.0 + 3.0 * x) * std::pow(1.0 - x, 3), 1e-16);
}

// Hoover and Hoover, "SPAM-based recipes for continuum simulations" (2001), exercise: least and greatest density of a
// lattice of unit spacing over all positions.
std::array<double, 2> chain_density(double range) {
  const Lucy<1> kernel(range);
  std::array<double, 2> extremes{10.0, 0.0};
  for (int i = 0; i <= 2000; ++i) {
    double density = 0.0;
    for (int site = -8; site <= 8; ++site) {
      const double r = std::abs(site - 0.5 * i / 2000.0);
      if (r < range) density += kernel.weight(r);
    }
    extremes = {std::min(extremes[0], density), std::max(extremes[1], density)};
  }
  return extremes;
}

std::array<double, 2> square_lattice_density(double range) {
  const Lucy<2> kernel(range);
  std::array<double, 2> extremes{10.0, 0.0};
  constexpr int cuts = 120;
  for (int i = 0; i <= cuts; ++i) {
    for (int j = 0; j <= i; ++j) {
      double density = 0.0;
      for (int a = -8; a <= 8; ++a) {
        for (int b = -8; b <= 8; ++b) {
          const double r = std::hypot(a - 0.5 * i / cuts, b - 0.5 * j / cuts);
          if (r < range) density += kernel.weight(r);
        }
      }
      extremes = {std::min(extremes[0], density), std::max(extremes[1], density)};
    }
  }
  return extremes;
}

TEST(Lucy, GivesTheTabulatedDensitiesOfRegularLattices) {
  struct Row {
    double range, least, greatest;
  };
  for (const Row& row : {Row{1.5, .987654, 1.018519},
                         {2, .986328, 1.015625},
                         {3, .997299, 1.003086},
                         {4, .999146, 1.000977},
                         {5, .999650, 1.000400},
                         {6, .999831, 1.000193}}) {
    const auto density = chain_density(row.range);
    EXPECT_NEAR(density[0], row.least, 1.5e-6) << "1D, h = " << row.range;
    EXPECT_NEAR(density[1], row.greatest, 1.5e-6) << "1D, h = " << row.range;
  }
  for (const Row& row : {Row{1.5, .989534, 1.023762},
                         {2, .984568, 1.020067},
                         {3, .998033, 1.002930},
                         {4, .999366, 1.000633},
                         {5, .999835, 1.000277},
                         {6, .999914, 1.000090}}) {
    const auto density = square_lattice_density(row.range);
    EXPECT_NEAR(density[0], row.least, 3e-6) << "2D, h = " << row.range;
    EXPECT_NEAR(density[1], row.greatest, 3e-6) << "2D, h = " << row.range;
  }
}

TEST(Lucy, RefusesARangeThatIsNotPositive) {
  EXPECT_THROW(Lucy<2>(0.0), BadInput);
  EXPECT_THROW(Lucy<2>(-3.0), BadInput);
  EXPECT_THROW(Lucy<2>(std::numeric_limits<double>::quiet_NaN()), BadInput);
}

}  // namespace
}  // namespace lucy::kernel
