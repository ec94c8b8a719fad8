// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/benard_comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lucy/errors.hpp"

namespace lucy::cases {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

template <class Point>
Point convecting(double rayleigh, double height = 50.0) {
  Point point;
  point.height = height;
  point.rayleigh = rayleigh;
  set_unset(point);
  return point;
}

/// Every value 2 % below the continuum of grid_rows(), with an error of 1 % of it.
BenardRow particles(double rayleigh, double height = 50.0) {
  BenardRow row;
  row.settings = convecting<BenardPoint>(rayleigh, height);
  row.settings.particles = static_cast<std::int64_t>(2.0 * height * height);
  for (const auto name : benard_compared) {
    const double continuum = name.starts_with("nusselt") ? 2.0 : 0.005;
    for (std::size_t i = 0; i < benard_quantities.size(); ++i)
      if (benard_quantities[i] == name) row.estimates[i] = {0.98 * continuum, 0.01 * continuum, 100.0, 99};
  }
  return row;
}

/// K(n) = K + 1/n^2 exactly, K = 0.005; both Nusselt numbers are 2.
std::vector<BenardGridRow> grid_rows(BenardGridPoint point, std::vector<int> meshes = {20, 40, 60}) {
  std::vector<BenardGridRow> rows;
  for (const int cells : meshes) {
    BenardGridRow& row = rows.emplace_back();
    row.settings = point;
    row.settings.cells = cells;
    row.kinetic_energy = 0.005 + 1.0 / (static_cast<double>(cells) * cells);
    row.nusselt_hot = 2.0;
    row.nusselt_cold = 2.0;
  }
  return rows;
}

std::vector<BenardGridRow> grid_rows(double rayleigh, double height = 50.0) {
  return grid_rows(convecting<BenardGridPoint>(rayleigh, height));
}

PublishedBenard published(std::int64_t particles, double kinetic_energy) {
  PublishedBenard print;
  print.particles = particles;
  print.convection = convecting<Convection>(10000.0);
  print.kinetic_energy.value = kinetic_energy;
  print.kinetic_energy.last_digit = 0.0001;
  return print;
}

std::vector<std::string_view> quantities(const BenardComparison& comparison) {
  std::vector<std::string_view> names;
  for (const BenardComparedRow& row : comparison.rows) names.push_back(row.quantity);
  return names;
}

bool same(const auto& change) {
  const auto point = convecting<BenardPoint>(10000.0);
  auto other = convecting<BenardGridPoint>(10000.0);
  change(other);
  return same_convection(point, other);
}

TEST(BenardComparison, MatchesWhatIsOneProblemOfAContinuum) {
  EXPECT_TRUE(same([](BenardGridPoint&) {}));
  // Twice as high, with all that has a length: the same flow, twice as large.
  EXPECT_TRUE(same([](BenardGridPoint& point) { point = convecting<BenardGridPoint>(10000.0, 100.0); }));
  // The same coefficients, given instead of the Rayleigh number.
  EXPECT_TRUE(same([](BenardGridPoint& point) {
    point = {};
    point.viscosity = 0.5;
    point.conductivity = 0.5;
    set_unset(point);
  }));
}

TEST(BenardComparison, TellsApartWhateverMakesAnotherFlow) {
  EXPECT_FALSE(same([](BenardGridPoint& point) { point = convecting<BenardGridPoint>(10001.0); }));
  EXPECT_FALSE(same([](BenardGridPoint& point) { point.hot = 1.6; }));
  EXPECT_FALSE(same([](BenardGridPoint& point) { point.cold = 0.4; }));
  EXPECT_FALSE(same([](BenardGridPoint& point) { point.sides = grid::Sides::walls; }));
  EXPECT_FALSE(same([](BenardGridPoint& point) { point.width = 50.0; }));
  EXPECT_FALSE(same([](BenardGridPoint& point) { point.gravity = 0.03; }));
  EXPECT_FALSE(
      same([](BenardGridPoint& point) { point.equation_of_state = spam::EquationOfStateName::van_der_waals; }));
  // Viscosity and conductivity exchanged for others of the same product: the same Rayleigh number, another flow.
  EXPECT_FALSE(same([](BenardGridPoint& point) {
    point.viscosity = 0.25;
    point.conductivity = 1.0;
  }));
}

TEST(BenardComparison, DiffersInPerCentAndInCombinedErrors) {
  const auto comparisons = compare_benard(std::vector{particles(10000.0)}, grid_rows(10000.0), {}, {});
  ASSERT_THAT(comparisons, SizeIs(1));
  ASSERT_THAT(quantities(comparisons[0]), ElementsAre("kinetic_energy_total", "kinetic_energy_smoothed",
                                                      "kinetic_energy_field", "nusselt_hot", "nusselt_cold"));
  for (const BenardComparedRow& row : comparisons[0].rows) {
    ASSERT_THAT(row.beside, SizeIs(1));
    const BenardBeside& grid = row.beside[0];
    EXPECT_EQ(grid.source, BenardSource::grid);
    EXPECT_NEAR(grid.value, row.value / 0.98, 1e-12);
    EXPECT_NEAR(grid.error, 0.0, 1e-12);
    EXPECT_NEAR(grid.difference, row.value - grid.value, 1e-15);
    EXPECT_NEAR(grid.per_cent, -2.0, 1e-9);
    EXPECT_NEAR(grid.per_cent_error, 1.0, 1e-9);
    EXPECT_NEAR(grid.z, -2.0, 1e-9);
  }
}

TEST(BenardComparison, CombinesErrorsOfBothSides) {
  auto rows = grid_rows(10000.0);
  rows[0].kinetic_energy += 0.001;  // the parabola ends elsewhere than the line
  const auto limit = limits_of(rows)[0].kinetic_energy;
  ASSERT_GT(limit.error, 1e-6);
  const auto comparison = compare_benard(std::vector{particles(10000.0)}, rows, {}, {})[0];
  const BenardComparedRow& total = comparison.rows[0];
  EXPECT_DOUBLE_EQ(total.beside[0].error, limit.error);
  EXPECT_DOUBLE_EQ(total.beside[0].difference_error, std::hypot(total.error, limit.error));
  EXPECT_DOUBLE_EQ(total.beside[0].z, (total.value - limit.value) / std::hypot(total.error, limit.error));
  // By hand: the error of the quotient of two independent numbers.
  EXPECT_NEAR(total.beside[0].per_cent_error,
              100.0 * total.value / limit.value * std::hypot(total.error / total.value, limit.error / limit.value),
              1e-12);
}

TEST(BenardComparison, HasNoErrorWhereOneSideHasNone) {
  const auto rows = grid_rows(convecting<BenardGridPoint>(10000.0), {20, 40});
  const BenardBeside grid = compare_benard(std::vector{particles(10000.0)}, rows, {}, {})[0].rows[0].beside[0];
  EXPECT_NEAR(grid.per_cent, -2.0, 1e-9);
  EXPECT_TRUE(std::isnan(grid.error));
  EXPECT_TRUE(std::isnan(grid.z));
}

TEST(BenardComparison, PrintStandsBesideTheTotalAndTheContinuumBesideItsOwn) {
  const std::vector print = {published(0, 0.0048), published(5000, 0.0046), published(800, 0.0072)};
  const auto comparison = compare_benard(std::vector{particles(10000.0)}, grid_rows(10000.0), {}, print)[0];
  const double rounding = 0.0001 / std::sqrt(12.0);
  ASSERT_THAT(comparison.rows[0].beside, SizeIs(2));
  const BenardBeside& total = comparison.rows[0].beside[1];
  EXPECT_EQ(total.source, BenardSource::published);
  EXPECT_EQ(total.value, 0.0046);
  EXPECT_EQ(total.last_digit, 0.0001);
  EXPECT_NEAR(total.error, rounding, 1e-12);
  EXPECT_NEAR(total.z, (0.0049 - 0.0046) / std::hypot(0.00005, rounding), 1e-9);
  EXPECT_THAT(comparison.rows[1].beside, SizeIs(1));
  ASSERT_EQ(comparison.rows.back().quantity, "kinetic_energy_continuum");
  EXPECT_NEAR(comparison.rows.back().value, 0.005, 1e-12);
  EXPECT_NEAR(comparison.rows.back().beside[0].z, 0.0002 / rounding, 1e-6);
}

TEST(BenardComparison, LeavesOutWhatBelongsToOtherFluids) {
  const std::vector print = {published(800, 0.0072)};
  auto other = convecting<BenardGridPoint>(10000.0);
  other.transport = grid::Transport::kinematic;  // smooth particles have constant eta and k
  auto rows = grid_rows(other);
  for (const auto& row : grid_rows(5000.0)) rows.push_back(row);
  const auto comparison = compare_benard(std::vector{particles(10000.0)}, rows, {}, print)[0];
  EXPECT_FALSE(comparison.grid);
  for (const BenardComparedRow& row : comparison.rows) EXPECT_THAT(row.beside, IsEmpty());
}

TEST(BenardComparison, TakesMeshesOfSeveralRunsTogether) {
  auto rows = grid_rows(convecting<BenardGridPoint>(10000.0), {20});
  for (const auto& row : grid_rows(convecting<BenardGridPoint>(10000.0), {40, 60})) rows.push_back(row);
  const auto comparison = compare_benard(std::vector{particles(10000.0)}, rows, {}, {})[0];
  ASSERT_TRUE(comparison.grid);
  EXPECT_EQ(comparison.grid->meshes, 3);
}

TEST(BenardComparison, FluidsWithoutViscosityHaveNoContinuum) {
  BenardRow row = particles(10000.0);
  row.settings.viscosity = 0.0;
  row.settings.conductivity = 0.1;
  row.settings.rayleigh = std::numeric_limits<double>::infinity();
  const auto comparison = compare_benard(std::vector{row}, grid_rows(10000.0), grid_rows(3000.0), {})[0];
  EXPECT_FALSE(comparison.grid);
  EXPECT_FALSE(comparison.effective);
}

/// A flow with coefficients larger than those of particles at `rayleigh`, in the same cell.
std::vector<BenardGridRow> effective_rows(double rayleigh, double viscosity, double conductivity) {
  auto point = convecting<BenardGridPoint>(rayleigh);
  point.viscosity = *point.viscosity * viscosity;
  point.conductivity = *point.conductivity * conductivity;
  point.rayleigh = rayleigh / viscosity / conductivity;
  return grid_rows(point);
}

TEST(BenardComparison, EffectiveFlowsBelongToParticlesInTheOrderOfRayleighNumbers) {
  const std::vector rows = {particles(10000.0), particles(5000.0), particles(10000.0), particles(10000.0, 20.0)};
  auto effective = effective_rows(10000.0, 1.3, 1.1);
  for (const auto& row : effective_rows(5000.0, 1.2, 1.1)) effective.push_back(row);
  const auto comparisons = compare_benard(rows, {}, effective, {});
  ASSERT_TRUE(comparisons[0].effective);
  EXPECT_NEAR(*comparisons[0].effective->settings.viscosity, 0.5 * 1.3, 1e-12);
  ASSERT_TRUE(comparisons[1].effective);
  EXPECT_NEAR(*comparisons[1].effective->settings.viscosity, std::sqrt(0.5) * 1.2, 1e-12);
  ASSERT_TRUE(comparisons[2].effective);   // others of the same fluid, such as particles with another weight
  EXPECT_FALSE(comparisons[3].effective);  // what particles add has a length: not in a cell of another height
  EXPECT_EQ(comparisons[0].rows[0].beside[0].source, BenardSource::effective_grid);
}

TEST(BenardComparison, RefusesEffectiveFlowsThatCannotBeTold) {
  const std::vector rows = {particles(10000.0), particles(5000.0)};
  std::string message;
  try {
    compare_benard(rows, {}, effective_rows(10000.0, 1.3, 1.1), {});
  } catch (const BadInput& refusal) {
    message = refusal.what();
  }
  EXPECT_THAT(message, HasSubstr("at 1 Rayleigh number in the cell of 50 x 100, where particles have 2"));
}

}  // namespace
}  // namespace lucy::cases
