// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/md/heat_flux.hpp"

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
HeatFlux<D> evaluate(const Crowd<D>& crowd, const Team& team = Team(1)) {
  Arranged<D> arranged(crowd);
  arranged.build(crowd, range, 0.0, 0.0, team);
  return heat_flux<D>(kernel::Lucy<D>(range), arranged.list, pairs::image_table(crowd.box, 0.0),
                      Arranged<D>::pointers(arranged.position), Arranged<D>::pointers(arranged.velocity), team);
}

template <int D>
double dot(const space::Vector<D>& a, const space::Vector<D>& b) {
  double sum = 0.0;
  for (int d = 0; d < D; ++d) sum += a[d] * b[d];
  return sum;
}

template <int D>
Crowd<D> crowd_at_rest(int particles, const space::Box<D>& box, std::uint64_t seed) {
  Crowd<D> crowd = Crowd<D>::random(particles, box, 0.8, seed);
  for (int d = 0; d < D; ++d) {
    double mean = 0.0;
    for (const auto& v : crowd.velocity) mean += v[d] / particles;
    for (auto& v : crowd.velocity) v[d] -= mean;
  }
  return crowd;
}

template <int D>
void expect_sums_by_hand(int particles, const space::Box<D>& box, std::uint64_t seed) {
  const Crowd<D> crowd = crowd_at_rest<D>(particles, box, seed);
  const kernel::Lucy<D> kernel(range);
  HeatFlux<D> expected;
  for (const auto& v : crowd.velocity) {
    for (int d = 0; d < D; ++d) expected.kinetic[d] += 0.5 * dot<D>(v, v) * v[d];
  }
  for_all_pairs<D>(box, crowd.position, 0.0, range,
                   [&](std::size_t i, std::size_t j, const space::Vector<D>& apart, const auto&) {
                     const double distance = std::sqrt(dot<D>(apart, apart));
                     space::Vector<D> sum;
                     for (int d = 0; d < D; ++d) sum[d] = crowd.velocity[i][d] + crowd.velocity[j][d];
                     const double power = kernel.slope(distance) * dot<D>(apart, sum) / 2.0;
                     for (int d = 0; d < D; ++d) {
                       expected.potential[d] += kernel.weight(distance) * sum[d] / 2.0;
                       expected.work[d] += apart[d] * power;
                     }
                   });
  const HeatFlux<D> ours = evaluate(crowd);
  for (int d = 0; d < D; ++d) {
    EXPECT_NEAR(ours.kinetic[d], expected.kinetic[d], 1e-11);
    EXPECT_NEAR(ours.potential[d], expected.potential[d], 1e-11);
    EXPECT_NEAR(ours.work[d], expected.work[d], 1e-11);
    EXPECT_DOUBLE_EQ(ours.total(d), ours.kinetic[d] + ours.potential[d] + ours.work[d]);
  }
}

TEST(HeatFlux, EqualsASumOverImages) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    expect_sums_by_hand<1>(30, space::Box<1>({21.0}), seed);
    expect_sums_by_hand<2>(131, space::Box<2>({11.0, 12.0}), seed);
    expect_sums_by_hand<3>(90, space::Box<3>({7.0, 8.0, 6.5}), seed);
  }
}

// J V in a frame that moves with -u: every particle carries its energy along, and pressure works at the speed u,
//     J' V = J V + (K + Phi + N u^2/2) u + P V . u
template <int D>
void expect_the_boost_of_galilei(const Crowd<D>& crowd, const space::Vector<D>& u) {
  Crowd<D> boosted = crowd;
  for (auto& v : boosted.velocity) {
    for (int d = 0; d < D; ++d) v[d] += u[d];
  }
  const kernel::Lucy<D> kernel(range);
  double energy = 0.5 * static_cast<double>(crowd.velocity.size()) * dot<D>(u, u);
  space::Vector<D> pressure_work{};
  for (const auto& v : crowd.velocity) {
    energy += 0.5 * dot<D>(v, v);
    for (int d = 0; d < D; ++d) pressure_work[d] += v[d] * dot<D>(v, u);
  }
  for_all_pairs<D>(crowd.box, crowd.position, 0.0, range,
                   [&](std::size_t, std::size_t, const space::Vector<D>& apart, const auto&) {
                     const double distance = std::sqrt(dot<D>(apart, apart));
                     energy += kernel.weight(distance);
                     for (int d = 0; d < D; ++d)
                       pressure_work[d] += kernel.slope(distance) * apart[d] * dot<D>(apart, u);
                   });
  const HeatFlux<D> at_rest = evaluate(crowd);
  const HeatFlux<D> moving = evaluate(boosted);
  for (int d = 0; d < D; ++d)
    EXPECT_NEAR(moving.total(d), at_rest.total(d) + energy * u[d] + pressure_work[d], 1e-10 * energy);
}

TEST(HeatFlux, GainsTheEnthalpyOfAFlow) {
  expect_the_boost_of_galilei<2>(crowd_at_rest<2>(100, space::Box<2>({10.0, 10.0}), 6), {0.7, -0.3});
  expect_the_boost_of_galilei<3>(crowd_at_rest<3>(80, space::Box<3>({7.0, 7.0, 7.0}), 7), {0.2, 0.5, -1.1});
}

// d/dt sum_i r_i e_i = J V for particles that do not meet the edges of their box.
template <int D>
void expect_the_rate_of_the_energy_moment(std::uint64_t seed) {
  constexpr int particles = 12;
  space::Vector<D> lengths;
  lengths.fill(20.0);
  space::Vector<D> small;
  small.fill(3.0);
  Crowd<D> cluster = crowd_at_rest<D>(particles, space::Box<D>(small), seed);
  cluster.box = space::Box<D>(lengths);
  for (auto& r : cluster.position) {
    for (double& x : r) x += 8.0;
  }
  const kernel::Lucy<D> kernel(range);
  const auto for_pairs = [&](const Crowd<D>& crowd, const auto& visit) {
    for_all_pairs<D>(crowd.box, crowd.position, 0.0, range,
                     [&](std::size_t i, std::size_t j, const space::Vector<D>& apart, const auto&) {
                       visit(i, j, apart, std::sqrt(dot<D>(apart, apart)));
                     });
  };
  const auto kick = [&](Crowd<D>& crowd, double time) {
    for_pairs(crowd, [&](std::size_t i, std::size_t j, const space::Vector<D>& apart, double distance) {
      for (int d = 0; d < D; ++d) {
        const double force = kernel.slope(distance) * apart[d];
        crowd.velocity[i][d] += time * force;
        crowd.velocity[j][d] -= time * force;
      }
    });
  };
  const auto energy_moment_after = [&](double time) {
    Crowd<D> crowd = cluster;
    kick(crowd, time / 2.0);
    for (std::size_t i = 0; i < particles; ++i) {
      for (int d = 0; d < D; ++d) crowd.position[i][d] += time * crowd.velocity[i][d];
    }
    kick(crowd, time / 2.0);
    space::Vector<D> moment{};
    for (std::size_t i = 0; i < particles; ++i) {
      for (int d = 0; d < D; ++d)
        moment[d] += crowd.position[i][d] * 0.5 * dot<D>(crowd.velocity[i], crowd.velocity[i]);
    }
    for_pairs(crowd, [&](std::size_t i, std::size_t j, const space::Vector<D>&, double distance) {
      for (int d = 0; d < D; ++d)
        moment[d] += 0.5 * kernel.weight(distance) * (crowd.position[i][d] + crowd.position[j][d]);
    });
    return moment;
  };
  constexpr double step = 1e-4;
  const auto later = energy_moment_after(step);
  const auto earlier = energy_moment_after(-step);
  const HeatFlux<D> ours = evaluate(cluster);
  for (int d = 0; d < D; ++d) {
    EXPECT_NEAR(ours.total(d), (later[d] - earlier[d]) / (2.0 * step), 1e-7);
    EXPECT_GT(std::abs(ours.work[d]), 1e-3) << "a test of nothing";
  }
}

TEST(HeatFlux, IsTheRateOfChangeOfTheEnergyMoment) {
  expect_the_rate_of_the_energy_moment<2>(8);
  expect_the_rate_of_the_energy_moment<3>(9);
}

TEST(HeatFlux, GivesTheSameBitsForEveryTeam) {
  const Crowd<2> crowd = crowd_at_rest<2>(5000, space::Box<2>({70.0, 72.0}), 10);
  const HeatFlux<2> alone = evaluate(crowd);
  for (const int threads : {2, 3}) {
    const HeatFlux<2> together = evaluate(crowd, Team(threads));
    EXPECT_EQ(together.kinetic, alone.kinetic);
    EXPECT_EQ(together.potential, alone.potential);
    EXPECT_EQ(together.work, alone.work);
  }
}

}  // namespace
}  // namespace lucy::md
