// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input file of sheared fluids. What all input files share (reading, refusing, overrides) is in input_test.cpp.
#include "lucy/files/shear_flow_input.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>

#include "input_folder.hpp"

namespace lucy::files {
namespace {

using testing::contains;
using testing::lacks;
using testing::Overrides;
using testing::starts_with;
using testing::with;

class ShearFlowInputTest : public testing::InputFolder {
 protected:
  ShearFlowInput read(const std::string& text, const Overrides& overrides = {}) const {
    return read_shear_flow(write(text), overrides);
  }
  std::string refusal(const std::string& text, const Overrides& overrides = {}) const {
    return refusal_from([&] { read(text, overrides); });
  }
};

/// Lines 1 to 9 of a file that is accepted.
const std::string minimal = R"([system]
particles = 64

[shear]
strain_rate = 0.1

[run]
duration = 100

)";

/// Every key of the rows as text with all its bits.
std::string fingerprint(const ShearFlowInput& input) {
  std::string text = input.title;
  for (const auto& p : input.points) {
    text += fmt::format("\n{} {} {} {} {} {} {} {} {}", p.particles, p.dimension, static_cast<int>(p.weight),
                        static_cast<int>(p.equation_of_state), static_cast<int>(p.density_mean),
                        static_cast<int>(p.uniform), static_cast<int>(p.cooling), p.replicas, p.seed);
    for (const double value :
         {p.density, p.range, p.temperature, p.viscosity, p.bulk_viscosity, p.conductivity, p.disorder, p.noise,
          p.strain_rate, p.step, p.equilibration, p.duration, p.energy_tolerance, p.sample_interval, p.frame_interval})
      text += fmt::format(" {:016x}", std::bit_cast<std::uint64_t>(value));
  }
  return text;
}

TEST_F(ShearFlowInputTest, DefaultsAreThoseOfThePoint) {
  cases::ShearFlowPoint expected;
  expected.particles = 64;
  expected.strain_rate = 0.1;
  expected.duration = 100.0;
  ShearFlowInput by_hand;
  by_hand.points = {expected};
  EXPECT_EQ(fingerprint(read(minimal)), fingerprint(by_hand));
  EXPECT_EQ(read(minimal).points.front().disorder, 0.1);
  EXPECT_EQ(read(minimal).points.front().step, 0.1);
}

const std::string all_keys = R"(title = "all keys"
[system]
particles = 100
density = 0.9
dimension = 2
[kernel]
name = "monaghan"
range = 2.5
[fluid]
equation_of_state = "dense-fluid"
temperature = 1.25
viscosity = 0.75
bulk_viscosity = 0.125
conductivity = 0.375
density_mean = "arithmetic"
[start]
disorder = 0.2
noise = 0.01
uniform = "temperature"
[shear]
strain_rate = -0.3
cooling = "none"
[run]
step = 0.05
equilibration = 7
duration = 500
replicas = 3
seed = 11
energy_tolerance = 1e-7
threads = 5
checkpoint_interval = 2.5
[output]
sample_interval = 0.5
frame_interval = 10
)";

TEST_F(ShearFlowInputTest, EveryKeyReachesItsPlace) {
  const ShearFlowInput input = read(all_keys);
  ASSERT_EQ(input.points.size(), 1u);
  const auto& point = input.points.front();
  EXPECT_EQ(input.title, "all keys");
  EXPECT_EQ(input.threads, 5);
  EXPECT_EQ(input.checkpoint_interval, 2.5);
  EXPECT_EQ(point.particles, 100);
  EXPECT_EQ(point.density, 0.9);
  EXPECT_EQ(point.weight, kernel::WeightName::monaghan);
  EXPECT_EQ(point.range, 2.5);
  EXPECT_EQ(point.equation_of_state, spam::EquationOfStateName::dense_fluid);
  EXPECT_EQ(point.temperature, 1.25);
  EXPECT_EQ(point.viscosity, 0.75);
  EXPECT_EQ(point.bulk_viscosity, 0.125);
  EXPECT_EQ(point.conductivity, 0.375);
  EXPECT_EQ(point.density_mean, spam::DensityMean::arithmetic);
  EXPECT_EQ(point.disorder, 0.2);
  EXPECT_EQ(point.noise, 0.01);
  EXPECT_EQ(point.strain_rate, -0.3);
  EXPECT_EQ(point.cooling, motion::Cooling::none);
  EXPECT_EQ(point.step, 0.05);
  EXPECT_EQ(point.equilibration, 7.0);
  EXPECT_EQ(point.duration, 500.0);
  EXPECT_EQ(point.replicas, 3);
  EXPECT_EQ(point.seed, 11u);
  EXPECT_EQ(point.energy_tolerance, 1e-7);
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
  EXPECT_PRED2(contains, refusal(minimal, {"shear.thermostat=\"none\""}), "unknown key 'thermostat'");
  EXPECT_PRED2(contains, refusal(minimal + "[wave]\nmode = 1\n"), "it belongs to an input of `lucy shear-wave`");
  EXPECT_PRED2(contains, refusal(minimal, {"system.energy_per_particle=1"}), "unknown key 'energy_per_particle'");
}

TEST_F(ShearFlowInputTest, TheResolvedTextGivesBackTheSameRows) {
  for (const std::string& text :
       {minimal, all_keys, with(minimal, "= 0.1", "= [0.05, 0.30000000000000004e-1]"),
        minimal + "[[point]]\nviscosity = 2\n[[point]]\nequation_of_state = \"isentropic\"\n"}) {
    const ShearFlowInput input = read(text);
    const std::string resolved = shear_flow_resolved_toml(input);
    EXPECT_EQ(fingerprint(read(resolved)), fingerprint(input)) << resolved;
    EXPECT_EQ(shear_flow_resolved_toml(read(resolved)), resolved);
    EXPECT_PRED2(lacks, resolved, "threads");
  }
}

TEST(ExplainShearFlow, NamesEveryKeyInNarrowLines) {
  const std::string text = explain_shear_flow();
  for (const Key& key : shear_flow_schema().keys) {
    EXPECT_PRED2(contains, text, "\n  " + key.name + "\n");
    EXPECT_FALSE(key.meaning.empty()) << key.path();
    EXPECT_PRED2(contains, explain_shear_flow(key.path()), "Accepted: ");
  }
  EXPECT_LE(testing::widest_line(text), 100u);
  EXPECT_PRED2(contains, explain_shear_flow("cooling"), "Default: \"isoenergetic\"");
  EXPECT_PRED2(contains, explain_shear_flow("strain_rate"), "(lists multiply)");
}

TEST(ShearFlowInput, ThePublishedFileIsSound) {
  const ShearFlowInput input = read_shear_flow(std::string(LUCY_SOURCE_DIRECTORY) + "/inputs/shear_flow.toml");
  EXPECT_GE(input.points.size(), 10u);
}

}  // namespace
}  // namespace lucy::files
