// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/spam/equation_of_state.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

namespace lucy::spam {
namespace {

/// (f(x + d) - f(x - d))/(2 d), of third order in the two widths d and d/2.
template <class F>
double derivative(const F& f, double x) {
  const auto central = [&](double d) { return (f(x + d) - f(x - d)) / (2.0 * d); };
  const double d = 1e-3;
  return (4.0 * central(0.5 * d) - central(d)) / 3.0;
}

// P/rho^2 = P0/(2 rho0^2) exactly, whatever the density: the heart of the isomorphism.
TEST(Isentropic, ItsSpecificPressureIsOneHalfInEveryBit) {
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> exponent(-30.0, 30.0);
  const Isentropic unit;
  const Isentropic other(4.0, 0.5);
  for (int i = 0; i < 100000; ++i) {
    const double rho = std::exp(exponent(generator));
    EXPECT_EQ(bits(unit.pressure(rho) / (rho * rho)), bits(0.5));
    EXPECT_EQ(bits(other.pressure(rho) / (rho * rho)), bits(8.0));
  }
}

TEST(Isentropic, RefusesConstantsThatAreNoPowersOfTwo) {
  EXPECT_THROW(Isentropic(3.0, 1.0), BadInput);
  EXPECT_THROW(Isentropic(1.0, -2.0), BadInput);
  EXPECT_THROW(Isentropic(0.0, 1.0), BadInput);
  EXPECT_THROW(Isentropic(1.0, INFINITY), BadInput);
}

TEST(Isentropic, EnergyIsThePressuresWork) {
  const Isentropic state(2.0, 0.5);
  for (const double rho : {0.3, 1.0, 4.0}) {
    const double slope = derivative([&](double density) { return state.energy(density); }, rho);
    EXPECT_NEAR(slope, state.pressure(rho) / (rho * rho), 1e-9 * slope);
  }
}

// e = rho/2 and P = rho^2/2 = rho e: the ideal gas's relation along one of its isentropes.
TEST(Isentropic, IsAnIdealGasOfTwoDimensionsAtConstantEntropy) {
  const Isentropic fluid;
  const IdealGas gas;
  const double entropy = gas.entropy(1.0, fluid.energy(1.0));
  for (const double rho : {0.2, 1.0, 3.0}) {
    EXPECT_NEAR(fluid.pressure(rho), gas.pressure(rho, fluid.energy(rho)), 1e-15 * rho * rho);
    EXPECT_NEAR(gas.entropy(rho, fluid.energy(rho)), entropy, 1e-15);
  }
}

TEST(IdealGas, HasPressureDensityTimesEnergy) {
  const IdealGas gas;
  EXPECT_EQ(gas.pressure(2.0, 3.0), 6.0);
  EXPECT_EQ(gas.temperature(2.0, 3.0), 3.0);
  EXPECT_EQ(gas.energy(2.0, 3.0), 3.0);
}

TEST(VanDerWaals, HasTheValuesOfItsDefinition) {
  const VanDerWaals fluid;
  // rho = 1, kT = 1: rho kT/(1 - b rho) - a rho^2 = 2 - 1/2, e = 1 - 1/2.
  EXPECT_DOUBLE_EQ(fluid.energy(1.0, 1.0), 0.5);
  EXPECT_DOUBLE_EQ(fluid.pressure(1.0, 0.5), 1.5);
  EXPECT_DOUBLE_EQ(fluid.pressure(0.5, fluid.energy(0.5, 2.0)), 0.5 * 2.0 / 0.75 - 0.125);
}

TEST(VanDerWaals, HasItsCriticalPointWhereTheTextbooksHaveIt) {
  // rho_c = 1/(3 b), kT_c = 8 a/(27 b), P_c = a/(27 b^2): there the isotherm is flat, and its bend zero.
  constexpr double a = VanDerWaals::attraction;
  constexpr double b = VanDerWaals::excluded;
  const double critical_density = 1.0 / (3.0 * b);
  const double critical_temperature = 8.0 * a / (27.0 * b);
  const VanDerWaals fluid;
  const auto isotherm = [&](double density) {
    return fluid.pressure(density, fluid.energy(density, critical_temperature));
  };
  EXPECT_NEAR(isotherm(critical_density), a / (27.0 * b * b), 1e-15);
  EXPECT_NEAR(derivative(isotherm, critical_density), 0.0, 1e-10);
  EXPECT_NEAR(derivative([&](double density) { return derivative(isotherm, density); }, critical_density), 0.0, 1e-8);
}

template <class State>
struct Consistent : testing::Test {};
using ConsistentStates = testing::Types<IdealGas, VanDerWaals>;
TYPED_TEST_SUITE(Consistent, ConsistentStates);

TYPED_TEST(Consistent, EnergyAndTemperatureAreEachOthersInverses) {
  const TypeParam state;
  for (const double rho : {0.1, 0.7, 1.0, 1.6}) {
    for (const double kT : {0.3, 1.0, 10.0}) {
      EXPECT_NEAR(state.temperature(rho, state.energy(rho, kT)), kT, 1e-15 * (kT + rho));
    }
  }
}

// de = T ds - P d(1/rho), along the energy and along the density.
TYPED_TEST(Consistent, EntropyGivesTemperatureAndPressure) {
  const TypeParam state;
  for (const double rho : {0.3, 1.0, 1.6}) {
    for (const double kT : {0.5, 1.0, 4.0}) {
      const double e = state.energy(rho, kT);
      const double by_energy = derivative([&](double energy) { return state.entropy(rho, energy); }, e);
      const double by_volume = derivative([&](double volume) { return state.entropy(1.0 / volume, e); }, 1.0 / rho);
      EXPECT_NEAR(by_energy * kT, 1.0, 1e-9);
      EXPECT_NEAR(by_volume * kT, state.pressure(rho, e), 1e-8 * (1.0 + kT));
    }
  }
}

/// rho^2 (de/drho)_T - (P - T (dP/dT)_rho): zero where P and e follow from one free energy.
template <class State>
double inconsistency(double rho, double kT) {
  const State state;
  const auto pressure = [&](double temperature) { return state.pressure(rho, state.energy(rho, temperature)); };
  const double by_density = derivative([&](double density) { return state.energy(density, kT); }, rho);
  return rho * rho * by_density - (pressure(kT) - kT * derivative(pressure, kT));
}

TYPED_TEST(Consistent, PressureAndEnergyFollowFromOneFreeEnergy) {
  EXPECT_NEAR(inconsistency<TypeParam>(1.0, 1.0), 0.0, 1e-9);
  EXPECT_NEAR(inconsistency<TypeParam>(0.4, 2.0), 0.0, 1e-9);
}

TEST(DenseFluid, HasThePublishedValuesInItsMiddle) {
  const DenseFluid fluid;
  EXPECT_DOUBLE_EQ(fluid.pressure(1.0, 1.443), 5.0);
  EXPECT_DOUBLE_EQ(fluid.temperature(1.0, 1.443), 1.0);
  EXPECT_DOUBLE_EQ(fluid.energy(1.0, 1.0), 1.443);
  EXPECT_NEAR(fluid.energy(1.0, 1.1), 1.443 + 0.15, 1e-15);
  // Off the middle, term by term: dn = 0.1, du = 0.2.
  EXPECT_NEAR(fluid.pressure(1.1, 1.643), 1.1 * (5.0 + 0.8 + 0.5 + 0.09 + 0.04), 1e-14);
  EXPECT_NEAR(fluid.temperature(1.1, 1.643), 1.0 - 0.1 + 0.14 - 0.008 - 0.01, 1e-15);
  EXPECT_NEAR(fluid.energy(1.1, 1.2), 1.443 + 0.15 + 0.3 + 0.024 + 0.024, 1e-15);
}

// As published: see the head of equation_of_state.hpp.
TEST(DenseFluid, IsNeitherExactlyInvertibleNorThermodynamicallyConsistent) {
  const DenseFluid fluid;
  EXPECT_EQ(fluid.temperature(1.0, fluid.energy(1.0, 1.0)), 1.0);
  for (const double dT : {-0.5, 0.5}) {
    const double error = fluid.temperature(1.0, fluid.energy(1.0, 1.0 + dT)) - (1.0 + dT);
    EXPECT_NEAR(error, 0.05 * dT, 1e-12);  // 0.7 times 1.5 is 1.05
  }
  EXPECT_NEAR(inconsistency<DenseFluid>(1.0, 1.0), 0.25, 1e-6);  // 1.5 - (5 - 2.5 times 1.5)
  EXPECT_FALSE(DenseFluid::has_entropy);
}

// The gravity that keeps the density uniform under a temperature difference: dP/dy = -rho g (KHP, Sec. V).
TEST(EquationOfState, PressureRisesWithTemperatureAsThePublishedGravitiesSay) {
  const auto rise = [](const auto& state) {
    return derivative([&](double kT) { return state.pressure(1.0, state.energy(1.0, kT)); }, 1.0);
  };
  EXPECT_NEAR(rise(IdealGas()), 1.0, 1e-9);
  EXPECT_NEAR(rise(VanDerWaals()), 2.0, 1e-9);
  EXPECT_NEAR(rise(DenseFluid()), 3.75, 1e-9);
}

TEST(EquationOfState, IsMadeByItsNameInInputFiles) {
  for (const auto& [name, which] : equation_of_state_names) {
    const EquationOfState state = make_equation_of_state(which);
    EXPECT_EQ(state.index(), static_cast<std::size_t>(which)) << name;
    EXPECT_EQ(has_temperature(state), name != "isentropic") << name;
  }
}

}  // namespace
}  // namespace lucy::spam
