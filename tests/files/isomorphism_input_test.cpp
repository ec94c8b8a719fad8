// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input file of isomorphism cases. What all input files share (reading, refusing, overrides) is in
// all_inputs_test.cpp; here are the keys, and what only these cases refuse.
#include "lucy/files/isomorphism_input.hpp"

#include <gtest/gtest.h>

#include "input_folder.hpp"
#include "shared_sections.hpp"

namespace lucy::files {
namespace {

using testing::contains;
using testing::lacks;
using testing::starts_with;
using testing::with;

using IsomorphismInputTest = testing::FolderReadBy<read_isomorphism>;

/// Lines 1 to 9 of a file that is accepted.
const std::string minimal = R"([system]
particles = 64
energy_per_particle = 1
[shear]
strain_rate = 0.5
[run]
duration = 100

[isentropic]
)";

TEST_F(IsomorphismInputTest, DefaultsAreThoseOfTheCase) {
  cases::IsomorphismPoint expected;
  expected.particles = 64;
  expected.energy_per_particle = 1.0;
  expected.strain_rate = 0.5;
  expected.duration = 100.0;
  IsomorphismInput by_hand;
  by_hand.points = {expected};
  const IsomorphismInput input = read(minimal);
  EXPECT_EQ(isomorphism_resolved_toml(input), isomorphism_resolved_toml(by_hand));
  EXPECT_EQ(input.threads, 0);
  EXPECT_EQ(input.checkpoint_interval, 10.0);
}

const std::string all_keys = R"(title = "all keys"
[system]
particles = 100
energy_per_particle = 1.5
density = 0.9
dimension = 2
[isentropic]
pressure = 4
reference_density = 0.5
[kernel]
name = "lucy"
range = 2.5
[shear]
strain_rate = -0.25
thermostat = "nose-hoover"
relaxation_time = 3
[run]
)" + testing::run_keys +
                             R"(integrator = "rk4"
[output]
sample_interval = 0.5
)";

TEST_F(IsomorphismInputTest, EveryKeyReachesItsPlace) {
  const IsomorphismInput input = read(all_keys);
  testing::expect_run_keys(input);
  const auto& point = input.points.front();
  EXPECT_EQ(input.title, "all keys");
  EXPECT_EQ(point.particles, 100);
  EXPECT_EQ(point.energy_per_particle, 1.5);
  EXPECT_EQ(point.density, 0.9);
  EXPECT_EQ(point.pressure, 4.0);
  EXPECT_EQ(point.reference_density, 0.5);
  EXPECT_EQ(point.range, 2.5);
  EXPECT_EQ(point.strain_rate, -0.25);
  EXPECT_EQ(point.thermostat, motion::Thermostat::nose_hoover);
  EXPECT_EQ(point.relaxation_time, 3.0);
  EXPECT_EQ(point.integrator, motion::Integrator::runge_kutta_4);
  EXPECT_EQ(point.sample_interval, 0.5);
}

TEST_F(IsomorphismInputTest, EnergiesAndRatesMultiplyWithTheEnergiesOutermost) {
  const auto text = with(minimal, "strain_rate = 0.5", "strain_rate = [0, 0.1]");
  const IsomorphismInput input = read(with(text, "energy_per_particle = 1", "energy_per_particle = [0.5, 1]"));
  ASSERT_EQ(input.points.size(), 4u);
  EXPECT_EQ(input.points[1].energy_per_particle, 0.5);
  EXPECT_EQ(input.points[1].strain_rate, 0.1);
  EXPECT_EQ(input.points[2].energy_per_particle, 1.0);
  EXPECT_EQ(input.points[2].strain_rate, 0.0);
  const IsomorphismInput steps = read(with(text, "duration = 100", "duration = 100\nstep = [0.05, 0.01]"));
  EXPECT_EQ(steps.points[0].step, 0.05);
  EXPECT_EQ(steps.points[1].step, 0.01);
  EXPECT_EQ(read(text + "[[point]]\nstrain_rate = 0.3\npressure = 2\n").points[0].pressure, 2.0);
}

TEST_F(IsomorphismInputTest, TheFluidIsOfPowersOfTwo) {
  EXPECT_EQ(refusal(minimal + "pressure = 3\n"),
            "a.toml:10: isentropic.pressure = 3 must be a power of two (1, 2, 0.5, ...), so that P/rho^2 is the same "
            "number at every density");
  EXPECT_PRED2(starts_with, refusal(minimal, {"isentropic.reference_density=0.3"}),
               "--set isentropic.reference_density=0.3: isentropic.reference_density = 0.3 must be a power of two");
  EXPECT_EQ(refusal(minimal + "pressure = 0\n"), "a.toml:10: isentropic.pressure = 0 must be a number above 0");
  EXPECT_EQ(read(minimal + "pressure = 0.25\nreference_density = 8\n").points.front().reference_density, 8.0);
}

TEST_F(IsomorphismInputTest, WhatCannotBeRunIsRefusedAtTheLineOfItsKey) {
  EXPECT_PRED2(starts_with, refusal(with(minimal, "= 64", "= 16")), "a.toml:2: system.particles = 16");
  EXPECT_PRED2(starts_with, refusal(with(minimal, "energy_per_particle = 1", "energy_per_particle = 0.4")),
               "a.toml:3: system.energy_per_particle = 0.4");
  EXPECT_PRED2(starts_with, refusal(minimal, {"run.step=0.3"}), "--set run.step=0.3: run.step = 0.3");
  EXPECT_PRED2(contains, refusal(with(minimal, "strain_rate = 0.5", "")), "shear.strain_rate");
  EXPECT_EQ(
      refusal(minimal, {"run.integrator=\"velocity-verlet\""}),
      "--set run.integrator=\"velocity-verlet\": run.integrator = \"velocity-verlet\" needs shear.strain_rate = 0 "
      "and thermostat \"none\" or \"isoenergetic\" (plain Newtonian motion); use \"rk4\"");
}

TEST_F(IsomorphismInputTest, BothReadingsAreRunSoThatNoneIsChosen) {
  EXPECT_PRED2(starts_with, refusal(minimal, {"system.reading=\"spam\""}),
               "--set system.reading=\"spam\": [system] unknown key 'reading'");
}

TEST_F(IsomorphismInputTest, TheResolvedTextGivesBackTheSameCases) {
  const auto lists = with(minimal, "strain_rate = 0.5", "strain_rate = [0, 0.30000000000000004]");
  for (const std::string& text : {minimal, all_keys, lists, lists + "[[point]]\nstrain_rate = 1\npressure = 2\n"}) {
    const IsomorphismInput input = read(text);
    const std::string resolved = isomorphism_resolved_toml(input);
    const IsomorphismInput again = read(resolved);
    EXPECT_EQ(isomorphism_resolved_toml(again), resolved);
    EXPECT_EQ(again.points.size(), input.points.size());
  }
}

TEST_F(IsomorphismInputTest, TheShippedInputHoldsAFreeCaseAndAShearedOne) {
  const IsomorphismInput input =
      read_isomorphism(std::filesystem::path(LUCY_SOURCE_DIRECTORY) / "inputs" / "isomorphism.toml");
  ASSERT_EQ(input.points.size(), 2u);
  EXPECT_EQ(cases::sweep_row(input.points[0]).thermostat, motion::Thermostat::none);
  EXPECT_EQ(cases::sweep_row(input.points[1]).thermostat, motion::Thermostat::isoenergetic);
  for (const auto& point : input.points) {
    EXPECT_EQ(point.particles, 1024);
    EXPECT_GE(point.duration / point.step, 199999.9);
    EXPECT_EQ(point.pressure / (point.reference_density * point.reference_density), 1.0);
  }
}

TEST(ExplainIsomorphism, SaysWhatIsItsOwn) {
  const Schema schema = isomorphism_schema();
  EXPECT_PRED2(contains, explain(schema, "pressure"), "a power of two");
  EXPECT_PRED2(contains, explain(schema, "thermostat"), "There is\n      none at strain rate zero");
  EXPECT_PRED2(lacks, explain(schema), "\n  reading\n");
}

}  // namespace
}  // namespace lucy::files
