// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/motion/fluid_trajectory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "lucy/errors.hpp"
#include "lucy/motion/start.hpp"
#include "lucy/motion/trajectory.hpp"
#include "spam/slow_rates.hpp"

namespace lucy::motion {
namespace {

constexpr spam::Transport all_transport{.viscosity = 0.5, .bulk_viscosity = 0.3, .conductivity = 0.4};
constexpr double turn = 2.0 * std::numbers::pi;

template <int D>
space::Vector<D> cube(double side) {
  space::Vector<D> lengths;
  lengths.fill(side);
  return lengths;
}

/// One particle per unit volume on a lattice with offsets up to `offset`, at rest with unit energy.
template <int D>
FluidStart<D> lattice_fluid(int side, double offset = 0.0, std::uint64_t seed = 1) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(-offset, offset);
  FluidStart<D> start;
  start.lengths = cube<D>(side);
  const int sites = D == 1 ? side : D == 2 ? side * side : side * side * side;
  for (int site = 0; site < sites; ++site) {
    space::Vector<D> position;
    for (int d = 0, rest = site; d < D; ++d, rest /= side) position[d] = rest % side + 0.5 + uniform(generator);
    start.position.push_back(position);
  }
  start.velocity.assign(start.position.size(), space::Vector<D>{});
  start.energy.assign(start.position.size(), 1.0);
  return start;
}

/// Waves of one wavelength in every velocity component and in energy.
template <int D>
FluidStart<D> waves(int side, double offset = 0.0, double amplitude = 0.1, std::uint64_t seed = 1) {
  FluidStart<D> start = lattice_fluid<D>(side, offset, seed);
  for (std::size_t i = 0; i < start.position.size(); ++i) {
    const auto& r = start.position[i];
    for (int d = 0; d < D; ++d) start.velocity[i][d] = amplitude * std::sin(turn * r[(d + 1) % D] / side + d);
    start.energy[i] = 1.0 + amplitude * std::sin(turn * r[D - 1] / side);
  }
  return start;
}

template <int D>
spam::Fluid<D> gas(const spam::Transport& transport = all_transport) {
  return {kernel::Monaghan<D>(2.5), spam::IdealGas(), transport, spam::DensityMean::geometric, {}};
}

struct Options {
  double strain_rate = 0.0;
  Cooling cooling = Cooling::none;
  double energy_tolerance = 1e-3;
  int threads = 1;
};

template <int D>
FluidTrajectory<D> flow(const spam::Fluid<D>& fluid, const FluidStart<D>& start, const Options& options = {}) {
  Watch watch;
  watch.energy_tolerance = options.energy_tolerance;
  return FluidTrajectory<D>(fluid, start, options.strain_rate, options.cooling, watch, Team(options.threads));
}

template <int D>
void run(FluidTrajectory<D>& trajectory, double time, double dt) {
  const auto steps = std::llround(time / dt);
  for (long long step = 0; step < steps; ++step) trajectory.advance(dt);
}

/// Sums of a vector quantity, given as x0 y0 x1 y1 ...
template <int D>
space::Vector<D> total(const std::vector<double>& values) {
  space::Vector<D> sum{};
  for (std::size_t i = 0; i < values.size(); ++i) sum[i % D] += values[i];
  return sum;
}

TEST(FluidTrajectory, EnergyDriftShrinksWithTheFourthPowerOfTheStep) {
  spam::Fluid<2> fluid = gas<2>();
  fluid.gravity = {0.0, -0.1};
  for (const Options& options :
       {Options{}, Options{.strain_rate = 0.2}, Options{.strain_rate = 0.2, .cooling = Cooling::isoenergetic}}) {
    const auto largest_drift = [&](double dt) {
      auto trajectory = flow<2>(fluid, waves<2>(16, 0.05, 0.3), options);
      double largest = 0.0;
      while (trajectory.time() < 6.4 - 0.5 * dt) {
        trajectory.advance(dt);
        largest = std::max(largest, std::abs(trajectory.energy_drift()));
      }
      return largest;
    };
    const double coarse = largest_drift(0.1);
    const double fine = largest_drift(0.05);
    EXPECT_GT(coarse / fine, 10.0) << coarse << " and " << fine;
    EXPECT_LT(coarse / fine, 40.0) << coarse << " and " << fine;
    EXPECT_LT(fine, 1e-8);
  }
}

TEST(FluidTrajectory, KeepsMomentum) {
  for (const double rate : {0.0, 0.3}) {
    auto trajectory = flow<2>(gas<2>(), waves<2>(16, 0.2, 0.3), {.strain_rate = rate});
    const auto before = total<2>(trajectory.velocities());
    run(trajectory, 20.0, 0.1);
    const auto after = total<2>(trajectory.velocities());
    // Under shear the total p_x would turn by -rate p_y; a lattice of whole waves has none.
    for (int d = 0; d < 2; ++d) EXPECT_NEAR(after[d], before[d] - (d == 0 ? rate * 20.0 * before[1] : 0.0), 1e-11);
  }
}

TEST(FluidTrajectory, KeepsTheTotalEnergyWhileViscosityTurnsMotionIntoHeat) {
  auto trajectory = flow<2>(gas<2>(), waves<2>(16, 0.1, 0.3));
  const double energy = trajectory.energy();
  const double motion = trajectory.kinetic().kinetic_energy();
  run(trajectory, 20.0, 0.1);
  EXPECT_LT(trajectory.kinetic().kinetic_energy(), 0.7 * motion);
  EXPECT_NEAR(trajectory.energy() / energy, 1.0, 1e-6);
  EXPECT_NEAR(trajectory.energy_drift(), (trajectory.energy() - energy) / 256.0, 1e-14);
}

TEST(FluidTrajectory, ConductsUntilTheTemperatureIsEven) {
  auto trajectory = flow<2>(gas<2>({.viscosity = 1.0, .bulk_viscosity = 1.0, .conductivity = 2.0}), waves<2>(16));
  const auto spread = [&] {
    const auto temperature = trajectory.temperatures();
    const auto [least, most] = std::minmax_element(temperature.begin(), temperature.end());
    return *most - *least;
  };
  const double before = spread();
  run(trajectory, 40.0, 0.1);
  EXPECT_LT(spread(), 0.05 * before);
}

TEST(FluidTrajectory, GoesOnFromASavedStateWithTheSameBits) {
  const Options options{.strain_rate = 0.3, .cooling = Cooling::isoenergetic};
  auto whole = flow<2>(gas<2>(), waves<2>(16, 0.2, 0.3), options);
  run(whole, 3.7, 0.1);
  ArchiveWriter saved;
  whole.save(saved);
  auto resumed = flow<2>(gas<2>(), lattice_fluid<2>(16), options);
  ArchiveReader reader(saved.bytes());
  resumed.load(reader);
  EXPECT_TRUE(reader.exhausted());
  EXPECT_EQ(whole.densities(), resumed.densities());
  EXPECT_EQ(whole.accelerations(), resumed.accelerations());
  EXPECT_EQ(whole.energy(), resumed.energy());
  EXPECT_EQ(whole.viscous_stress_xy(), resumed.viscous_stress_xy());
  for (auto* trajectory : {&whole, &resumed}) trajectory->renew_list(0.1);
  EXPECT_EQ(whole.gradients(), resumed.gradients());
  EXPECT_EQ(whole.entropy_production(), resumed.entropy_production());
  for (auto* trajectory : {&whole, &resumed}) run(*trajectory, 5.0, 0.1);
  EXPECT_EQ(whole.positions(), resumed.positions());
  EXPECT_EQ(whole.velocities(), resumed.velocities());
  EXPECT_EQ(whole.energies(), resumed.energies());
  EXPECT_EQ(whole.energy_drift(), resumed.energy_drift());
  EXPECT_EQ(whole.cooling_rate(), resumed.cooling_rate());
  EXPECT_EQ(whole.fluid().virial_xy(), resumed.fluid().virial_xy());
  EXPECT_EQ(whole.report().worst_energy_error, resumed.report().worst_energy_error);
}

TEST(FluidTrajectory, RefusesATruncatedStateAndThatOfAnotherNumberOfParticles) {
  auto trajectory = flow<2>(gas<2>(), waves<2>(10));
  ArchiveWriter saved;
  trajectory.save(saved);
  for (std::size_t length : {std::size_t{0}, std::size_t{7}, saved.bytes().size() / 2, saved.bytes().size() - 1}) {
    ArchiveReader reader(std::span(saved.bytes()).first(length));
    EXPECT_THROW(trajectory.load(reader), RunFailed);
  }
  auto other = flow<2>(gas<2>(), waves<2>(12));
  ArchiveReader reader(saved.bytes());
  EXPECT_THROW(other.load(reader), RunFailed);
}

// What is known of a state does not depend on when its list was made.
TEST(FluidTrajectory, AStateIsTheSameAfterItsListIsRenewed) {
  auto trajectory = flow<2>(gas<2>(), waves<2>(16, 0.3, 0.5), {.strain_rate = 0.4});
  run(trajectory, 5.0, 0.1);
  const auto density = trajectory.densities();
  const auto gradients = trajectory.gradients();
  const auto energy_rates = trajectory.energy_rates();
  const auto production = trajectory.entropy_production();
  trajectory.renew_list(0.1);
  EXPECT_EQ(trajectory.densities(), density);
  EXPECT_EQ(trajectory.energy_rates(), energy_rates);
  const auto expect_near = [](const std::vector<double>& again, const std::vector<double>& before) {
    ASSERT_EQ(again.size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i) ASSERT_NEAR(again[i], before[i], 1e-14);
  };
  expect_near(trajectory.gradients(), gradients);
  expect_near(trajectory.entropy_production(), production);
}

TEST(FluidTrajectory, GivesTheSameBitsForEveryNumberOfThreads) {
  const auto run_with = [](int threads) {
    auto trajectory = flow<2>(gas<2>(), waves<2>(48, 0.2, 0.3),
                              {.strain_rate = 0.3, .cooling = Cooling::isoenergetic, .threads = threads});
    run(trajectory, 0.3, 0.1);
    return trajectory;
  };
  const auto alone = run_with(1);
  for (const int threads : {2, 3}) {
    const auto together = run_with(threads);
    EXPECT_EQ(alone.positions(), together.positions());
    EXPECT_EQ(alone.velocities(), together.velocities());
    EXPECT_EQ(alone.energies(), together.energies());
    EXPECT_EQ(alone.energy(), together.energy());
    EXPECT_EQ(alone.entropy_production(), together.entropy_production());
  }
}

// The thermostat on e: see the head of fluid_trajectory.hpp.
TEST(FluidTrajectoryLong, ShearedWithCoolingReachesASteadyStateOfNewtonsStress) {
  constexpr double eta = 1.0;
  constexpr double rate = 0.1;
  auto trajectory = flow<2>(gas<2>({.viscosity = eta, .bulk_viscosity = 0.0, .conductivity = 1.0}),
                            lattice_fluid<2>(16, 0.1), {.strain_rate = rate, .cooling = Cooling::isoenergetic});
  const double energy = trajectory.energy();
  run(trajectory, 100.0, 0.1);
  constexpr int halves = 2;
  constexpr int samples = 1000;
  std::array<double, halves> stress{};
  std::array<double, halves> viscous{};
  std::array<double, halves> heat{};
  for (int half = 0; half < halves; ++half) {
    for (int sample = 0; sample < samples; ++sample) {
      trajectory.advance(0.1);
      stress[half] +=
          (trajectory.kinetic().momentum_flux(0, 1) + trajectory.fluid().virial_xy()) / trajectory.volume() / samples;
      viscous[half] += trajectory.viscous_stress_xy() / trajectory.volume() / samples;
      heat[half] += trajectory.cooling_rate() * trajectory.internal_energy() / trajectory.volume() / samples;
    }
  }
  EXPECT_NEAR(trajectory.energy() / energy, 1.0, 1e-6);
  EXPECT_NEAR(stress[1], stress[0], 0.05 * eta * rate);  // steady
  EXPECT_NEAR(stress[1], -eta * rate, 0.15 * eta * rate);
  EXPECT_NEAR(viscous[1], -eta * rate, 0.1 * eta * rate);
  EXPECT_NEAR(heat[1], -rate * stress[1], 1e-10);  // all of the flow's work leaves as heat
}

TEST(FluidTrajectory, ShearedWithoutCoolingHeatsUpByTheWorkOfTheFlow) {
  auto trajectory = flow<2>(gas<2>(), lattice_fluid<2>(16, 0.1), {.strain_rate = 0.5});
  const double before = trajectory.energy();
  double work = 0.0;
  for (int step = 0; step < 200; ++step) {
    const auto power = [&] {
      return -0.5 * (trajectory.kinetic().momentum_flux(0, 1) + trajectory.fluid().virial_xy());
    };
    const double start = power();
    trajectory.advance(0.05);
    work += 0.5 * 0.05 * (start + power());
  }
  EXPECT_GT(work, 0.5 * 256.0 * 0.5 * 0.5 * 0.5 * 10.0);  // half of eta rate^2 V t
  EXPECT_NEAR(trajectory.energy() - before, work, 1e-3 * work);
  EXPECT_LT(std::abs(trajectory.energy_drift()), 1e-6);
}

TEST(FluidTrajectory, ALatticeAtRestStaysAtRest) {
  for (const bool transport : {false, true}) {
    for (const auto name : {kernel::WeightName::lucy, kernel::WeightName::monaghan}) {
      spam::Fluid<2> fluid = gas<2>(transport ? all_transport : spam::Transport{});
      fluid.weight = kernel::make_weight<2>(name, 3.0);
      const auto start = lattice_fluid<2>(12);
      auto trajectory = flow<2>(fluid, start);
      run(trajectory, 20.0, 0.5);
      const auto position = trajectory.positions();
      for (std::size_t i = 0; i < start.position.size(); ++i) {
        for (std::size_t d = 0; d < 2; ++d) EXPECT_NEAR(position[2 * i + d], start.position[i][d], 1e-11);
      }
      for (const double e : trajectory.energies()) EXPECT_NEAR(e, 1.0, 1e-12);
      EXPECT_NEAR(trajectory.energy_drift(), 0.0, 1e-15);
    }
  }
}

// One particle alone: no velocity, no acceleration, no partner at all.
TEST(FluidTrajectory, AParticleAloneStaysWhereItIs) {
  FluidStart<2> start{{10.0, 10.0}, {{4.0, 4.0}}, {{0.0, 0.0}}, {1.0}};
  auto trajectory = flow<2>(gas<2>(), start);
  run(trajectory, 10.0, 0.1);
  EXPECT_EQ(trajectory.positions(), (std::vector{4.0, 4.0}));
  EXPECT_EQ(trajectory.energy(), 1.0);
}

TEST(FluidTrajectory, FallsFreelyUnderGravity) {
  spam::Fluid<2> fluid = gas<2>();
  fluid.gravity = {0.03, -0.2};
  auto falling = flow<2>(fluid, waves<2>(12, 0.1, 0.2));
  auto floating = flow<2>(gas<2>(), waves<2>(12, 0.1, 0.2));
  constexpr double time = 8.0;
  run(falling, time, 0.1);
  run(floating, time, 0.1);
  const space::Box<2> box = falling.box();
  const auto there = falling.positions();
  const auto here = floating.positions();
  const auto fast = falling.velocities();
  const auto slow = floating.velocities();
  for (std::size_t i = 0; i < 144; ++i) {
    for (std::size_t d = 0; d < 2; ++d) {
      double apart = there[2 * i + d] - here[2 * i + d] - 0.5 * fluid.gravity[d] * time * time;
      apart -= std::round(apart / box.lengths()[d]) * box.lengths()[d];
      EXPECT_NEAR(apart, 0.0, 1e-9);
      EXPECT_NEAR(fast[2 * i + d] - slow[2 * i + d], fluid.gravity[d] * time, 1e-9);
    }
  }
  EXPECT_LT(std::abs(falling.energy_drift()), 1e-6);
  EXPECT_GT(falling.energy() - floating.energy(), 100.0);  // the work of gravity is accounted for, not lost
}

TEST(FluidTrajectory, RefusesATemperatureThatIsNotPositiveNamingTimeAndParticle) {
  FluidStart<2> start = lattice_fluid<2>(10);
  start.energy[37] = -0.2;
  try {
    flow<2>(gas<2>(), start);
    FAIL() << "a negative temperature was accepted";
  } catch (const RunFailed& failure) {
    EXPECT_NE(std::string(failure.what()).find("particle 37"), std::string::npos) << failure.what();
    EXPECT_NE(std::string(failure.what()).find("time 0"), std::string::npos) << failure.what();
  }
}

// Partners share the work of their common pressure by halves, so that a cold particle in a hot gas that expands pays
// with more than it has.
TEST(FluidTrajectory, SaysWhenExpansionUsesUpTheHeatOfAParticle) {
  FluidStart<2> start = lattice_fluid<2>(12);
  for (std::size_t i = 0; i < start.position.size(); ++i) {
    start.velocity[i][0] = 0.5 * std::sin(turn * start.position[i][0] / 12.0);
    if (i % 12 == 0) start.energy[i] = 0.01;
  }
  auto trajectory = flow<2>(gas<2>({}), start);
  try {
    run(trajectory, 10.0, 0.05);
    FAIL() << "no particle was cooled below zero";
  } catch (const RunFailed& failure) {
    EXPECT_NE(std::string(failure.what()).find("the temperature of particle"), std::string::npos) << failure.what();
    EXPECT_GT(trajectory.time(), 0.0);
  }
}

// Beyond 1/b = 2 the pressure of van der Waals is negative, and the particles would fall into each other.
TEST(FluidTrajectory, RefusesAVanDerWaalsFluidThatIsDenserThanItsParticlesAllow) {
  FluidStart<2> start = lattice_fluid<2>(12);
  start.position.insert(start.position.end(), {{3.4, 3.3}, {3.6, 3.7}, {3.5, 3.6}, {3.3, 3.5}});
  start.velocity.resize(start.position.size());
  start.energy.resize(start.position.size(), 1.0);
  spam::Fluid<2> fluid = gas<2>();
  EXPECT_NO_THROW(flow<2>(fluid, start));
  fluid.state = spam::VanDerWaals();
  try {
    flow<2>(fluid, start);
    FAIL() << "a negative pressure was accepted";
  } catch (const RunFailed& failure) {
    EXPECT_NE(std::string(failure.what()).find("the density of particle"), std::string::npos) << failure.what();
  }
}

TEST(FluidTrajectory, RefusesToCoolAFluidWithoutInternalEnergy) {
  FluidStart<2> start = lattice_fluid<2>(12);
  start.energy.assign(start.energy.size(), 0.0);
  spam::Fluid<2> fluid = gas<2>({});
  fluid.state = spam::Isentropic();
  EXPECT_THROW(flow<2>(fluid, start, {.strain_rate = 0.1, .cooling = Cooling::isoenergetic}), BadInput);
  EXPECT_NO_THROW(flow<2>(fluid, start, {.strain_rate = 0.1, .cooling = Cooling::none}));
}

// A step that is far too long for the viscosity is cut until it is stable.
TEST(FluidTrajectory, StaysStableWhereTheViscosityIsTooStiffForTheStep) {
  auto trajectory = flow<2>(gas<2>({.viscosity = 50.0, .bulk_viscosity = 0.0, .conductivity = 50.0}),
                            waves<2>(12, 0.1, 0.3), {.energy_tolerance = 1e-5});
  run(trajectory, 5.0, 0.5);
  EXPECT_GT(trajectory.report().subdivided_steps, 0);
  EXPECT_LT(std::abs(trajectory.energy_drift()), 1e-4);
  EXPECT_LT(trajectory.kinetic().kinetic_energy(), 1.0);
}

TEST(FluidTrajectory, SubdividesAStepThatChangesTheEnergyTooMuch) {
  auto careful = flow<2>(gas<2>(), waves<2>(12, 0.3, 0.8), {.energy_tolerance = 1e-9});
  auto careless = flow<2>(gas<2>(), waves<2>(12, 0.3, 0.8), {.energy_tolerance = 1.0});
  run(careful, 4.0, 0.4);
  run(careless, 4.0, 0.4);
  EXPECT_GT(careful.report().subdivided_steps, 0);
  EXPECT_LE(careful.report().worst_energy_error, 1e-9);
  EXPECT_GT(careless.report().worst_energy_error, 1e-7);
  EXPECT_LT(std::abs(careful.energy_drift()), 0.1 * std::abs(careless.energy_drift()));
  EXPECT_NEAR(careful.time(), 4.0, 1e-12);
  EXPECT_EQ(careful.report().steps, 10);
}

TEST(FluidTrajectory, GivesUpWithASentenceWhenSubdividingDoesNotHelp) {
  auto trajectory = flow<2>(gas<2>(), waves<2>(12, 0.3, 0.5), {.energy_tolerance = 1e-19});
  try {
    run(trajectory, 1.0, 0.05);
    FAIL() << "an energy tolerance below rounding was met";
  } catch (const RunFailed& failure) {
    EXPECT_NE(std::string(failure.what()).find("run.energy_tolerance"), std::string::npos) << failure.what();
  }
}

// Whatever the state: densities and rates by the list, at every age, against sums over images.
template <int D>
int finished_random_flows(int trials, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  const auto uniform = [&] { return std::uniform_real_distribution<double>()(generator); };
  int finished = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const int side = D == 1   ? 20 + static_cast<int>(generator() % 20)
                     : D == 2 ? 6 + static_cast<int>(generator() % 5)
                              : 5;
    FluidStart<D> start = lattice_fluid<D>(side, 0.3 * uniform(), generator());
    std::normal_distribution<double> normal(0.0, std::pow(10.0, -2.0 + 2.0 * uniform()));
    for (auto& velocity : start.velocity) {
      for (double& component : velocity) component = normal(generator);
    }
    for (double& e : start.energy) e = 0.5 + uniform();
    if (uniform() < 0.3) start.velocity[3][0] = 10.0 * uniform();
    const double range = 0.5 * side * (uniform() < 0.4 ? 1.0 - 1e-12 : 0.6 + 0.4 * uniform());
    spam::Fluid<D> fluid{
        kernel::make_weight<D>(generator() % 2 == 0 ? kernel::WeightName::lucy : kernel::WeightName::monaghan,
                               D == 1 ? 0.2 * range : range),
        spam::IdealGas(),
        {.viscosity = uniform(), .bulk_viscosity = uniform(), .conductivity = uniform()},
        generator() % 2 == 0 ? spam::DensityMean::geometric : spam::DensityMean::arithmetic,
        {}};
    if (uniform() < 0.3) fluid.transport = {};
    if (uniform() < 0.3) fluid.state = spam::DenseFluid();
    fluid.gravity.fill(0.1 * uniform());
    const double dt = 0.2 * std::pow(0.1, 1.2 * uniform());
    Options options;
    options.strain_rate = (uniform() < 0.5 ? -1.0 : 1.0) * std::min(0.5 / dt, std::pow(10.0, -2.0 + 3.0 * uniform()));
    options.cooling = uniform() < 0.5 ? Cooling::isoenergetic : Cooling::none;
    options.energy_tolerance = uniform() < 0.5 ? 1e-5 : 1e-2;
    try {
      auto trajectory = flow<D>(fluid, start, options);
      for (int step = 0; step < 20; ++step) {
        trajectory.advance(dt);
        spam::testing::SmoothCrowd<D> crowd;
        crowd.box = trajectory.box();
        crowd.energy = trajectory.energies();
        const auto position = trajectory.positions();
        const auto velocity = trajectory.velocities();
        for (std::size_t i = 0; i < crowd.energy.size(); ++i) {
          std::copy_n(&position[i * D], D, crowd.position.emplace_back().begin());
          std::copy_n(&velocity[i * D], D, crowd.velocity.emplace_back().begin());
        }
        const auto slow = spam::testing::slow_rates(fluid, crowd);
        const auto density = trajectory.densities();
        const auto acceleration = trajectory.accelerations();
        const auto energy_rate = trajectory.energy_rates();
        double strongest = 0.0;
        double fastest = 0.0;
        for (const double a : acceleration) strongest = std::max(strongest, std::abs(a));
        for (const double rate : energy_rate) fastest = std::max(fastest, std::abs(rate));
        for (std::size_t i = 0; i < density.size(); ++i) {
          EXPECT_NEAR(density[i], slow.density[i], 1e-12 * slow.density[i]);
          EXPECT_NEAR(energy_rate[i], slow.energy_rate[i], 1e-10 * (1.0 + fastest));
          for (int d = 0; d < D; ++d)
            EXPECT_NEAR(acceleration[i * D + static_cast<std::size_t>(d)], slow.acceleration[i][d],
                        1e-10 * (1.0 + strongest));
        }
        if (::testing::Test::HasFailure()) {
          ADD_FAILURE() << "trial " << trial << ", step " << step << ", rate " << options.strain_rate << ", range "
                        << range;
          return finished;
        }
      }
      ++finished;
    } catch (const RunFailed& failure) {
      // Some of these states have no flow, and say so in numbers.
      EXPECT_EQ(std::string(failure.what()).find("nan"), std::string::npos) << failure.what();
    }
  }
  return finished;
}

TEST(FluidTrajectoryLong, RatesEqualSumsOverImagesThroughoutRandomFlows) {
  EXPECT_GT(finished_random_flows<1>(60, 81), 45);
  EXPECT_GT(finished_random_flows<2>(60, 82), 45);
  EXPECT_GT(finished_random_flows<3>(6, 83), 3);
}

template <int D>
void expect_to_run(int side) {
  for (const auto name : {kernel::WeightName::lucy, kernel::WeightName::monaghan}) {
    for (const auto mean : {spam::DensityMean::geometric, spam::DensityMean::arithmetic}) {
      spam::Fluid<D> fluid = gas<D>();
      fluid.weight = kernel::make_weight<D>(name, 2.5);
      fluid.mean = mean;
      auto trajectory = flow<D>(fluid, waves<D>(side, 0.1, 0.2), {.strain_rate = D > 1 ? 0.2 : 0.0});
      run(trajectory, 2.0, 0.1);
      EXPECT_LT(std::abs(trajectory.energy_drift()), 1e-6);
      for (const double sum : total<D>(trajectory.accelerations())) EXPECT_NEAR(sum, 0.0, 1e-11);
    }
  }
}

TEST(FluidTrajectory, RunsInOneDimension) { expect_to_run<1>(40); }
TEST(FluidTrajectory, RunsInTwoDimensions) { expect_to_run<2>(12); }
TEST(FluidTrajectory, RunsInThreeDimensions) { expect_to_run<3>(8); }

// The inviscid ideal gas with e = rho at the start is the Lucy fluid with epsilon = 2: e stays rho, P/rho^2 stays one.
// With velocities sqrt(2) times as large it does in a time sqrt(2) times as short what the atoms of epsilon = 1 do.
TEST(FluidTrajectory, TheInviscidIdealGasMovesAsTheAtomsDoOnAnotherClock) {
  const kernel::Lucy<2> kernel(3.0);
  const Start<2> atoms = lattice_start(kernel, 256, 1.0, 1.0, 5);
  Trajectory<2> slow(kernel, atoms, Shear{.strain_rate = 0.0, .thermostat = Thermostat::none},
                     Integrator::runge_kutta_4, Watch{.energy_tolerance = 1e-3}, Team(1));

  const spam::Fluid<2> fluid{kernel, spam::IdealGas(), {}, {}, {}};
  FluidStart<2> start{atoms.lengths, atoms.position, atoms.momentum, std::vector<double>(256, 1.0)};
  start.energy = flow<2>(fluid, start).densities();
  for (auto& velocity : start.velocity) {
    for (double& component : velocity) component *= std::numbers::sqrt2;
  }
  auto fast = flow<2>(fluid, start);
  const auto force = slow.forces();
  const auto acceleration = fast.accelerations();
  for (std::size_t k = 0; k < force.size(); ++k) EXPECT_NEAR(acceleration[k], 2.0 * force[k], 1e-13);

  constexpr double dt = 0.02;
  for (int step = 0; step < 100; ++step) {
    slow.advance(dt);
    fast.advance(dt / std::numbers::sqrt2);
  }
  const auto momenta = slow.momenta();
  const auto velocities = fast.velocities();
  for (std::size_t k = 0; k < momenta.size(); ++k) EXPECT_NEAR(velocities[k], std::numbers::sqrt2 * momenta[k], 1e-5);
  const auto density = fast.densities();
  const auto energy = fast.energies();
  for (std::size_t i = 0; i < density.size(); ++i) EXPECT_NEAR(energy[i], density[i], 1e-5);
}

// The general path, with an energy equation beside it, from step to step: nothing in it knows of this equation of
// state.
TEST(FluidTrajectory, OfAnIsentropicFluidIsThatOfTheAtomsToTheBit) {
  Start<2> atoms;
  atoms.lengths = {16.0, 16.0};
  FluidStart<2> start = waves<2>(16, 0.2, 0.5, 9);
  atoms.position = start.position;
  atoms.momentum = start.velocity;
  const kernel::Lucy<2> lucy(3.0);
  Trajectory<2> md(lucy, atoms, Shear{.strain_rate = 0.0, .thermostat = Thermostat::none}, Integrator::runge_kutta_4,
                   Watch{}, Team(1));
  FluidTrajectory<2> spam({lucy, spam::Isentropic(), {}}, start, 0.0, Cooling::none, Watch{}, Team(1));
  for (int step = 0; step < 2000; ++step) {
    md.advance(0.05);
    spam.advance(0.05);
  }
  EXPECT_EQ(md.positions(), spam.positions());
  EXPECT_EQ(md.momenta(), spam.velocities());
}

}  // namespace
}  // namespace lucy::motion
