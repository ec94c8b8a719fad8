// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lucy::cases {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t pxy_kinetic = 1;
constexpr std::size_t pxy_potential = 2;
constexpr std::size_t viscosity = 7;

/// 100 time units in all, every value 1 with error 0.03.
TableRow our_row() {
  TableRow row;
  row.particles = 1024;
  row.energy_per_particle = 0.5;
  row.strain_rate = 0.1;
  row.duration = 30.0;
  row.replicas = 4;
  row.equilibration_discarded = 5.0;
  for (auto& estimate : row.estimates) estimate = {1.0, 0.03, 100.0, 99};
  return row;
}

PublishedRow published_row() {
  PublishedRow row;
  row.particles = 1024;
  row.energy_per_particle = 0.5;
  row.strain_rate = 0.1;
  row.total_time = 25.0;
  for (std::size_t i = 0; i < row.cells.size(); ++i)
    if (i != viscosity) row.cells[i] = {.value = 1.0, .last_digit = 0.01};
  return row;
}

Comparison compare_rows(const TableRow& ours, const PublishedRow& published) {
  return compare(std::vector{ours}, {.name = "t", .source = "s", .rows = {published}});
}

TEST(Comparison, CombinesOurErrorWithPrintAndWithTheLengthsOfTheRuns) {
  PublishedRow published = published_row();
  published.cells[0].value = 1.2;
  const auto result = compare_rows(our_row(), published);
  ASSERT_EQ(result.rows.size(), 1u);
  const ComparedCell& cell = result.rows[0].cells[0];
  EXPECT_DOUBLE_EQ(result.rows[0].our_time, 100.0);
  const double their_variance = 0.0001 / 12.0 + 0.0009 * 100.0 / 25.0;
  EXPECT_NEAR(cell.published_error, std::sqrt(their_variance), 1e-15);
  EXPECT_NEAR(cell.difference, -0.2 / std::sqrt(0.0009 + their_variance), 1e-12);
}

TEST(Comparison, UsesTheErrorThatTheSourceGives) {
  PublishedRow published = published_row();
  published.cells[0] = {.value = 0.9, .last_digit = 0.1, .standard_error = 0.04};
  EXPECT_NEAR(compare_rows(our_row(), published).rows[0].cells[0].difference, 0.1 / 0.05, 1e-12);
}

TEST(Comparison, CountsLargeDifferencesAndJudges) {
  PublishedRow published = published_row();
  for (auto& cell : published.cells) cell.standard_error = 0.04;
  published.cells[0].value = 1.0 - 2.5 * 0.05;
  published.cells[3].value = 1.0 + 3.5 * 0.05;
  auto result = compare_rows(our_row(), published);
  EXPECT_EQ(result.judged, 7);
  EXPECT_EQ(result.independent, 7);
  EXPECT_EQ(result.beyond, (std::array{2, 1, 0}));
  EXPECT_NEAR(result.largest, 3.5, 1e-12);
  EXPECT_EQ(result.largest_where, "pxx_kinetic at N = 1024, E/N = 0.5, rate 0.1");
  EXPECT_NEAR(result.chi_squared, 2.5 * 2.5 + 3.5 * 3.5, 1e-12);
  EXPECT_EQ(result.verdict, Verdict::agree);
  published.cells[3].value = 1.0 + 4.01 * 0.05;
  result = compare_rows(our_row(), published);
  EXPECT_EQ(result.verdict, Verdict::disagree);
}

TEST(Comparison, DerivesTheViscosityFromBothPartsOfTheShearStress) {
  PublishedRow published = published_row();
  published.cells[pxy_kinetic] = {.value = -0.0305, .last_digit = 1e-4};
  published.cells[pxy_potential] = {.value = 0.0014, .last_digit = 1e-4};
  derive_viscosity(published);
  EXPECT_NEAR(published.cells[viscosity].value, 0.291, 1e-12);
  EXPECT_NEAR(published.cells[viscosity].last_digit, std::sqrt(2.0) * 1e-3, 1e-12);
  EXPECT_FALSE(published.cells[viscosity].misprint);
  const auto result = compare_rows(our_row(), published);
  EXPECT_EQ(result.judged, 8);
  EXPECT_EQ(result.independent, 7);
}

TEST(Comparison, JudgesAMisprintAsItShouldReadAndShowsBoth) {
  TableRow ours = our_row();
  ours.estimates[quantity("pxy_potential")] = {-1.0, 0.03, 100.0, 99};
  ours.estimates[quantity("viscosity")] = {0.0, 0.03, 100.0, 99};
  PublishedRow published = published_row();
  published.cells[pxy_potential].misprint = true;
  published.cells[pxy_potential].reading = -1.0;
  derive_viscosity(published);
  const auto result = compare_rows(ours, published);
  ASSERT_EQ(result.rows[0].cells.size(), 10u);
  EXPECT_EQ(result.rows[0].cells[2].standing, Standing::misprint);
  EXPECT_LT(result.rows[0].cells[2].difference, -20.0);
  EXPECT_EQ(result.rows[0].cells[3].standing, Standing::read_differently);
  EXPECT_DOUBLE_EQ(result.rows[0].cells[3].difference, 0.0);
  EXPECT_EQ(result.rows[0].cells[8].standing, Standing::misprint);
  EXPECT_NEAR(result.rows[0].cells[9].published, 0.0, 1e-15);
  EXPECT_EQ(result.judged, 8);
  EXPECT_EQ(result.verdict, Verdict::agree);
}

TEST(Comparison, AMisprintWithoutAReadingTakesNoPart) {
  PublishedRow published = published_row();
  published.cells[3].value = 77.0;
  published.cells[3].misprint = true;
  const auto result = compare_rows(our_row(), published);
  EXPECT_EQ(result.judged, 6);
  EXPECT_EQ(result.verdict, Verdict::agree);
}

TEST(Comparison, TheInstabilityRegionTakesNoPart) {
  PublishedRow published = published_row();
  published.instability_region = true;
  published.cells[0].value = 77.0;
  const auto result = compare_rows(our_row(), published);
  EXPECT_EQ(result.judged, 0);
  EXPECT_LT(result.rows[0].cells[0].difference, -100.0);
  EXPECT_EQ(result.verdict, Verdict::nothing_to_judge);
}

TEST(Comparison, ACellWithoutAnErrorTakesNoPart) {
  TableRow ours = our_row();
  ours.estimates[quantity("potential_energy")].error = nan;
  const auto result = compare_rows(ours, published_row());
  EXPECT_EQ(result.rows[0].cells[0].standing, Standing::no_error);
  EXPECT_TRUE(std::isnan(result.rows[0].cells[0].difference));
  EXPECT_EQ(result.judged, 6);
}

TEST(Comparison, ListsRowsWithoutAPartner) {
  TableRow ours = our_row();
  ours.particles = 400;
  auto result = compare_rows(ours, published_row());
  EXPECT_EQ(result.rows.size(), 0u);
  EXPECT_EQ(result.only_ours.size(), 1u);
  EXPECT_EQ(result.only_published.size(), 1u);
  EXPECT_EQ(result.verdict, Verdict::nothing_to_judge);
  ours = our_row();
  ours.strain_rate = 0.1 * (1.0 + 1e-13);
  EXPECT_EQ(compare_rows(ours, published_row()).rows.size(), 1u);
  ours.strain_rate = 0.1001;
  EXPECT_EQ(compare_rows(ours, published_row()).rows.size(), 0u);
  ours = our_row();
  ours.energy_per_particle = 1.0;
  EXPECT_EQ(compare_rows(ours, published_row()).rows.size(), 0u);
}

}  // namespace
}  // namespace lucy::cases
