// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What fluids do between walls in the course of time: conduct, shear, keep their particles and their energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "walled_fluid.hpp"

namespace lucy::motion {
namespace {

using namespace testing;

TEST(FluidBetweenWalls, KeepsEveryParticleInTheCellThroughLongHotRuns) {
  for (const auto kind : kinds) {
    for (const bool sides : {false, true}) {
      spam::Fluid<2> fluid = gas<2>({.viscosity = 0.3, .bulk_viscosity = 0.0, .conductivity = 0.3});
      fluid.gravity = {0.0, -0.5};
      const space::Vector<2> lengths{12.0, 10.0};
      auto trajectory =
          flow<2>(fluid, noisy_lattice<2>(lengths, heated(kind, sides, 10.0, 10.0, 5.0), 21, 0.4, 2.0, 8.0, 1.0));
      run(trajectory, 60.0, 0.05);
      const auto position = trajectory.positions();
      for (std::size_t i = 0; i < position.size(); ++i) {
        ASSERT_GE(position[i], 0.0);
        ASSERT_LE(position[i], lengths[i % 2]);
      }
      EXPECT_GT(trajectory.reflections(), 50);
      EXPECT_LT(std::abs(trajectory.energy_drift()), 1e-3);
      const auto temperature = trajectory.temperatures();
      EXPECT_NEAR(sum(temperature) / 120.0, 7.5, 2.5);
    }
  }
}

// Reflections happen at the end of a step; between them the drift is that of RK4.
TEST(FluidBetweenWalls, EnergyDriftShrinksWithTheStep) {
  for (const auto kind : kinds) {
    for (const bool sides : {false, true}) {
      spam::Fluid<2> fluid = gas<2>();
      fluid.gravity = {0.0, -0.1};
      const auto largest_drift = [&](double dt) {
        auto trajectory = flow<2>(fluid, noisy_lattice<2>({10.0, 10.0}, heated(kind, sides, 10.0), 22, 0.1, 0.3));
        double result = 0.0;
        while (trajectory.time() < 6.4 - 0.5 * dt) {
          trajectory.advance(dt);
          result = std::max(result, std::abs(trajectory.energy_drift()));
        }
        return result;
      };
      const double coarse = largest_drift(0.1);
      const double fine = largest_drift(0.025);
      EXPECT_LT(coarse, 1e-5);
      EXPECT_LT(fine, 0.1 * coarse) << coarse << " and " << fine;
    }
  }
}

/// Slope of a quantity against height, over the middle six tenths.
class MiddleSlope {
 public:
  explicit MiddleSlope(double height) : height_(height) {}
  void add(double y, double value) {
    const double from_middle = y - 0.5 * height_;
    if (std::abs(from_middle) > 0.3 * height_) return;
    square_ += from_middle * from_middle;
    product_ += from_middle * value;
  }
  double slope() const { return product_ / square_; }

 private:
  double height_;
  double square_ = 0.0;
  double product_ = 0.0;
};

// Particles see the walls over their range, so that the temperature jumps there: the cell conducts as if it were longer
// at either end by 1.0 with mirror images and 1.75 with boundary particles, for a range of 3, whatever its height. Six
// runs scatter by 0.07.
TEST(FluidBetweenWallsLong, ConductsTheHeatOfALinearProfile) {
  constexpr double width = 8.0;
  constexpr double kappa = 2.0;
  constexpr double difference = 0.2;
  constexpr double time = 100.0;
  for (const auto kind : kinds) {
    for (const double height : {12.0, 24.0}) {
      auto start = noisy_lattice<2>({width, height}, heated(kind, false, height, 1.1, 0.9), 31, 0.02, 0.0, 1.0, 0.0);
      for (std::size_t i = 0; i < start.energy.size(); ++i)
        start.energy[i] = 1.1 - difference * start.position[i][1] / height;
      auto trajectory = flow<2>(gas<2>({.viscosity = 2.0, .bulk_viscosity = 2.0, .conductivity = kappa}, 3.0), start);
      run(trajectory, time, 0.1);
      const auto before = trajectory.given_by_walls();
      MiddleSlope middle(height);
      while (trajectory.time() < 2.0 * time - 0.05) {
        trajectory.advance(0.1);
        const auto position = trajectory.positions();
        const auto temperature = trajectory.temperatures();
        for (std::size_t i = 0; i < temperature.size(); ++i) middle.add(position[2 * i + 1], temperature[i] - 1.0);
      }
      const double ideal = kappa * difference / height * width;
      std::array<double, 2> heat{};
      for (std::size_t wall = 0; wall < 2; ++wall)
        heat[wall] = (trajectory.given_by_walls()[2 + wall].conduction - before[2 + wall].conduction) / time / ideal;
      EXPECT_NEAR(heat[0], -heat[1], 0.04);
      EXPECT_NEAR(heat[0] - heat[1], -2.0 * middle.slope() * height / difference, 0.1);
      const double longer = 0.5 * height * (2.0 / (heat[0] - heat[1]) - 1.0);
      EXPECT_NEAR(longer, kind == WallKind::mirror_images ? 1.0 : 1.75, 0.35);
    }
  }
}

// Here, too, the fluid slips: six runs with mirror images have 0.88 of the gradient between walls that are L apart and
// 0.92 of the work, with boundary particles 0.86 and 0.89; they scatter by 0.01 and 0.015.
TEST(FluidBetweenWallsLong, ShearsAsNewtonSaysBetweenWallsThatMove) {
  constexpr double width = 8.0;
  constexpr double height = 24.0;
  constexpr double u = 0.2;
  constexpr double eta = 1.0;
  constexpr double time = 100.0;
  for (const auto kind : kinds) {
    auto walls = walls_across<2>(kind, {1});
    (*walls.across[1])[0].velocity = {-u, 0.0};
    (*walls.across[1])[1].velocity = {u, 0.0};
    auto start = noisy_lattice<2>({width, height}, walls, 31, 0.02, 0.0, 1.0, 0.0);
    for (std::size_t i = 0; i < start.position.size(); ++i)
      start.velocity[i][0] = u * (2.0 * start.position[i][1] / height - 1.0);
    auto trajectory = flow<2>(gas<2>({.viscosity = eta, .bulk_viscosity = 1.0, .conductivity = 2.0}, 3.0), start);
    run(trajectory, time, 0.1);
    const auto before = trajectory.given_by_walls();
    const double energy = trajectory.energy();
    MiddleSlope middle(height);
    while (trajectory.time() < 2.0 * time - 0.05) {
      trajectory.advance(0.1);
      const auto position = trajectory.positions();
      const auto velocity = trajectory.velocities();
      for (std::size_t i = 0; i < position.size(); i += 2) middle.add(position[i + 1], velocity[i]);
    }
    const double ideal = 2.0 * u * width * eta * 2.0 * u / height;
    double work = 0.0;
    double heat = 0.0;
    for (std::size_t wall = 2; wall < 4; ++wall) {
      work += (trajectory.given_by_walls()[wall].work - before[wall].work) / time / ideal;
      heat += (trajectory.given_by_walls()[wall].conduction - before[wall].conduction) / time / ideal;
    }
    EXPECT_NEAR(work + heat, (trajectory.energy() - energy) / time / ideal, 0.01);
    EXPECT_NEAR(heat, -work, 0.15);
    EXPECT_NEAR(middle.slope() * height / (2.0 * u), kind == WallKind::mirror_images ? 0.88 : 0.86, 0.05);
    EXPECT_NEAR(work, kind == WallKind::mirror_images ? 0.92 : 0.89, 0.07);
  }
}

// The rule that sums up what walls give errs by the square of the step.
TEST(FluidBetweenWalls, GainsTheEnergyThatWallsGive) {
  for (const auto kind : kinds) {
    auto walls = heated(kind, false, 10.0);
    (*walls.across[1])[1].velocity = {0.3, 0.0};
    const auto imbalance = [&](double dt) {
      auto trajectory = flow<2>(gas<2>(), noisy_lattice<2>({10.0, 10.0}, walls, 33, 0.2, 0.5));
      const double before = trajectory.energy();
      run(trajectory, 4.0, dt);
      EXPECT_GT(trajectory.reflections(), 3);
      double given = 0.0;
      for (const auto& wall : trajectory.given_by_walls()) given += wall.conduction + wall.work;
      EXPECT_GT(std::abs(given), 1.0);
      return given - (trajectory.energy() - before);
    };
    const double coarse = std::abs(imbalance(0.1));
    const double fine = std::abs(imbalance(0.02));
    EXPECT_LT(coarse, 0.1);
    EXPECT_LT(fine, 0.15 * coarse) << coarse << " and " << fine;
  }
}

}  // namespace
}  // namespace lucy::motion
