// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/spam/wall_exchange.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "lucy/spam/smooth_particles.hpp"
#include "slow_rates.hpp"

namespace lucy::spam {
namespace {

using space::WallKind;
using testing::SlowWallParticle;
using testing::WalledCrowd;

constexpr Transport all_transport{.viscosity = 0.5, .bulk_viscosity = 0.3, .conductivity = 0.4};
constexpr std::array kinds = {WallKind::mirror_images, WallKind::boundary_particles};

/// A fluid between walls through list and passes, what stands for walls put in its place by the slow sums' rule.
template <int D>
class Walled {
 public:
  Walled(const Fluid<D>& fluid, const WalledCrowd<D>& crowd, int threads = 1)
      : range_(kernel::range_of<D>(fluid.weight)),
        particles_(crowd.position.size()),
        all_(places(crowd)),
        arranged_(all_),
        energy_(1, arranged_.list.capacity()),
        images_(pairs::image_table(all_.box, 0.0)),
        fluid_(fluid, arranged_.list.capacity()),
        team_(threads) {
    arranged_.build(all_, range_, 0.0, 0.0, team_);
    std::vector<std::uint32_t> slot_of(all_.position.size());
    for (std::size_t slot = 0; slot < arranged_.number.size(); ++slot) {
      if (arranged_.number[slot] == pairs::nobody) continue;
      const auto number = static_cast<std::size_t>(arranged_.number[slot]);
      slot_of[number] = static_cast<std::uint32_t>(slot);
      if (number < particles_) energy_[0][slot] = crowd.energy[number];
    }
    for (std::size_t k = 0; k < stand_for_walls_.size(); ++k) {
      const SlowWallParticle& at = stand_for_walls_[k];
      const bool image = at.parent != SlowWallParticle::no_parent;
      walls_.push_back(
          {slot_of[particles_ + k], image ? slot_of[at.parent] : WallParticle::no_parent, at.wall, at.temperature});
    }
    fluid_.evaluate(given(), team_);
  }

  std::array<WallExchange, 2 * D> exchange() { return fluid_.wall_exchange(given(), team_); }

  /// Of the particles: sum of v.a + e'.
  double energy_rate() const {
    double sum = 0.0;
    for (std::size_t slot = 0; slot < arranged_.number.size(); ++slot) {
      if (!is_particle(slot)) continue;
      sum += fluid_.energy_rate()[0][slot];
      for (int d = 0; d < D; ++d) sum += arranged_.velocity[d][slot] * fluid_.acceleration()[d][slot];
    }
    return sum;
  }
  /// Of their motion and of their heat, largest terms: what rounding is measured by.
  double largest_rate() const {
    double most = 0.0;
    for (std::size_t slot = 0; slot < arranged_.number.size(); ++slot)
      if (is_particle(slot)) most = std::max(most, std::abs(fluid_.energy_rate()[0][slot]));
    return most;
  }

 private:
  testing::Crowd<D> places(const WalledCrowd<D>& crowd) {
    auto [position, velocity, walls] = testing::places_between_walls<D>(crowd, range_);
    stand_for_walls_ = walls;
    space::Vector<D> lengths = crowd.lengths;
    for (int d = 0; d < D; ++d) {
      if (!crowd.walls.across[d]) continue;
      lengths[d] += 4.0 * range_;
      for (auto& r : position) r[d] += 2.0 * range_;
    }
    return {space::Box<D>(lengths), position, velocity};
  }
  bool is_particle(std::size_t slot) const {
    return arranged_.number[slot] != pairs::nobody && static_cast<std::size_t>(arranged_.number[slot]) < particles_;
  }
  Particles<D> given() const {
    return {arranged_.list,
            images_,
            arranged_.number,
            pairs::testing::Arranged<D>::pointers(arranged_.position),
            pairs::testing::Arranged<D>::pointers(arranged_.velocity),
            energy_[0],
            0.0,
            walls_};
  }

  double range_;
  std::size_t particles_;
  std::vector<SlowWallParticle> stand_for_walls_;
  testing::Crowd<D> all_;
  pairs::testing::Arranged<D> arranged_;
  space::Columns energy_;
  pairs::ImageTable<D> images_;
  SmoothParticles<D> fluid_;
  std::vector<WallParticle> walls_;
  Team team_;
};

/// Disordered, moving, and unevenly warm, between walls across the given axes.
template <int D>
WalledCrowd<D> disordered(const space::Vector<D>& lengths, WallKind kind, const std::vector<std::size_t>& axes,
                          std::uint64_t seed) {
  auto crowd = testing::lattice<D>(space::Box<D>(lengths), 0.45, seed);
  testing::make_noisy(crowd, 0.5, seed + 1);
  WalledCrowd<D> walled{lengths, {}, 0.0, crowd.position, crowd.velocity, crowd.energy};
  walled.walls.kind = kind;
  for (const std::size_t axis : axes) walled.walls.across[axis].emplace();
  return walled;
}

/// Four walls, or a floor and a ceiling of different temperatures that move.
WalledCrowd<2> heated(WallKind kind, bool sides, std::uint64_t seed) {
  auto crowd =
      disordered<2>({9.0, 8.0}, kind, sides ? std::vector<std::size_t>{0, 1} : std::vector<std::size_t>{1}, seed);
  (*crowd.walls.across[1])[0] = {{-0.4, 0.0}, 1.5, {}};
  (*crowd.walls.across[1])[1] = {{0.7, 0.0}, 0.5, {}};
  if (sides) crowd.walls.across[0] = {space::Wall<2>{{}, 1.5, {0.0, -0.125}}, space::Wall<2>{{0.0, 0.3}, 1.5, {}}};
  return crowd;
}

std::vector<Fluid<2>> fluids() {
  const Fluid<2> lucy{kernel::Lucy<2>(2.5), IdealGas(), all_transport, DensityMean::geometric, {0.05, -0.3}};
  std::vector<Fluid<2>> all(6, lucy);
  all[1].weight = kernel::Monaghan<2>(2.5);
  all[2].transport = {};
  all[3].transport = {.viscosity = 0.5};
  all[4].transport = {.conductivity = 0.4};
  all[4].mean = DensityMean::arithmetic;
  all[5].state = VanDerWaals();
  return all;
}

TEST(WallExchange, IsTheSumOverPairsOfParticlesAndWall) {
  for (const auto kind : kinds) {
    for (const bool sides : {false, true}) {
      for (const auto& fluid : fluids()) {
        const auto crowd = heated(kind, sides, 61);
        const auto slow = testing::slow_rates_between_walls<2>(fluid, crowd);
        const auto exchange = Walled<2>(fluid, crowd).exchange();
        for (std::size_t wall = 0; wall < 4; ++wall) {
          EXPECT_NEAR(exchange[wall].conduction, slow.exchange[wall].conduction, 1e-12) << "wall " << wall;
          EXPECT_NEAR(exchange[wall].work, slow.exchange[wall].work, 1e-12) << "wall " << wall;
        }
      }
    }
  }
}

// With gravity's power, what walls give is all that the particles get: of motion and heat together.
TEST(WallExchange, AndThePowerOfGravityAreAllTheEnergyThatTheFluidGains) {
  for (const auto kind : kinds) {
    for (const bool sides : {false, true}) {
      for (const auto& fluid : fluids()) {
        const auto crowd = heated(kind, sides, 62);
        Walled<2> walled(fluid, crowd);
        double given = 0.0;
        for (const auto& velocity : crowd.velocity)
          given += fluid.gravity[0] * velocity[0] + fluid.gravity[1] * velocity[1];
        double size = std::abs(given);
        for (const auto& wall : walled.exchange()) {
          given += wall.conduction + wall.work;
          size = std::max({size, std::abs(wall.conduction), std::abs(wall.work)});
        }
        EXPECT_GT(size, 1.0);
        EXPECT_NEAR(given, walled.energy_rate(), 1e-12 * std::max(size, walled.largest_rate()));
      }
    }
  }
}

TEST(WallExchange, BalancesInOneAndInThreeDimensions) {
  for (const auto kind : kinds) {
    const Fluid<1> thin{kernel::Lucy<1>(2.5), IdealGas(), all_transport, {}, {}};
    auto line = disordered<1>({20.0}, kind, {0}, 63);
    (*line.walls.across[0])[1].temperature = 0.5;
    Walled<1> in_line(thin, line);
    double given = 0.0;
    for (const auto& wall : in_line.exchange()) given += wall.conduction + wall.work;
    EXPECT_NEAR(given, in_line.energy_rate(), 1e-12);

    const Fluid<3> thick{kernel::Lucy<3>(1.8), IdealGas(), all_transport, {}, {}};
    auto box = disordered<3>({5.0, 4.0, 5.0}, kind, {0, 1, 2}, 64);
    (*box.walls.across[2])[1] = {{0.3, -0.2, 0.0}, 0.5, {}};
    (*box.walls.across[0])[0] = {{0.0, 0.5, 0.0}, 1.0, {}};
    Walled<3> in_box(thick, box);
    given = 0.0;
    for (const auto& wall : in_box.exchange()) given += wall.conduction + wall.work;
    EXPECT_NEAR(given, in_box.energy_rate(), 1e-11);
  }
}

TEST(WallExchange, ConductsNothingWithoutConductivityAndIsZeroWhereThereIsNoWall) {
  for (const auto kind : kinds) {
    const auto crowd = heated(kind, false, 65);
    for (const Transport& transport : {Transport{}, Transport{.viscosity = 0.5}}) {
      const auto exchange = Walled<2>({kernel::Lucy<2>(2.5), IdealGas(), transport, {}, {}}, crowd).exchange();
      for (std::size_t wall = 0; wall < 4; ++wall) EXPECT_EQ(exchange[wall].conduction, 0.0);
      for (std::size_t wall = 0; wall < 2; ++wall) EXPECT_EQ(exchange[wall].work, 0.0);
      for (std::size_t wall = 2; wall < 4; ++wall) EXPECT_NE(exchange[wall].work, 0.0);
    }
  }
}

// By the symmetry of a fluid at rest no wall works, and a hot one heats.
TEST(WallExchange, OfAFluidAtRestIsHeatFromTheHotterWall) {
  for (const auto kind : kinds) {
    auto crowd = disordered<2>({9.0, 8.0}, kind, {1}, 66);
    for (auto& velocity : crowd.velocity) velocity = {};
    crowd.energy.assign(crowd.energy.size(), 1.0);
    (*crowd.walls.across[1])[0].temperature = 1.5;
    (*crowd.walls.across[1])[1].temperature = 0.5;
    const auto exchange = Walled<2>({kernel::Lucy<2>(2.5), IdealGas(), all_transport, {}, {}}, crowd).exchange();
    EXPECT_GT(exchange[2].conduction, 0.1);
    EXPECT_LT(exchange[3].conduction, -0.1);
    EXPECT_EQ(exchange[2].work, 0.0);
    EXPECT_EQ(exchange[3].work, 0.0);
  }
}

TEST(WallExchange, IsTheSameToTheBitForEveryNumberOfThreads) {
  for (const auto kind : kinds) {
    auto crowd = disordered<2>({40.0, 30.0}, kind, {0, 1}, 67);
    (*crowd.walls.across[1])[0].temperature = 1.5;
    const auto fluid = fluids()[0];
    const auto alone = Walled<2>(fluid, crowd, 1).exchange();
    const auto together = Walled<2>(fluid, crowd, 2).exchange();
    for (std::size_t wall = 0; wall < 4; ++wall) {
      EXPECT_EQ(alone[wall].conduction, together[wall].conduction);
      EXPECT_EQ(alone[wall].work, together[wall].work);
    }
  }
}

}  // namespace
}  // namespace lucy::spam
