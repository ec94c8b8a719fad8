// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/motion/start.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lucy/errors.hpp"

namespace lucy::motion {
namespace {

const kernel::Lucy<2> lucy_kernel(3.0);

TEST(Start, KnowsTheEnergyOfTheSquareLattice) { EXPECT_NEAR(lattice_energy(lucy_kernel, 1.0), 0.41305, 5e-6); }

TEST(Start, FindsNearlySquareLattices) {
  EXPECT_EQ(near_square(1024), (std::array<std::int64_t, 2>{32, 32}));
  EXPECT_EQ(near_square(992), (std::array<std::int64_t, 2>{32, 31}));
  EXPECT_EQ(near_square(54), (std::array<std::int64_t, 2>{9, 6}));
  EXPECT_FALSE(near_square(1021));  // a prime
  EXPECT_FALSE(near_square(1000));  // 40 x 25
}

TEST(Start, RefusesParticleNumbersWithoutALatticeAndNamesTheNearest) {
  try {
    lattice_start(lucy_kernel, 1000, 1.0, 1.0, 1);
    FAIL();
  } catch (const BadInput& refusal) {
    const std::string text = refusal.what();
    EXPECT_NE(text.find("system.particles = 1000"), std::string::npos) << text;
    EXPECT_NE(text.find("999 and 1008"), std::string::npos) << text;
  }
}

TEST(Start, RefusesEnergiesAtOrBelowTheLattice) {
  EXPECT_THROW(lattice_start(lucy_kernel, 400, 1.0, 0.413, 1), BadInput);
  EXPECT_THROW(lattice_start(lucy_kernel, 400, 1.0, lattice_energy(lucy_kernel, 1.0), 1), BadInput);
  EXPECT_THROW(lattice_start(lucy_kernel, 400, 1.0, std::nan(""), 1), BadInput);
  EXPECT_NO_THROW(lattice_start(lucy_kernel, 400, 1.0, 0.4131, 1));
}

TEST(Start, SeedsDecideTheStart) {
  const auto a = lattice_start(lucy_kernel, 400, 1.0, 1.0, 1);
  const auto b = lattice_start(lucy_kernel, 400, 1.0, 1.0, 1);
  const auto c = lattice_start(lucy_kernel, 400, 1.0, 1.0, 2);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.momentum, b.momentum);
  EXPECT_NE(a.position, c.position);
  EXPECT_NE(a.momentum, c.momentum);
}

TEST(Start, DensityAndRectanglesAreRight) {
  const auto start = lattice_start(lucy_kernel, 600, 0.5, 1.0, 3);
  EXPECT_NEAR(start.lengths[0] * start.lengths[1], 1200.0, 1e-9);
  EXPECT_NEAR(start.lengths[0] / start.lengths[1], 25.0 / 24.0, 1e-12);
}

}  // namespace
}  // namespace lucy::motion
