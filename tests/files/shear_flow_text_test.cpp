// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/shear_flow_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch.hpp"
#include "shear_flow_rows.hpp"

namespace lucy::files {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::shear_flow_row;
using testing::unknown_value;
using testing::widest_line;

TEST(ShearFlowText, ShowsTheViscosityWithItsPartsAndTheBalance) {
  const std::vector rows = {shear_flow_row()};
  const std::string text = format_shear_flow(rows);
  EXPECT_THAT(text, HasSubstr("   fluid      eta  rate   viscosity     Newtonian     pressure     carried  status\n"));
  EXPECT_THAT(text, HasSubstr("1  ideal-gas  0.5   0.1  0.5765(12)  0.492170(40)  0.03270(50)  0.0516(15)"));
  EXPECT_THAT(text, HasSubstr("-0.000120(20)"));
  EXPECT_THAT(text, HasSubstr("0.9850(10)\n"));  // the gradient over the rate
  EXPECT_THAT(text, HasSubstr("1024 particles. Reduced units."));
  EXPECT_THAT(text, Not(HasSubstr("short: ")));
  EXPECT_LE(widest_line(text), 118u);
}

TEST(ShearFlowText, NamesWhatIsNotTheUsual) {
  std::vector rows = {shear_flow_row(), shear_flow_row()};
  rows[1].settings.equation_of_state = spam::EquationOfStateName::van_der_waals;
  rows[1].settings.weight = kernel::WeightName::monaghan;
  EXPECT_EQ(shear_flow_label(rows[1].settings), "van-der-waals, monaghan, viscosity 0.5, rate 0.1");
  rows[0].settings.particles = 256;
  rows[0].settings.range = 4;
  EXPECT_EQ(shear_flow_label(rows[0].settings), "ideal-gas, h = 4, viscosity 0.5, rate 0.1");
  const std::string text = format_shear_flow(rows);
  EXPECT_THAT(text, HasSubstr("   fluid                       N  eta  rate"));
  EXPECT_THAT(text, Not(HasSubstr("particles. Reduced")));
}

TEST(ShearFlowText, ExplainsWhatIsShortOrFailedAndWarns) {
  std::vector rows = {shear_flow_row(), shear_flow_row(), shear_flow_row()};
  rows[0].status = cases::RowStatus::too_short;
  rows[0].estimates[cases::shear_flow_quantity("viscosity")].error = unknown_value;
  rows[1] = cases::failed_row(rows[1].settings, "replica 2: at time 3, it broke");
  rows[2].warnings = {"the flow is not homogeneous"};
  const std::string text = format_shear_flow(rows);
  EXPECT_THAT(text, HasSubstr("0.5765(nan)"));
  EXPECT_THAT(text, HasSubstr("short: too short for an error bar, or not steady"));
  EXPECT_THAT(text, HasSubstr("failed: row 2 (ideal-gas, viscosity 0.5, rate 0.1): replica 2: at time 3, it broke\n"));
  EXPECT_THAT(text, HasSubstr("warning: row 3 (ideal-gas, viscosity 0.5, rate 0.1): the flow is not homogeneous\n"));
  EXPECT_LE(widest_line(text), 118u);
}

}  // namespace
}  // namespace lucy::files
