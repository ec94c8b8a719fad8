// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input file of sheared fluids. What all input files share (reading, refusing, overrides) is in
// all_inputs_test.cpp.
#include "lucy/files/shear_flow_input.hpp"

#include <gtest/gtest.h>

#include "input_folder.hpp"
#include "shared_sections.hpp"

namespace lucy::files {
namespace {

using testing::contains;
using testing::starts_with;
using testing::with;

using ShearFlowInputTest = testing::FolderReadBy<read_shear_flow>;

/// Lines 1 to 9 of a file that is accepted.
const std::string minimal = R"([system]
particles = 64

[shear]
strain_rate = 0.1

[run]
duration = 100

)";

TEST_F(ShearFlowInputTest, DefaultsAreThoseOfThePoint) {
  cases::ShearFlowPoint expected;
  expected.particles = 64;
  expected.strain_rate = 0.1;
  expected.duration = 100.0;
  ShearFlowInput by_hand;
  by_hand.points = {expected};
  EXPECT_EQ(shear_flow_resolved_toml(read(minimal)), shear_flow_resolved_toml(by_hand));
  EXPECT_EQ(read(minimal).points.front().disorder, 0.1);
  EXPECT_EQ(read(minimal).points.front().step, 0.1);
}

const std::string all_keys = R"(title = "all keys"
[system]
particles = 100
density = 0.9
dimension = 2
)" + testing::fluid_sections +
                             R"([shear]
strain_rate = -0.3
cooling = "none"
[run]
)" + testing::run_keys +
                             R"([output]
sample_interval = 0.5
frame_interval = 10
)";

TEST_F(ShearFlowInputTest, EveryKeyReachesItsPlace) {
  const ShearFlowInput input = read(all_keys);
  testing::expect_run_keys(input);
  const auto& point = input.points.front();
  EXPECT_EQ(input.title, "all keys");
  EXPECT_EQ(point.particles, 100);
  EXPECT_EQ(point.density, 0.9);
  testing::expect_fluid_sections(point);
  EXPECT_EQ(point.strain_rate, -0.3);
  EXPECT_EQ(point.cooling, motion::Cooling::none);
  EXPECT_EQ(point.sample_interval, 0.5);
  EXPECT_EQ(point.frame_interval, 10.0);
}

TEST_F(ShearFlowInputTest, AStrainRateIsARow) {
  const auto rates = [&](const ShearFlowInput& input) {
    std::vector<double> values;
    for (const auto& point : input.points) values.push_back(point.strain_rate);
    return values;
  };
  const std::string list = with(minimal, "= 0.1", "= [0.05, 0.2]");
  EXPECT_EQ(rates(read(list)), (std::vector{0.05, 0.2}));
  EXPECT_EQ(read(with(list, "duration = 100", "duration = [300, 50]")).points[1].duration, 50.0);
  const std::string points =
      minimal + "[[point]]\nviscosity = 2\n[[point]]\nstrain_rate = 0.4\nkernel.name = \"monaghan\"\n";
  EXPECT_EQ(rates(read(points)), (std::vector{0.1, 0.4}));
  EXPECT_EQ(read(points).points[0].viscosity, 2.0);
  EXPECT_EQ(read(points).points[1].weight, kernel::WeightName::monaghan);
  EXPECT_EQ(rates(read(points, {"shear.strain_rate=[1, 2, 3]"})), (std::vector{1.0, 2.0, 3.0}));
}

TEST_F(ShearFlowInputTest, WhatCannotBeRunIsRefusedAtTheLineOfItsKey) {
  EXPECT_EQ(refusal(with(minimal, "= 0.1", "= 0")), "a.toml:5: shear.strain_rate = 0 must be finite and not 0");
  EXPECT_PRED2(starts_with, refusal(with(minimal, "= 64", "= 25")), "a.toml:2: system.particles = 25");
  EXPECT_PRED2(starts_with, refusal(minimal, {"run.step=0.3"}), "--set run.step=0.3: run.step = 0.3");
  EXPECT_PRED2(starts_with, refusal(minimal + "[fluid]\nviscosity = -1\n"), "a.toml:11: fluid.viscosity = -1");
  EXPECT_EQ(refusal(minimal + "[fluid]\nequation_of_state = \"air\"\n"),
            "a.toml:11: fluid.equation_of_state = \"air\" must be one of \"isentropic\", \"ideal-gas\", "
            "\"van-der-waals\", \"dense-fluid\"");
  EXPECT_PRED2(contains, refusal(with(minimal, "[shear]\nstrain_rate = 0.1\n", "")), "shear.strain_rate");
  EXPECT_EQ(refusal(minimal, {"shear.thermostat=\"none\""}),
            "--set shear.thermostat=\"none\": [shear] unknown key 'thermostat'; it belongs to an input of `lucy sweep` "
            "or `lucy isomorphism`");
  EXPECT_EQ(refusal(minimal + "[wave]\nmode = 1\n"),
            "a.toml:10: unknown section [wave]; it belongs to an input of `lucy shear-wave` or `lucy "
            "temperature-wave`");
}

TEST_F(ShearFlowInputTest, TheResolvedTextGivesBackTheSameRows) {
  for (const std::string& text :
       {minimal, all_keys, with(minimal, "= 0.1", "= [0.05, 0.30000000000000004e-1]"),
        minimal + "[[point]]\nviscosity = 2\n[[point]]\nequation_of_state = \"isentropic\"\n"}) {
    const ShearFlowInput input = read(text);
    const std::string resolved = shear_flow_resolved_toml(input);
    const ShearFlowInput again = read(resolved);
    EXPECT_EQ(shear_flow_resolved_toml(again), resolved);
    EXPECT_EQ(again.points.size(), input.points.size());
  }
}

TEST(ExplainShearFlow, SaysWhatIsItsOwn) {
  EXPECT_PRED2(contains, explain(shear_flow_schema(), "cooling"), "Default: \"isoenergetic\"");
  EXPECT_PRED2(contains, explain(shear_flow_schema(), "strain_rate"), "(lists multiply)");
}

TEST(ShearFlowInput, ThePublishedFileIsSound) {
  const ShearFlowInput input = read_shear_flow(std::string(LUCY_SOURCE_DIRECTORY) + "/inputs/shear_flow.toml");
  EXPECT_GE(input.points.size(), 10u);
}

}  // namespace
}  // namespace lucy::files
