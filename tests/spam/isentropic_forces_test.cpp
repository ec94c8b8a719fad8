// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/spam/isentropic_forces.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "lucy/md/lucy_atoms.hpp"
#include "lucy/spam/density.hpp"
#include "pairs/crowd.hpp"

namespace lucy::spam {
namespace {

using pairs::testing::Arranged;
using pairs::testing::Crowd;
using pairs::testing::for_all_pairs;

constexpr double range = 3.0;

template <int D>
Crowd<D> crowd_in(const space::Vector<D>& lengths, int particles, std::mt19937_64& generator) {
  return Crowd<D>::random(particles, space::Box<D>(lengths), 1.0, generator());
}

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

/// Of one crowd: densities, P/rho^2 and forces by slot.
template <int D>
struct Fluid {
  Arranged<D> arranged;
  space::Columns force;
  space::Columns fluid;
  pairs::PairTotals<D> totals;

  Fluid(const Crowd<D>& crowd, const Isentropic& state, const Team& team = Team(1))
      : arranged(crowd), force(D, arranged.list.capacity()), fluid(2, arranged.list.capacity()) {
    arranged.build(crowd, range, 0.0, 0.0);
    totals = isentropic_forces<D>(kernel::Lucy<D>(range), state, arranged.list, pairs::image_table(crowd.box, 0.0),
                                  Arranged<D>::pointers(arranged.position), columns_of(force), fluid[0], fluid[1],
                                  pairs::Wanted::everything, team);
  }

  static std::array<double*, D> columns_of(space::Columns& columns) {
    std::array<double*, D> result;
    for (int d = 0; d < D; ++d) result[d] = columns[d];
    return result;
  }
};

template <int D>
void expect_density_of_all_partners(const Crowd<D>& crowd) {
  const kernel::Lucy<D> kernel(range);
  std::vector<double> density(crowd.position.size(), kernel.weight_at_zero());
  for_all_pairs<D>(crowd.box, crowd.position, 0.0, range,
                   [&](std::size_t i, std::size_t j, const auto& apart, const auto&) {
                     double squared = 0.0;
                     for (double component : apart) squared += component * component;
                     density[i] += kernel.weight(std::sqrt(squared));
                     density[j] += kernel.weight(std::sqrt(squared));
                   });
  const Fluid<D> fluid(crowd, Isentropic());
  for (std::size_t slot = 0; slot < fluid.arranged.number.size(); ++slot) {
    const auto number = fluid.arranged.number[slot];
    if (number == pairs::nobody) continue;
    const double expected = density[static_cast<std::size_t>(number)];
    EXPECT_NEAR(fluid.fluid[0][slot], expected, 1e-13 * expected);
  }
}

TEST(Density, CountsEveryPartnerAndTheParticleItself) {
  std::mt19937_64 generator(3);
  expect_density_of_all_partners<1>(crowd_in<1>({40.0}, 60, generator));
  expect_density_of_all_partners<2>(crowd_in<2>({12.0, 9.0}, 200, generator));
  expect_density_of_all_partners<3>(crowd_in<3>({7.0, 8.0, 9.0}, 400, generator));
}

// P/rho^2 = P0/(2 rho0^2) exactly, whatever the density: the heart of the isomorphism.
TEST(Isentropic, ItsSpecificPressureIsOneHalfInEveryBit) {
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> exponent(-30.0, 30.0);
  const Isentropic unit;
  const Isentropic other(4.0, 0.5);
  for (int i = 0; i < 100000; ++i) {
    const double rho = std::exp(exponent(generator));
    EXPECT_EQ(bits(unit.pressure(rho) / (rho * rho)), bits(0.5));
    EXPECT_EQ(bits(other.pressure(rho) / (rho * rho)), bits(8.0));
  }
  EXPECT_THROW(Isentropic(3.0, 1.0), BadInput);
  EXPECT_THROW(Isentropic(1.0, -2.0), BadInput);
}

TEST(Isentropic, EnergyIsThePressuresWork) {
  const Isentropic state(2.0, 0.5);
  for (const double rho : {0.3, 1.0, 4.0}) {
    const double step = 1e-6 * rho;
    const double slope = (state.energy(rho + step) - state.energy(rho - step)) / (2.0 * step);
    EXPECT_NEAR(slope, state.pressure(rho) / (rho * rho), 1e-8 * slope);
  }
}

template <int D>
void expect_atoms_bits(const Crowd<D>& crowd) {
  Fluid<D> smooth(crowd, Isentropic());
  Arranged<D> arranged(crowd);
  arranged.build(crowd, range, 0.0, 0.0);
  space::Columns force(D, arranged.list.capacity());
  const auto atoms = md::lucy_forces<D>(kernel::Lucy<D>(range), arranged.list, pairs::image_table(crowd.box, 0.0),
                                        Arranged<D>::pointers(arranged.position), Fluid<D>::columns_of(force),
                                        pairs::Wanted::everything, Team(1));
  ASSERT_EQ(arranged.number, smooth.arranged.number);
  for (std::size_t slot = 0; slot < arranged.number.size(); ++slot)
    for (int d = 0; d < D; ++d) ASSERT_EQ(bits(force[d][slot]), bits(smooth.force[d][slot])) << slot;
  EXPECT_EQ(bits(atoms.potential_energy), bits(smooth.totals.potential_energy));
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) EXPECT_EQ(bits(atoms.virial(a, b)), bits(smooth.totals.virial(a, b)));
}

TEST(IsentropicForces, AreThoseOfTheAtomsInEveryBit) {
  std::mt19937_64 generator(7);
  for (int repeat = 0; repeat < 5; ++repeat) {
    expect_atoms_bits<1>(crowd_in<1>({40.0}, 60, generator));
    expect_atoms_bits<2>(crowd_in<2>({16.0, 13.0}, 250, generator));
    expect_atoms_bits<3>(crowd_in<3>({7.0, 8.0, 9.0}, 400, generator));
  }
}

TEST(IsentropicForces, AreThoseOfAnotherFluidTimesItsCoefficient) {
  std::mt19937_64 generator(9);
  const Crowd<2> crowd = crowd_in<2>({16.0, 13.0}, 250, generator);
  const Fluid<2> unit(crowd, Isentropic());
  const Fluid<2> stiff(crowd, Isentropic(4.0, 0.5));  // P0/rho0^2 = 16
  for (std::size_t slot = 0; slot < unit.arranged.number.size(); ++slot)
    for (int d = 0; d < 2; ++d) EXPECT_EQ(stiff.force[d][slot], 16.0 * unit.force[d][slot]);
}

TEST(IsentropicForces, DoNotDependOnTheNumberOfThreads) {
  std::mt19937_64 generator(11);
  const Crowd<2> crowd = crowd_in<2>({60.0, 60.0}, 3600, generator);
  const Fluid<2> alone(crowd, Isentropic(), Team(1));
  const Fluid<2> shared(crowd, Isentropic(), Team(3));
  for (std::size_t slot = 0; slot < alone.arranged.number.size(); ++slot) {
    EXPECT_EQ(bits(alone.fluid[0][slot]), bits(shared.fluid[0][slot]));
    for (int d = 0; d < 2; ++d) EXPECT_EQ(bits(alone.force[d][slot]), bits(shared.force[d][slot]));
  }
}

}  // namespace
}  // namespace lucy::spam
