// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Convection side by side, as files and on a terminal; and the published values that come with Lucy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lucy/errors.hpp"
#include "lucy/files/benard_comparison_csv.hpp"
#include "lucy/files/benard_comparison_text.hpp"
#include "lucy/files/csv.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using testing::contents;
using ::testing::ElementsAre;
using testing::FullDisk;
using ::testing::HasSubstr;
using testing::message_of;
using ::testing::Not;
using testing::put;
using testing::ScratchFolder;
using ::testing::SizeIs;
using testing::widest_line;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const std::filesystem::path shipped = std::filesystem::path(LUCY_SOURCE_DIRECTORY) / "reference" / "kum1995_benard.csv";

cases::BenardComparison comparison() {
  cases::BenardComparison comparison;
  cases::BenardPoint& point = comparison.particles.settings;
  point.particles = 5000;
  point.height = 50.0;
  point.rayleigh = 10000.0;
  cases::set_unset(point);
  cases::BenardGridLimit limit;
  static_cast<cases::Convection&>(limit.settings) = point;
  comparison.grid = limit;
  limit.settings.rayleigh = 6250.0;
  limit.settings.viscosity = 0.75;
  limit.settings.conductivity = 0.52;
  comparison.effective = limit;
  const cases::BenardBeside grid = {.source = cases::BenardSource::grid,
                                    .value = 0.0048910,
                                    .error = 2e-9,
                                    .difference = -0.00038,
                                    .difference_error = 0.00002,
                                    .per_cent = -7.79,
                                    .per_cent_error = 0.41,
                                    .z = -19.0};
  const cases::BenardBeside effective = {.source = cases::BenardSource::effective_grid,
                                         .value = 0.0045,
                                         .error = nan,
                                         .difference = 0.00001,
                                         .difference_error = nan,
                                         .per_cent = 0.22,
                                         .per_cent_error = nan,
                                         .z = nan};
  const cases::BenardBeside print = {.source = cases::BenardSource::published,
                                     .value = 0.0050,
                                     .error = 0.00003,
                                     .last_digit = 0.0001,
                                     .difference = -0.00049,
                                     .difference_error = 0.00004,
                                     .per_cent = -9.8,
                                     .per_cent_error = 0.8,
                                     .z = -12.25};
  comparison.rows = {{"kinetic_energy_total", 0.00451, 0.00002, {grid, effective, print}},
                     {"nusselt_hot", 1.75, 0.01, {}},
                     {"kinetic_energy_continuum", 0.0048910, 2e-9, {print}}};
  return comparison;
}

TEST(BenardComparisonCsv, HasALineForEachNumberAndEachThatStandsBesideIt) {
  const ScratchFolder folder;
  write_benard_comparison_csv(folder / "benard_compare.csv", std::vector{comparison()});
  const CsvFile file(folder / "benard_compare.csv");
  EXPECT_EQ(file.columns(), benard_comparison_columns());
  ASSERT_THAT(file.rows(), SizeIs(4));
  EXPECT_THAT(file.rows()[0].cells,
              ElementsAre("5000", "ideal-gas", "lucy", "3", "periodic", "mirror-images", "50", "100", "1.5", "0.5",
                          "10000", "0.5", "0.5", "kinetic_energy_total", "0.00451", "2e-05", "grid", "10000",
                          "0.004891", "2e-09", "-0.00038", "2e-05", "-7.79", "0.41", "-19"));
  const auto cell = [&](std::size_t row, std::string_view column) {
    return file.rows()[row].cells[file.column(column)];
  };
  EXPECT_EQ(cell(1, "beside"), "effective-grid");
  EXPECT_EQ(cell(1, "beside_rayleigh"), "6250");
  EXPECT_EQ(cell(1, "z"), "nan");
  EXPECT_EQ(cell(2, "beside"), "published");
  EXPECT_EQ(cell(3, "quantity"), "kinetic_energy_continuum");
}

TEST(BenardComparisonCsv, IsTheOldOneWhenTheDiskIsFull) {
  const ScratchFolder folder;
  write_benard_comparison_csv(folder / "benard_compare.csv", {});
  const std::string before = contents(folder / "benard_compare.csv");
  const FullDisk full(8);
  EXPECT_THAT(message_of<RunFailed>(
                  [&] { write_benard_comparison_csv(folder / "benard_compare.csv", std::vector{comparison()}); }),
              HasSubstr("benard_compare.csv"));
  EXPECT_EQ(contents(folder / "benard_compare.csv"), before);
}

TEST(BenardComparisonText, HasEveryNumberWithItsDifferenceBelow) {
  const std::string text = format_benard_comparison(std::vector{comparison()});
  EXPECT_LE(widest_line(text), 118u);
  EXPECT_THAT(text, HasSubstr("ideal-gas, N = 5000, Ra = 10000; lucy, h = 3; 50 x 100, mirror-images\n"));
  for (const char* piece : {"particles", "grid", "effective grid", "print", "kinetic energy, total", "0.004510(20)",
                            "-7.79(41) %   -19.0", "+0.22(nan) %     nan", "0.0050\n", "-9.80(80) %   -12.2",
                            "Nusselt number, hot", "1.750(10)", "kinetic energy, continuum"})
    EXPECT_THAT(text, HasSubstr(piece));
  EXPECT_THAT(text, HasSubstr("at Ra = 6250 with eta = 0.75, k = 0.52 beside ideal-gas"));
  EXPECT_THAT(text, Not(HasSubstr("no grid:")));
}

TEST(BenardComparisonText, LeavesOutColumnsThatNothingStandsIn) {
  cases::BenardComparison alone = comparison();
  alone.grid.reset();
  alone.effective.reset();
  alone.rows = {{"kinetic_energy_total", 0.00451, 0.00002, {alone.rows[0].beside[2]}}};
  const std::string text = format_benard_comparison(std::vector{alone});
  EXPECT_THAT(text, Not(HasSubstr("effective grid")));
  EXPECT_THAT(text, HasSubstr("no grid: ideal-gas, N = 5000, Ra = 10000"));
}

TEST(BenardComparisonText, NamesFluidsWithoutViscosityByTheirCoefficients) {
  cases::BenardPoint point;
  point.particles = 800;
  point.height = 20.0;
  point.viscosity = 0.0;
  point.conductivity = 0.1;
  point.rayleigh = std::numeric_limits<double>::infinity();
  EXPECT_EQ(benard_particles_text(point), "ideal-gas, N = 800, eta = 0, k = 0.1; lucy, h = 3; 20 x 40, mirror-images");
  point.sides = grid::Sides::walls;
  EXPECT_THAT(benard_particles_text(point), HasSubstr("20 x 20, four walls, mirror-images"));
}

TEST(PublishedBenard, ValuesThatComeWithLucyAreThoseOfPrint) {
  const auto prints = read_published_benard(shipped);
  ASSERT_THAT(prints, SizeIs(4));
  const auto value = [&](std::int64_t particles, double rayleigh) {
    for (const auto& print : prints)
      if (print.particles == particles && print.convection.rayleigh == rayleigh) return print.kinetic_energy;
    return cases::PublishedCell{};
  };
  EXPECT_EQ(value(0, 5000).value, 0.00340);
  EXPECT_EQ(value(0, 10000).value, 0.00481);
  EXPECT_EQ(value(5000, 5000).value, 0.0030);
  EXPECT_EQ(value(5000, 10000).value, 0.0046);
  EXPECT_NEAR(value(0, 5000).last_digit, 1e-5, 1e-18);
  EXPECT_NEAR(value(5000, 5000).last_digit, 1e-4, 1e-18);
  for (const auto& print : prints) {
    EXPECT_THAT(print.source, HasSubstr("4899 (1995)"));
    cases::Convection usual;
    usual.rayleigh = print.convection.rayleigh;
    EXPECT_TRUE(cases::same_convection(print.convection, usual));
  }
}

TEST(PublishedBenard, RefusesWhatIsNoNumberOrNoFluid) {
  const ScratchFolder folder;
  const std::string text = contents(shipped);
  const auto refusal = [&](const std::string& before, const std::string& after) {
    std::string changed = text;
    const auto place = changed.find(before);
    EXPECT_NE(place, std::string::npos) << before;
    changed.replace(place, before.size(), after);
    put(folder / "print.csv", changed);
    return message_of<BadInput>([&] { read_published_benard(folder / "print.csv"); });
  };
  EXPECT_THAT(refusal("0.00340", "-1"),
              HasSubstr("print.csv:2: kinetic_energy is -1 where a number above 0 was expected"));
  EXPECT_THAT(refusal("0.00340", "much"), HasSubstr("print.csv:2"));
  EXPECT_THAT(refusal("ideal-gas", "water"), HasSubstr("\"water\" where one of ideal-gas"));
  EXPECT_THAT(refusal(",rayleigh", ",ra"), HasSubstr("has a column rayleigh"));
}

}  // namespace
}  // namespace lucy::files
