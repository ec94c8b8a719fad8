// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/pairs/cluster_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "crowd.hpp"
#include "lucy/errors.hpp"
#include "lucy/pairs/traverse.hpp"

namespace lucy::pairs {
namespace {

using testing::Arranged;
using testing::Crowd;
using testing::for_all_pairs;

// A sum that tells pairs apart: neighbours, a smooth weight, and laboratory velocity differences.
template <int D>
struct ProbeSum {
  static constexpr int carried = D;
  static constexpr int lab_velocity = 0;
  static constexpr int given = 2 + D;
  static constexpr int totals = 2;
  static constexpr Keeping keeping = Keeping::nothing;
  double range;

  void operator()(const Pair<D, D>& pair, std::array<Lanes, given>& to_i, std::array<Lanes, given>& to_j,
                  std::array<Lanes, totals>& sums) const {
    Lanes one = 1.0;
    simd::where(pair.distance >= range, one) = 0.0;
    const Lanes weight = range - pair.distance;
    to_i[0] = to_j[0] = one;
    to_i[1] = to_j[1] = weight;
    for (int d = 0; d < D; ++d) {
      to_i[2 + d] = weight * (pair.of_i[d] - pair.of_j[d]);
      to_j[2 + d] = -to_i[2 + d];
    }
    sums[0] += one;
    sums[1] += weight * pair.displacement[0];
  }
};

template <int D>
struct Outcome {
  std::vector<double> given;  // by particle number
  Totals<ProbeSum<D>> totals;
};

template <int D>
Outcome<D> by_list(Arranged<D>& arranged, const Crowd<D>& crowd, double age, double range, const Team& team = Team(1)) {
  constexpr int given = ProbeSum<D>::given;
  arranged.move_to(crowd, age);
  // Laboratory velocities: peculiar plus the flow where the particle is.
  space::Columns velocity(D, arranged.list.capacity());
  space::Columns sums(given, arranged.list.capacity());
  Pass<D, ProbeSum<D>> pass{Arranged<D>::pointers(arranged.position), {}, {}};
  for (std::size_t slot = 0; slot < arranged.number.size(); ++slot) {
    for (int d = 0; d < D; ++d) velocity[d][slot] = arranged.velocity[d][slot];
    if constexpr (D > 1) velocity[0][slot] += crowd.box.strain_rate() * arranged.position[1][slot];
  }
  for (int d = 0; d < D; ++d) pass.carried[d] = velocity[d];
  for (int c = 0; c < given; ++c) pass.given[c] = sums[c];
  Outcome<D> outcome{};
  outcome.totals = traverse<D>(arranged.list, image_table(crowd.box, age), range, pass, ProbeSum<D>{range}, team);
  outcome.given.resize(crowd.position.size() * given);
  for (std::size_t slot = 0; slot < arranged.number.size(); ++slot) {
    if (arranged.number[slot] == nobody) continue;
    for (int c = 0; c < given; ++c) {
      outcome.given[static_cast<std::size_t>(arranged.number[slot]) * given + c] = sums[c][slot];
    }
  }
  return outcome;
}

template <int D>
Outcome<D> by_hand(const Crowd<D>& crowd, double age, double range) {
  constexpr int given = ProbeSum<D>::given;
  std::vector<space::Vector<D>> position;
  for (std::size_t i = 0; i < crowd.position.size(); ++i) position.push_back(crowd.position_at(i, age));
  const auto lab = [&](std::size_t i, int d) {
    return crowd.velocity[i][d] + (D > 1 && d == 0 ? crowd.box.strain_rate() * position[i][D > 1 ? 1 : 0] : 0.0);
  };
  Outcome<D> outcome{};
  outcome.given.resize(position.size() * given);
  for_all_pairs<D>(crowd.box, position, age, range,
                   [&](std::size_t i, std::size_t j, const auto& apart, const auto& shift) {
                     double squared = 0.0;
                     for (double component : apart) squared += component * component;
                     const double weight = range - std::sqrt(squared);
                     for (std::size_t k : {i, j}) {
                       outcome.given[k * given] += 1.0;
                       outcome.given[k * given + 1] += weight;
                     }
                     for (int d = 0; d < D; ++d) {
                       const double difference = weight * (lab(i, d) - lab(j, d) - shift.velocity[d]);
                       outcome.given[i * given + 2 + d] += difference;
                       outcome.given[j * given + 2 + d] -= difference;
                     }
                     outcome.totals[0] += 1.0;
                   });
  return outcome;
}

template <int D>
void expect_same(const Outcome<D>& list, const Outcome<D>& hand) {
  EXPECT_EQ(list.totals[0], hand.totals[0]);
  ASSERT_EQ(list.given.size(), hand.given.size());
  for (std::size_t k = 0; k < list.given.size(); ++k) {
    ASSERT_NEAR(list.given[k], hand.given[k], 1e-10) << "at " << k;
  }
}

TEST(ClusterList, FindsEveryPairOfARandomCrowdAtRandomOffsetsOfBothSigns) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> strains(-50.0, 50.0);
  for (int particles : {36, 37, 100, 251}) {
    const double side = std::sqrt(static_cast<double>(particles));
    for (double rate : {0.3, -0.3}) {
      const space::Box<2> box({side, side}, rate, strains(generator) * side);
      const auto crowd = Crowd<2>::random(particles, box, 0.7, generator());
      Arranged<2> arranged(crowd);
      arranged.build(crowd, 3.0, 0.0, 0.0);
      expect_same(by_list(arranged, crowd, 0.0, 3.0), by_hand(crowd, 0.0, 3.0));
    }
  }
}

TEST(ClusterList, HoldsForItsWholeLifetimeAlongStraightPaths) {
  std::mt19937_64 generator(12);
  std::uniform_real_distribution<double> offsets(-100.0, 100.0);
  for (double rate : {0.0, 0.1, -1.0, 1.5}) {
    const space::Box<2> box({14.0, 11.0}, rate, offsets(generator));
    auto crowd = Crowd<2>::random(154, box, 0.7, generator());
    Arranged<2> arranged(crowd);
    const double lifetime = std::min(0.3, arranged.list.longest_lifetime(3.0, 0.04, crowd.fastest(), rate));
    ASSERT_GT(lifetime, 0.2);
    arranged.build(crowd, 3.0, lifetime, 0.04);
    for (double part : {0.0, 0.31, 0.78, 1.0}) {
      expect_same(by_list(arranged, crowd, part * lifetime, 3.0), by_hand(crowd, part * lifetime, 3.0));
    }
    // Off the line by no more than the slack.
    std::uniform_real_distribution<double> stray(-0.04 / std::numbers::sqrt2, 0.04 / std::numbers::sqrt2);
    for (auto& r : crowd.position) {
      for (double& component : r) component += stray(generator);
    }
    expect_same(by_list(arranged, crowd, lifetime, 3.0), by_hand(crowd, lifetime, 3.0));
  }
}

TEST(ClusterList, FollowsOneFastParticleAmongSlowOnes) {
  for (double rate : {0.0, 0.01}) {
    const space::Box<2> box({20.0, 20.0}, rate, 4.0);
    auto crowd = Crowd<2>::random(400, box, 0.2, 13);
    crowd.velocity[17] = {28.0, -9.0};
    Arranged<2> arranged(crowd);
    const double lifetime = std::min(0.2, arranged.list.longest_lifetime(3.0, 0.04, crowd.fastest(), rate));
    ASSERT_GT(lifetime, 0.1);
    arranged.build(crowd, 3.0, lifetime, 0.04);
    const auto entries = arranged.list.entry_count();
    for (double part : {0.0, 0.5, 1.0}) {
      expect_same(by_list(arranged, crowd, part * lifetime, 3.0), by_hand(crowd, part * lifetime, 3.0));
    }
    // Its own row is long, but the others' are not.
    crowd.velocity[17] = {0.2, 0.1};
    arranged.build(crowd, 3.0, lifetime, 0.04);
    EXPECT_LT(entries, arranged.list.entry_count() * 1.3);
  }
}

TEST(ClusterList, WorksInTheSmallestBoxAllowed) {
  for (double offset : {0.0, 1.3, 5.9, -2.2}) {
    const space::Box<2> box({6.0, 6.0}, 0.4, offset);
    const auto crowd = Crowd<2>::random(36, box, 0.5, 14);
    Arranged<2> arranged(crowd);
    const double lifetime = std::min(0.2, arranged.list.longest_lifetime(3.0, 0.04, crowd.fastest(), 0.4));
    arranged.build(crowd, 3.0, lifetime, 0.04);
    expect_same(by_list(arranged, crowd, 0.0, 3.0), by_hand(crowd, 0.0, 3.0));
    expect_same(by_list(arranged, crowd, lifetime, 3.0), by_hand(crowd, lifetime, 3.0));
  }
}

TEST(ClusterList, CopesWithAnEmptyHalfAndACrowdInOnePlace) {
  const space::Box<2> box({20.0, 20.0}, 0.1, 7.0);
  auto crowd = Crowd<2>::random(200, box, 0.3, 15);
  for (auto& r : crowd.position) r = {0.2 * r[0] + 19.0 - 4.0, 0.1 * r[1]};
  crowd.position[0] = {3.0, 15.0};
  Arranged<2> arranged(crowd);
  arranged.build(crowd, 3.0, 0.1, 0.02);
  expect_same(by_list(arranged, crowd, 0.1, 3.0), by_hand(crowd, 0.1, 3.0));
}

TEST(ClusterList, SortsAndPairsInOneAndThreeDimensions) {
  const space::Box<1> line({50.0});
  const auto chain = Crowd<1>::random(50, line, 0.5, 16);
  Arranged<1> on_line(chain);
  on_line.build(chain, 3.0, 0.2, 0.02);
  expect_same(by_list(on_line, chain, 0.2, 3.0), by_hand(chain, 0.2, 3.0));

  for (double rate : {0.0, 0.5}) {
    const space::Box<3> box({7.0, 6.5, 6.0}, rate, -3.0);
    const auto crowd = Crowd<3>::random(150, box, 0.5, 17);
    Arranged<3> arranged(crowd);
    const double lifetime = std::min(0.1, arranged.list.longest_lifetime(2.5, 0.02, crowd.fastest(), rate));
    arranged.build(crowd, 2.5, lifetime, 0.02);
    expect_same(by_list(arranged, crowd, lifetime, 2.5), by_hand(crowd, lifetime, 2.5));
  }
}

TEST(ClusterList, GivesTheSameBitsForEveryNumberOfThreads) {
  const space::Box<2> box({64.0, 64.0}, 0.1, 21.0);
  const auto crowd = Crowd<2>::random(4096, box, 0.7, 18);
  Arranged<2> arranged(crowd);
  arranged.build(crowd, 3.0, 0.2, 0.04);
  ASSERT_GT(arranged.list.blocks().size(), 4U);
  const auto alone = by_list(arranged, crowd, 0.1, 3.0, Team(1));
  for (int threads : {2, 3, 5}) {
    Arranged<2> again(crowd);
    again.build(crowd, 3.0, 0.2, 0.04, Team(threads));
    const auto together = by_list(again, crowd, 0.1, 3.0, Team(threads));
    EXPECT_EQ(alone.given, together.given);
    EXPECT_EQ(alone.totals, together.totals);
  }
}

// Even blocks are summed at the same time, then odd ones: a row may write to its own block and the next, no further.
TEST(ClusterList, RowsOfABlockReachNoFurtherThanTheNextBlock) {
  const space::Box<2> box({64.0, 64.0}, 0.1, 21.0);
  auto crowd = Crowd<2>::random(4096, box, 0.7, 18);
  for (double fastest : {0.0, 10.0}) {
    if (fastest > 0.0) crowd.velocity[5] = {1.0, fastest};
    Arranged<2> arranged(crowd);
    arranged.build(crowd, 3.0, 0.2, 0.04);
    const auto blocks = arranged.list.blocks();
    ASSERT_EQ(blocks.size() % 2, 0U);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const auto& next = blocks[(b + 1) % blocks.size()];
      for (const RowEntry entry : blocks[b].entries) {
        const bool own = entry.cluster() >= blocks[b].first_cluster && entry.cluster() < blocks[b].last_cluster;
        const bool above = entry.cluster() >= next.first_cluster && entry.cluster() < next.last_cluster;
        ASSERT_TRUE(own || above) << "block " << b;
      }
    }
  }
}

TEST(ClusterList, ArrangingWhatIsArrangedChangesNothing) {
  const space::Box<2> box({20.0, 20.0});
  const auto crowd = Crowd<2>::random(399, box, 0.7, 19);
  Arranged<2> arranged(crowd);
  std::vector<std::int32_t> number = arranged.number;
  const auto order = arranged.list.arrange(Arranged<2>::pointers(arranged.position), number);
  for (std::size_t slot = 0; slot < order.size(); ++slot) {
    EXPECT_EQ(order[slot], number[slot] == nobody ? nobody : static_cast<std::int32_t>(slot));
  }
}

TEST(ClusterList, RefusesALifetimeInWhichAParticleCrossesTheBox) {
  const space::Box<2> box({8.0, 8.0});
  const auto crowd = Crowd<2>::random(64, box, 5.0, 20);
  Arranged<2> arranged(crowd);
  EXPECT_THROW(arranged.build(crowd, 3.0, 10.0, 0.04), RunFailed);
}

TEST(ImageSet, NamesEveryImageOnce) {
  std::set<std::array<int, 3>> seen;
  for (int index = 0; index < ImageSet<3>::count; ++index) {
    const auto n = ImageSet<3>::numbers(index);
    EXPECT_EQ(ImageSet<3>::index(n), index);
    EXPECT_TRUE(seen.insert(n).second);
    EXPECT_GE(n[2], 0);
  }
  for (int index = 0; index < ImageSet<2>::count; ++index) {
    EXPECT_EQ(ImageSet<2>::index(ImageSet<2>::numbers(index)), index);
  }
}

}  // namespace
}  // namespace lucy::pairs
