// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/measure/smoothed_velocity.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lucy/spam/density.hpp"
#include "pairs/crowd.hpp"

namespace lucy::measure {
namespace {

using pairs::testing::Arranged;
using pairs::testing::Crowd;

constexpr double range = 3.0;

/// The smoothed velocities of a crowd, by slot.
template <int D>
struct Smoothed {
  Arranged<D> arranged;
  space::Columns density;
  space::Columns velocity;

  explicit Smoothed(const Crowd<D>& crowd, const Team& team = Team(1))
      : arranged(crowd), density(1, arranged.list.capacity()), velocity(D, arranged.list.capacity()) {
    arranged.build(crowd, range, 0.0, 0.0);
    const kernel::Lucy<D> kernel(range);
    const auto images = pairs::image_table(crowd.box, 0.0);
    const auto position = Arranged<D>::pointers(arranged.position);
    std::array<double*, D> smoothed;
    for (int d = 0; d < D; ++d) smoothed[d] = velocity[d];
    pairs::KeptPairs slopes;
    spam::densities<D>(kernel, arranged.list, images, position, density[0], slopes, team);
    smoothed_velocities<D>(kernel, arranged.list, images, position, Arranged<D>::pointers(arranged.velocity),
                           density[0], smoothed, team);
  }
};

template <int D>
void expect_mean_over_all_partners(const Crowd<D>& crowd) {
  const kernel::Lucy<D> kernel(range);
  const std::size_t count = crowd.position.size();
  std::vector<double> density(count, kernel.weight_at_zero());
  std::vector<space::Vector<D>> momentum(count);
  for (std::size_t i = 0; i < count; ++i)
    for (int d = 0; d < D; ++d) momentum[i][d] = kernel.weight_at_zero() * crowd.velocity[i][d];
  pairs::testing::for_all_pairs<D>(crowd.box, crowd.position, 0.0, range,
                                   [&](std::size_t i, std::size_t j, const auto& apart, const auto&) {
                                     double squared = 0.0;
                                     for (double component : apart) squared += component * component;
                                     const double weight = kernel.weight(std::sqrt(squared));
                                     density[i] += weight;
                                     density[j] += weight;
                                     for (int d = 0; d < D; ++d) {
                                       momentum[i][d] += weight * crowd.velocity[j][d];
                                       momentum[j][d] += weight * crowd.velocity[i][d];
                                     }
                                   });
  const Smoothed<D> smoothed(crowd);
  for (std::size_t slot = 0; slot < smoothed.arranged.number.size(); ++slot) {
    const std::int32_t number = smoothed.arranged.number[slot];
    for (int d = 0; d < D; ++d) {
      if (number == pairs::nobody) {
        EXPECT_EQ(smoothed.velocity[d][slot], 0.0);
      } else {
        const auto i = static_cast<std::size_t>(number);
        EXPECT_NEAR(smoothed.velocity[d][slot], momentum[i][d] / density[i], 1e-13) << i;
      }
    }
  }
}

TEST(SmoothedVelocity, IsTheWeightedMeanOverAllPartnersAndTheParticleItself) {
  expect_mean_over_all_partners<1>(Crowd<1>::random(60, space::Box<1>({40.0}), 1.0, 3));
  expect_mean_over_all_partners<2>(Crowd<2>::random(200, space::Box<2>({12.0, 9.0}), 1.0, 4));
  expect_mean_over_all_partners<3>(Crowd<3>::random(400, space::Box<3>({7.0, 8.0, 9.0}), 1.0, 5));
}

// Images above and below have the peculiar velocity of their owner, however fast they slide.
TEST(SmoothedVelocity, LeavesOutTheMeanFlow) {
  expect_mean_over_all_partners<2>(Crowd<2>::random(200, space::Box<2>({12.0, 9.0}, 0.7, 4.3), 1.0, 6));
}

TEST(SmoothedVelocity, OfACommonVelocityIsThatVelocity) {
  Crowd<2> crowd = Crowd<2>::random(200, space::Box<2>({12.0, 9.0}), 1.0, 7);
  for (auto& velocity : crowd.velocity) velocity = {0.3, -1.25};
  const Smoothed<2> smoothed(crowd);
  for (std::size_t slot = 0; slot < smoothed.arranged.number.size(); ++slot) {
    if (smoothed.arranged.number[slot] == pairs::nobody) continue;
    EXPECT_NEAR(smoothed.velocity[0][slot], 0.3, 1e-14);
    EXPECT_NEAR(smoothed.velocity[1][slot], -1.25, 1e-14);
  }
}

TEST(SmoothedVelocity, DoesNotDependOnTheNumberOfThreads) {
  const Crowd<2> crowd = Crowd<2>::random(3600, space::Box<2>({60.0, 60.0}), 1.0, 8);
  const Smoothed<2> alone(crowd, Team(1));
  const Smoothed<2> shared(crowd, Team(3));
  for (std::size_t slot = 0; slot < alone.arranged.number.size(); ++slot)
    for (int d = 0; d < 2; ++d)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(alone.velocity[d][slot]),
                std::bit_cast<std::uint64_t>(shared.velocity[d][slot]));
}

}  // namespace
}  // namespace lucy::measure
