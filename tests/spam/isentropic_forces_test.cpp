// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/spam/isentropic_forces.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <random>

#include "lucy/md/lucy_atoms.hpp"
#include "pairs/crowd.hpp"

namespace lucy::spam {
namespace {

using pairs::testing::Arranged;
using pairs::testing::Crowd;

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
    pairs::KeptPairs slopes;
    totals = isentropic_forces<D>(kernel::Lucy<D>(range), state, arranged.list, pairs::image_table(crowd.box, 0.0),
                                  Arranged<D>::pointers(arranged.position), columns_of(force), fluid[0], fluid[1],
                                  slopes, pairs::Wanted::everything, team);
  }

  static std::array<double*, D> columns_of(space::Columns& columns) {
    std::array<double*, D> result;
    for (int d = 0; d < D; ++d) result[d] = columns[d];
    return result;
  }
};

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
