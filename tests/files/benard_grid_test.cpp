// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Convection on grids: its input, its tables, its words. What all input files share is in all_inputs_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "input_folder.hpp"
#include "lucy/files/benard_grid_csv.hpp"
#include "lucy/files/benard_grid_input.hpp"
#include "lucy/files/benard_grid_text.hpp"
#include "lucy/files/csv.hpp"

namespace lucy::files {
namespace {

using testing::contains;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::put;
using testing::starts_with;
using testing::with;

using BenardGridInputTest = testing::FolderReadBy<read_benard_grid>;

/// Lines 1 to 5 of a file that is accepted.
const std::string minimal = R"([fluid]
rayleigh = 5000
[grid]
cells = 20
[run]
)";

TEST_F(BenardGridInputTest, ListsMultiplyWithTheMeshesInside) {
  const auto input = read(with(with(minimal, "5000", "[5000, 10000]"), "20", "[20, 40, 60]"));
  ASSERT_EQ(input.points.size(), 6u);
  EXPECT_EQ(input.points[1].cells, 40);
  EXPECT_EQ(*input.points[2].rayleigh, 5000.0);
  EXPECT_EQ(*input.points[3].rayleigh, 10000.0);
}

TEST_F(BenardGridInputTest, EveryKeyArrivesAndIsWrittenAgain) {
  const std::string text = R"(title = "all keys"
[cell]
height = 20
width = 30
side = "walls"
hot = 2
cold = 1
gravity = 0.1
[fluid]
equation_of_state = "van-der-waals"
viscosity = 0.4
conductivity = 0.3
transport = "kinematic"
[start]
roll_velocity = 0.01
[grid]
cells = 10
[run]
find = "growth-rate"
step = 0.1
duration = 50
tolerance = 1e-4
)";
  const auto input = read(text);
  const cases::BenardGridPoint& point = input.points.front();
  EXPECT_EQ(input.title, "all keys");
  EXPECT_EQ(point.height, 20.0);
  EXPECT_EQ(*point.width, 30.0);
  EXPECT_EQ(point.sides, grid::Sides::walls);
  EXPECT_EQ(point.hot, 2.0);
  EXPECT_EQ(point.cold, 1.0);
  EXPECT_EQ(*point.gravity, 0.1);
  EXPECT_EQ(point.equation_of_state, spam::EquationOfStateName::van_der_waals);
  EXPECT_EQ(*point.viscosity, 0.4);
  EXPECT_EQ(*point.conductivity, 0.3);
  EXPECT_EQ(point.transport, grid::Transport::kinematic);
  EXPECT_EQ(*point.roll_velocity, 0.01);
  EXPECT_EQ(point.cells, 10);
  EXPECT_EQ(point.find, cases::BenardGoal::growth_rate);
  EXPECT_EQ(*point.step, 0.1);
  EXPECT_EQ(*point.duration, 50.0);
  EXPECT_EQ(point.tolerance, 1e-4);
  const std::string once = benard_grid_resolved_toml(input);
  EXPECT_EQ(benard_grid_resolved_toml(read(once)), once);
}

TEST_F(BenardGridInputTest, WhatCannotBeIsToldAtItsLine) {
  EXPECT_PRED2(starts_with, refusal(minimal + "step = 5\n"), "a.toml:6: run.step = 5 is unstable with grid.cells = 20");
  EXPECT_PRED2(starts_with, refusal(minimal, {"fluid.viscosity=1"}), "a.toml:2: fluid.rayleigh = 5000 leaves nothing");
  EXPECT_PRED2(starts_with, refusal(minimal + "[cell]\nhot = 0.2\n"), "a.toml:7: cell.hot = 0.2 must be above");
  EXPECT_PRED2(starts_with, refusal(with(minimal, "rayleigh = 5000", "")), "a.toml: fluid.rayleigh is missing");
  EXPECT_PRED2(contains, refusal(with(minimal, "20", "[]")), "grid.cells");
  EXPECT_PRED2(contains, refusal(minimal, {"fluid.equation_of_state='isentropic'"}), "one of \"ideal-gas\"");
  EXPECT_PRED2(contains, refusal(minimal, {"cell.side='open'"}), "one of \"periodic\", \"walls\"");
  EXPECT_PRED2(contains, refusal(minimal + "[system]\nparticles = 3\n"), "a continuum has no particles");
}

cases::BenardGridRow row_of(double rayleigh, int cells, double kinetic_energy) {
  cases::BenardGridPoint point;
  point.rayleigh = rayleigh;
  point.cells = cells;
  cases::BenardGridRow row = cases::failed_row(point, "");
  row.status = cases::RowStatus::ok;
  row.kinetic_energy = kinetic_energy;
  row.nusselt_hot = 1.5;
  row.nusselt_cold = 1.4;
  row.nusselt_sides = 0.0;
  row.energy_imbalance = 0.1 / 1.5;
  row.mass_error = -2e-15;
  return row;
}

class BenardGridFiles : public testing::InputFolder {};

TEST_F(BenardGridFiles, TableIsReadBackWithTheSameBits) {
  std::vector<cases::BenardGridRow> rows = {row_of(5000.0, 20, 0.1 / 3.0), row_of(5000.0, 40, 0.03)};
  rows[1].status = cases::RowStatus::too_short;
  const auto path = folder_ / "benard_grid.csv";
  write_benard_grid_csv(path, rows);
  const auto again = read_benard_grid_csv(path);
  ASSERT_EQ(again.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again[i].kinetic_energy, rows[i].kinetic_energy);
    EXPECT_EQ(again[i].mass_error, rows[i].mass_error);
    EXPECT_EQ(again[i].settings.rayleigh, rows[i].settings.rayleigh);
    EXPECT_EQ(again[i].settings.step, rows[i].settings.step);
    EXPECT_EQ(again[i].settings.cells, rows[i].settings.cells);
    EXPECT_EQ(again[i].status, rows[i].status);
    EXPECT_TRUE(std::isnan(again[i].growth_rate));
  }
  put(path, "find,cells\nsteady-state,20\n");
  EXPECT_THAT(refusal_from([&] { read_benard_grid_csv(path); }), HasSubstr("benard_grid.csv"));
}

TEST_F(BenardGridFiles, CompanionsAreWrittenOnlyWhenThereIsSomethingToSay) {
  write_benard_limits_csv(folder_ / "extrapolated.csv", {});
  write_critical_csv(folder_ / "critical.csv", {});
  EXPECT_EQ(folder_.entries(), 0u);
  const std::vector<cases::BenardGridRow> rows = {row_of(5000.0, 20, 0.035), row_of(5000.0, 40, 0.032)};
  write_benard_limits_csv(folder_ / "extrapolated.csv", cases::limits_of(rows));
  const CsvFile file(folder_ / "extrapolated.csv");
  ASSERT_EQ(file.rows().size(), 1u);
  EXPECT_NEAR(file.number(file.rows()[0], file.column("kinetic_energy")), 0.031, 1e-12);
  EXPECT_TRUE(std::isnan(file.number(file.rows()[0], file.column("kinetic_energy_error"))));
}

TEST(BenardGridText, HasMeshesTheirLimitAndTheMeaningOfWords) {
  std::vector<cases::BenardGridRow> rows = {row_of(5000.0, 20, 0.035), row_of(5000.0, 40, 0.032),
                                            row_of(5000.0, 60, 0.0315)};
  std::string text = format_benard_grid(rows);
  for (const char* part : {"Steady flows", "Extrapolated to infinitely many cells", "0.0311", "6.667 %"})
    EXPECT_THAT(text, HasSubstr(part));
  for (const char* part : {"short: ", "failed: ", "Growth", "Critical", "critical"})
    EXPECT_THAT(text, Not(HasSubstr(part)));
  EXPECT_LE(testing::widest_line(text), 118u);
  rows[0].status = cases::RowStatus::too_short;
  rows[1].status = cases::RowStatus::failed;
  rows[1].failure = "at time 3 the density is gone";
  text = format_benard_grid(rows);
  EXPECT_THAT(text, HasSubstr("short: not steady"));
  EXPECT_THAT(text, HasSubstr("failed: ideal-gas, Ra = 5000, 40 cells: at time 3 the density is gone"));
}

TEST(BenardGridText, TellsWhyThereIsNoCriticalRayleighNumber) {
  cases::BenardGridRow row = row_of(1800.0, 20, 1e-15);
  row.settings.find = cases::BenardGoal::growth_rate;
  row.growth_rate = 1e-4;
  std::vector<cases::BenardGridRow> rows = {row};
  EXPECT_THAT(format_benard_grid(rows), HasSubstr("No critical Rayleigh number"));
  row.settings.rayleigh = 1700.0;
  row.growth_rate = -1e-4;
  rows.push_back(row);
  EXPECT_THAT(format_benard_grid(rows), HasSubstr("growth-rates"));
  EXPECT_THAT(format_benard_grid(rows), Not(HasSubstr("No critical")));
}

}  // namespace
}  // namespace lucy::files
