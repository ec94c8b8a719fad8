// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/grid/flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "lucy/errors.hpp"

namespace lucy::grid {
namespace {

Settings settings_of(int cells, Sides sides = Sides::periodic) {
  Settings settings;
  settings.height = 10.0;
  settings.width = sides == Sides::periodic ? 20.0 : 10.0;
  settings.cells_y = cells;
  settings.cells_x = sides == Sides::periodic ? 2 * cells : cells;
  settings.sides = sides;
  settings.viscosity = 0.15;
  settings.conductivity = 0.15;
  settings.gravity = 0.1;
  return settings;
}

Flow rolling(const Settings& settings, double time, double step) {
  Flow flow(settings);
  flow.set_rolls(0.1);
  for (int n = 0; n < std::lround(time / step); ++n) flow.advance(step);
  return flow;
}

double energy(const Flow& flow) {
  // Ideal gas: internal energy in the cells, density times the mean of e at their corners; then that of the flow and
  // of the height.
  const auto fields = flow.fields();
  const auto densities = flow.cell_densities();
  const std::size_t row = fields.x.size();
  const double dx = fields.x[1] - fields.x[0];
  const double dy = fields.y[1] - fields.y[0];
  double sum = 0.0;
  for (std::size_t j = 0; j + 1 < fields.y.size(); ++j)
    for (std::size_t i = 0; i + 1 < row; ++i) {
      const auto mean = [&](const auto& of) {
        const std::size_t n = j * row + i;
        return 0.25 * (of(n) + of(n + 1) + of(n + row) + of(n + row + 1));
      };
      const double inner = mean([&](std::size_t n) { return fields.temperature[n]; });
      const double moving = mean(
          [&](std::size_t n) { return 0.5 * (std::pow(fields.velocity_x[n], 2) + std::pow(fields.velocity_y[n], 2)); });
      const double height = 0.5 * (fields.y[j] + fields.y[j + 1]);
      sum += densities[j * (row - 1) + i] * (inner + moving + flow.settings().gravity * height) * dx * dy;
    }
  return sum;
}

TEST(Flow, AtRestStaysAtRest) {
  for (const Sides sides : {Sides::periodic, Sides::walls})
    for (const Transport transport : {Transport::dynamic, Transport::kinematic}) {
      Settings settings = settings_of(8, sides);
      settings.transport = transport;
      Flow flow(settings);
      for (int n = 0; n < 200; ++n) flow.advance(0.3);
      EXPECT_LT(flow.largest_speed(), 1e-13);
      const auto fields = flow.fields();
      for (std::size_t n = 0; n < fields.temperature.size(); ++n) {
        EXPECT_NEAR(fields.temperature[n], 1.0 - 0.1 * fields.y[n / fields.x.size()], 1e-13);
        EXPECT_NEAR(fields.density[n], 1.0, 1e-12);
      }
      EXPECT_NEAR(flow.nusselt().hot, 1.0, 1e-11);
      EXPECT_NEAR(flow.nusselt().cold, 1.0, 1e-11);
      EXPECT_NEAR(flow.nusselt().sides, 0.0, 1e-11);
    }
}

TEST(Flow, OfAVanDerWaalsFluidRestsUnderItsOwnGravity) {
  Settings settings = settings_of(8, Sides::walls);
  settings.state = spam::VanDerWaals();
  settings.gravity = 0.2;
  Flow flow(settings);
  for (int n = 0; n < 200; ++n) flow.advance(0.2);
  EXPECT_LT(flow.largest_speed(), 1e-12);
}

TEST(Flow, ConservesMassToRounding) {
  for (const Sides sides : {Sides::periodic, Sides::walls}) {
    const Flow flow = rolling(settings_of(12, sides), 60.0, 0.2);
    EXPECT_GT(flow.largest_speed(), 0.01);
    EXPECT_NEAR(flow.mass() / (flow.settings().width * flow.settings().height), 1.0, 1e-13);
  }
}

/// What comes in by floor and sides and does not leave by the ceiling heats the fluid, up to an error that falls with
/// the square of the spacing.
TEST(Flow, BalancesItsEnergyBetterOnFinerMeshes) {
  for (const Sides sides : {Sides::periodic, Sides::walls}) {
    const auto imbalance = [&](int cells) {
      const Settings settings = settings_of(cells, sides);
      const double unit = settings.conductivity * (settings.hot - settings.cold) * settings.width / settings.height;
      const double step = 0.05;
      Flow flow = rolling(settings, 20.0, step);
      const double before = energy(flow);
      double heat = 0.0;
      for (int n = 0; n < 400; ++n) {
        const auto first = flow.nusselt();
        flow.advance(step);
        const auto last = flow.nusselt();
        const auto net = [](const Flow::Nusselt& n_) { return n_.hot + n_.sides - n_.cold; };
        heat += 0.5 * step * unit * (net(first) + net(last));
      }
      return (energy(flow) - before - heat) / (400 * step * unit);
    };
    const double coarse = imbalance(12);
    const double fine = imbalance(24);
    EXPECT_LT(std::abs(coarse), 0.1);
    EXPECT_LT(std::abs(fine), 0.4 * std::abs(coarse));
  }
}

TEST(Flow, ConvergesWithTheSquareOfTheSpacing) {
  const auto kinetic = [](int cells) { return rolling(settings_of(cells), 40.0, 0.05).kinetic_energy(); };
  const double coarse = kinetic(10);
  const double middle = kinetic(20);
  const double fine = kinetic(40);
  EXPECT_NEAR((coarse - middle) / (middle - fine), 4.0, 0.6);
}

TEST(Flow, IsOfFourthOrderInTime) {
  const auto rolls = [](double step) { return rolling(settings_of(8), 8.0, step).roll_amplitude(); };
  const double exact = rolls(0.0125);
  const double long_step = rolls(0.4) - exact;
  const double short_step = rolls(0.2) - exact;
  EXPECT_NEAR(std::log2(long_step / short_step), 4.0, 0.6);
}

TEST(Flow, KnowsTheSpeedOfSound) {
  EXPECT_NEAR(sound_speed(spam::IdealGas(), 1.0, 1.0), std::sqrt(2.0), 1e-6);
  // P = 2 T - 1/2 at density 1: (dP/drho)_e = 4 T - 1 + 1, (dP/de)_rho = 2.
  EXPECT_NEAR(sound_speed(spam::VanDerWaals(), 1.0, 0.5), std::sqrt(4.0 + 2.0 * 1.5), 1e-5);
}

TEST(Flow, EnergiesOfWallsHaveTheTemperatureOfTheWall) {
  for (const spam::EquationOfState& state :
       {spam::EquationOfState(spam::IdealGas()), spam::EquationOfState(spam::VanDerWaals()),
        spam::EquationOfState(spam::DenseFluid())})
    for (const double density : {0.9, 1.0, 1.2})
      for (const double temperature : {0.5, 1.5})
        EXPECT_NEAR(
            std::visit([&](const auto& s) { return s.temperature(density, energy_at(state, density, temperature)); },
                       state),
            temperature, 1e-14);
}

TEST(Flow, IsStableWithTheLongestStepAndNotWithTwice) {
  for (const double viscosity : {0.02, 0.15, 2.0}) {
    Settings settings = settings_of(12);
    settings.viscosity = viscosity;
    settings.conductivity = viscosity;
    settings.cold = settings.hot;
    settings.gravity = 0.0;
    const double longest = longest_step(settings);
    const auto run = [&](double step) {
      Flow flow(settings);
      flow.set_rolls(0.001);
      for (int n = 0; n < 600; ++n) flow.advance(step);
      return flow.largest_speed();
    };
    EXPECT_LT(run(longest), 1e-4);
    EXPECT_THROW(run(2.0 * longest), RunFailed);
  }
}

TEST(Flow, ThatFailsSaysWhenWhereAndWhy) {
  Flow flow(settings_of(12));
  flow.set_rolls(0.1);
  try {
    for (int n = 0; n < 1000; ++n) flow.advance(2.0);
    FAIL() << "a step of 2 is stable";
  } catch (const RunFailed& failure) {
    const std::string message = failure.what();
    for (const char* part : {"at time ", "x = ", "y = ", "must be above 0", "run.step", "grid.cells"})
      EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST(Flow, SavedGoesOnWithTheSameBits) {
  for (const Sides sides : {Sides::periodic, Sides::walls}) {
    Flow flow = rolling(settings_of(8, sides), 4.0, 0.2);
    ArchiveWriter archive;
    flow.save(archive);
    Flow loaded(flow.settings());
    ArchiveReader reader(archive.bytes());
    loaded.load(reader);
    EXPECT_TRUE(reader.exhausted());
    for (int n = 0; n < 20; ++n) {
      flow.advance(0.2);
      loaded.advance(0.2);
    }
    EXPECT_EQ(flow.time(), loaded.time());
    EXPECT_EQ(flow.fields().velocity_y, loaded.fields().velocity_y);
    EXPECT_EQ(flow.fields().temperature, loaded.fields().temperature);
    EXPECT_EQ(flow.cell_densities(), loaded.cell_densities());
    Flow other(settings_of(10, sides));
    ArchiveReader again(archive.bytes());
    EXPECT_THROW(other.load(again), RunFailed);
  }
}

TEST(Flow, StartsWithTheRollsThatAreAskedFor) {
  using std::numbers::pi;
  Flow periodic(settings_of(8));
  periodic.set_rolls(0.2);
  EXPECT_NEAR(periodic.roll_amplitude(), 0.2, 1e-15);
  EXPECT_NEAR(periodic.kinetic_energy(), 0.01, 1e-15);  // A^2/4
  const auto fields = periodic.fields();
  for (std::size_t n = 0; n < fields.density.size(); ++n) {
    const double x = fields.x[n % fields.x.size()];
    const double y = fields.y[n / fields.x.size()];
    EXPECT_NEAR(fields.velocity_x[n], 0.2 * std::sin(pi * x / 10) * std::sin(2 * pi * y / 10), 1e-15);
    EXPECT_NEAR(fields.velocity_y[n], 0.2 * std::cos(pi * x / 10) * std::cos(pi * y / 10), 1e-15);
  }
  Flow walls(settings_of(8, Sides::walls));
  walls.set_rolls(0.2);
  EXPECT_NEAR(walls.roll_amplitude(), 0.2, 1e-15);
  EXPECT_EQ(walls.fields().velocity_x.front(), 0.0);
}

}  // namespace
}  // namespace lucy::grid
