// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/space/box.hpp"

#include <gtest/gtest.h>

#include <random>

namespace lucy::space {
namespace {

TEST(Box, ImagesAboveSlideForwardAtThePositiveRate) {
  const Box<2> box({10.0, 8.0}, 0.5, 3.0);
  const auto above = box.image({0, 1}, 2.0);
  EXPECT_DOUBLE_EQ(above.position[0], 3.0 + 0.5 * 8.0 * 2.0);
  EXPECT_DOUBLE_EQ(above.position[1], 8.0);
  EXPECT_DOUBLE_EQ(above.velocity[0], 4.0);
  EXPECT_DOUBLE_EQ(above.velocity[1], 0.0);
}

TEST(Box, StreamingVelocityIsTheRateOfTheDisplacement) {
  for (double rate : {0.7, -0.3}) {
    const Box<3> box({10.0, 8.0, 9.0}, rate, 1.0);
    for (int n_y : {-2, -1, 0, 1, 2}) {
      const auto early = box.image({1, n_y, 1}, 0.4);
      const auto late = box.image({1, n_y, 1}, 0.4 + 1e-3);
      for (int d = 0; d < 3; ++d) {
        EXPECT_NEAR((late.position[d] - early.position[d]) / 1e-3, early.velocity[d], 1e-9);
      }
    }
  }
}

TEST(Box, OppositeImagesHaveOppositeShifts) {
  const Box<2> box({10.0, 8.0}, -0.4, 6.5);
  for (int n_x : {-1, 0, 2}) {
    const auto there = box.image({n_x, 1}, 0.3);
    const auto back = box.image({-n_x, -1}, 0.3);
    for (int d = 0; d < 2; ++d) {
      EXPECT_DOUBLE_EQ(there.position[d], -back.position[d]);
      EXPECT_DOUBLE_EQ(there.velocity[d], -back.velocity[d]);
    }
  }
}

TEST(Box, WrappingMovesByAnImageShift) {
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> anywhere(-40.0, 40.0);
  for (double offset : {0.0, 2.5, -7.75}) {
    const Box<2> box({10.0, 8.0}, 0.2, offset);
    for (int trial = 0; trial < 500; ++trial) {
      const Vector<2> start{anywhere(generator), anywhere(generator)};
      Vector<2> wrapped = start;
      box.wrap(wrapped);
      ASSERT_GE(wrapped[0], 0.0);
      ASSERT_LT(wrapped[0], 10.0);
      ASSERT_GE(wrapped[1], 0.0);
      ASSERT_LT(wrapped[1], 8.0);
      const int n_y = static_cast<int>(std::lround((start[1] - wrapped[1]) / 8.0));
      const auto row = box.image({0, n_y}, 0.0);
      const double n_x = (start[0] - wrapped[0] - row.position[0]) / 10.0;
      ASSERT_NEAR(n_x, std::round(n_x), 1e-12);
      ASSERT_NEAR(start[1] - wrapped[1], row.position[1], 1e-12);
    }
  }
}

TEST(Box, WrappingAJustNegativeCoordinateStaysBelowTheLength) {
  const Box<2> box({10.0, 8.0});
  Vector<2> position{-1e-18, -1e-18};
  box.wrap(position);
  EXPECT_LT(position[0], 10.0);
  EXPECT_LT(position[1], 8.0);
  EXPECT_GE(position[0], 0.0);
  EXPECT_GE(position[1], 0.0);

  // It stays where it was, whatever the offset of the image that it might have come from.
  const Box<2> sheared({10.0, 8.0}, 0.2, 2.5);
  position = {5.0, -1e-18};
  sheared.wrap(position);
  EXPECT_EQ(position, (Vector<2>{5.0, 0.0}));
}

TEST(Box, AdvancingFoldsTheOffsetAndKeepsTheLatticeOfImages) {
  Box<2> box({10.0, 8.0}, -0.3, 1.0);
  const auto before = box.image({0, 1}, 12.0);
  box.advance(12.0);
  EXPECT_GE(box.offset(), 0.0);
  EXPECT_LT(box.offset(), 10.0);
  const double columns = (before.position[0] - box.image({0, 1}, 0.0).position[0]) / 10.0;
  EXPECT_NEAR(columns, std::round(columns), 1e-12);
}

TEST(Box, AtZeroRateItIsPeriodic) {
  const Box<2> box({10.0, 8.0});
  const auto shift = box.image({-1, 2}, 100.0);
  EXPECT_EQ(shift.position, (Vector<2>{-10.0, 16.0}));
  EXPECT_EQ(shift.velocity, (Vector<2>{0.0, 0.0}));
}

}  // namespace
}  // namespace lucy::space
