// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/spam/gradients.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "slow_rates.hpp"

namespace lucy::spam {
namespace {

using testing::Evaluated;
using testing::SmoothCrowd;

constexpr Transport newton_and_fourier{.viscosity = 1.0, .bulk_viscosity = 0.0, .conductivity = 1.0};

template <int D>
Fluid<D> gas(kernel::WeightName weight, double range, DensityMean mean = DensityMean::geometric) {
  return {kernel::make_weight<D>(weight, range), IdealGas(), newton_and_fourier, mean, {}};
}

constexpr std::array both_weights = {kernel::WeightName::lucy, kernel::WeightName::monaghan};
constexpr std::array both_means = {DensityMean::geometric, DensityMean::arithmetic};

template <int D>
void expect_slow_gradients(const space::Box<D>& box, double range, std::uint64_t seed) {
  SmoothCrowd<D> crowd = testing::lattice<D>(box, 0.4, seed);
  testing::make_noisy(crowd, 1.0, seed + 1);
  for (const auto weight : both_weights) {
    for (const auto mean : both_means) {
      const Fluid<D> fluid = gas<D>(weight, range, mean);
      const Evaluated<D> fast(fluid, crowd);
      const auto slow = testing::slow_rates(fluid, crowd);
      for (int b = 0; b < D; ++b) {
        for (int a = 0; a < D; ++a) {
          const auto gradient = fast.gradient(a * D + b);
          for (std::size_t i = 0; i < gradient.size(); ++i) {
            ASSERT_NEAR(gradient[i], slow.velocity_gradient[i](a, b), 1e-12)
                << "d v_" << a << "/d x_" << b << " of particle " << i;
          }
        }
        const auto gradient = fast.gradient(D * D + b);
        for (std::size_t i = 0; i < gradient.size(); ++i)
          ASSERT_NEAR(gradient[i], slow.temperature_gradient[i][b], 1e-12) << "d T/d x_" << b << " of particle " << i;
      }
    }
  }
}

/// What the rates use: of the velocity the lower triangle of the symmetric part.
template <int D>
void expect_slow_deformation(const space::Box<D>& box, double range, std::uint64_t seed) {
  SmoothCrowd<D> crowd = testing::lattice<D>(box, 0.4, seed);
  testing::make_noisy(crowd, 1.0, seed + 1);
  for (const auto weight : both_weights) {
    for (const auto mean : both_means) {
      const Fluid<D> fluid = gas<D>(weight, range, mean);
      const Evaluated<D> fast(fluid, crowd);
      const auto slow = testing::slow_rates(fluid, crowd);
      int column = 0;
      for (int a = 0; a < D; ++a) {
        for (int b = 0; b <= a; ++b) {
          const auto deformation = fast.by_particle(fast.fluid.deformation(), column++);
          for (std::size_t i = 0; i < deformation.size(); ++i) {
            const auto& gradient = slow.velocity_gradient[i];
            ASSERT_NEAR(deformation[i], a == b ? gradient(a, a) : gradient(a, b) + gradient(b, a), 2e-12)
                << a << b << " of particle " << i;
          }
        }
      }
      for (int b = 0; b < D; ++b) {
        const auto gradient = fast.by_particle(fast.fluid.deformation(), column++);
        for (std::size_t i = 0; i < gradient.size(); ++i)
          ASSERT_NEAR(gradient[i], slow.temperature_gradient[i][b], 1e-12) << "d T/d x_" << b << " of particle " << i;
      }
      ASSERT_EQ(column, fast.fluid.deformation().count());
    }
  }
}

TEST(Gradients, EqualSumsOverAllPartners) {
  expect_slow_gradients<1>(space::Box<1>({30.0}), 3.0, 21);
  expect_slow_gradients<2>(space::Box<2>({12.0, 9.0}), 3.0, 22);
  expect_slow_gradients<3>(space::Box<3>({6.0, 7.0, 6.0}), 2.5, 23);
}

TEST(Gradients, AreThoseOfLaboratoryVelocitiesInAShearedBox) {
  for (const auto& [rate, offset] : {std::array{-1.3, -31.7}, {0.6, 0.0}, {0.6, 4.4}}) {
    expect_slow_gradients<2>(space::Box<2>({12.0, 9.0}, rate, offset), 3.0, 24);
    expect_slow_gradients<3>(space::Box<3>({6.0, 5.0, 5.0}, rate, offset), 2.4, 25);
  }
}

TEST(Gradients, OfTheRatesAreTheSymmetricPartOfThatOfTheVelocityAndThatOfTheTemperature) {
  expect_slow_deformation<1>(space::Box<1>({30.0}), 3.0, 31);
  expect_slow_deformation<2>(space::Box<2>({12.0, 9.0}), 3.0, 32);
  expect_slow_deformation<2>(space::Box<2>({12.0, 9.0}, 0.6, 4.4), 3.0, 33);
  expect_slow_deformation<3>(space::Box<3>({6.0, 7.0, 6.0}, -1.3, -31.7), 2.5, 34);
}

template <int D>
void expect_no_gradient_of_constants(const space::Box<D>& box) {
  for (const auto weight : both_weights) {
    for (const auto mean : both_means) {
      SmoothCrowd<D> crowd = testing::lattice<D>(box, 0.4, 26);
      for (auto& velocity : crowd.velocity) velocity.fill(0.7);
      crowd.energy.assign(crowd.energy.size(), 1.3);
      const Evaluated<D> evaluated(gas<D>(weight, 2.5, mean), crowd);
      for (int c = 0; c < D * D + D; ++c)
        for (const double gradient : evaluated.gradient(c)) ASSERT_EQ(gradient, 0.0);
      for (int c = 0; c < evaluated.fluid.deformation().count(); ++c)
        for (const double rate : evaluated.by_particle(evaluated.fluid.deformation(), c)) ASSERT_EQ(rate, 0.0);
    }
  }
}

TEST(Gradients, OfConstantFieldsAreExactlyZero) {
  expect_no_gradient_of_constants<1>(space::Box<1>({30.0}));
  expect_no_gradient_of_constants<2>(space::Box<2>({12.0, 9.0}));
  expect_no_gradient_of_constants<3>(space::Box<3>({6.0, 7.0, 6.0}));
}

// The mean flow u_x = rate y of a sheared box, particles at rest in it, is a linear field without edges.
double linear_factor(kernel::WeightName weight, double range, DensityMean mean) {
  const SmoothCrowd<2> crowd = testing::lattice<2>(space::Box<2>({16.0, 16.0}, 0.25));
  const Evaluated<2> evaluated(gas<2>(weight, range, mean), crowd);
  const auto along_y = evaluated.gradient(1);
  for (const double gradient : along_y) EXPECT_NEAR(gradient, along_y[0], 1e-14);
  for (const int other : {0, 2, 3, 4, 5}) {
    for (const double gradient : evaluated.gradient(other)) EXPECT_NEAR(gradient, 0.0, 1e-14);
  }
  return along_y[0] / 0.25;
}

// Measured over true gradient of T = 1 + 0.1 sin(2 pi y/length), by projection.
double wave_factor(kernel::WeightName weight, double range, int length) {
  SmoothCrowd<2> crowd = testing::lattice<2>(space::Box<2>({16.0, static_cast<double>(length)}));
  const double k = 2.0 * std::numbers::pi / length;
  for (std::size_t i = 0; i < crowd.position.size(); ++i)
    crowd.energy[i] = 1.0 + 0.1 * std::sin(k * crowd.position[i][1]);
  const Evaluated<2> evaluated(gas<2>(weight, range), crowd);
  const auto gradient = evaluated.gradient(5);
  double product = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    const double truth = 0.1 * k * std::cos(k * crowd.position[i][1]);
    product += gradient[i] * truth;
    square += truth * truth;
  }
  return product / square;
}

TEST(Gradients, OfALatticeHaveAFactorThatNeitherTheMeanNorTheWavelengthAloneTakesToOne) {
  for (const auto mean : both_means) EXPECT_NEAR(linear_factor(kernel::WeightName::lucy, 3.0, mean), 0.99790, 5e-6);
  EXPECT_NEAR(wave_factor(kernel::WeightName::lucy, 3.0, 64), 0.99406, 5e-6);
  EXPECT_NEAR(wave_factor(kernel::WeightName::lucy, 3.0, 1024), 0.99790, 2e-5);  // the floor
  for (const auto weight : both_weights) {                                       // h over the spacing does
    EXPECT_NEAR(linear_factor(weight, 6.0, DensityMean::geometric), 1.0, 5e-4);
    EXPECT_NEAR(wave_factor(weight, 8.0, 1024), 1.0, 5e-4);
  }
}

TEST(Gradients, AreLinearInTheField) {
  SmoothCrowd<2> crowd = testing::lattice<2>(space::Box<2>({12.0, 9.0}), 0.3, 27);
  testing::make_noisy(crowd, 1.0, 28);
  SmoothCrowd<2> other = crowd;
  for (std::size_t i = 0; i < crowd.position.size(); ++i) {
    // v_x scaled, v_y with T added: gradients of T and v_y do not mix with others.
    other.velocity[i][0] = -2.0 * crowd.velocity[i][0];
    other.velocity[i][1] = crowd.velocity[i][1] + crowd.energy[i];
  }
  const Fluid<2> fluid = gas<2>(kernel::WeightName::monaghan, 3.0);
  const Evaluated<2> first(fluid, crowd);
  const Evaluated<2> second(fluid, other);
  for (int b = 0; b < 2; ++b) {
    const auto vx = first.gradient(b);
    const auto vy = first.gradient(2 + b);
    const auto temperature = first.gradient(4 + b);
    const auto scaled = second.gradient(b);
    const auto added = second.gradient(2 + b);
    for (std::size_t i = 0; i < vx.size(); ++i) {
      EXPECT_NEAR(scaled[i], -2.0 * vx[i], 1e-13);
      EXPECT_NEAR(added[i], vy[i] + temperature[i], 1e-13);
    }
  }
}

}  // namespace
}  // namespace lucy::spam
