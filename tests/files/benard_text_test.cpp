// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/benard_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benard_rows.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using testing::benard_row;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::widest_line;

TEST(BenardText, ShowsKineticEnergiesHeatAndExtremes) {
  const std::vector rows = {benard_row()};
  const std::string text = format_benard(rows);
  EXPECT_THAT(text, HasSubstr("   fluid         N     Ra       K total    K smoothed       K field  status\n"));
  EXPECT_THAT(text, HasSubstr("1  ideal-gas  5000  10000  0.004510(20)  0.003890(20)  0.004020(10)  ok\n"));
  EXPECT_THAT(text, HasSubstr("1.532(12)"));
  EXPECT_THAT(text, HasSubstr("0.912(11)"));  // what the ceiling takes away by conduction
  EXPECT_THAT(text, Not(HasSubstr("-0.912")));
  EXPECT_THAT(text, HasSubstr("temperature from"));
  EXPECT_THAT(text, HasSubstr("blocking"));
  for (const char* part : {"short: ", "failed: ", "sides"}) EXPECT_THAT(text, Not(HasSubstr(part)));
  EXPECT_LE(widest_line(text), 118u);
}

TEST(BenardText, NamesWhatIsNotTheUsual) {
  EXPECT_EQ(benard_label(benard_row().settings), "ideal-gas, 5000 particles, Ra = 10000");
  const std::string fluid = "van-der-waals, walls, boundary-particles, monaghan, h = 3.5, T 10 to 0.5";
  EXPECT_EQ(benard_label(testing::unusual_benard_row().settings), fluid + ", 2500 particles, eta = 0, k = 0.3");
  const std::string text = format_benard(std::vector{benard_row(), testing::unusual_benard_row()});
  EXPECT_THAT(text, HasSubstr("2  van-der-waals  2500  eta = 0, k = 0.3"));
  EXPECT_THAT(text, HasSubstr("\n2: " + fluid + "\n"));  // too wide for the table
  EXPECT_THAT(text, HasSubstr("sides"));
  EXPECT_LE(widest_line(text), 118u);

  std::vector rows = {benard_row(), benard_row()};
  rows[1].settings.wall = space::WallKind::boundary_particles;
  rows[1].settings.weight = kernel::WeightName::monaghan;
  EXPECT_THAT(format_benard(rows), HasSubstr("2  ideal-gas, boundary-particles, monaghan  5000  10000"));
}

TEST(BenardText, ExplainsWhatIsShortOrFailedAndWarns) {
  std::vector rows = {testing::unusual_benard_row(), benard_row(), benard_row(), benard_row()};
  rows[1] = cases::failed_row(rows[1].settings, "replica 2: at time 3, particle 5 broke");
  rows[2].status = cases::RowStatus::failed;  // with what it had recorded
  rows[2].failure = "at time 9 it broke";
  rows[3].warnings = {"nothing flows"};
  const std::string text = format_benard(rows);
  EXPECT_THAT(text, HasSubstr("short: too short for an error bar of everything"));
  EXPECT_THAT(text, HasSubstr("failed: row 2 (ideal-gas, 5000 particles, Ra = 10000): replica 2: at time 3, particle 5 "
                              "broke\n"));
  EXPECT_THAT(text, HasSubstr("failed: row 3 (ideal-gas, 5000 particles, Ra = 10000): at time 9 it broke\n"));
  EXPECT_THAT(text, HasSubstr("warning: row 4 (ideal-gas, 5000 particles, Ra = 10000): nothing flows\n"));
  EXPECT_LE(widest_line(text), 118u);
}

}  // namespace
}  // namespace lucy::files
