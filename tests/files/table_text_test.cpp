// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/table_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "scratch.hpp"

namespace lucy::files {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::widest_line;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(FormatWithError, GivesTwoDigitsOfTheErrorInUnitsOfTheLastDigit) {
  EXPECT_EQ(format_with_error(13.5234, 0.14), "13.52(14)");
  EXPECT_EQ(format_with_error(-0.26771, 0.00042), "-0.26771(42)");
  EXPECT_EQ(format_with_error(0.42, 0.0996), "0.42(10)");
  EXPECT_EQ(format_with_error(0.42, 0.0994), "0.420(99)");
  EXPECT_EQ(format_with_error(2.0, 0.25), "2.00(25)");
}

TEST(FormatWithError, PutsAPointIntoTheErrorWhereItReachesTheUnits) {
  EXPECT_EQ(format_with_error(13.52, 1.44), "13.5(1.4)");
  EXPECT_EQ(format_with_error(13.52, 0.999), "13.5(1.0)");
  EXPECT_EQ(format_with_error(13.52, 9.96), "14(10)");
  EXPECT_EQ(format_with_error(1352.3, 14.4), "1352(14)");
  EXPECT_EQ(format_with_error(13523.0, 144.0), "13520(140)");
}

TEST(FormatWithError, StaysHonestWhereSomethingIsMissing) {
  EXPECT_EQ(format_with_error(nan, nan), "nan");
  EXPECT_EQ(format_with_error(-nan, 0.1), "nan");
  EXPECT_EQ(format_with_error(0.0134567, nan), "0.01346(nan)");
  EXPECT_EQ(format_with_error(2.0, 0.0), "2(0)");
  EXPECT_EQ(format_with_error(-0.0001, 0.5), "0.00(50)");
  EXPECT_EQ(format_with_error(1.0, 1e-300), "1.000000000000000(0)");
}

TEST(FormatWithError, WritesAnExponentWhereZerosWouldHaveToBeCounted) {
  EXPECT_EQ(format_with_error(1.234e-20, 1.2e-22), "1.234(12)e-20");
  EXPECT_EQ(format_with_error(-1.234e15, 1.2e13), "-1.234(12)e15");
  EXPECT_EQ(format_with_error(0.0, 1e-20), "0.0(1.0)e-20");
  EXPECT_EQ(format_with_error(1e-20, 1e-9), "0.0000000000(10)");
  EXPECT_EQ(format_with_error(123.4567890123, 1e-10), "123.45678901230(10)");
  EXPECT_EQ(format_with_error(3e-300, nan), "3e-300(nan)");
  EXPECT_EQ(format_with_error(3e-300, 0.0), "3e-300(0)");
}

TEST(FormatPlain, WritesAnExponentOnlyWhereZerosWouldHaveToBeCounted) {
  EXPECT_EQ(format_plain(1e-300), "1e-300");
  EXPECT_EQ(format_plain(-2.5e-12, 2), "-2.5e-12");
  EXPECT_EQ(format_plain(123456789012345.0), "1.23457e14");
  EXPECT_EQ(format_plain(0.00451), "0.00451");
  EXPECT_EQ(format_plain(0.5), "0.5");
  EXPECT_EQ(format_plain(0.0), "0");
  EXPECT_EQ(format_plain(3e-9), "0.000000003");
  EXPECT_EQ(format_plain(1234567.0), "1234567");
  EXPECT_EQ(format_plain(0.1 + 0.2), "0.3");
  EXPECT_EQ(format_plain(-0.99999, 2), "-1");
}

cases::TableRow row(double strain_rate) {
  cases::TableRow result;
  result.particles = 1024;
  result.energy_per_particle = 0.5;
  result.strain_rate = strain_rate;
  result.estimates[cases::quantity("kinetic_temperature")] = {0.0729, 0.00011, 50, 49};
  result.estimates[cases::quantity("pxy_kinetic")] = {-0.0305, 0.0001, 50, 49};
  result.estimates[cases::quantity("pxy_potential")] = {0.0014, 0.00002, 50, 49};
  result.estimates[cases::quantity("viscosity")] = {0.291, 0.001, 50, 49};
  result.estimates[cases::quantity("normal_stress")] = {3.2, 0.1, 50, 49};
  result.estimates[cases::quantity("largest_kinetic_share")] = {0.0075, 0.0001, 50, 49};
  return result;
}

TEST(FormatTable, ShowsValuesWithErrorsAndSaysHowTheyWereMade) {
  const std::vector rows = {row(0.1)};
  const std::string text = format_table(rows);
  EXPECT_THAT(text, HasSubstr("1024  0.5   0.1  0.07290(11)"));
  EXPECT_THAT(text, HasSubstr("0.2910(10)"));
  EXPECT_THAT(text, HasSubstr("-0.03050(10)"));
  EXPECT_THAT(text, HasSubstr("3.20(10)"));
  EXPECT_THAT(text, HasSubstr("one standard error"));
  EXPECT_THAT(text, HasSubstr("blocking"));
  EXPECT_THAT(text, Not(HasSubstr("share")));
  EXPECT_THAT(text, Not(HasSubstr("short:")));
}

TEST(FormatTable, TellsOfARunawayParticleAndOfWhatFailed) {
  std::vector rows = {row(0.1), row(0.009), row(0.5)};
  rows[1].estimates[cases::quantity("largest_kinetic_share")].value = 0.81;
  rows[1].status = cases::RowStatus::too_short;
  rows[2].status = cases::RowStatus::failed;
  rows[2].failure = "the step could not be made small enough";
  const std::string text = format_table(rows);
  EXPECT_THAT(text, HasSubstr("0.81"));
  EXPECT_THAT(text, Not(HasSubstr("0.0075 ")));
  EXPECT_THAT(text, HasSubstr("share:"));
  EXPECT_THAT(text, HasSubstr("short:"));
  EXPECT_THAT(text, HasSubstr("failed: N = 1024, E/N = 0.5, rate 0.5: the step could not be made small enough"));
}

TEST(FormatTable, FitsATerminal) {
  std::vector rows = {row(0.1), row(0.00001)};
  rows[0].particles = 262144;
  rows[0].energy_per_particle = 0.4567;
  rows[1].estimates[cases::quantity("normal_stress")] = {-12345678.0, 2345678.0, 50, 49};
  rows[1].estimates[cases::quantity("viscosity")] = {-123.456, 0.0123, 50, 49};
  rows[1].estimates[cases::quantity("largest_kinetic_share")].value = 0.8;
  rows[1].status = cases::RowStatus::failed;
  EXPECT_LE(widest_line(format_table(rows)), 120u);
}

TEST(FormatTable, OfNoRowsIsOnlyTheHeader) { EXPECT_THAT(format_table({}), HasSubstr("viscosity")); }

}  // namespace
}  // namespace lucy::files
