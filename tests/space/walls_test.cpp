// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/space/walls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <vector>

namespace lucy::space {
namespace {

constexpr double range = 2.0;

template <int D>
Walls<D> walls_across(const std::vector<int>& axes) {
  Walls<D> walls;
  for (const int axis : axes) walls.across[static_cast<std::size_t>(axis)].emplace();
  return walls;
}

const Cell<2> closed({10.0, 8.0}, walls_across<2>({0, 1}), range);
const Cell<2> channel({10.0, 8.0}, walls_across<2>({1}), range);

/// A place in the cell, from its lowest corner.
Vector<2> in_box(const Cell<2>& cell, double x, double y) { return {x + cell.corner()[0], y + cell.corner()[1]}; }

TEST(Cell, WithoutWallsIsThePeriodicBox) {
  const Cell<2> cell({10.0, 8.0}, {}, range);
  EXPECT_FALSE(cell.walls().any());
  EXPECT_EQ(cell.corner(), (Vector<2>{0.0, 0.0}));
  EXPECT_EQ(cell.box_lengths(), cell.lengths());
  EXPECT_EQ(cell.most_images(), 0U);
  EXPECT_TRUE(cell.boundary_sites(1.0, range).empty());
  Vector<2> position{-3.0, 11.0};
  Vector<2> velocity{1.0, 2.0};
  EXPECT_EQ(cell.reflect(position, velocity), Crossing::none);
  EXPECT_EQ(position, (Vector<2>{-3.0, 11.0}));
}

TEST(Cell, HasRoomBehindWallsOnly) {
  EXPECT_TRUE(channel.walls().any());
  EXPECT_EQ(channel.corner()[0], 0.0);
  EXPECT_EQ(channel.box_lengths()[0], 10.0);
  // Images behind opposite walls are farther apart through the periodic box than anybody sees.
  EXPECT_GE(channel.box_lengths()[1] - 8.0 - 2.0 * 1.25 * range, range);
  EXPECT_GE(closed.box_lengths()[0] - 10.0 - 2.0 * 1.25 * range, range);
  EXPECT_DOUBLE_EQ(2.0 * channel.corner()[1], channel.box_lengths()[1] - 8.0);
}

TEST(Cell, ReflectsAParticleThatCrossedEitherWall) {
  for (const auto& [y, reflected] : {std::pair{-0.25, 0.25}, std::pair{8.5, 7.5}}) {
    Vector<2> position = in_box(channel, 3.0, y);
    Vector<2> velocity{0.7, -1.3};
    EXPECT_EQ(channel.reflect(position, velocity), Crossing::reflected);
    EXPECT_DOUBLE_EQ(position[0], channel.corner()[0] + 3.0);
    EXPECT_DOUBLE_EQ(position[1], channel.corner()[1] + reflected);
    EXPECT_EQ(velocity, (Vector<2>{0.7, 1.3}));
  }
}

TEST(Cell, ReflectsInACornerAtBothWalls) {
  Vector<2> position = in_box(closed, -0.5, 8.25);
  Vector<2> velocity{-1.0, 2.0};
  EXPECT_EQ(closed.reflect(position, velocity), Crossing::reflected);
  EXPECT_DOUBLE_EQ(position[0], closed.corner()[0] + 0.5);
  EXPECT_DOUBLE_EQ(position[1], closed.corner()[1] + 7.75);
  EXPECT_EQ(velocity, (Vector<2>{1.0, -2.0}));
}

TEST(Cell, LeavesAloneWhoIsInsideOrOnAWall) {
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, std::pair{10.0, 8.0}, std::pair{4.0, 3.0}}) {
    const Vector<2> place = in_box(closed, x, y);
    Vector<2> position = place;
    Vector<2> velocity{-1.0, 2.0};
    EXPECT_EQ(closed.reflect(position, velocity), Crossing::none);
    EXPECT_EQ(position, place);
    EXPECT_EQ(velocity, (Vector<2>{-1.0, 2.0}));
  }
}

TEST(Cell, DoesNotReflectAcrossAPeriodicAxis) {
  Vector<2> position = in_box(channel, -4.0, 3.0);
  Vector<2> velocity{-1.0, 0.0};
  EXPECT_EQ(channel.reflect(position, velocity), Crossing::none);
  EXPECT_EQ(position[0], -4.0);
  EXPECT_EQ(velocity[0], -1.0);
}

TEST(Cell, HasLostWhoIsFartherBehindAWallThanItIsWideOrNowhere) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double y : {-8.01, 16.01, nan, infinity, -infinity}) {
    Vector<2> position = in_box(channel, 3.0, y);
    Vector<2> velocity{};
    EXPECT_EQ(channel.reflect(position, velocity), Crossing::lost) << y;
  }
  for (const double y : {-7.99, 15.99}) {
    Vector<2> position = in_box(channel, 3.0, y);
    Vector<2> velocity{};
    EXPECT_EQ(channel.reflect(position, velocity), Crossing::reflected) << y;
  }
  Vector<2> position = in_box(closed, -1.0, nan);
  Vector<2> velocity{};
  EXPECT_EQ(closed.reflect(position, velocity), Crossing::lost);
}

TEST(Cell, MirrorsPlacesAndTurnsVelocitiesAcrossTheWallsOnly) {
  const Vector<2> place = in_box(closed, 1.0, 7.5);
  const auto expect_at = [&](const Behind<2>& behind, double x, double y, const Vector<2>& turned) {
    const Vector<2> image = closed.mirrored(behind, place);
    EXPECT_DOUBLE_EQ(image[0] - closed.corner()[0], x);
    EXPECT_DOUBLE_EQ(image[1] - closed.corner()[1], y);
    EXPECT_EQ(Cell<2>::turned(behind, {0.3, 0.4}), turned);
  };
  expect_at({0, 0}, 1.0, 7.5, {0.3, 0.4});
  expect_at({-1, 0}, -1.0, 7.5, {-0.3, 0.4});
  expect_at({1, 0}, 19.0, 7.5, {-0.3, 0.4});
  expect_at({0, -1}, 1.0, -7.5, {0.3, -0.4});
  expect_at({0, 1}, 1.0, 8.5, {0.3, -0.4});
  expect_at({-1, 1}, -1.0, 8.5, {-0.3, -0.4});
}

template <int D>
std::set<Behind<D>> images_of(const Cell<D>& cell, const Vector<D>& position, double reach) {
  std::set<Behind<D>> images;
  int found = 0;
  cell.for_images(position, reach, [&](const Behind<D>& behind) {
    images.insert(behind);
    ++found;
  });
  EXPECT_EQ(images.size(), static_cast<std::size_t>(found)) << "an image was found twice";
  return images;
}

TEST(Cell, HasImagesOfThoseNearWallsAndThreeInACorner) {
  using Images = std::set<Behind<2>>;
  EXPECT_EQ(images_of<2>(closed, in_box(closed, 5.0, 4.0), 2.5), Images{});
  EXPECT_EQ(images_of<2>(closed, in_box(closed, 2.4, 4.0), 2.5), (Images{{-1, 0}}));
  EXPECT_EQ(images_of<2>(closed, in_box(closed, 2.6, 4.0), 2.5), Images{});
  EXPECT_EQ(images_of<2>(closed, in_box(closed, 7.6, 4.0), 2.5), (Images{{1, 0}}));
  EXPECT_EQ(images_of<2>(closed, in_box(closed, 5.0, 2.4), 2.5), (Images{{0, -1}}));
  EXPECT_EQ(images_of<2>(closed, in_box(closed, 5.0, 5.6), 2.5), (Images{{0, 1}}));
  EXPECT_EQ(images_of<2>(closed, in_box(closed, 1.0, 1.0), 2.5), (Images{{-1, 0}, {0, -1}, {-1, -1}}));
  EXPECT_EQ(images_of<2>(closed, in_box(closed, 9.0, 7.0), 2.5), (Images{{1, 0}, {0, 1}, {1, 1}}));
  EXPECT_EQ(images_of<2>(closed, in_box(closed, 1.0, 7.0), 2.5), (Images{{-1, 0}, {0, 1}, {-1, 1}}));
  EXPECT_EQ(images_of<2>(channel, in_box(channel, 1.0, 1.0), 2.5), (Images{{0, -1}}));
  // Who is on its way through a wall keeps its image.
  EXPECT_EQ(images_of<2>(channel, in_box(channel, 1.0, -0.1), 2.5), (Images{{0, -1}}));
}

TEST(Cell, HasSevenImagesOfThoseInACornerInThreeDimensions) {
  const Cell<3> cell({9.0, 9.0, 9.0}, walls_across<3>({0, 1, 2}), range);
  EXPECT_EQ(cell.most_images(), 7U);
  Vector<3> position;
  for (std::size_t d = 0; d < 3; ++d) position[d] = cell.corner()[d] + (d == 1 ? 8.5 : 0.5);
  EXPECT_EQ(images_of<3>(cell, position, 2.5),
            (std::set<Behind<3>>{{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {-1, 1, 0}, {-1, 0, -1}, {0, 1, -1}, {-1, 1, -1}}));
  EXPECT_EQ(channel.most_images(), 1U);
  EXPECT_EQ(closed.most_images(), 3U);
}

TEST(Cell, NeverHasMoreImagesThanItSays) {
  for (const auto* cell : {&closed, &channel}) {
    std::size_t most = 0;
    for (double x = 0.0; x <= 10.0; x += 0.25)
      for (double y = 0.0; y <= 8.0; y += 0.25)
        most = std::max(most, images_of<2>(*cell, in_box(*cell, x, y), 1.25 * range).size());
    EXPECT_EQ(most, cell->most_images());
  }
}

TEST(Cell, GivesTheDiagonalImageToTheWallAcrossTheLastAxis) {
  EXPECT_EQ(wall_behind<2>({-1, 0}), wall_number(0, false));
  EXPECT_EQ(wall_behind<2>({1, 0}), wall_number(0, true));
  EXPECT_EQ(wall_behind<2>({0, -1}), wall_number(1, false));
  EXPECT_EQ(wall_behind<2>({-1, -1}), wall_number(1, false));
  EXPECT_EQ(wall_behind<2>({1, -1}), wall_number(1, false));
  EXPECT_EQ(wall_behind<2>({-1, 1}), wall_number(1, true));
  EXPECT_EQ(wall_behind<3>({1, 1, -1}), wall_number(2, false));
  EXPECT_EQ(wall_behind<3>({1, -1, 0}), wall_number(1, false));
  EXPECT_EQ(wall_behind<1>({1}), wall_number(0, true));
}

/// From the lowest corner of the cell, in units of `spacing`, half a spacing off.
std::map<std::pair<int, int>, int> wall_by_site(const Cell<2>& cell, double asked, double reach,
                                                const Vector<2>& spacing) {
  std::map<std::pair<int, int>, int> walls;
  for (const auto& site : cell.boundary_sites(asked, reach)) {
    std::array<int, 2> index{};
    for (std::size_t d = 0; d < 2; ++d) {
      const double place = (site.position[d] - cell.corner()[d]) / spacing[d] - 0.5;
      index[d] = static_cast<int>(std::lround(place));
      EXPECT_NEAR(place, index[d], 1e-12);
    }
    EXPECT_TRUE(walls.emplace(std::pair{index[0], index[1]}, site.wall).second)
        << "two boundary particles in one place";
  }
  return walls;
}

TEST(Cell, IsSurroundedByRowsOfBoundaryParticlesThatContinueItsLattice) {
  const auto walls = wall_by_site(closed, 1.0, 3.0, {1.0, 1.0});
  EXPECT_EQ(walls.size(), 16U * 14U - 10U * 8U);
  for (int x = -3; x < 13; ++x) {
    for (int y = -3; y < 11; ++y) {
      const bool inside = x >= 0 && x < 10 && y >= 0 && y < 8;
      ASSERT_EQ(walls.count({x, y}), inside ? 0U : 1U) << x << " " << y;
      if (inside) continue;
      // The corners are the floor's and the ceiling's.
      const int wall = y < 0 ? 2 : y >= 8 ? 3 : x < 0 ? 0 : 1;
      EXPECT_EQ(walls.at({x, y}), wall) << x << " " << y;
    }
  }
}

TEST(Cell, HasRowsOnlyBehindWalls) {
  const auto walls = wall_by_site(channel, 1.0, 3.0, {1.0, 1.0});
  EXPECT_EQ(walls.size(), 2U * 3U * 10U);
  for (const auto& [at, wall] : walls) {
    EXPECT_GE(at.first, 0);
    EXPECT_LT(at.first, 10);
    EXPECT_EQ(wall, at.second < 0 ? 2 : 3);
    EXPECT_TRUE(at.second < 0 ? at.second >= -3 : at.second >= 8 && at.second < 11);
  }
}

TEST(Cell, HasRowsThatReachOverAFractionalRange) {
  EXPECT_EQ(channel.boundary_sites(1.0, 2.5).size(), 2U * 3U * 10U);
  EXPECT_EQ(channel.boundary_sites(1.0, 2.0).size(), 2U * 2U * 10U);
}

TEST(Cell, FitsRowsToASpacingThatDoesNotDivideIt) {
  // 10/1.3 and 8/1.3 round to 8 and 6.
  const auto walls = wall_by_site(closed, 1.3, 3.0, {1.25, 8.0 / 6.0});
  EXPECT_EQ(walls.size(), (8U + 2U * 3U) * (6U + 2U * 3U) - 8U * 6U);
  for (const auto& site : closed.boundary_sites(1.3, 3.0)) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t d = 0; d < 2; ++d) {
      const double depth = site.position[d] - closed.corner()[d];
      if (depth < 0.0) nearest = std::min(nearest, -depth);
      if (depth > closed.lengths()[d]) nearest = std::min(nearest, depth - closed.lengths()[d]);
    }
    EXPECT_GE(nearest, 0.5 * 1.25 - 1e-12);  // half a spacing behind the wall
    EXPECT_LT(nearest, 3.0 + 0.5 * 8.0 / 6.0);
  }
  // Wider than the cell: one particle across it.
  EXPECT_EQ(channel.boundary_sites(30.0, 3.0).size(), 2U);
}

TEST(Cell, KnowsTheTemperatureAlongItsWalls) {
  Walls<2> walls = walls_across<2>({0, 1});
  for (auto& side : *walls.across[0]) side = {{}, 1.5, {0.0, -0.125}};
  (*walls.across[1])[0].temperature = 1.5;
  (*walls.across[1])[1].temperature = 0.5;
  const Cell<2> cell({10.0, 8.0}, walls, range);
  for (const bool high : {false, true}) {
    EXPECT_DOUBLE_EQ(cell.temperature(wall_number(0, high), in_box(cell, high ? 10.5 : -0.5, 0.0)), 1.5);
    EXPECT_DOUBLE_EQ(cell.temperature(wall_number(0, high), in_box(cell, high ? 10.5 : -0.5, 6.0)), 0.75);
    EXPECT_DOUBLE_EQ(cell.temperature(wall_number(0, high), in_box(cell, high ? 12.0 : -2.0, 8.0)), 0.5);
  }
  EXPECT_EQ(cell.temperature(wall_number(1, false), in_box(cell, -1.0, -1.0)), 1.5);
  EXPECT_EQ(cell.temperature(wall_number(1, true), in_box(cell, 3.0, 9.0)), 0.5);
}

}  // namespace
}  // namespace lucy::space
