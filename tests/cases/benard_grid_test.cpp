// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/benard_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "lucy/cases/benard_grid_table.hpp"
#include "lucy/errors.hpp"

namespace lucy::cases {
namespace {

using ::testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

BenardGridPoint point_of(double rayleigh, int cells) {
  BenardGridPoint point;
  point.height = 10.0;
  point.rayleigh = rayleigh;
  point.cells = cells;
  return point;
}

BenardGridRow row_of(const BenardGridPoint& point) {
  BenardGridRun run(point);
  while (run.intervals_done() < interval_count(point)) run.advance_one_interval();
  return summarize(point, run.record());
}

std::string refusal(const std::function<void(BenardGridPoint&)>& change) {
  BenardGridPoint point = point_of(5000.0, 8);
  change(point);
  try {
    validate(point);
  } catch (const BadInput& refusal) {
    return refusal.what();
  }
  return "accepted";
}

TEST(BenardGrid, RayleighNumbersAreThoseOfTheOriginalWork) {
  BenardGridPoint point = point_of(5000.0, 20);
  point.height = 50.0;
  EXPECT_NEAR(*resolved(point).viscosity, 0.70711, 1e-5);
  EXPECT_NEAR(*resolved(point).gravity, 0.02, 1e-15);
  point.equation_of_state = spam::EquationOfStateName::van_der_waals;
  EXPECT_NEAR(*resolved(point).viscosity, 0.8165, 1e-4);
  EXPECT_NEAR(*resolved(point).gravity, 0.04, 1e-15);
  point.equation_of_state = spam::EquationOfStateName::dense_fluid;
  point.height = 16.0;
  point.rayleigh = 3000.0;
  EXPECT_NEAR(*resolved(point).conductivity, 0.328, 5e-4);
  point.rayleigh.reset();
  point.viscosity = 0.2;
  point.conductivity = 0.1;
  EXPECT_NEAR(*resolved(point).rayleigh, 1.26 * 256.0 / 0.02, 1e-9);
  EXPECT_EQ(*resolved(resolved(point)).viscosity, 0.2);
  EXPECT_EQ(*resolved(resolved(point)).conductivity, 0.1);
}

TEST(BenardGrid, RefusesWhatCannotBe) {
  const auto says = [](const std::function<void(BenardGridPoint&)>& change, const char* part) {
    EXPECT_THAT(refusal(change), HasSubstr(part));
  };
  EXPECT_EQ(refusal([](BenardGridPoint&) {}), "accepted");
  says([](BenardGridPoint& p) { p.hot = 0.5; }, "cell.hot = 0.5 must be above cell.cold = 0.5");
  says([](BenardGridPoint& p) { p.viscosity = 1.0; }, "fluid.rayleigh = 5000 leaves nothing");
  says([](BenardGridPoint& p) { p.rayleigh.reset(); }, "fluid.rayleigh is missing");
  says([](BenardGridPoint& p) { p.rayleigh = nan; }, "fluid.rayleigh = nan");
  says([](BenardGridPoint& p) { p.cells = 3; }, "grid.cells = 3 must be at least 4");
  says([](BenardGridPoint& p) { p.width = 11.0; }, "makes 8.8 cells along x");
  says([](BenardGridPoint& p) { p.step = 2.0; }, "run.step = 2 is unstable with grid.cells = 8: at most ");
  says([](BenardGridPoint& p) { p.gravity = -1.0; }, "cell.gravity = -1 must be above 0");
  says([](BenardGridPoint& p) { p.duration = 1e300; }, "steps of run.step");
}

/// Kum, Hoover and Posch print 0.00340; three meshes up to 60 cells give 0.003398.
TEST(BenardGrid, HasTheKnownKineticEnergyOnCoarseMeshes) {
  BenardGridPoint point;
  point.rayleigh = 5000.0;
  std::vector<BenardGridRow> rows;
  for (const int cells : {10, 14, 20}) {
    point.cells = cells;
    rows.push_back(row_of(point));
    EXPECT_EQ(rows.back().status, RowStatus::ok);
    EXPECT_LT(std::abs(rows.back().mass_error), 1e-13);
  }
  EXPECT_NEAR(rows.back().kinetic_energy, 0.0034572, 1e-7);
  EXPECT_LT(std::abs(rows[2].energy_imbalance), 0.4 * std::abs(rows[0].energy_imbalance));
  const auto limits = limits_of(rows);
  ASSERT_EQ(limits.size(), 1u);
  EXPECT_EQ(limits[0].meshes, 3);
  EXPECT_NEAR(limits[0].kinetic_energy.value, 0.003398, 4e-6);
  EXPECT_LT(limits[0].kinetic_energy.error, 4e-6);
  EXPECT_NEAR(limits[0].nusselt_hot.value, 1.5433, 1e-2);
  EXPECT_NEAR(limits[0].nusselt_cold.value, 1.5433, 1e-2);
}

TEST(BenardGrid, RollsDieOutBelowTheCriticalRayleighNumber) {
  const BenardGridRow row = row_of(point_of(1000.0, 8));
  EXPECT_EQ(row.status, RowStatus::ok);
  EXPECT_LT(row.kinetic_energy, 1e-10);
  EXPECT_NEAR(row.nusselt_hot, 1.0, 1e-5);
}

TEST(BenardGrid, AFlowThatIsStoppedEarlyIsShort) {
  BenardGridPoint point = point_of(5000.0, 8);
  point.duration = 20.0;
  EXPECT_EQ(row_of(point).status, RowStatus::too_short);
  point.find = BenardGoal::growth_rate;
  point.duration = 3.0;
  EXPECT_EQ(row_of(point).status, RowStatus::too_short);
}

/// Incompressible between rigid walls, rolls as wide as high: 1707.8.
TEST(BenardGrid, OnsetIsThatOfBoussinesqWhenTemperaturesDifferLittle) {
  std::vector<BenardGridRow> rows;
  for (const double rayleigh : {1650.0, 1800.0})
    for (const int cells : {8, 12}) {
      BenardGridPoint point = point_of(rayleigh, cells);
      point.hot = 1.05;
      point.cold = 0.95;
      point.find = BenardGoal::growth_rate;
      rows.push_back(row_of(point));
    }
  const auto found = critical_rayleighs(rows);
  ASSERT_EQ(found.size(), 3u);  // two meshes and their limit
  EXPECT_EQ(found.back().cells, 0);
  EXPECT_NEAR(found.back().rayleigh.value, 1707.8, 17.0);
}

/// 1712.4 and 1780.7 by finer grids.
TEST(BenardGrid, OnsetDependsOnTheTransportLaw) {
  const std::vector<std::pair<grid::Transport, double>> expected = {{grid::Transport::dynamic, 1712.4},
                                                                    {grid::Transport::kinematic, 1780.7}};
  for (const auto& [transport, critical] : expected) {
    std::vector<BenardGridRow> rows;
    for (const double rayleigh : {1700.0, 1800.0})
      for (const int cells : {10, 16}) {
        BenardGridPoint point = point_of(rayleigh, cells);
        point.transport = transport;
        point.find = BenardGoal::growth_rate;
        rows.push_back(row_of(point));
        EXPECT_LT(rows.back().growth_rate_error * diffusion_time(rows.back().settings), 1e-3);
      }
    EXPECT_NEAR(critical_rayleighs(rows).back().rayleigh.value, critical, 2.0);
  }
}

TEST(BenardGrid, AFlowThatFailsKeepsWhatWasBefore) {
  BenardGridPoint point = point_of(5000.0, 8);
  point.roll_velocity = 30.0;  // far beyond sound
  const BenardGridRow row = row_of(point);
  EXPECT_EQ(row.status, RowStatus::failed);
  EXPECT_THAT(row.failure, HasSubstr("must be above 0"));
  BenardGridRun run(point);
  run.advance_one_interval();
  const auto samples = run.record().samples.size();
  EXPECT_GE(samples, 1u);
  for (const double density : run.record().fields.density) EXPECT_GT(density, 0.0);
  run.advance_one_interval();
  EXPECT_EQ(run.record().samples.size(), samples);
}

TEST(BenardGrid, SavedGoesOnWithTheSameBits) {
  const BenardGridPoint point = point_of(5000.0, 8);
  BenardGridRun whole(point);
  for (int n = 0; n < 3; ++n) whole.advance_one_interval();
  ArchiveWriter archive;
  whole.save(archive);
  BenardGridRun resumed(point);
  ArchiveReader reader(archive.bytes());
  resumed.load(reader);
  EXPECT_EQ(resumed.intervals_done(), 3);
  for (int n = 0; n < 3; ++n) {
    whole.advance_one_interval();
    resumed.advance_one_interval();
  }
  EXPECT_EQ(whole.record().samples.back().kinetic_energy, resumed.record().samples.back().kinetic_energy);
  EXPECT_EQ(whole.record().samples.size(), resumed.record().samples.size());
  EXPECT_EQ(whole.record().fields.velocity_x, resumed.record().fields.velocity_x);
}

TEST(BenardGridTable, ExtrapolatesInTheInverseSquareOfTheCells) {
  const std::vector<int> cells = {40, 10, 20};
  const auto values = [&](double fourth) {
    std::vector<double> values;
    for (const int n : cells) values.push_back(2.0 + 3.0 / (n * n) + fourth / std::pow(n, 4));
    return values;
  };
  EXPECT_NEAR(extrapolate(cells, values(0.0)).value, 2.0, 1e-14);
  EXPECT_NEAR(extrapolate(cells, values(0.0)).error, 0.0, 1e-14);
  const Extrapolated bent = extrapolate(cells, values(50.0));
  EXPECT_NEAR(std::abs(bent.value - 2.0), bent.error, 1e-12);
  EXPECT_TRUE(std::isnan(extrapolate(std::vector{20}, std::vector{1.0}).value));
  EXPECT_TRUE(std::isnan(extrapolate(std::vector{10, 20}, std::vector{1.0, 2.0}).error));
  EXPECT_TRUE(std::isnan(extrapolate(std::vector{20, 20}, std::vector{1.0, 1.0}).value));
}

BenardGridRow made_up(double rayleigh, int cells, BenardGoal goal) {
  BenardGridRow row;
  BenardGridPoint point = point_of(rayleigh, cells);
  point.find = goal;
  row.settings = resolved(point);
  return row;
}

TEST(BenardGridTable, FindsTheRayleighNumberWhereRollsNeitherGrowNorDecay) {
  std::vector<BenardGridRow> rows;
  for (const double rayleigh : {1600.0, 1700.0, 1800.0})
    for (const int cells : {10, 20}) {
      rows.push_back(made_up(rayleigh, cells, BenardGoal::growth_rate));
      const double critical = 1750.0 + 400.0 / (cells * cells);
      rows.back().growth_rate = (rayleigh - critical) * 1e-3 / diffusion_time(rows.back().settings);
    }
  const auto found = critical_rayleighs(rows);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0].rayleigh.value, 1754.0, 1e-9);
  EXPECT_EQ(found[0].cells, 10);
  EXPECT_NEAR(found[2].rayleigh.value, 1750.0, 1e-9);
  rows.resize(4);  // decay alone
  EXPECT_TRUE(critical_rayleighs(rows).empty());
}

TEST(BenardGridTable, FindsWhereTheStraightLineOfKineticEnergiesEnds) {
  std::vector<BenardGridRow> rows;
  for (const double rayleigh : {1500.0, 2000.0, 3000.0, 5000.0})
    for (const int cells : {10, 20}) {
      rows.push_back(made_up(rayleigh, cells, BenardGoal::steady_state));
      rows.back().kinetic_energy =
          std::max(0.0, 0.2 * (1.0 / std::sqrt(1750.0) - 1.0 / std::sqrt(rayleigh))) * (1.0 + 1.0 / (cells * cells));
    }
  const auto found = critical_rayleighs(rows);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].route, CriticalRayleigh::Route::straight_line);
  EXPECT_EQ(found[0].points, 3);  // what is at rest takes no part
  EXPECT_NEAR(found[0].rayleigh.value, 1750.0, 1e-6);
  EXPECT_NEAR(found[0].rayleigh.error, 0.0, 1e-4);
  rows[2].status = RowStatus::too_short;
  rows[3].status = RowStatus::failed;
  EXPECT_TRUE(critical_rayleighs(rows).empty());
}

}  // namespace
}  // namespace lucy::cases
