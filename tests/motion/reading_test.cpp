// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Atoms and smooth particles move alike, to the bit, through thousands of steps and every kind of motion.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "lucy/motion/trajectory.hpp"

namespace lucy::motion {
namespace {

Trajectory<2> fluid(Reading reading, double rate, Thermostat thermostat, Integrator integrator, int threads) {
  const kernel::Lucy<2> kernel(3.0);
  Shear shear;
  shear.strain_rate = rate;
  shear.thermostat = thermostat;
  return Trajectory<2>(kernel, lattice_start(kernel, 100, 1.0, 1.0, 5), shear, integrator, Watch{}, Team(threads),
                       reading);
}

std::vector<std::uint64_t> bits_of(const std::vector<double>& values) {
  std::vector<std::uint64_t> bits;
  for (const double value : values) bits.push_back(std::bit_cast<std::uint64_t>(value));
  return bits;
}

void expect_same_bits(double rate, Thermostat thermostat, Integrator integrator, int threads = 1) {
  auto atoms = fluid(Reading::md, rate, thermostat, integrator, 1);
  auto smooth = fluid(Reading::spam, rate, thermostat, integrator, threads);
  for (int step = 1; step <= 1500; ++step) {
    atoms.advance(0.05);
    smooth.advance(0.05);
    if (step % 50 != 0) continue;
    ASSERT_EQ(bits_of(atoms.positions()), bits_of(smooth.positions())) << step;
    ASSERT_EQ(bits_of(atoms.momenta()), bits_of(smooth.momenta())) << step;
    ASSERT_EQ(bits_of(atoms.forces()), bits_of(smooth.forces())) << step;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(atoms.energy()), std::bit_cast<std::uint64_t>(smooth.energy())) << step;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(atoms.friction()), std::bit_cast<std::uint64_t>(smooth.friction())) << step;
  }
}

TEST(Readings, MoveAlikeAtRest) { expect_same_bits(0.0, Thermostat::none, Integrator::runge_kutta_4); }

TEST(Readings, MoveAlikeAtRestByVerlet) { expect_same_bits(0.0, Thermostat::none, Integrator::velocity_verlet); }

TEST(Readings, MoveAlikeUnderShearWithTheErgostat) {
  expect_same_bits(0.5, Thermostat::isoenergetic, Integrator::runge_kutta_4);
}

TEST(Readings, MoveAlikeUnderShearAtConstantTemperature) {
  expect_same_bits(-0.3, Thermostat::isokinetic, Integrator::runge_kutta_4);
}

TEST(Readings, MoveAlikeOnAnyNumberOfThreads) {
  expect_same_bits(0.5, Thermostat::isoenergetic, Integrator::runge_kutta_4, 3);
}

}  // namespace
}  // namespace lucy::motion
