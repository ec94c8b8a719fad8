// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/pairs/kept_pairs.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "lucy/pairs/traverse.hpp"
#include "pairs/crowd.hpp"

namespace lucy::pairs {
namespace {

using testing::Arranged;
using testing::Crowd;

constexpr double range = 2.5;

// A sum that can leave a number for each pair, find it, or do without: (range - r)^2, to both, along x with a sign.
template <int D, Keeping how>
struct SquareSum {
  static constexpr int carried = 0;
  static constexpr int lab_velocity = -1;
  static constexpr int given = 2;
  static constexpr int totals = 1;
  static constexpr Keeping keeping = how;

  Lanes operator()(const Pair<D, 0>& pair, std::array<Lanes, 2>& to_i, std::array<Lanes, 2>& to_j,
                   std::array<Lanes, 1>& sums) const {
    Lanes square = pair.kept;
    if constexpr (how != Keeping::finds) {
      const Lanes left = range - pair.distance;
      square = left * left;
    }
    to_i[0] = to_j[0] = square;
    to_i[1] = square * pair.displacement[0];
    to_j[1] = -to_i[1];
    sums[0] += square;
    return square;
  }
};

template <int D>
struct Sums {
  std::vector<double> given;
  double total = 0.0;
  bool operator==(const Sums&) const = default;
};

template <int D, Keeping how>
Sums<D> sums_of(const Arranged<D>& arranged, const Crowd<D>& crowd, KeptPairs& kept, const Team& team = Team(1)) {
  using Sum = SquareSum<D, how>;
  space::Columns columns(2, arranged.list.capacity());
  const Pass<D, Sum> pass{Arranged<D>::pointers(arranged.position), {}, {columns[0], columns[1]}};
  Sums<D> sums;
  sums.total = traverse<D>(arranged.list, image_table(crowd.box, 0.0), range, pass, Sum{}, team, kept)[0];
  for (int c = 0; c < 2; ++c) sums.given.insert(sums.given.end(), columns[c], columns[c] + arranged.list.slots());
  return sums;
}

template <int D>
void expect_the_same_with_kept_numbers(const Crowd<D>& crowd, KeptPairs& kept) {
  Arranged<D> arranged(crowd);
  arranged.build(crowd, range, 0.0, 0.0);
  const Sums<D> anew = sums_of<D, Keeping::nothing>(arranged, crowd, kept);
  ASSERT_GT(anew.total, 0.0);
  for (const int threads : {1, 3}) {
    EXPECT_EQ((sums_of<D, Keeping::leaves>(arranged, crowd, kept, Team(threads))), anew);
    EXPECT_EQ((sums_of<D, Keeping::finds>(arranged, crowd, kept, Team(threads))), anew);
    EXPECT_EQ((sums_of<D, Keeping::finds>(arranged, crowd, kept, Team(threads))), anew) << "found twice";
  }
}

TEST(KeptPairs, GiveTheSameBitsAsPairsLookedAtAnew) {
  KeptPairs line;
  expect_the_same_with_kept_numbers(Crowd<1>::random(40, space::Box<1>({30.0}), 1.0, 1), line);
  KeptPairs plane;
  expect_the_same_with_kept_numbers(Crowd<2>::random(300, space::Box<2>({20.0, 15.0}), 1.0, 2), plane);
  expect_the_same_with_kept_numbers(Crowd<2>::random(300, space::Box<2>({20.0, 15.0}, 0.5, 3.0), 1.0, 3), plane);
  KeptPairs space;
  expect_the_same_with_kept_numbers(Crowd<3>::random(500, space::Box<3>({8.0, 9.0, 7.0}), 1.0, 4), space);
}

TEST(KeptPairs, AreGoodForALongListAndThenForAShortOne) {
  KeptPairs kept;
  for (const int particles : {50, 2000, 20, 400})
    expect_the_same_with_kept_numbers(Crowd<2>::random(particles, space::Box<2>({40.0, 30.0}), 1.0, 5), kept);
}

TEST(KeptPairs, LeaveOutEntriesWithoutAPartner) {
  const auto crowd = Crowd<2>::random(1000, space::Box<2>({36.0, 30.0}), 1.0, 6);
  Arranged<2> arranged(crowd);
  arranged.build(crowd, range, 0.3, 0.0);  // rows for a time to come: many are empty now
  KeptPairs kept;
  sums_of<2, Keeping::leaves>(arranged, crowd, kept);
  std::size_t entries = 0;
  for (std::size_t b = 0; b < arranged.list.blocks().size(); ++b) {
    const auto& block = arranged.list.blocks()[b];
    if (block.last_cluster > block.first_cluster)
      entries += kept[b].cluster_end[block.last_cluster - block.first_cluster - 1];
  }
  EXPECT_LT(entries, arranged.list.entry_count());
  EXPECT_GT(entries, arranged.list.entry_count() / 4);
}

}  // namespace
}  // namespace lucy::pairs
