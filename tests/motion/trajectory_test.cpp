// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/motion/trajectory.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "lucy/errors.hpp"
#include "pairs/crowd.hpp"
#include "slow_sllod.hpp"

namespace lucy::motion {
namespace {

const kernel::Lucy<2> lucy_kernel(3.0);

struct Options {
  Integrator integrator = Integrator::runge_kutta_4;
  bool rescale = false;
  double energy_tolerance = 1e-3;
  int threads = 1;
  double target_kinetic_energy = 0.0;
};

Trajectory<2> flow(std::int64_t particles, double energy, double rate, Thermostat thermostat,
                   const Options& options = {}, std::uint64_t seed = 31) {
  Shear shear;
  shear.strain_rate = rate;
  shear.thermostat = thermostat;
  shear.target_kinetic_energy = options.target_kinetic_energy;
  Watch watch;
  watch.rescale = options.rescale;
  watch.energy_tolerance = options.energy_tolerance;
  return Trajectory<2>(lucy_kernel, lattice_start(lucy_kernel, particles, 1.0, energy, seed), shear, options.integrator,
                       watch, Team(options.threads));
}

double distance(const space::Box<2>& box, const double* a, const double* b) {
  const double rows = std::round((a[1] - b[1]) / box.lengths()[1]);
  const double dy = a[1] - b[1] - rows * box.lengths()[1];
  double dx = a[0] - b[0] - rows * box.offset();
  dx -= std::round(dx / box.lengths()[0]) * box.lengths()[0];
  return std::hypot(dx, dy);
}

// Particle by particle against the slow integrator, through several list renewals and several strains.
void expect_same_motion(double rate, Thermostat thermostat) {
  constexpr std::int64_t n = 49;
  auto fast = flow(n, 1.0, rate, thermostat);
  testing::SlowSllod slow{lucy_kernel, {7.0, 7.0}, rate, thermostat, fast.kinetic().kinetic_energy(), 1.0};
  auto state = slow.start(lattice_start(lucy_kernel, n, 1.0, 1.0, 31));
  for (int step = 0; step < 60; ++step) {
    fast.advance(0.05);
    slow.step(state, 0.05);
  }
  const auto position = fast.positions();
  const auto momentum = fast.momenta();
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_LT(distance(fast.box(), &position[2 * i], &state.y[4 * i]), 1e-9) << "particle " << i;
    EXPECT_NEAR(momentum[2 * i], state.y[4 * i + 2], 1e-9);
    EXPECT_NEAR(momentum[2 * i + 1], state.y[4 * i + 3], 1e-9);
  }
}

TEST(Trajectory, MovesAsAnIndependentIntegratorDoes) {
  expect_same_motion(0.0, Thermostat::none);
  expect_same_motion(0.4, Thermostat::none);
  expect_same_motion(0.4, Thermostat::isoenergetic);
  expect_same_motion(-1.3, Thermostat::isoenergetic);
  expect_same_motion(0.7, Thermostat::isokinetic);
  expect_same_motion(0.7, Thermostat::nose_hoover);
}

TEST(Trajectory, StartsAtTheExactEnergyAtEveryDensity) {
  for (double density : {0.4, 2.0}) {
    Watch watch;
    Trajectory<2> trajectory(lucy_kernel, lattice_start(lucy_kernel, 400, density, 2.5, 37), Shear{},
                             Integrator::runge_kutta_4, watch, Team(1));
    EXPECT_NEAR(trajectory.energy() / 400.0, 2.5, 1e-12);
    EXPECT_NEAR(trajectory.volume(), 400.0 / density, 1e-9);
  }
}

// Whatever the state: forces by the list, at every age, against sums over images. This is what bounds on accelerations,
// lifetimes, margins and images are for.
TEST(Trajectory, ForcesEqualSumsOverImagesThroughoutRandomFlows) {
  std::mt19937_64 generator(36);
  const auto uniform = [&] { return std::uniform_real_distribution<double>()(generator); };
  const std::array<std::int64_t, 9> numbers = {36, 42, 49, 54, 56, 64, 72, 81, 100};
  const std::array<Thermostat, 4> thermostats = {Thermostat::isoenergetic, Thermostat::isokinetic,
                                                 Thermostat::nose_hoover, Thermostat::none};
  int finished = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const std::int64_t n = numbers[generator() % numbers.size()];
    const double density = std::pow(10.0, -1.5 + 2.0 * uniform());
    const double side = static_cast<double>((*near_square(n))[1]) / std::sqrt(density);
    const kernel::Lucy<2> kernel(0.5 * side * (uniform() < 0.4 ? 1.0 - 1e-12 : 0.25 + 0.75 * uniform()));
    const double dt = 0.2 * std::pow(0.1, 1.2 * uniform());
    Shear shear;
    shear.strain_rate = (uniform() < 0.5 ? -1.0 : 1.0) * std::min(0.5 / dt, std::pow(10.0, -2.0 + 3.0 * uniform()));
    shear.thermostat = thermostats[generator() % thermostats.size()];
    shear.relaxation_time = 0.3 + 3.0 * uniform();
    const double energy = lattice_energy(kernel, density) + std::pow(10.0, -3.0 + 4.0 * uniform());
    Start<2> start = lattice_start(kernel, n, density, energy, generator());
    if (uniform() < 0.3) start.momentum[3] = {20.0 * uniform(), -20.0 * uniform()};
    Watch watch;
    watch.energy_tolerance = uniform() < 0.5 ? 1e-5 : 1e-2;
    try {
      Trajectory<2> trajectory(kernel, start, shear, Integrator::runge_kutta_4, watch, Team(1));
      for (int step = 0; step < 40; ++step) {
        trajectory.advance(dt);
        const auto flat = trajectory.positions();
        const auto force = trajectory.forces();
        std::vector<space::Vector<2>> position;
        for (std::size_t i = 0; i < flat.size() / 2; ++i) position.push_back({flat[2 * i], flat[2 * i + 1]});
        std::vector<double> slow(flat.size(), 0.0);
        pairs::testing::for_all_pairs<2>(trajectory.box(), position, 0.0, kernel.range(),
                                         [&](std::size_t i, std::size_t j, const auto& apart, const auto&) {
                                           const double slope = kernel.slope(std::hypot(apart[0], apart[1]));
                                           for (std::size_t d = 0; d < 2; ++d) {
                                             slow[2 * i + d] += slope * apart[d];
                                             slow[2 * j + d] -= slope * apart[d];
                                           }
                                         });
        for (std::size_t k = 0; k < slow.size(); ++k) {
          ASSERT_NEAR(force[k], slow[k], 1e-10 * kernel.slope(0.0) * kernel.range())
              << "trial " << trial << ", step " << step << ", N = " << n << ", rate " << shear.strain_rate;
        }
      }
      ++finished;
    } catch (const RunFailed&) {
      // Some of these states have no steady flow.
    }
  }
  EXPECT_GT(finished, 90);
}

TEST(Trajectory, SaysWhenTheErgostatUsesUpTheKineticEnergy) {
  auto trajectory = flow(256, 0.42, 0.5, Thermostat::isoenergetic, {.rescale = true, .energy_tolerance = 1e-5});
  try {
    for (int step = 0; step < 1000; ++step) trajectory.advance(0.05);
    FAIL() << "a flow went on without kinetic energy";
  } catch (const RunFailed& failure) {
    EXPECT_NE(std::string(failure.what()).find("kinetic energy"), std::string::npos) << failure.what();
    EXPECT_EQ(std::string(failure.what()).find("nan"), std::string::npos) << failure.what();
  }
}

TEST(Trajectory, IsokineticStartsAtItsTargetTemperature) {
  for (bool rescale : {true, false}) {
    auto trajectory =
        flow(196, 0.5, 0.3, Thermostat::isokinetic, {.rescale = rescale, .target_kinetic_energy = 5.0 * 195.0});
    for (int step = 0; step < 20; ++step) trajectory.advance(0.02);
    EXPECT_NEAR(trajectory.kinetic().kinetic_energy(), 5.0 * 195.0, 1e-3);
    EXPECT_LT(std::abs(trajectory.report().energy_rescaled), 1e-4);
  }
}

TEST(Trajectory, AHotFluidIsNotSubdividedForItsListsSake) {
  auto trajectory = flow(256, 20.0, 0.1, Thermostat::isoenergetic, {.rescale = true, .energy_tolerance = 1e3});
  for (int step = 0; step < 50; ++step) trajectory.advance(0.05);
  EXPECT_EQ(trajectory.report().subdivided_steps, 0);
}

TEST(Trajectory, StrainRatesAtTheEdgeOfAListsLifetimeRun) {
  for (double rate : {1.6666666666666667, 0.8333333333333334, 2.5, 1.25}) {
    auto trajectory = flow(100, 1.0, rate, Thermostat::isoenergetic, {.rescale = true});
    for (int step = 0; step < 40; ++step) trajectory.advance(0.1);
    EXPECT_NEAR(trajectory.time(), 4.0, 1e-12);
  }
}

TEST(Trajectory, VerletKeepsItsStepAndItsMomenta) {
  auto trajectory = flow(256, 1.0, 0.0, Thermostat::isoenergetic,
                         {.integrator = Integrator::velocity_verlet, .rescale = true, .energy_tolerance = 1e-9});
  for (int step = 0; step < 50; ++step) trajectory.advance(0.1);
  EXPECT_EQ(trajectory.report().subdivided_steps, 0);
  EXPECT_EQ(trajectory.report().energy_rescaled, 0.0);
  EXPECT_GT(trajectory.report().worst_energy_error, 1e-9);
}

TEST(Trajectory, StartsAtTheExactEnergyWithoutTotalMomentum) {
  for (double energy : {0.42, 0.5, 1.0}) {
    auto trajectory = flow(1024, energy, 0.1, Thermostat::isoenergetic);
    EXPECT_NEAR(trajectory.energy() / 1024.0, energy, 1e-12);
    double total[2] = {0.0, 0.0};
    const auto momenta = trajectory.momenta();
    for (std::size_t i = 0; i < momenta.size(); ++i) total[i % 2] += momenta[i];
    EXPECT_NEAR(total[0], 0.0, 1e-11);
    EXPECT_NEAR(total[1], 0.0, 1e-11);
  }
}

TEST(Trajectory, ErgostatKeepsTheEnergyOfAShearedFlow) {
  auto trajectory = flow(256, 1.0, 0.5, Thermostat::isoenergetic);
  EXPECT_NEAR(trajectory.number_rates()[energy_input], 0.0, 1e-13);  // dE/dt as an identity
  const double start = trajectory.energy();
  double work = 0.0;
  for (int step = 0; step < 1000; ++step) {
    trajectory.advance(0.01);
    work -= 0.01 * 0.5 * (trajectory.kinetic().momentum_flux(0, 1) + trajectory.pair_totals().virial(0, 1));
  }
  EXPECT_GT(work, 0.05 * start);  // a wrong friction would show: the flow has done real work
  EXPECT_NEAR(trajectory.energy(), start, 1e-6 * 256);
}

TEST(Trajectory, RescalingRemovesTheResidualErrorAndSaysSo) {
  auto drifting = flow(256, 1.0, 0.5, Thermostat::isoenergetic);
  auto held = flow(256, 1.0, 0.5, Thermostat::isoenergetic, {.rescale = true});
  const double start = held.energy();
  for (int step = 0; step < 400; ++step) {
    drifting.advance(0.1);
    held.advance(0.1);
  }
  EXPECT_NEAR(held.energy(), start, 1e-11 * start);
  EXPECT_GT(std::abs(drifting.energy() - start), 1e-9 * start);
  EXPECT_EQ(drifting.report().energy_rescaled, 0.0);
  EXPECT_NE(held.report().energy_rescaled, 0.0);
  EXPECT_GT(held.report().worst_energy_error, 0.0);
}

TEST(Trajectory, IsokineticThermostatKeepsTheKineticEnergy) {
  auto trajectory = flow(256, 1.0, 0.5, Thermostat::isokinetic);
  const double start = trajectory.kinetic().kinetic_energy();
  const double energy = trajectory.energy();
  for (int step = 0; step < 1000; ++step) trajectory.advance(0.01);
  EXPECT_NEAR(trajectory.kinetic().kinetic_energy(), start, 1e-7 * start);
  EXPECT_GT(std::abs(trajectory.energy() - energy), 1e-3);  // the energy is free
}

TEST(Trajectory, NoseHooverHoldsTheMeanKineticEnergyAtItsTarget) {
  auto trajectory = flow(256, 1.0, 0.5, Thermostat::nose_hoover, {.target_kinetic_energy = 100.0});
  double sum = 0.0;
  for (int step = 0; step < 4000; ++step) {
    trajectory.advance(0.05);
    if (step >= 1000) sum += trajectory.kinetic().kinetic_energy();
  }
  // zeta is bounded and zeta' = (K/K0 - 1)/tau^2, so the mean of K/K0 - 1 is at most (change of zeta) tau^2 / time.
  EXPECT_NEAR(sum / 3000.0 / 100.0, 1.0, 0.01);
  EXPECT_LT(trajectory.report().worst_energy_error, 1e-5);  // work and heat are accounted for
}

TEST(Trajectory, WorkAndHeatAccountForTheEnergyOfEveryThermostat) {
  for (Thermostat thermostat : {Thermostat::none, Thermostat::isokinetic, Thermostat::nose_hoover}) {
    auto trajectory = flow(256, 1.0, 0.5, thermostat);
    for (int step = 0; step < 200; ++step) trajectory.advance(0.02);
    EXPECT_LT(trajectory.report().worst_energy_error, 1e-7);
  }
}

TEST(Trajectory, TotalMomentumStaysZeroUnderShear) {
  auto trajectory = flow(400, 1.0, 1.0, Thermostat::isoenergetic, {.rescale = true});
  for (int step = 0; step < 1000; ++step) trajectory.advance(0.05);
  double total[2] = {0.0, 0.0};
  const auto momenta = trajectory.momenta();
  for (std::size_t i = 0; i < momenta.size(); ++i) total[i % 2] += momenta[i];
  EXPECT_NEAR(total[0], 0.0, 1e-9);
  EXPECT_NEAR(total[1], 0.0, 1e-9);
}

// Four particles that stay well apart and well within range of each other: there w has all its derivatives.
Start<2> four_particles() {
  Start<2> start;
  start.lengths = {20.0, 20.0};
  start.position = {{9.6, 9.7}, {10.7, 9.9}, {9.9, 10.9}, {10.8, 11.1}};
  start.momentum = {{-0.25, -0.10}, {0.20, -0.15}, {-0.15, 0.20}, {0.20, 0.05}};
  return start;
}

double final_error(Integrator integrator, double rate, double dt, const std::vector<double>& exact) {
  Shear shear;
  shear.strain_rate = rate;
  shear.thermostat = rate == 0.0 ? Thermostat::none : Thermostat::isoenergetic;
  Watch watch;
  watch.rescale = false;
  watch.energy_tolerance = 1.0;
  Trajectory<2> trajectory(lucy_kernel, four_particles(), shear, integrator, watch, Team(1));
  for (int step = 0; step < static_cast<int>(std::lround(0.8 / dt)); ++step) trajectory.advance(dt);
  const auto position = trajectory.positions();
  double error = 0.0;
  for (std::size_t k = 0; k < position.size(); ++k) error = std::max(error, std::abs(position[k] - exact[k]));
  return error;
}

double measured_order(Integrator integrator, double rate) {
  testing::SlowSllod slow{lucy_kernel, {20.0, 20.0}, rate};
  if (rate == 0.0) slow.thermostat = Thermostat::none;
  auto state = slow.start(four_particles());
  for (int step = 0; step < 800; ++step) slow.step(state, 0.001);
  std::vector<double> exact;
  for (std::size_t i = 0; i < 4; ++i) {
    exact.push_back(state.y[4 * i]);
    exact.push_back(state.y[4 * i + 1]);
  }
  return std::log2(final_error(integrator, rate, 0.1, exact) / final_error(integrator, rate, 0.05, exact));
}

TEST(Trajectory, RungeKuttaIsOfFourthOrder) {
  EXPECT_NEAR(measured_order(Integrator::runge_kutta_4, 0.0), 4.0, 0.25);
  EXPECT_NEAR(measured_order(Integrator::runge_kutta_4, 0.3), 4.0, 0.25);
}

TEST(Trajectory, VelocityVerletIsOfSecondOrder) {
  EXPECT_NEAR(measured_order(Integrator::velocity_verlet, 0.0), 2.0, 0.15);
}

TEST(Trajectory, VelocityVerletKeepsTheEnergyWithoutDrift) {
  auto trajectory = flow(256, 1.0, 0.0, Thermostat::none, {.integrator = Integrator::velocity_verlet});
  const double start = trajectory.energy();
  double worst_early = 0.0;
  double worst_late = 0.0;
  for (int step = 0; step < 4000; ++step) {
    trajectory.advance(0.05);
    double& worst = step < 2000 ? worst_early : worst_late;
    worst = std::max(worst, std::abs(trajectory.energy() - start) / 256.0);
  }
  EXPECT_LT(worst_late, 1e-4);
  EXPECT_LT(worst_late, 2.0 * worst_early + 1e-6);
}

TEST(Trajectory, ReversedMomentaLeadBack) {
  Start<2> start = lattice_start(lucy_kernel, 100, 1.0, 1.0, 32);
  Watch watch;
  watch.energy_tolerance = 1.0;
  const Shear at_rest{.strain_rate = 0.0, .thermostat = Thermostat::none};
  Trajectory<2> there(lucy_kernel, start, at_rest, Integrator::velocity_verlet, watch, Team(1));
  for (int step = 0; step < 100; ++step) there.advance(0.02);
  Start<2> turned = start;
  const auto position = there.positions();
  const auto momentum = there.momenta();
  for (std::size_t i = 0; i < 100; ++i) {
    for (std::size_t d = 0; d < 2; ++d) {
      turned.position[i][d] = position[2 * i + d];
      turned.momentum[i][d] = -momentum[2 * i + d];
    }
  }
  Trajectory<2> back(lucy_kernel, turned, at_rest, Integrator::velocity_verlet, watch, Team(1));
  for (int step = 0; step < 100; ++step) back.advance(0.02);
  const auto again = back.positions();
  for (std::size_t i = 0; i < 100; ++i) EXPECT_LT(distance(back.box(), &again[2 * i], start.position[i].data()), 1e-10);
}

// SLLOD with the ergostat has no arrow of time: the independent integrator, with a negative step, leads back from where
// ours has come to.
TEST(Trajectory, ShearedMotionRunsBackwardsToItsStart) {
  const Start<2> start = lattice_start(lucy_kernel, 100, 1.0, 1.0, 33);
  testing::SlowSllod forward{lucy_kernel, {10.0, 10.0}, 0.5};
  auto ours = flow(100, 1.0, 0.5, Thermostat::isoenergetic, {}, 33);
  for (int step = 0; step < 100; ++step) ours.advance(0.02);
  // Back with the independent integrator from where ours ended, time running from the strain reached to zero.
  testing::SlowState state = forward.start(start);
  const auto position = ours.positions();
  const auto momentum = ours.momenta();
  for (std::size_t i = 0; i < 100; ++i) {
    state.y[4 * i] = position[2 * i];
    state.y[4 * i + 1] = position[2 * i + 1];
    state.y[4 * i + 2] = momentum[2 * i];
    state.y[4 * i + 3] = momentum[2 * i + 1];
  }
  state.time = 2.0;
  for (int step = 0; step < 100; ++step) forward.step(state, -0.02);
  const space::Box<2> box({10.0, 10.0});
  for (std::size_t i = 0; i < 100; ++i) EXPECT_LT(distance(box, &state.y[4 * i], start.position[i].data()), 1e-6);
}

TEST(Trajectory, SubdividesAStepThatChangesTheEnergyTooMuch) {
  Start<2> start = lattice_start(lucy_kernel, 400, 1.0, 0.5, 34);
  start.momentum[7] = {25.0, 3.0};
  start.momentum[8] = {-25.0, -3.0};
  const Shear at_rest{.strain_rate = 0.0, .thermostat = Thermostat::none};
  Watch strict;
  strict.energy_tolerance = 1e-8;
  Trajectory<2> careful(lucy_kernel, start, at_rest, Integrator::runge_kutta_4, strict, Team(1));
  Watch loose;
  loose.energy_tolerance = 1.0;
  Trajectory<2> careless(lucy_kernel, start, at_rest, Integrator::runge_kutta_4, loose, Team(1));
  const double energy = careful.energy();
  for (int step = 0; step < 40; ++step) {
    careful.advance(0.1);
    careless.advance(0.1);
  }
  EXPECT_GT(careful.report().subdivided_steps, 20);
  EXPECT_LE(careful.report().worst_energy_error, 1e-8);
  EXPECT_NEAR(careful.energy(), energy, 400 * 1e-5);
  EXPECT_GT(careless.report().worst_energy_error, 1e-6);
  EXPECT_NEAR(careful.time(), 4.0, 1e-12);
}

TEST(Trajectory, GivesUpWithASentenceWhenSubdividingDoesNotHelp) {
  auto trajectory = flow(100, 1.0, 0.1, Thermostat::isoenergetic, {.energy_tolerance = 1e-19});
  try {
    for (int step = 0; step < 10; ++step) trajectory.advance(0.05);
    FAIL() << "an energy tolerance below rounding was met";
  } catch (const RunFailed& failure) {
    EXPECT_NE(std::string(failure.what()).find("run.energy_tolerance"), std::string::npos) << failure.what();
  }
}

TEST(Trajectory, GivesTheSameBitsForEveryNumberOfThreads) {
  auto alone = flow(4096, 1.0, 0.3, Thermostat::isoenergetic, {.rescale = true});
  auto together = flow(4096, 1.0, 0.3, Thermostat::isoenergetic, {.rescale = true, .threads = 3});
  for (int step = 0; step < 20; ++step) {
    alone.advance(0.05);
    together.advance(0.05);
  }
  EXPECT_EQ(alone.positions(), together.positions());
  EXPECT_EQ(alone.momenta(), together.momenta());
  EXPECT_EQ(alone.energy(), together.energy());
  EXPECT_EQ(alone.kinetic().momentum_flux, together.kinetic().momentum_flux);
}

TEST(Trajectory, GoesOnFromASavedStateWithTheSameBits) {
  for (Thermostat thermostat : {Thermostat::isoenergetic, Thermostat::nose_hoover}) {
    auto whole = flow(400, 1.0, 0.3, thermostat, {.rescale = true, .energy_tolerance = 1e-8});
    for (int step = 0; step < 37; ++step) whole.advance(0.05);
    ArchiveWriter saved;
    whole.save(saved);
    auto resumed = flow(400, 1.0, 0.3, thermostat, {.rescale = true, .energy_tolerance = 1e-8}, 99);
    ArchiveReader reader(saved.bytes());
    resumed.load(reader);
    EXPECT_TRUE(reader.exhausted());
    for (auto* trajectory : {&whole, &resumed}) {
      trajectory->renew_list(0.05);
      for (int step = 0; step < 50; ++step) trajectory->advance(0.05);
    }
    EXPECT_EQ(whole.positions(), resumed.positions());
    EXPECT_EQ(whole.momenta(), resumed.momenta());
    EXPECT_EQ(whole.energy(), resumed.energy());
    EXPECT_EQ(whole.report().energy_rescaled, resumed.report().energy_rescaled);
  }
}

TEST(Trajectory, RefusesATruncatedState) {
  auto trajectory = flow(100, 1.0, 0.3, Thermostat::isoenergetic);
  ArchiveWriter saved;
  trajectory.save(saved);
  for (std::size_t length : {std::size_t{0}, std::size_t{7}, saved.bytes().size() / 2, saved.bytes().size() - 1}) {
    ArchiveReader reader(std::span(saved.bytes()).first(length));
    EXPECT_THROW(trajectory.load(reader), RunFailed);
  }
}

TEST(Trajectory, ThreeDimensionsComeFree) {
  Start<3> start;
  start.lengths = {7.0, 7.0, 7.0};
  std::mt19937_64 generator(35);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 343; ++i) {
    start.position.push_back({i % 7 + 0.5, i / 7 % 7 + 0.5, i / 49 + 0.5});
    start.momentum.push_back({normal(generator), normal(generator), normal(generator)});
  }
  Shear shear{.strain_rate = 0.4, .thermostat = Thermostat::isoenergetic};
  Watch watch{.energy_tolerance = 1e-3, .rescale = false};
  Trajectory<3> trajectory(kernel::Lucy<3>(3.0), start, shear, Integrator::runge_kutta_4, watch, Team(1));
  const double energy = trajectory.energy();
  for (int step = 0; step < 200; ++step) trajectory.advance(0.02);
  EXPECT_NEAR(trajectory.energy() / energy, 1.0, 1e-7);
}

}  // namespace
}  // namespace lucy::motion
