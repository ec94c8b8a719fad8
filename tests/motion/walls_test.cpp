// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fluids between walls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "lucy/errors.hpp"
#include "lucy/motion/fluid_trajectory.hpp"
#include "spam/slow_rates.hpp"
#include "walled_fluid.hpp"

namespace lucy::motion {
namespace {

using namespace testing;

template <int D>
spam::testing::WalledCrowd<D> crowd_of(const FluidTrajectory<D>& trajectory) {
  spam::testing::WalledCrowd<D> crowd;
  crowd.lengths = trajectory.cell().lengths();
  crowd.walls = trajectory.cell().walls();
  crowd.time = trajectory.time();
  crowd.energy = trajectory.energies();
  const auto position = trajectory.positions();
  const auto velocity = trajectory.velocities();
  for (std::size_t i = 0; i < crowd.energy.size(); ++i) {
    std::copy_n(&position[i * D], D, crowd.position.emplace_back().begin());
    std::copy_n(&velocity[i * D], D, crowd.velocity.emplace_back().begin());
  }
  return crowd;
}

/// Densities, gradients, rates and what walls give, against sums over all particles and images.
template <int D>
void expect_slow_rates(const FluidTrajectory<D>& trajectory) {
  const auto slow = spam::testing::slow_rates_between_walls<D>(trajectory.fluid().fluid(), crowd_of(trajectory));
  const auto density = trajectory.densities();
  const auto acceleration = trajectory.accelerations();
  const auto energy_rate = trajectory.energy_rates();
  const auto gradients = trajectory.gradients();
  const double strongest = largest(acceleration);
  const double fastest = largest(energy_rate);
  const double steepest = largest(gradients);
  for (std::size_t i = 0; i < density.size(); ++i) {
    ASSERT_NEAR(density[i], slow.density[i], 1e-12 * slow.density[i]);
    ASSERT_NEAR(energy_rate[i], slow.energy_rate[i], 1e-12 * (0.01 + fastest)) << "particle " << i;
    for (int d = 0; d < D; ++d)
      ASSERT_NEAR(acceleration[i * D + static_cast<std::size_t>(d)], slow.acceleration[i][d],
                  1e-12 * (0.01 + strongest))
          << "particle " << i;
    if (gradients.empty()) continue;
    const double* const of_particle = &gradients[i * (D * D + D)];
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < D; ++b)
        ASSERT_NEAR(of_particle[a * D + b], slow.velocity_gradient[i](a, b), 1e-12 * steepest);
      ASSERT_NEAR(of_particle[D * D + a], slow.temperature_gradient[i][a], 1e-12 * steepest);
    }
  }
  const auto exchange = trajectory.power_of_walls();
  double most = 0.0;
  for (const auto& wall : slow.exchange) most = std::max({most, std::abs(wall.conduction), std::abs(wall.work)});
  for (std::size_t wall = 0; wall < exchange.size(); ++wall) {
    ASSERT_NEAR(exchange[wall].conduction, slow.exchange[wall].conduction, 1e-12 * (0.01 + most)) << "wall " << wall;
    ASSERT_NEAR(exchange[wall].work, slow.exchange[wall].work, 1e-12 * (0.01 + most)) << "wall " << wall;
  }
}

std::vector<spam::Fluid<2>> fluids_of_every_kind() {
  std::vector<spam::Fluid<2>> fluids;
  for (const auto name : {kernel::WeightName::lucy, kernel::WeightName::monaghan}) {
    for (const bool plain : {true, false}) {
      spam::Fluid<2> fluid = gas<2>(plain ? spam::Transport{} : all_transport);
      fluid.weight = kernel::make_weight<2>(name, 2.5);
      fluid.gravity = {0.0, -0.1};
      fluids.push_back(fluid);
    }
  }
  fluids[1].mean = spam::DensityMean::arithmetic;
  fluids.push_back(fluids[1]);
  fluids.back().state = spam::VanDerWaals();
  fluids.push_back(fluids[3]);
  fluids.back().state = spam::DenseFluid();
  return fluids;
}

TEST(FluidBetweenWalls, RatesEqualSumsOverParticlesAndImages) {
  for (const auto kind : kinds) {
    for (const bool sides : {false, true}) {
      for (const auto& fluid : fluids_of_every_kind()) {
        const bool dense = std::holds_alternative<spam::DenseFluid>(fluid.state);
        auto walls = heated(kind, sides, 8.0);
        if (!sides) {
          (*walls.across[1])[0].velocity = {0.2, 0.0};
          (*walls.across[1])[1].velocity = {-0.4, 0.0};
        }
        auto trajectory =
            flow<2>(fluid, noisy_lattice<2>({8.0, 8.0}, walls, 11, dense ? 0.1 : 0.3, 0.3, dense ? 1.6 : 1.0));
        expect_slow_rates(trajectory);
        if (HasFatalFailure()) FAIL() << "kind " << static_cast<int>(kind) << ", side walls " << sides;
      }
    }
  }
}

// Images follow their parents through every step, and particles that cross get new ones.
TEST(FluidBetweenWalls, RatesStayThoseOfTheSumsWhileParticlesMove) {
  for (const auto kind : kinds) {
    for (const bool sides : {false, true}) {
      spam::Fluid<2> fluid = gas<2>();
      fluid.gravity = {0.02, -0.2};
      auto walls = heated(kind, sides, 8.0);
      if (!sides) (*walls.across[1])[0].velocity = {0.7, 0.0};
      auto trajectory = flow<2>(fluid, noisy_lattice<2>({9.0, 8.0}, walls, 12, 0.4, 0.5));
      for (int step = 0; step < 60; ++step) {
        trajectory.advance(step < 40 ? 0.05 : 0.2);
        expect_slow_rates(trajectory);
        if (HasFatalFailure())
          FAIL() << "kind " << static_cast<int>(kind) << ", side walls " << sides << ", step " << step;
      }
      EXPECT_GT(trajectory.reflections(), 0);
    }
  }
}

// Sides, of whatever kind, with moving walls of mirror images: the lid of a cavity.
TEST(FluidBetweenWalls, RatesEqualTheSumsInACavityWithAMovingLid) {
  auto walls = heated(WallKind::mirror_images, true, 8.0);
  (*walls.across[1])[1].velocity = {0.8, 0.0};
  (*walls.across[0])[0].velocity = {0.0, -0.3};
  auto trajectory = flow<2>(gas<2>(), noisy_lattice<2>({8.0, 8.0}, walls, 13));
  for (int step = 0; step < 20; ++step) {
    trajectory.advance(0.1);
    expect_slow_rates(trajectory);
    if (HasFatalFailure()) FAIL() << "step " << step;
  }
}

TEST(FluidBetweenWalls, RatesEqualTheSumsWithWallsAtTheSidesOnly) {
  for (const auto kind : kinds) {
    auto walls = walls_across<2>(kind, {0});
    (*walls.across[0])[0] = {{0.0, 0.5}, 0.7, {}};
    auto trajectory = flow<2>(gas<2>(), noisy_lattice<2>({8.0, 9.0}, walls, 14));
    for (int step = 0; step < 20; ++step) {
      trajectory.advance(0.1);
      expect_slow_rates(trajectory);
      if (HasFatalFailure()) FAIL() << "kind " << static_cast<int>(kind) << ", step " << step;
    }
  }
}

TEST(FluidBetweenWalls, RatesEqualTheSumsInOneAndInThreeDimensions) {
  for (const auto kind : kinds) {
    auto line = walls_across<1>(kind, {0});
    (*line.across[0])[1].temperature = 0.6;
    auto thin = flow<1>(gas<1>(), noisy_lattice<1>({20.0}, line, 15));
    auto box = walls_across<3>(kind, {0, 2});
    (*box.across[2])[1] = {{}, 0.6, {}};
    (*box.across[0])[0] = {{}, 1.0, {0.0, 0.0, -0.08}};
    auto thick = flow<3>(gas<3>(all_transport, 1.8), noisy_lattice<3>({6.0, 4.0, 6.0}, box, 16));
    for (int step = 0; step < 4; ++step) {
      expect_slow_rates(thin);
      expect_slow_rates(thick);
      if (HasFatalFailure()) FAIL() << "kind " << static_cast<int>(kind) << ", step " << step;
      for (int more = 0; more < 5; ++more) {
        thin.advance(0.05);
        thick.advance(0.05);
      }
    }
  }
}

// A fluid at rest has no speed of its own that would bound the life of its first list: the walls have.
TEST(FluidBetweenWalls, TheFirstListKnowsThatBoundaryParticlesMove) {
  auto walls = walls_across<2>(WallKind::boundary_particles, {1});
  (*walls.across[1])[0].velocity = {-0.5, 0.0};
  (*walls.across[1])[1].velocity = {0.5, 0.0};
  for (const bool isentropic : {true, false}) {
    spam::Fluid<2> fluid = gas<2>({});
    if (isentropic) fluid.state = spam::Isentropic();
    auto trajectory = flow<2>(fluid, noisy_lattice<2>({16.0, 8.0}, walls, 17, 0.0, 0.0, 1.0, 0.0));
    for (int step = 0; step < 40; ++step) {
      trajectory.advance(0.05);
      expect_slow_rates(trajectory);
      if (HasFatalFailure()) FAIL() << (isentropic ? "isentropic fluid" : "ideal gas") << ", step " << step;
    }
  }
}

template <int D>
void expect_same_bits(const FluidTrajectory<D>& one, const FluidTrajectory<D>& other) {
  EXPECT_EQ(one.positions(), other.positions());
  EXPECT_EQ(one.velocities(), other.velocities());
  EXPECT_EQ(one.energies(), other.energies());
  EXPECT_EQ(one.densities(), other.densities());
  EXPECT_EQ(one.accelerations(), other.accelerations());
  EXPECT_EQ(one.energy(), other.energy());
  EXPECT_EQ(one.energy_drift(), other.energy_drift());
  EXPECT_EQ(one.reflections(), other.reflections());
  for (std::size_t wall = 0; wall < 2 * D; ++wall) {
    EXPECT_EQ(one.power_of_walls()[wall].conduction, other.power_of_walls()[wall].conduction);
    EXPECT_EQ(one.power_of_walls()[wall].work, other.power_of_walls()[wall].work);
    EXPECT_EQ(one.given_by_walls()[wall].conduction, other.given_by_walls()[wall].conduction);
    EXPECT_EQ(one.given_by_walls()[wall].work, other.given_by_walls()[wall].work);
  }
}

TEST(FluidBetweenWalls, GivesTheSameBitsForEveryNumberOfThreads) {
  for (const auto kind : kinds) {
    const auto run_with = [&](int threads) {
      auto trajectory =
          flow<2>(gas<2>(), noisy_lattice<2>({48.0, 40.0}, heated(kind, true, 40.0), 41, 0.4, 0.5), 1e-3, threads);
      run(trajectory, 0.3, 0.1);
      return trajectory;
    };
    const auto alone = run_with(1);
    EXPECT_GT(alone.reflections(), 0);
    for (const int threads : {2, 3}) expect_same_bits(alone, run_with(threads));
  }
}

TEST(FluidBetweenWalls, GoesOnFromASavedStateWithTheSameBits) {
  for (const auto kind : kinds) {
    spam::Fluid<2> fluid = gas<2>();
    fluid.state = spam::VanDerWaals();
    fluid.gravity = {0.0, -0.1};
    auto walls = heated(kind, false, 12.0);
    (*walls.across[1])[1].velocity = {0.3, 0.0};
    auto whole = flow<2>(fluid, noisy_lattice<2>({14.0, 12.0}, walls, 42));
    run(whole, 3.7, 0.1);
    ArchiveWriter saved;
    whole.save(saved);
    auto resumed = flow<2>(fluid, noisy_lattice<2>({14.0, 12.0}, walls, 43));
    run(resumed, 1.0, 0.1);
    ArchiveReader reader(saved.bytes());
    resumed.load(reader);
    EXPECT_TRUE(reader.exhausted());
    EXPECT_EQ(whole.positions(), resumed.positions());
    EXPECT_EQ(whole.densities(), resumed.densities());
    for (auto* trajectory : {&whole, &resumed}) trajectory->renew_list(0.1);
    EXPECT_EQ(whole.gradients(), resumed.gradients());
    expect_same_bits(whole, resumed);
    for (auto* trajectory : {&whole, &resumed}) run(*trajectory, 5.0, 0.1);
    expect_same_bits(whole, resumed);
    EXPECT_EQ(whole.field_places().position, resumed.field_places().position);
    EXPECT_EQ(whole.field_places().energy, resumed.field_places().energy);
  }
}

TEST(FluidBetweenWalls, RefusesATruncatedState) {
  auto trajectory = flow<2>(gas<2>(), noisy_lattice<2>({8.0, 8.0}, heated(WallKind::mirror_images, true, 8.0), 44));
  ArchiveWriter saved;
  trajectory.save(saved);
  for (std::size_t length : {std::size_t{0}, std::size_t{7}, saved.bytes().size() / 2, saved.bytes().size() - 1}) {
    ArchiveReader reader(std::span(saved.bytes()).first(length));
    EXPECT_THROW(trajectory.load(reader), RunFailed);
  }
}

// What is known of a state does not depend on when its list was made.
TEST(FluidBetweenWalls, AStateIsTheSameAfterItsListIsRenewed) {
  for (const auto kind : kinds) {
    spam::Fluid<2> fluid = gas<2>();
    fluid.state = spam::VanDerWaals();
    auto walls = heated(kind, false, 12.0);
    (*walls.across[1])[1].velocity = {0.3, 0.0};
    auto trajectory = flow<2>(fluid, noisy_lattice<2>({14.0, 12.0}, walls, 45));
    run(trajectory, 5.0, 0.1);
    const auto position = trajectory.positions();
    const auto density = trajectory.densities();
    const auto gradients = trajectory.gradients();
    const auto energy_rates = trajectory.energy_rates();
    const auto exchange = trajectory.power_of_walls();
    trajectory.renew_list(0.1);
    EXPECT_EQ(trajectory.positions(), position);
    EXPECT_EQ(trajectory.densities(), density);
    const auto gradients_again = trajectory.gradients();  // a pass of their own, with other additions in another order
    for (std::size_t i = 0; i < gradients.size(); ++i) EXPECT_NEAR(gradients_again[i], gradients[i], 1e-12);
    EXPECT_EQ(trajectory.energy_rates(), energy_rates);
    const auto again = trajectory.power_of_walls();
    for (std::size_t wall = 0; wall < 4; ++wall) {
      EXPECT_NEAR(again[wall].conduction, exchange[wall].conduction, 1e-12);
      EXPECT_NEAR(again[wall].work, exchange[wall].work, 1e-12);
    }
    expect_slow_rates(trajectory);
    trajectory.advance(0.1);
    expect_slow_rates(trajectory);
  }
}

/// What takes part in the fields behind the walls, in an order of its own: place and energy.
std::vector<std::array<double, 3>> behind_walls(const FieldPlaces<2>& places, std::size_t particles) {
  std::vector<std::array<double, 3>> found;
  for (std::size_t k = particles; k < places.energy.size(); ++k)
    found.push_back({places.position[2 * k], places.position[2 * k + 1], places.energy[k]});
  std::sort(found.begin(), found.end());
  return found;
}

TEST(FluidBetweenWalls, FieldsSeeTheSameWallsAfterTheListIsRenewed) {
  for (const auto kind : kinds) {
    spam::Fluid<2> fluid = gas<2>();
    fluid.state = spam::VanDerWaals();
    auto trajectory = flow<2>(fluid, noisy_lattice<2>({14.0, 12.0}, heated(kind, true, 12.0), 46));
    run(trajectory, 5.0, 0.1);
    const auto slow = spam::testing::slow_rates_between_walls<2>(fluid, crowd_of(trajectory));
    const auto places = spam::testing::places_between_walls<2>(crowd_of(trajectory), 2.5);
    for (const bool renewed : {false, true}) {
      if (renewed) trajectory.renew_list(0.1);
      const auto found = behind_walls(trajectory.field_places(), 168);
      // Images farther away than the range may be there, too.
      for (std::size_t k = 0; k < places.walls.size(); ++k) {
        const double energy = places.walls[k].temperature - 0.5 * slow.density[168 + k];
        const auto same = std::find_if(found.begin(), found.end(), [&](const auto& place) {
          return std::hypot(place[0] - trajectory.cell().corner()[0] - places.position[168 + k][0],
                            place[1] - trajectory.cell().corner()[1] - places.position[168 + k][1]) < 1e-10;
        });
        ASSERT_NE(same, found.end());
        ASSERT_NEAR((*same)[2], energy, 1e-12) << "kind " << static_cast<int>(kind) << ", renewed " << renewed;
      }
    }
  }
}

TEST(FluidBetweenWalls, ProducesTheEntropyOfTheSums) {
  for (const auto kind : kinds) {
    auto walls = heated(kind, false, 8.0);
    (*walls.across[1])[1].velocity = {0.3, 0.0};
    auto trajectory = flow<2>(gas<2>(), noisy_lattice<2>({8.0, 8.0}, walls, 47));
    run(trajectory, 1.0, 0.1);
    const auto slow = spam::testing::slow_rates_between_walls<2>(trajectory.fluid().fluid(), crowd_of(trajectory));
    for (const bool renewed : {false, true}) {
      if (renewed) trajectory.renew_list(0.1);
      const auto produced = trajectory.entropy_production();
      for (std::size_t i = 0; i < 64; ++i) {
        EXPECT_NEAR(produced[2 * i], slow.viscous_entropy[i], 1e-12) << "renewed " << renewed;
        EXPECT_NEAR(produced[2 * i + 1], slow.conducted_entropy[i], 1e-12) << "renewed " << renewed;
        if (HasFailure()) FAIL() << "kind " << static_cast<int>(kind);
      }
    }
  }
}

TEST(FluidBetweenWalls, AveragesTheViscousStressOverTheParticles) {
  for (const auto kind : kinds) {
    auto walls = heated(kind, false, 8.0);
    (*walls.across[1])[1].velocity = {0.3, 0.0};
    auto trajectory = flow<2>(gas<2>(), noisy_lattice<2>({8.0, 8.0}, walls, 48));
    run(trajectory, 1.0, 0.1);
    const auto gradients = trajectory.gradients();
    const auto density = trajectory.densities();
    double expected = 0.0;
    for (std::size_t i = 0; i < density.size(); ++i)
      expected -= 0.5 * (gradients[6 * i + 1] + gradients[6 * i + 2]) / density[i];
    EXPECT_NEAR(trajectory.viscous_stress_xy(), expected, 1e-11) << "kind " << static_cast<int>(kind);
  }
}

TEST(FluidBetweenWalls, CountsTheEnergyOfTheParticlesOnly) {
  for (const auto kind : kinds) {
    auto walls = heated(kind, false, 8.0);
    for (auto& wall : *walls.across[1]) wall.velocity = {2.0, 0.0};
    auto trajectory = flow<2>(gas<2>(), noisy_lattice<2>({8.0, 8.0}, walls, 49));
    run(trajectory, 1.0, 0.1);
    const auto velocity = trajectory.velocities();
    double motion = 0.0;
    for (const double v : velocity) motion += 0.5 * v * v;
    EXPECT_NEAR(trajectory.kinetic().kinetic_energy(), motion, 1e-11 * motion);
    EXPECT_NEAR(trajectory.internal_energy(), sum(trajectory.energies()), 1e-11);
    EXPECT_EQ(trajectory.particles(), 64);
    EXPECT_DOUBLE_EQ(trajectory.volume(), 64.0);
  }
}

TEST(FluidBetweenWalls, RefusesShearAndCooling) {
  for (const auto kind : kinds) {
    const auto start = noisy_lattice<2>({10.0, 10.0}, heated(kind, false, 10.0), 51);
    EXPECT_THROW(FluidTrajectory<2>(gas<2>(), start, 0.1, Cooling::none, Watch{}, Team(1)), BadInput);
    EXPECT_THROW(FluidTrajectory<2>(gas<2>(), start, 0.0, Cooling::isoenergetic, Watch{}, Team(1)), BadInput);
    EXPECT_NO_THROW(FluidTrajectory<2>(gas<2>(), start, 0.0, Cooling::none, Watch{}, Team(1)));
  }
}

TEST(FluidBetweenWalls, RefusesACellThatIsTooNarrowForItsImages) {
  for (const auto kind : kinds) {
    try {
      flow<2>(gas<2>(), noisy_lattice<2>({10.0, 6.0}, heated(kind, false, 6.0), 52));
      FAIL() << "a cell of 6 was accepted for a range of 2.5";
    } catch (const BadInput& refusal) {
      EXPECT_NE(std::string(refusal.what()).find("a cell of length 6 "), std::string::npos) << refusal.what();
      EXPECT_NE(std::string(refusal.what()).find("kernel.range = 2.5"), std::string::npos) << refusal.what();
    }
    // Along a periodic axis it may be shorter.
    EXPECT_NO_THROW(flow<2>(gas<2>(), noisy_lattice<2>({6.0, 10.0}, heated(kind, false, 10.0), 53)));
  }
}

TEST(FluidBetweenWalls, SaysWhichParticleWasThrownOutOfTheCellAndWhen) {
  constexpr double never = std::numeric_limits<double>::infinity();
  for (const auto kind : kinds) {
    // Far too stiff for the step, and nobody watches the energy.
    auto trajectory =
        flow<2>(gas<2>({.viscosity = 1e6}),
                noisy_lattice<2>({10.0, 10.0}, heated(kind, false, 10.0, 1.0, 1.0), 54, 0.0, 1e-7, 1.0, 0.0), never);
    try {
      run(trajectory, 5.0, 0.1);
      FAIL() << "particles outside of the cell went unnoticed";
    } catch (const RunFailed& failure) {
      EXPECT_THAT(failure.what(),
                  ::testing::MatchesRegex("at time 0\\.[0-9]+ particle [0-9]+ was thrown through a wall .*"));
    }
  }
}

// Rows that a wall carries along would leave a gap behind them, where other walls bar their way.
TEST(FluidBetweenWalls, RefusesALidOfBoundaryParticlesThatMoves) {
  auto walls = heated(WallKind::boundary_particles, true, 8.0);
  (*walls.across[1])[1].velocity = {0.5, 0.0};
  try {
    flow<2>(gas<2>(), noisy_lattice<2>({8.0, 8.0}, walls, 55, 0.1, 0.1));
    FAIL();
  } catch (const BadInput& refusal) {
    EXPECT_THAT(refusal.what(), ::testing::HasSubstr("other walls bar their way"));
  }
}

// A place in the room behind the walls, or beyond it, is none for a particle.
TEST(FluidBetweenWalls, RefusesAStartOutsideOfTheCell) {
  for (const auto kind : kinds) {
    for (const double y : {-0.5, 12.0, 25.0, -15.0}) {
      auto start = noisy_lattice<2>({10.0, 10.0}, heated(kind, false, 10.0), 56);
      start.position[37][1] = y;
      EXPECT_ANY_THROW(flow<2>(gas<2>(), start)) << "kind " << static_cast<int>(kind) << ", y = " << y;
    }
  }
}

}  // namespace
}  // namespace lucy::motion
