// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/measure/fields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "lucy/errors.hpp"
#include "pairs/crowd.hpp"

namespace lucy::measure {
namespace {

using pairs::testing::Crowd;
using ::testing::HasSubstr;

/// A crowd with internal energies, as flat numbers.
template <int D>
struct Matter {
  space::Box<D> box;
  std::vector<double> position;
  std::vector<double> velocity;
  std::vector<double> energy;

  static Matter random(int particles, const space::Box<D>& box, std::uint64_t seed) {
    const auto crowd = Crowd<D>::random(particles, box, 1.0, seed);
    Matter matter{box, {}, {}, {}};
    std::mt19937_64 generator(seed + 1);
    std::uniform_real_distribution<double> uniform(0.5, 1.5);
    for (std::size_t i = 0; i < crowd.position.size(); ++i) {
      matter.position.insert(matter.position.end(), crowd.position[i].begin(), crowd.position[i].end());
      matter.velocity.insert(matter.velocity.end(), crowd.velocity[i].begin(), crowd.velocity[i].end());
      matter.energy.push_back(uniform(generator));
    }
    return matter;
  }

  std::size_t particles() const { return energy.size(); }
  FieldSource<D> source() const { return {box, position, velocity, energy}; }
};

template <int D>
std::vector<double> random_points(int count, const space::Box<D>& box, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> points;
  for (int k = 0; k < count; ++k)
    for (int d = 0; d < D; ++d) points.push_back(uniform(generator) * box.lengths()[d]);
  return points;
}

/// The sums at one point, over all particles and images up to three boxes away, with laboratory velocities of images.
template <int D>
struct ByBruteForce {
  double density = 0.0;
  space::Vector<D> laboratory{};
  double square = 0.0;
  double energy = 0.0;

  ByBruteForce(const kernel::Weight<D>& weight, const Matter<D>& matter, const double* point) {
    const double range = kernel::range_of(weight);
    const int images = D == 1 ? 7 : D == 2 ? 49 : 343;
    for (std::size_t j = 0; j < matter.particles(); ++j) {
      for (int code = 0; code < images; ++code) {
        std::array<int, D> n{};
        for (int d = 0, rest = code; d < D; ++d, rest /= 7) n[d] = rest % 7 - 3;
        const auto shift = matter.box.image(n, 0.0);
        double squared = 0.0;
        for (int d = 0; d < D; ++d) {
          const double apart = point[d] - matter.position[j * D + static_cast<std::size_t>(d)] - shift.position[d];
          squared += apart * apart;
        }
        if (squared >= range * range) continue;
        const double w = std::visit([&](const auto& kernel) { return kernel.weight(std::sqrt(squared)); }, weight);
        density += w;
        energy += w * matter.energy[j];
        for (int d = 0; d < D; ++d) {
          const double p = matter.velocity[j * D + static_cast<std::size_t>(d)];
          double v = p + shift.velocity[d];
          if (D > 1 && d == 0) v += matter.box.strain_rate() * matter.position[j * D + 1];
          laboratory[d] += w * v;
          square += w * p * p;
        }
      }
    }
  }
};

template <int D>
void expect_sums_over_all_images(const kernel::Weight<D>& weight, const Matter<D>& matter, std::uint64_t seed) {
  const auto points = random_points<D>(60, matter.box, seed);
  const auto found = moments<D>(weight, matter.source(), points, Team(1)).points;
  const auto fields = fields_of<D>(found, points, matter.box.strain_rate(), spam::VanDerWaals(), true);
  const Field& velocity = *find_field(fields, "velocity_smoothed");
  for (std::size_t k = 0; k < 60; ++k) {
    const ByBruteForce<D> expected(weight, matter, points.data() + k * D);
    const double rho = expected.density;
    EXPECT_NEAR(found.column[Moments<D>::density][k], rho, 1e-13 * rho);
    EXPECT_NEAR(found.column[Moments<D>::square][k], expected.square, 1e-12 * expected.square);
    EXPECT_NEAR(find_field(fields, "density")->values[k], rho, 1e-13 * rho);
    EXPECT_NEAR(find_field(fields, "internal_energy")->values[k], expected.energy / rho, 1e-12);
    for (int d = 0; d < D; ++d)
      EXPECT_NEAR(velocity.values[k * D + static_cast<std::size_t>(d)], expected.laboratory[d] / rho, 1e-11);
    EXPECT_NEAR(find_field(fields, "temperature")->values[k], expected.energy / rho + 0.5 * rho, 1e-12);
    const double pressure = spam::VanDerWaals().pressure(rho, expected.energy / rho);
    EXPECT_NEAR(find_field(fields, "pressure")->values[k], pressure, 1e-10 * (1.0 + std::abs(pressure)));
  }
}

TEST(Fields, AreSumsOverAllParticlesAndImages) {
  for (const auto name : {kernel::WeightName::lucy, kernel::WeightName::monaghan}) {
    expect_sums_over_all_images<1>(kernel::make_weight<1>(name, 3.0), Matter<1>::random(60, space::Box<1>({50.0}), 1),
                                   2);
    expect_sums_over_all_images<2>(kernel::make_weight<2>(name, 3.0),
                                   Matter<2>::random(150, space::Box<2>({12.0, 9.0}), 3), 4);
    expect_sums_over_all_images<3>(kernel::make_weight<3>(name, 3.0),
                                   Matter<3>::random(300, space::Box<3>({7.0, 6.5, 8.0}), 5), 6);
  }
}

TEST(Fields, ShearedImagesSlideAndCarryTheMeanFlow) {
  for (const double offset : {-4.3, 0.7, 5.9, 11.9}) {
    const auto weight = kernel::make_weight<2>(kernel::WeightName::lucy, 3.0);
    const auto matter = Matter<2>::random(100, space::Box<2>({12.0, 9.0}, 0.4, offset), 7);
    expect_sums_over_all_images<2>(weight, matter, 8);
  }
  expect_sums_over_all_images<3>(kernel::make_weight<3>(kernel::WeightName::monaghan, 2.5),
                                 Matter<3>::random(200, space::Box<3>({7.0, 6.5, 8.0}, -0.6, 2.2), 9), 10);
}

TEST(Fields, ABoxAsShortAsTheRangeSeesEveryParticleSeveralTimes) {
  const auto weight = kernel::make_weight<2>(kernel::WeightName::lucy, 4.0);
  const auto matter = Matter<2>::random(20, space::Box<2>({4.0, 4.5}, 0.3, 1.1), 11);
  expect_sums_over_all_images<2>(weight, matter, 12);
  EXPECT_NO_THROW(moments<2>(weight, matter.source(), {}, Team(1)));
  try {
    moments<2>(kernel::make_weight<2>(kernel::WeightName::lucy, 4.1), matter.source(), {}, Team(1));
    FAIL() << "a range longer than the box was accepted";
  } catch (const BadInput& refusal) {
    EXPECT_THAT(refusal.what(), HasSubstr("kernel.range = 4.1"));
  }
}

// The node has distance zero from the particle, and w(0) = A.
TEST(Fields, APointOnAParticleGetsTheParticlesOwnTerm) {
  const kernel::Weight<2> weight = kernel::Lucy<2>(3.0);
  const Matter<2> one{space::Box<2>({10.0, 10.0}), {2.5, 7.5}, {0.5, -1.0}, {2.0}};
  const std::vector<double> points = {2.5, 7.5, 6.0, 2.0};
  const auto sums = moments<2>(weight, one.source(), points, Team(1));
  const double own = 5.0 / (9.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(sums.points.column[Moments<2>::density][0], own);
  EXPECT_DOUBLE_EQ(sums.points.column[Moments<2>::energy][0], 2.0 * own);
  EXPECT_DOUBLE_EQ(sums.particles.column[Moments<2>::density][0], own);

  const auto matter = Matter<2>::random(300, space::Box<2>({14.0, 11.0}, 0.2, 3.0), 13);
  const auto all = moments<2>(weight, matter.source(), matter.position, Team(1));
  for (int c = 0; c < Moments<2>::count; ++c)
    for (std::size_t i = 0; i < matter.particles(); ++i)
      EXPECT_NEAR(all.points.column[c][i], all.particles.column[c][i], 2e-13);

  const auto fields = fields_of<2>(sums.points, points, 0.0, std::nullopt, true);
  EXPECT_DOUBLE_EQ(find_field(fields, "velocity_smoothed")->values[1], -1.0);
  EXPECT_DOUBLE_EQ(find_field(fields, "kinetic_temperature")->values[0], 0.0);
}

TEST(Fields, OutsideTheFluidDensitiesVanishAndVelocitiesAreUnknown) {
  const Matter<2> one{space::Box<2>({10.0, 10.0}), {2.5, 7.5}, {0.5, -1.0}, {2.0}};
  const std::vector<double> points = {6.0, 2.0};
  const auto sums = moments<2>(kernel::Lucy<2>(3.0), one.source(), points, Team(1)).points;
  const auto fields = fields_of<2>(sums, points, 0.1, spam::IdealGas(), true);
  for (const char* name : {"density", "pressure", "pressure_kinetic", "kinetic_energy_density_individual",
                           "kinetic_energy_density_smoothed"})
    EXPECT_EQ(find_field(fields, name)->values[0], 0.0) << name;
  for (const char* name :
       {"velocity_smoothed", "velocity_smoothed_peculiar", "internal_energy", "temperature", "kinetic_temperature"})
    EXPECT_TRUE(std::isnan(find_field(fields, name)->values[0])) << name;
}

// A square lattice of unit spacing with Lucy's h = 3: between .998033 and 1.002930 everywhere (Hoover and Hoover).
TEST(Fields, AUniformLatticeIsUniform) {
  Matter<2> lattice{space::Box<2>({12.0, 12.0}), {}, {}, {}};
  for (int i = 0; i < 144; ++i) {
    lattice.position.insert(lattice.position.end(), {i % 12 + 0.5, i / 12 + 0.5});
    lattice.velocity.insert(lattice.velocity.end(), {0.25, -0.5});
    lattice.energy.push_back(1.5);
  }
  const Grid grid{{120, 120}, {12.0, 12.0}};
  const auto points = grid.points();
  const auto sums = moments<2>(kernel::Lucy<2>(3.0), lattice.source(), points, Team(2)).points;
  const auto fields = fields_of<2>(sums, points, 0.0, spam::IdealGas(), true);
  const FieldSummary density = summary(find_field(fields, "density")->values);
  EXPECT_NEAR(density.lowest, 0.998033, 2e-6);
  EXPECT_NEAR(density.highest, 1.002930, 2e-6);
  EXPECT_NEAR(density.mean, 1.0, 1e-6);
  EXPECT_NEAR(summary(find_field(fields, "velocity_smoothed")->component(1)).highest, -0.5, 1e-15);
  EXPECT_NEAR(summary(find_field(fields, "temperature")->values).lowest, 1.5, 1e-14);
  EXPECT_LT(summary(find_field(fields, "kinetic_temperature")->values).highest, 1e-15);
}

TEST(Fields, TheGridHoldsTheWholeMass) {
  for (const double offset : {0.0, 7.7}) {
    const auto matter = Matter<2>::random(500, space::Box<2>({20.0, 25.0}, 0.5, offset), 15);
    const Grid grid = default_grid(matter.box.lengths(), 3.0);
    const auto sums = moments<2>(kernel::Lucy<2>(3.0), matter.source(), grid.points(), Team(2)).points;
    // Lucy's weight has two continuous derivatives: six nodes to the range integrate it to a few parts in a million.
    EXPECT_NEAR(summary(sums.column[Moments<2>::density]).mean * matter.box.volume(), 500.0, 1e-3);
    EXPECT_NEAR(summary(sums.column[Moments<2>::energy]).mean * matter.box.volume(),
                std::accumulate(matter.energy.begin(), matter.energy.end(), 0.0), 2e-3);
  }
}

// At equal places, whatever else is asked for, and in how many meetings.
TEST(Fields, DoNotDependOnTheOtherPoints) {
  const auto matter = Matter<2>::random(200, space::Box<2>({14.0, 15.0}, 0.3, 2.0), 17);
  const kernel::Weight<2> weight = kernel::Monaghan<2>(3.0);
  const auto many = random_points<2>(5000, matter.box, 18);
  const auto all = moments<2>(weight, matter.source(), many, Team(1)).points;
  const auto few = moments<2>(weight, matter.source(), std::span(many).first(14), Team(1)).points;
  for (int c = 0; c < Moments<2>::count; ++c)
    for (std::size_t k = 0; k < 7; ++k) EXPECT_NEAR(few.column[c][k], all.column[c][k], 1e-13);
}

TEST(Fields, AreTheSameBitsOnAnyNumberOfThreads) {
  const auto matter = Matter<2>::random(2000, space::Box<2>({45.0, 45.0}, 0.3, 2.0), 19);
  const auto points = random_points<2>(5000, matter.box, 20);
  const auto one = moments<2>(kernel::Lucy<2>(3.0), matter.source(), points, Team(1));
  const auto three = moments<2>(kernel::Lucy<2>(3.0), matter.source(), points, Team(3));
  for (int c = 0; c < Moments<2>::count; ++c) {
    for (std::size_t k = 0; k < one.points.places(); ++k)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(one.points.column[c][k]),
                std::bit_cast<std::uint64_t>(three.points.column[c][k]));
    for (std::size_t i = 0; i < one.particles.places(); ++i)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(one.particles.column[c][i]),
                std::bit_cast<std::uint64_t>(three.particles.column[c][i]));
  }
}

TEST(Fields, OfAtomsThePressureHasAKineticAndAPotentialPart) {
  const auto matter = Matter<2>::random(200, space::Box<2>({14.0, 15.0}), 21);
  const auto points = random_points<2>(50, matter.box, 22);
  const auto sums = moments<2>(kernel::Lucy<2>(3.0), matter.source(), points, Team(1)).points;
  const auto fields = fields_of<2>(sums, points, 0.0, std::nullopt, false);
  EXPECT_EQ(find_field(fields, "temperature"), nullptr);
  EXPECT_EQ(find_field(fields, "internal_energy"), nullptr);
  EXPECT_EQ(find_field(fields, "velocity_smoothed_peculiar"), nullptr);
  for (std::size_t k = 0; k < 50; ++k) {
    const double rho = find_field(fields, "density")->values[k];
    const double kT = find_field(fields, "kinetic_temperature")->values[k];
    EXPECT_NEAR(find_field(fields, "pressure_kinetic")->values[k], rho * kT, 1e-13);
    EXPECT_NEAR(find_field(fields, "pressure_potential")->values[k], 0.5 * rho * rho, 1e-13);
    EXPECT_NEAR(find_field(fields, "pressure")->values[k], rho * kT + 0.5 * rho * rho, 1e-13);
    // What smoothing takes out of the kinetic energy is the kinetic temperature, D/2 rho kT.
    EXPECT_NEAR(find_field(fields, "kinetic_energy_density_individual")->values[k],
                find_field(fields, "kinetic_energy_density_smoothed")->values[k] + rho * kT, 1e-13);
  }
}

TEST(Fields, AnIsentropicFluidHasAPressureButNoTemperature) {
  const auto matter = Matter<2>::random(50, space::Box<2>({7.0, 7.0}), 23);
  const std::vector<double> point = {1.0, 2.0};
  const auto sums = moments<2>(kernel::Lucy<2>(3.0), matter.source(), point, Team(1)).points;
  const auto isentropic = fields_of<2>(sums, point, 0.0, spam::Isentropic(), false);
  EXPECT_EQ(find_field(isentropic, "temperature"), nullptr);
  EXPECT_NE(find_field(isentropic, "pressure"), nullptr);
  const auto ideal = fields_of<2>(sums, point, 0.0, spam::IdealGas(), false);  // its energies are not known
  EXPECT_EQ(find_field(ideal, "pressure"), nullptr);
}

// Two frames of unequal density: the mean velocity is that of the mass, not of the frames.
TEST(Fields, AnAverageOverTimeIsOneOfDensities) {
  const std::vector<double> point = {5.0, 5.0};
  const Matter<2> slow{space::Box<2>({10.0, 10.0}), {5.0, 5.0}, {1.0, 0.0}, {1.0}};
  const Matter<2> fast{
      space::Box<2>({10.0, 10.0}), {5.0, 5.0, 5.0, 5.0, 5.0, 5.0}, {5.0, 0.0, 5.0, 0.0, 5.0, 0.0}, {2.0, 2.0, 2.0}};
  auto average = moments<2>(kernel::Lucy<2>(3.0), slow.source(), point, Team(1)).points;
  average.add(moments<2>(kernel::Lucy<2>(3.0), fast.source(), point, Team(1)).points);
  average.divide_by(2.0);
  const auto fields = fields_of<2>(average, point, 0.0, spam::IdealGas(), true);
  EXPECT_DOUBLE_EQ(find_field(fields, "density")->values[0], 2.0 * 5.0 / (9.0 * std::numbers::pi));
  EXPECT_DOUBLE_EQ(find_field(fields, "velocity_smoothed")->values[0], 4.0);
  EXPECT_DOUBLE_EQ(find_field(fields, "internal_energy")->values[0], 1.75);
  EXPECT_DOUBLE_EQ(find_field(fields, "kinetic_temperature")->values[0], 0.5 * (19.0 - 16.0));
}

TEST(Fields, KineticEnergiesOfIndividualAndSmoothedVelocities) {
  const auto matter = Matter<2>::random(800, space::Box<2>({20.0, 40.0}), 25);
  const Grid grid = default_grid(matter.box.lengths(), 3.0);
  const auto sums = moments<2>(kernel::Lucy<2>(3.0), matter.source(), grid.points(), Team(1));
  auto energies = kinetic_energies(matter.source(), sums.particles);
  energies.field = field_kinetic_energy(sums.points, 800.0, 800);
  double individual = 0.0;
  for (const double v : matter.velocity) individual += 0.5 * v * v / 800.0;
  EXPECT_NEAR(energies.individual, individual, 1e-12);
  EXPECT_LT(energies.field, energies.smoothed);  // at the particles, each counts its own velocity
  EXPECT_LT(energies.smoothed, 0.3 * individual);

  // On the grid, individual and smoothed differ by the kinetic temperature.
  const auto fields = fields_of<2>(sums.points, grid.points(), 0.0, std::nullopt, false);
  EXPECT_NEAR(summary(find_field(fields, "kinetic_energy_density_smoothed")->values).mean, energies.field, 1e-12);
  EXPECT_NEAR(summary(find_field(fields, "kinetic_energy_density_individual")->values).mean, individual, 1e-4);
}

TEST(Grid, CountsAlongXFirst) {
  const Grid grid{{2, 3}, {4.0, 9.0}};
  EXPECT_THAT(grid.points(), ::testing::ElementsAre(0, 0, 2, 0, 0, 3, 2, 3, 0, 6, 2, 6));
  EXPECT_THAT(grid.axis(1), ::testing::ElementsAre(0, 3, 6));
  EXPECT_THAT(default_grid({32.0, 32.0}, 3.0).nodes, ::testing::ElementsAre(64, 64));
  EXPECT_THAT(default_grid({1000.0, 1.0}, 3.0).nodes, ::testing::ElementsAre(1024, 16));
}

}  // namespace
}  // namespace lucy::measure
