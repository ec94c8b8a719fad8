// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/measure/kinetic.hpp"

#include <gtest/gtest.h>

#include <random>

#include "lucy/space/columns.hpp"

namespace lucy::measure {
namespace {

TEST(KineticSums, EqualPlainSumsAndDoNotDependOnTheTeam) {
  constexpr std::size_t slots = 20000;
  space::Columns columns(4, slots);
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  double power = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < slots; ++i) {
    for (int c = 0; c < 4; ++c) columns[c][i] = normal(generator);
    xx += columns[0][i] * columns[0][i];
    xy += columns[0][i] * columns[1][i];
    yy += columns[1][i] * columns[1][i];
    power += columns[0][i] * columns[2][i] + columns[1][i] * columns[3][i];
    largest = std::max(largest, columns[0][i] * columns[0][i] + columns[1][i] * columns[1][i]);
  }
  const auto sums = kinetic_sums<2>({columns[0], columns[1]}, {columns[2], columns[3]}, slots, Team(1));
  EXPECT_NEAR(sums.momentum_flux(0, 0), xx, 1e-8);
  EXPECT_NEAR(sums.momentum_flux(0, 1), xy, 1e-8);
  EXPECT_NEAR(sums.momentum_flux(1, 0), xy, 1e-8);
  EXPECT_NEAR(sums.momentum_flux(1, 1), yy, 1e-8);
  EXPECT_NEAR(sums.force_power, power, 1e-8);
  EXPECT_DOUBLE_EQ(sums.largest_square, largest);
  EXPECT_DOUBLE_EQ(sums.kinetic_energy(), 0.5 * (sums.momentum_flux(0, 0) + sums.momentum_flux(1, 1)));
  EXPECT_DOUBLE_EQ(largest_square<2>({columns[0], columns[1]}, slots), largest);

  const auto threaded = kinetic_sums<2>({columns[0], columns[1]}, {columns[2], columns[3]}, slots, Team(3));
  EXPECT_EQ(sums.momentum_flux, threaded.momentum_flux);
  EXPECT_EQ(sums.force_power, threaded.force_power);
}

}  // namespace
}  // namespace lucy::measure
