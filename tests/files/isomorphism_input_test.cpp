// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input file of isomorphism cases. What all input files share (reading, refusing, overrides) is in input_test.cpp;
// here are the keys, and what only these cases refuse.
#include "lucy/files/isomorphism_input.hpp"

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

class IsomorphismInputTest : public testing::InputFolder {
 protected:
  IsomorphismInput read(const std::string& text, const Overrides& overrides = {}) const {
    return read_isomorphism(write(text), overrides);
  }
  std::string refusal(const std::string& text, const Overrides& overrides = {}) const {
    return refusal_from([&] { read(text, overrides); });
  }
};

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

/// Every key of the cases as text with all its bits.
std::string fingerprint(const IsomorphismInput& input) {
  std::string text = input.title;
  for (const auto& p : input.points) {
    text += fmt::format("\n{} {} {} {} {} {} {}", p.particles, p.dimension, p.kernel, static_cast<int>(p.thermostat),
                        static_cast<int>(p.integrator), p.replicas, p.seed);
    for (const double value :
         {p.energy_per_particle, p.density, p.pressure, p.reference_density, p.range, p.strain_rate, p.relaxation_time,
          p.step, p.equilibration, p.duration, p.energy_tolerance, p.sample_interval})
      text += fmt::format(" {:016x}", std::bit_cast<std::uint64_t>(value));
  }
  return text;
}

TEST_F(IsomorphismInputTest, DefaultsAreThoseOfTheCase) {
  cases::IsomorphismPoint expected;
  expected.particles = 64;
  expected.energy_per_particle = 1.0;
  expected.strain_rate = 0.5;
  expected.duration = 100.0;
  IsomorphismInput by_hand;
  by_hand.points = {expected};
  const IsomorphismInput input = read(minimal);
  EXPECT_EQ(fingerprint(input), fingerprint(by_hand));
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
integrator = "rk4"
step = 0.02
equilibration = 7
duration = 50
replicas = 3
seed = 9223372036854775807
energy_tolerance = 1e-7
threads = 5
checkpoint_interval = 2.5
[output]
sample_interval = 0.5
)";

TEST_F(IsomorphismInputTest, EveryKeyReachesItsPlace) {
  const IsomorphismInput input = read(all_keys);
  ASSERT_EQ(input.points.size(), 1u);
  const auto& point = input.points.front();
  EXPECT_EQ(input.title, "all keys");
  EXPECT_EQ(input.threads, 5);
  EXPECT_EQ(input.checkpoint_interval, 2.5);
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
  EXPECT_EQ(point.step, 0.02);
  EXPECT_EQ(point.equilibration, 7.0);
  EXPECT_EQ(point.duration, 50.0);
  EXPECT_EQ(point.replicas, 3);
  EXPECT_EQ(point.seed, 9223372036854775807u);
  EXPECT_EQ(point.energy_tolerance, 1e-7);
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
  EXPECT_EQ(refusal(minimal + "[correlation]\nlength = 5\n"),
            "a.toml:10: unknown section [correlation]; it belongs to an input of `lucy green-kubo`");
}

TEST_F(IsomorphismInputTest, TheResolvedTextGivesBackTheSameCases) {
  const auto lists = with(minimal, "strain_rate = 0.5", "strain_rate = [0, 0.30000000000000004]");
  for (const std::string& text : {minimal, all_keys, lists, lists + "[[point]]\nstrain_rate = 1\npressure = 2\n"}) {
    const IsomorphismInput input = read(text);
    const std::string resolved = isomorphism_resolved_toml(input);
    const IsomorphismInput again = read(resolved);
    EXPECT_EQ(fingerprint(again), fingerprint(input)) << resolved;
    EXPECT_EQ(isomorphism_resolved_toml(again), resolved);
    EXPECT_PRED2(lacks, resolved, "threads");
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

TEST(ExplainIsomorphism, NamesEveryKeyWithUnitDefaultAndRangeInNarrowLines) {
  const std::string text = explain_isomorphism();
  for (const Key& key : isomorphism_schema().keys) {
    EXPECT_PRED2(contains, text, "\n  " + key.name + "\n");
    EXPECT_FALSE(key.meaning.empty()) << key.path();
    EXPECT_PRED2(contains, explain_isomorphism(key.path()), "Accepted: ");
    if (!key.required && key.default_value) {
      EXPECT_EQ(checked_value(key, *key.default_value, {}), *key.default_value) << key.path();
    }
  }
  EXPECT_LE(testing::widest_line(text), 100u);
  EXPECT_PRED2(contains, explain_isomorphism("pressure"), "a power of two");
  EXPECT_PRED2(contains, explain_isomorphism("thermostat"), "There is\n      none at strain rate zero");
  EXPECT_PRED2(lacks, text, "\n  reading\n");
}

}  // namespace
}  // namespace lucy::files
