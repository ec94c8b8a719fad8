// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/spam/smooth_particles.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "lucy/errors.hpp"
#include "lucy/md/lucy_atoms.hpp"
#include "slow_rates.hpp"

namespace lucy::spam {
namespace {

using testing::Evaluated;
using testing::SmoothCrowd;

constexpr Transport all_transport{.viscosity = 0.8, .bulk_viscosity = 0.5, .conductivity = 0.6};
constexpr std::array both_weights = {kernel::WeightName::lucy, kernel::WeightName::monaghan};
constexpr std::array both_means = {DensityMean::geometric, DensityMean::arithmetic};
constexpr std::array all_states = {EquationOfStateName::isentropic, EquationOfStateName::ideal_gas,
                                   EquationOfStateName::van_der_waals, EquationOfStateName::dense_fluid};

template <int D>
space::Vector<D> downwards(double g) {
  space::Vector<D> gravity{};
  gravity[D - 1] = -g;
  return gravity;
}

template <int D>
SmoothCrowd<D> disordered(const space::Box<D>& box, std::uint64_t seed) {
  SmoothCrowd<D> crowd = testing::lattice<D>(box, 0.3, seed);
  testing::make_noisy(crowd, 0.7, seed + 1);
  return crowd;
}

double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

double sum(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result += value;
  return result;
}

template <int D>
void expect_slow_rates(const Fluid<D>& fluid, const SmoothCrowd<D>& crowd) {
  const Evaluated<D> fast(fluid, crowd);
  const auto slow = testing::slow_rates(fluid, crowd);
  const std::size_t n = crowd.position.size();
  const auto density = fast.by_particle(fast.fluid.density());
  const auto pressure = fast.by_particle(fast.fluid.pressure());
  const auto temperature = fast.by_particle(fast.fluid.temperature());
  const auto energy_rate = fast.energy_rate();
  const double most = largest(energy_rate);
  for (std::size_t i = 0; i < n; ++i) {
    ASSERT_NEAR(density[i], slow.density[i], 1e-13);
    ASSERT_NEAR(pressure[i], slow.pressure[i], 1e-12);
    ASSERT_NEAR(temperature[i], slow.temperature[i], 1e-12);
    ASSERT_NEAR(energy_rate[i], slow.energy_rate[i], 1e-12 * most) << "particle " << i;
  }
  for (int d = 0; d < D; ++d) {
    const auto acceleration = fast.acceleration(d);
    const double strongest = largest(acceleration);
    for (std::size_t i = 0; i < n; ++i)
      ASSERT_NEAR(acceleration[i], slow.acceleration[i][d], 1e-12 * strongest) << "particle " << i;
  }
  EXPECT_NEAR(fast.fluid.virial_xy(), slow.virial_xy, 1e-11 * static_cast<double>(n));

  double viscous = 0.0;
  if constexpr (D > 1) {
    for (std::size_t i = 0; i < n; ++i) {
      const auto& gradient = slow.velocity_gradient[i];
      viscous -= fluid.transport.viscosity * (gradient(0, 1) + gradient(1, 0)) / slow.density[i];
    }
  }
  EXPECT_NEAR(fast.fluid.viscous_stress_xy(fast.arranged.number.size()), viscous, 1e-11 * static_cast<double>(n));
}

template <int D>
void expect_slow_rates_of_every_fluid(const SmoothCrowd<D>& crowd, double range) {
  for (const auto weight : both_weights) {
    for (const auto mean : both_means) {
      const Fluid<D> fluid{kernel::make_weight<D>(weight, range), VanDerWaals(), all_transport, mean,
                           downwards<D>(0.3)};
      expect_slow_rates(fluid, crowd);
    }
    Fluid<D> inviscid{kernel::make_weight<D>(weight, range), IdealGas(), {}, {}, {}};
    expect_slow_rates(inviscid, crowd);
  }
  for (const auto state : all_states) {
    Transport transport = all_transport;
    if (state == EquationOfStateName::isentropic) transport.conductivity = 0.0;
    expect_slow_rates<D>({kernel::Lucy<D>(range), make_equation_of_state(state), transport, {}, downwards<D>(1.0)},
                         crowd);
  }
}

TEST(SmoothParticles, HaveTheRatesOfTheTensorEquations) {
  expect_slow_rates_of_every_fluid(disordered<1>(space::Box<1>({30.0}), 41), 3.0);
  expect_slow_rates_of_every_fluid(disordered<2>(space::Box<2>({12.0, 9.0}), 42), 3.0);
  expect_slow_rates_of_every_fluid(disordered<3>(space::Box<3>({5.0, 6.0, 5.0}), 43), 2.4);
}

TEST(SmoothParticles, HaveTheRatesOfTheTensorEquationsInAShearedBox) {
  for (const double offset : {-29.3, 5.2}) {
    expect_slow_rates_of_every_fluid(disordered<2>(space::Box<2>({12.0, 9.0}, 0.6, offset), 44), 3.0);
    expect_slow_rates_of_every_fluid(disordered<3>(space::Box<3>({5.0, 6.0, 5.0}, -0.9, offset), 45), 2.4);
  }
}

// A crowd that lies nowhere near a lattice, where densities differ by a factor of five.
TEST(SmoothParticles, HaveTheRatesOfTheTensorEquationsWhereParticlesCrowd) {
  SmoothCrowd<2> crowd;
  static_cast<pairs::testing::Crowd<2>&>(crowd) =
      pairs::testing::Crowd<2>::random(120, space::Box<2>({12.0, 11.0}, 0.4, 3.3), 0.8, 46);
  crowd.energy.assign(120, 1.0);
  for (const auto weight : both_weights) {
    for (const auto mean : both_means)
      expect_slow_rates<2>({kernel::make_weight<2>(weight, 2.0), IdealGas(), all_transport, mean, {}}, crowd);
  }
}

template <int D>
void expect_conservation(const SmoothCrowd<D>& crowd, double range) {
  const double n = static_cast<double>(crowd.position.size());
  for (const auto weight : both_weights) {
    for (const auto mean : both_means) {
      const Fluid<D> fluid{kernel::make_weight<D>(weight, range), VanDerWaals(), all_transport, mean,
                           downwards<D>(0.3)};
      const Evaluated<D> evaluated(fluid, crowd);
      double power = 0.0;  // of the particles' forces on the peculiar motion, without gravity's
      for (int d = 0; d < D; ++d) {
        const auto acceleration = evaluated.acceleration(d);
        EXPECT_NEAR(sum(acceleration), n * fluid.gravity[d], 1e-14 * n * largest(acceleration)) << "component " << d;
        for (std::size_t i = 0; i < acceleration.size(); ++i)
          power += (acceleration[i] - fluid.gravity[d]) * crowd.velocity[i][d];
      }
      const auto energy_rate = evaluated.energy_rate();
      EXPECT_NEAR(sum(energy_rate) + power, -crowd.box.strain_rate() * evaluated.fluid.virial_xy(),
                  3e-14 * n * largest(energy_rate));
      EXPECT_GT(largest(energy_rate), 0.1);
    }
  }
}

TEST(SmoothParticles, ConserveMomentumAndTotalEnergyToRounding) {
  expect_conservation(disordered<1>(space::Box<1>({60.0}), 47), 3.0);
  expect_conservation(disordered<2>(space::Box<2>({24.0, 20.0}), 48), 3.0);
  expect_conservation(disordered<3>(space::Box<3>({8.0, 9.0, 7.0}), 49), 3.0);
}

TEST(SmoothParticles, TakeUnderShearTheWorkOfTheFlowAndNoOther) {
  for (const double offset : {-100.7, 0.0, 11.3}) {
    expect_conservation(disordered<2>(space::Box<2>({24.0, 20.0}, 0.7, offset), 50), 3.0);
    expect_conservation(disordered<3>(space::Box<3>({8.0, 9.0, 7.0}, -0.4, offset), 51), 3.0);
  }
}

template <int D>
Fluid<D> full_fluid() {
  return {kernel::Monaghan<D>(3.0), IdealGas(), all_transport, DensityMean::geometric, {}};
}

TEST(SmoothParticles, AreTheSameForAMovingObserver) {
  const SmoothCrowd<2> crowd = disordered<2>(space::Box<2>({14.0, 11.0}), 52);
  SmoothCrowd<2> moving = crowd;
  for (auto& velocity : moving.velocity) velocity = {velocity[0] + 3.0, velocity[1] - 5.0};
  const Evaluated<2> here(full_fluid<2>(), crowd);
  const Evaluated<2> there(full_fluid<2>(), moving);
  for (int d = 0; d < 2; ++d) {
    const auto a = here.acceleration(d);
    const auto b = there.acceleration(d);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-13);
  }
  for (std::size_t i = 0; i < crowd.position.size(); ++i)
    EXPECT_NEAR(here.energy_rate()[i], there.energy_rate()[i], 1e-13);
}

// A quarter turn: x' = L_y - y, y' = x. What depends on an axis, or on the order of indices, would show.
TEST(SmoothParticles, AreTheSameAfterAQuarterTurn) {
  const SmoothCrowd<2> crowd = disordered<2>(space::Box<2>({14.0, 11.0}), 53);
  SmoothCrowd<2> turned = crowd;
  turned.box = space::Box<2>({11.0, 14.0});
  for (std::size_t i = 0; i < crowd.position.size(); ++i) {
    turned.position[i] = {11.0 - crowd.position[i][1], crowd.position[i][0]};
    turned.velocity[i] = {-crowd.velocity[i][1], crowd.velocity[i][0]};
  }
  const Evaluated<2> before(full_fluid<2>(), crowd);
  const Evaluated<2> after(full_fluid<2>(), turned);
  const auto ax = before.acceleration(0);
  const auto ay = before.acceleration(1);
  const auto turned_x = after.acceleration(0);
  const auto turned_y = after.acceleration(1);
  const auto rate = before.energy_rate();
  const auto turned_rate = after.energy_rate();
  for (std::size_t i = 0; i < ax.size(); ++i) {
    EXPECT_NEAR(turned_x[i], -ay[i], 1e-12);
    EXPECT_NEAR(turned_y[i], ax[i], 1e-12);
    EXPECT_NEAR(turned_rate[i], rate[i], 1e-12);
  }
}

TEST(SmoothParticles, GiveTheSameBitsForEveryNumberOfThreads) {
  const SmoothCrowd<2> crowd = disordered<2>(space::Box<2>({60.0, 60.0}, 0.3, 17.0), 54);
  const Evaluated<2> alone(full_fluid<2>(), crowd);
  for (const int threads : {2, 3}) {
    const Evaluated<2> together(full_fluid<2>(), crowd, Team(threads));
    for (int d = 0; d < 2; ++d) EXPECT_EQ(alone.acceleration(d), together.acceleration(d));
    EXPECT_EQ(alone.energy_rate(), together.energy_rate());
    EXPECT_EQ(alone.fluid.virial_xy(), together.fluid.virial_xy());
    for (int c = 0; c < 6; ++c) EXPECT_EQ(alone.gradient(c), together.gradient(c));
    for (int c = 0; c < 5; ++c)
      EXPECT_EQ(alone.by_particle(alone.fluid.deformation(), c), together.by_particle(together.fluid.deformation(), c));
    const auto produced = alone.fluid.entropy_production(alone.particles(), Team(1));
    const auto shared = together.fluid.entropy_production(together.particles(), Team(threads));
    for (int c = 0; c < 2; ++c) EXPECT_EQ(alone.by_particle(produced, c), together.by_particle(shared, c));
  }
}

// The isomorphism through the three passes: rates.hpp knows nothing of the isentropic fluid.
template <int D>
void expect_the_accelerations_of_atoms(const Fluid<D>& fluid, const SmoothCrowd<D>& crowd) {
  const Evaluated<D> smooth(fluid, crowd);
  space::Columns force(D, smooth.arranged.list.capacity());
  std::array<double*, D> columns;
  for (int d = 0; d < D; ++d) columns[d] = force[d];
  md::lucy_forces<D>(kernel::Lucy<D>(3.0), smooth.arranged.list, smooth.images,
                     Evaluated<D>(fluid, crowd).particles().position, columns, pairs::Wanted::everything, Team(1));
  for (int d = 0; d < D; ++d) {
    for (std::size_t slot = 0; slot < smooth.arranged.number.size(); ++slot) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(smooth.fluid.acceleration()[d][slot]),
                std::bit_cast<std::uint64_t>(force[d][slot]));
    }
  }
}

template <int D>
void expect_isomorphism(const space::Box<D>& box) {
  SmoothCrowd<D> crowd = disordered<D>(box, 55);
  Fluid<D> fluid{kernel::Lucy<D>(3.0), Isentropic(), {}, {}, {}};
  expect_the_accelerations_of_atoms(fluid, crowd);
  // Tensors and gradients are computed, but nothing flows.
  fluid.transport = {.viscosity = 0.7, .bulk_viscosity = 0.2};
  for (auto& velocity : crowd.velocity) velocity.fill(0.25);
  if (box.strain_rate() == 0.0) expect_the_accelerations_of_atoms(fluid, crowd);
}

TEST(SmoothParticles, OfAnIsentropicFluidAccelerateAsAtomsDoInEveryBit) {
  expect_isomorphism<1>(space::Box<1>({50.0}));
  expect_isomorphism<2>(space::Box<2>({16.0, 13.0}));
  expect_isomorphism<2>(space::Box<2>({16.0, 13.0}, 0.6, 4.4));
  expect_isomorphism<3>(space::Box<3>({7.0, 8.0, 9.0}));
}

// Where e = rho an ideal gas has P/rho^2 = 1: twice the atoms' one half.
TEST(SmoothParticles, OfAnIdealGasWhoseEnergyIsItsDensityAccelerateTwiceAsMuchAsAtoms) {
  SmoothCrowd<2> crowd = disordered<2>(space::Box<2>({16.0, 13.0}), 56);
  const Evaluated<2> atoms({kernel::Lucy<2>(3.0), Isentropic(), {}, {}, {}}, crowd);
  crowd.energy = atoms.by_particle(atoms.fluid.density());
  const Evaluated<2> gas({kernel::Lucy<2>(3.0), IdealGas(), {}, {}, {}}, crowd);
  for (int d = 0; d < 2; ++d) {
    const auto one = atoms.acceleration(d);
    const auto two = gas.acceleration(d);
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(two[i], 2.0 * one[i], 1e-14);
  }
}

TEST(SmoothParticles, LieStillOnALatticeAtRest) {
  for (const auto weight : both_weights) {
    const SmoothCrowd<2> crowd = testing::lattice<2>(space::Box<2>({16.0, 16.0}));
    const Evaluated<2> evaluated(
        {kernel::make_weight<2>(weight, 3.0), VanDerWaals(), all_transport, {}, downwards<2>(0.5)}, crowd);
    for (const double x : evaluated.acceleration(0)) EXPECT_NEAR(x, 0.0, 1e-14);
    for (const double y : evaluated.acceleration(1)) EXPECT_NEAR(y, -0.5, 1e-14);
    for (const double rate : evaluated.energy_rate()) EXPECT_NEAR(rate, 0.0, 1e-15);
  }
}

// Heat spreads as a wave on a lattice must: e' = -kappa k^2 (e - 1), times what the discrete operator makes of it.
TEST(SmoothParticles, ConductHeatDownItsGradient) {
  const space::Box<2> box({64.0, 64.0});
  SmoothCrowd<2> crowd = testing::lattice<2>(box);
  const double k = 2.0 * std::numbers::pi / 64.0;
  for (std::size_t i = 0; i < crowd.position.size(); ++i)
    crowd.energy[i] = 1.0 + 0.1 * std::sin(k * crowd.position[i][1]);
  const Evaluated<2> evaluated(
      {kernel::Lucy<2>(3.0), IdealGas(), {.viscosity = 0.0, .bulk_viscosity = 0.0, .conductivity = 0.6}, {}, {}},
      crowd);
  double product = 0.0;
  double square = 0.0;
  const auto rate = evaluated.energy_rate();
  for (std::size_t i = 0; i < rate.size(); ++i) {
    product += rate[i] * (crowd.energy[i] - 1.0);
    square += std::pow(crowd.energy[i] - 1.0, 2);
  }
  EXPECT_NEAR(product / square / (-0.6 * k * k), 0.98527, 1e-4);
}

/// Viscosity that the rate with eta less the rate without shows, over the prescribed one: v_x = A sin(2 pi y/64).
double viscous_operator_factor(kernel::WeightName weight, double offset, double eta) {
  const double k = 2.0 * std::numbers::pi / 64.0;
  SmoothCrowd<2> crowd = testing::lattice<2>(space::Box<2>({64.0, 64.0}), offset, 57);
  for (std::size_t i = 0; i < crowd.position.size(); ++i)
    crowd.velocity[i] = {0.1 * std::sin(k * crowd.position[i][1]), 0.0};
  Fluid<2> fluid{kernel::make_weight<2>(weight, 3.0), IdealGas(), {.viscosity = eta}, {}, {}};
  const auto with = Evaluated<2>(fluid, crowd).acceleration(0);
  fluid.transport = {};
  const auto without = Evaluated<2>(fluid, crowd).acceleration(0);
  double product = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    product += (with[i] - without[i]) * crowd.velocity[i][0];
    square += crowd.velocity[i][0] * crowd.velocity[i][0];
  }
  return product / square / (-eta * k * k);
}

// On a lattice the factor is (g/rho)^2/rho: g/rho that of the gradient of this wave (0.99406 for Lucy, gradients_test),
// rho = 1.00293 the density at a site.
TEST(SmoothParticles, HaveTheKnownFactorOfTheDiscreteViscousOperator) {
  EXPECT_NEAR(viscous_operator_factor(kernel::WeightName::lucy, 0.0, 1.0), 0.98527, 1e-5);
  EXPECT_NEAR(viscous_operator_factor(kernel::WeightName::monaghan, 0.0, 1.0), 0.99631, 1e-5);
  for (const auto weight : both_weights) {
    EXPECT_NEAR(viscous_operator_factor(weight, 0.0, 0.1) / viscous_operator_factor(weight, 0.0, 1.0), 1.0, 1e-11);
    double before = viscous_operator_factor(weight, 0.0, 1.0);
    for (const double offset : {0.1, 0.2, 0.3}) {  // and it falls with disorder
      const double factor = viscous_operator_factor(weight, offset, 1.0);
      EXPECT_LT(factor, before) << "offset " << offset;
      EXPECT_GT(factor, 0.8) << "offset " << offset;
      before = factor;
    }
  }
}

TEST(SmoothParticles, ReportTheNewtonianStressOfAUniformShear) {
  const SmoothCrowd<2> crowd = testing::lattice<2>(space::Box<2>({16.0, 16.0}, 0.25));
  const Evaluated<2> evaluated({kernel::Lucy<2>(3.0), IdealGas(), {.viscosity = 0.8}, {}, {}}, crowd);
  const double rho = evaluated.by_particle(evaluated.fluid.density())[0];
  EXPECT_NEAR(evaluated.fluid.viscous_stress_xy(evaluated.arranged.number.size()), -0.8 * 0.25 * 0.997898 / rho * 256.0,
              1e-3);
  // The momentum that pairs hand on is that stress seen once more through the lattice.
  EXPECT_NEAR(evaluated.fluid.virial_xy() / 256.0, -0.8 * 0.25, 0.02 * 0.2);
}

TEST(SmoothParticles, RefuseNegativeCoefficientsAndHeatWithoutATemperature) {
  const auto message_of = [](const Transport& transport, const EquationOfState& state) -> std::string {
    try {
      SmoothParticles<2>({kernel::Lucy<2>(3.0), state, transport, {}, {}}, 8);
    } catch (const BadInput& refusal) {
      return refusal.what();
    }
    return "";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message_of({.viscosity = -0.1}, IdealGas()).find("fluid.viscosity = -0.1"), std::string::npos);
  EXPECT_NE(message_of({.bulk_viscosity = nan}, IdealGas()).find("fluid.bulk_viscosity"), std::string::npos);
  EXPECT_NE(message_of({.conductivity = INFINITY}, IdealGas()).find("fluid.conductivity"), std::string::npos);
  EXPECT_NE(message_of({.conductivity = 0.1}, Isentropic()).find("isentropic"), std::string::npos);
  EXPECT_EQ(message_of({.viscosity = 0.1}, Isentropic()), "");
}

}  // namespace
}  // namespace lucy::spam
