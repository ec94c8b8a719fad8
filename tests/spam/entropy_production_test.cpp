// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/spam/entropy_production.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "lucy/errors.hpp"
#include "slow_rates.hpp"

namespace lucy::spam {
namespace {

using testing::Evaluated;
using testing::SmoothCrowd;

constexpr Transport all_transport{.viscosity = 0.8, .bulk_viscosity = 0.5, .conductivity = 0.6};

/// By particle: through viscosity, through conduction.
template <int D>
std::array<std::vector<double>, 2> produced(const Fluid<D>& fluid, const SmoothCrowd<D>& crowd) {
  const Evaluated<D> evaluated(fluid, crowd);
  const space::Columns columns = evaluated.fluid.entropy_production(evaluated.particles(), Team(1));
  return {evaluated.by_particle(columns, 0), evaluated.by_particle(columns, 1)};
}

double sum(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result += value;
  return result;
}

double least(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

/// sum_i (e' with the transport - e' without)_i / T_i.
template <int D>
double entropy_by_heating(const Transport& transport, const Fluid<D>& like, const SmoothCrowd<D>& crowd) {
  Fluid<D> fluid = like;
  fluid.transport = transport;
  const Evaluated<D> with(fluid, crowd);
  fluid.transport = {};
  const Evaluated<D> without(fluid, crowd);
  const auto heated = with.energy_rate();
  const auto inviscid = without.energy_rate();
  const auto temperature = with.by_particle(with.fluid.temperature());
  double result = 0.0;
  for (std::size_t i = 0; i < heated.size(); ++i) result += (heated[i] - inviscid[i]) / temperature[i];
  return result;
}

template <int D>
void expect_totals_of_the_heating(const SmoothCrowd<D>& crowd) {
  const double tolerance = 1e-13 * static_cast<double>(crowd.position.size());
  for (const auto mean : {DensityMean::geometric, DensityMean::arithmetic}) {
    const Fluid<D> fluid{kernel::Monaghan<D>(2.4), VanDerWaals(), all_transport, mean, {}};
    const auto [viscous, conductive] = produced(fluid, crowd);
    EXPECT_NEAR(
        sum(viscous),
        entropy_by_heating<D>(
            {.viscosity = all_transport.viscosity, .bulk_viscosity = all_transport.bulk_viscosity, .conductivity = 0.0},
            fluid, crowd),
        tolerance);
    EXPECT_NEAR(
        sum(conductive),
        entropy_by_heating<D>({.viscosity = 0.0, .bulk_viscosity = 0.0, .conductivity = all_transport.conductivity},
                              fluid, crowd),
        tolerance);
    EXPECT_GT(std::abs(sum(viscous)) + std::abs(sum(conductive)), 1e3 * tolerance);
  }
}

TEST(EntropyProduction, TotalsAreTheHeatOverTheTemperature) {
  SmoothCrowd<1> chain = testing::lattice<1>(space::Box<1>({40.0}), 0.2, 61);
  testing::make_noisy(chain, 0.3, 62);
  expect_totals_of_the_heating(chain);
  for (const double rate : {0.0, 0.5}) {
    SmoothCrowd<2> plane = testing::lattice<2>(space::Box<2>({16.0, 14.0}, rate, 3.3), 0.2, 63);
    testing::make_noisy(plane, 0.3, 64);
    expect_totals_of_the_heating(plane);
    SmoothCrowd<3> space = testing::lattice<3>(space::Box<3>({6.0, 6.0, 7.0}, -rate, 1.7), 0.2, 65);
    testing::make_noisy(space, 0.3, 66);
    expect_totals_of_the_heating(space);
  }
}

/// Total over that of the continuum, eta <(grad v)^2>/T and kappa <(grad T)^2>/T^2, and the least over the mean.
struct Production {
  double total;
  double least;
};
std::array<Production, 2> of_waves(kernel::WeightName weight, double length, double offset) {
  SmoothCrowd<2> crowd = testing::lattice<2>(space::Box<2>({length, length}), offset, 67);
  testing::make_wavy(crowd, 0.1, 0.1);
  const auto parts = produced<2>({kernel::make_weight<2>(weight, 3.0), IdealGas(), all_transport, {}, {}}, crowd);
  const double square = std::pow(0.1 * 2.0 * std::numbers::pi / length, 2);  // of either gradient, on average
  const double n = length * length;
  return {Production{sum(parts[0]) / (n * all_transport.viscosity * square), n * least(parts[0]) / sum(parts[0])},
          Production{sum(parts[1]) / (n * all_transport.conductivity * square), n * least(parts[1]) / sum(parts[1])}};
}

TEST(EntropyProduction, OfSmoothFieldsIsPositiveInTotalAndThatOfTheContinuum) {
  for (const double offset : {0.0, 0.1, 0.3}) {
    for (const auto weight : {kernel::WeightName::lucy, kernel::WeightName::monaghan}) {
      for (const Production& part : of_waves(weight, 32.0, offset))
        EXPECT_NEAR(part.total, 1.0, 0.15) << "offset " << offset;
    }
  }
}

// Where a gradient vanishes stress and heating do not see the same zero; it is a matter of (h/length)^2.
TEST(EntropyProduction, OfSmoothFieldsOnALatticeIsPositiveEverywhereTheFinerTheTruer) {
  for (const auto weight : {kernel::WeightName::lucy, kernel::WeightName::monaghan}) {
    const auto coarse = of_waves(weight, 32.0, 0.0);
    const auto fine = of_waves(weight, 64.0, 0.0);
    for (std::size_t part = 0; part < 2; ++part) {
      EXPECT_GT(coarse[part].least, -0.05);
      EXPECT_GT(fine[part].least, std::min(0.3 * coarse[part].least, -1e-6));
    }
  }
}

// Stress and heating see different discrete gradients, and on noise that is seen particle by particle.
TEST(EntropyProduction, OfNoiseIsPositiveInTotalWhereSingleParticlesLose) {
  SmoothCrowd<2> crowd = testing::lattice<2>(space::Box<2>({32.0, 32.0}), 0.3, 68);
  testing::make_noisy(crowd, 0.5, 69);
  const auto [viscous, conductive] = produced<2>({kernel::Lucy<2>(3.0), IdealGas(), all_transport, {}, {}}, crowd);
  EXPECT_GT(sum(viscous), 0.0);
  EXPECT_GT(sum(conductive), 0.0);
  EXPECT_LT(least(viscous), 0.0);
  EXPECT_LT(least(conductive), 0.0);
}

TEST(EntropyProduction, OfAFluidThatMovesAsOneIsZero) {
  SmoothCrowd<2> crowd = testing::lattice<2>(space::Box<2>({16.0, 14.0}), 0.3, 70);
  for (auto& velocity : crowd.velocity) velocity = {0.7, -1.1};
  const auto [viscous, conductive] = produced<2>({kernel::Lucy<2>(3.0), IdealGas(), all_transport, {}, {}}, crowd);
  for (const double value : viscous) EXPECT_EQ(value, 0.0);
  for (const double value : conductive) EXPECT_EQ(value, 0.0);
}

TEST(EntropyProduction, OfAFluidWithoutTransportIsZero) {
  SmoothCrowd<2> crowd = testing::lattice<2>(space::Box<2>({16.0, 14.0}), 0.3, 71);
  testing::make_noisy(crowd, 0.5, 72);
  const auto [viscous, conductive] = produced<2>({kernel::Lucy<2>(3.0), IdealGas(), {}, {}, {}}, crowd);
  for (const double value : viscous) EXPECT_EQ(value, 0.0);
  for (const double value : conductive) EXPECT_EQ(value, 0.0);
}

TEST(EntropyProduction, NeedsATemperature) {
  const SmoothCrowd<2> crowd = testing::lattice<2>(space::Box<2>({16.0, 14.0}));
  EXPECT_THROW(produced<2>({kernel::Lucy<2>(3.0), Isentropic(), {.viscosity = 1.0}, {}, {}}, crowd), BadInput);
}

}  // namespace
}  // namespace lucy::spam
