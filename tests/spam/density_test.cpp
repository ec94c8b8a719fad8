// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/spam/density.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <variant>
#include <vector>

#include "slow_rates.hpp"

namespace lucy::spam {
namespace {

using pairs::testing::Arranged;
using pairs::testing::Crowd;

template <int D>
std::vector<double> densities_of(const kernel::Weight<D>& weight, const Crowd<D>& crowd, const Team& team = Team(1)) {
  Arranged<D> arranged(crowd);
  arranged.build(crowd, kernel::range_of<D>(weight), 0.0, 0.0, team);
  space::Columns density(1, arranged.list.capacity());
  pairs::KeptPairs slopes;
  densities<D>(weight, arranged.list, pairs::image_table(crowd.box, 0.0), Arranged<D>::pointers(arranged.position),
               density[0], slopes, team);
  std::vector<double> by_particle(crowd.position.size());
  for (std::size_t slot = 0; slot < arranged.number.size(); ++slot) {
    const auto number = arranged.number[slot];
    if (number != pairs::nobody) by_particle[static_cast<std::size_t>(number)] = density[0][slot];
  }
  return by_particle;
}

template <int D>
void expect_density_of_all_partners(int particles, const space::Box<D>& box, std::uint64_t seed) {
  const Crowd<D> crowd = Crowd<D>::random(particles, box, 1.0, seed);
  for (const auto name : {kernel::WeightName::lucy, kernel::WeightName::monaghan}) {
    const kernel::Weight<D> weight = kernel::make_weight<D>(name, 3.0);
    const double self = std::visit([](const auto& w) { return w.weight_at_zero(); }, weight);
    std::vector<double> expected(crowd.position.size(), self);
    pairs::testing::for_all_pairs<D>(
        box, crowd.position, 0.0, 3.0, [&](std::size_t i, std::size_t j, const auto& apart, const auto&) {
          double squared = 0.0;
          for (double component : apart) squared += component * component;
          const double w = std::visit([&](const auto& kernel) { return kernel.weight(std::sqrt(squared)); }, weight);
          expected[i] += w;
          expected[j] += w;
        });
    const std::vector<double> density = densities_of<D>(weight, crowd);
    for (std::size_t i = 0; i < density.size(); ++i) EXPECT_NEAR(density[i], expected[i], 1e-13 * expected[i]);
  }
}

TEST(Density, CountsEveryPartnerAndTheParticleItself) {
  expect_density_of_all_partners<1>(60, space::Box<1>({40.0}), 3);
  expect_density_of_all_partners<2>(200, space::Box<2>({12.0, 9.0}), 4);
  expect_density_of_all_partners<3>(200, space::Box<3>({7.0, 8.0, 9.0}), 5);
}

TEST(Density, CountsImagesWhereTheyHaveSlidTo) {
  for (const double offset : {-7.3, 0.4, 5.9}) {
    expect_density_of_all_partners<2>(200, space::Box<2>({12.0, 9.0}, 0.7, offset), 6);
    expect_density_of_all_partners<3>(150, space::Box<3>({7.0, 8.0, 6.5}, -0.7, offset), 7);
  }
}

TEST(Density, OfOneParticleAloneIsTheSelfTerm) {
  Crowd<2> crowd = Crowd<2>::random(1, space::Box<2>({20.0, 20.0}), 1.0, 8);
  for (const auto name : {kernel::WeightName::lucy, kernel::WeightName::monaghan}) {
    const kernel::Weight<2> weight = kernel::make_weight<2>(name, 3.0);
    EXPECT_EQ(densities_of<2>(weight, crowd)[0], std::visit([](const auto& w) { return w.weight_at_zero(); }, weight));
  }
}

TEST(Density, OfRandomParticlesIsTheNumberDensityAndTheSelfTermOnAverage) {
  constexpr int n = 20000;
  const space::Box<2> box({100.0, 100.0});
  const Crowd<2> crowd = Crowd<2>::random(n, box, 1.0, 9);
  const kernel::Weight<2> weight = kernel::Monaghan<2>(3.0);
  double sum = 0.0;
  for (const double rho : densities_of<2>(weight, crowd)) sum += rho;
  const double self = kernel::Monaghan<2>(3.0).weight_at_zero();
  // Variance of 2 sum_{i<j} w_ij/n over independent positions: 2 (n - 1)/n times that of w over the box.
  const double mean_square_weight = 2.0 * std::numbers::pi * [&] {
    double integral = 0.0;
    for (int k = 0; k < 3000; ++k) {
      const double r = 1e-3 * (k + 0.5);
      integral += 1e-3 * r * std::pow(kernel::Monaghan<2>(3.0).weight(r), 2);
    }
    return integral;
  }() / box.volume();
  EXPECT_NEAR(sum / n, self + (n - 1) / box.volume(), 4.0 * std::sqrt(2.0 * mean_square_weight));
}

}  // namespace
}  // namespace lucy::spam
