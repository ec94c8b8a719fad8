// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/md/lucy_atoms.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pairs/crowd.hpp"

namespace lucy::md {
namespace {

using pairs::testing::Arranged;
using pairs::testing::Crowd;
using pairs::testing::for_all_pairs;

constexpr double range = 3.0;

template <int D>
struct Forces {
  std::vector<space::Vector<D>> force;  // by particle number
  pairs::PairTotals<D> totals;
};

template <int D>
Forces<D> evaluate(const Crowd<D>& crowd, pairs::Wanted wanted = pairs::Wanted::everything) {
  Arranged<D> arranged(crowd);
  arranged.build(crowd, range, 0.0, 0.0);
  space::Columns columns(D, arranged.list.capacity());
  std::array<double*, D> force;
  for (int d = 0; d < D; ++d) force[d] = columns[d];
  Forces<D> result;
  result.totals = lucy_forces<D>(kernel::Lucy<D>(range), arranged.list, pairs::image_table(crowd.box, 0.0),
                                 Arranged<D>::pointers(arranged.position), force, wanted, Team(1));
  result.force.resize(crowd.position.size());
  for (std::size_t slot = 0; slot < arranged.number.size(); ++slot) {
    if (arranged.number[slot] == pairs::nobody) continue;
    for (int d = 0; d < D; ++d) result.force[static_cast<std::size_t>(arranged.number[slot])][d] = columns[d][slot];
  }
  return result;
}

template <int D>
double energy_by_hand(const Crowd<D>& crowd) {
  const kernel::Lucy<D> kernel(range);
  double energy = 0.0;
  for_all_pairs<D>(crowd.box, crowd.position, 0.0, range,
                   [&](std::size_t, std::size_t, const auto& apart, const auto&) {
                     double squared = 0.0;
                     for (double component : apart) squared += component * component;
                     energy += kernel.weight(std::sqrt(squared));
                   });
  return energy;
}

TEST(LucyAtoms, ForcesEqualASumOverImagesAfterManyStrainsOfEitherSign) {
  std::mt19937_64 generator(21);
  std::uniform_real_distribution<double> strains(-200.0, 200.0);
  const kernel::Lucy<2> kernel(range);
  for (int trial = 0; trial < 12; ++trial) {
    const space::Box<2> box({9.0, 7.0}, 0.0, 7.0 * strains(generator));
    const auto crowd = Crowd<2>::random(63, box, 0.5, generator());
    const auto ours = evaluate(crowd);
    std::vector<space::Vector<2>> force(63, {0.0, 0.0});
    pairs::Tensor<2> virial = pairs::Tensor<2>::Zero();
    for_all_pairs<2>(box, crowd.position, 0.0, range,
                     [&](std::size_t i, std::size_t j, const auto& apart, const auto&) {
                       const double slope = kernel.slope(std::hypot(apart[0], apart[1]));
                       for (int a = 0; a < 2; ++a) {
                         force[i][a] += slope * apart[a];
                         force[j][a] -= slope * apart[a];
                         for (int b = 0; b < 2; ++b) virial(a, b) += slope * apart[a] * apart[b];
                       }
                     });
    for (std::size_t i = 0; i < force.size(); ++i) {
      for (int d = 0; d < 2; ++d) ASSERT_NEAR(ours.force[i][d], force[i][d], 1e-13);
    }
    EXPECT_NEAR(ours.totals.potential_energy, energy_by_hand(crowd), 1e-11);
    EXPECT_LT((ours.totals.virial - virial).cwiseAbs().maxCoeff(), 1e-11);
  }
}

template <int D>
void expect_force_is_minus_the_gradient(const space::Box<D>& box, int particles) {
  auto crowd = Crowd<D>::random(particles, box, 0.5, 22);
  const auto ours = evaluate(crowd);
  constexpr double step = 1e-5;
  for (std::size_t i : {0, 5, 11}) {
    for (int d = 0; d < D; ++d) {
      const double there = crowd.position[i][d];
      crowd.position[i][d] = there + step;
      const double up = energy_by_hand(crowd);
      crowd.position[i][d] = there - step;
      const double down = energy_by_hand(crowd);
      crowd.position[i][d] = there;
      EXPECT_NEAR(ours.force[i][d], -(up - down) / (2.0 * step), 1e-9);
    }
  }
}

TEST(LucyAtoms, ForceIsMinusTheGradientOfTheEnergy) {
  expect_force_is_minus_the_gradient(space::Box<1>({20.0}), 20);
  expect_force_is_minus_the_gradient(space::Box<2>({8.0, 8.0}, 0.0, 3.1), 64);
  expect_force_is_minus_the_gradient(space::Box<3>({6.5, 6.5, 6.5}, 0.0, -2.0), 40);
}

TEST(LucyAtoms, PressureIsMinusTheDerivativeOfTheEnergyByStrain) {
  const space::Vector<2> lengths{8.0, 7.0};
  const double offset = 2.7;
  const auto crowd = Crowd<2>::random(56, space::Box<2>(lengths, 0.0, offset), 0.5, 23);
  const pairs::Tensor<2> virial = evaluate(crowd).totals.virial;
  // r -> (1 + strain e_a e_b) r of everything: particles, box, images.
  const auto strained_energy = [&](int a, int b, double strain) {
    Crowd<2> moved = crowd;
    for (auto& r : moved.position) r[a] += strain * r[b];
    space::Vector<2> box = lengths;
    double slide = offset;
    if (a == b) box[a] *= 1.0 + strain;
    if (a == 0 && b == 0) slide *= 1.0 + strain;
    if (a == 0 && b == 1) slide += strain * lengths[1];
    moved.box = space::Box<2>(box, 0.0, slide);
    return energy_by_hand(moved);
  };
  constexpr double strain = 1e-6;
  for (const auto& [a, b] : {std::pair{0, 0}, {1, 1}, {0, 1}}) {
    const double slope = (strained_energy(a, b, strain) - strained_energy(a, b, -strain)) / (2.0 * strain);
    EXPECT_NEAR(virial(a, b), -slope, 1e-7) << a << b;
  }
}

TEST(LucyAtoms, ForcesAddUpToZeroAndTheQuickPassGivesTheSameShearStress) {
  const space::Box<2> box({32.0, 32.0}, 0.0, 11.0);
  const auto crowd = Crowd<2>::random(1024, box, 0.5, 24);
  const auto full = evaluate(crowd);
  const auto quick = evaluate(crowd, pairs::Wanted::shear_stress);
  space::Vector<2> total{};
  for (std::size_t i = 0; i < full.force.size(); ++i) {
    EXPECT_EQ(full.force[i], quick.force[i]);
    for (int d = 0; d < 2; ++d) total[d] += full.force[i][d];
  }
  EXPECT_NEAR(total[0], 0.0, 1e-12);
  EXPECT_NEAR(total[1], 0.0, 1e-12);
  EXPECT_EQ(full.totals.virial(0, 1), quick.totals.virial(0, 1));
  EXPECT_TRUE(std::isnan(quick.totals.potential_energy));
}

TEST(LucyAtoms, CoincidingParticlesGiveNoForceAndAFiniteEnergy) {
  const space::Box<2> box({12.0, 12.0});
  Crowd<2> crowd{box, {{5.0, 5.0}, {5.0, 5.0}}, {{0.0, 0.0}, {0.0, 0.0}}};
  const auto ours = evaluate(crowd);
  EXPECT_DOUBLE_EQ(ours.totals.potential_energy, kernel::Lucy<2>(range).weight_at_zero());
  EXPECT_EQ(ours.force[0], (space::Vector<2>{0.0, 0.0}));
}

}  // namespace
}  // namespace lucy::md
