// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input file of Green-Kubo states. What all input files share (reading, refusing, overrides) is in
// all_inputs_test.cpp; here are the keys, the two lists that multiply, and lists of texts.
#include "lucy/files/green_kubo_input.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "input_folder.hpp"
#include "shared_sections.hpp"

namespace lucy::files {
namespace {

using testing::contains;
using testing::Overrides;
using testing::starts_with;
using testing::with;

using GreenKuboInputTest = testing::FolderReadBy<read_green_kubo>;

/// Lines 1 to 8 of a file that is accepted.
const std::string minimal = R"([system]
particles = 64
energy_per_particle = 1

[run]
duration = 1000

[correlation]
)";

/// Particles, energy and duration of every state.
std::vector<std::string> states(const GreenKuboInput& input) {
  std::vector<std::string> result;
  for (const auto& point : input.points)
    result.push_back(fmt::format("{} {} {}", point.particles, point.energy_per_particle, point.duration));
  return result;
}

using States = std::vector<std::string>;

TEST_F(GreenKuboInputTest, DefaultsAreThoseOfTheState) {
  cases::GreenKuboPoint expected;
  expected.particles = 64;
  expected.energy_per_particle = 1.0;
  expected.duration = 1000.0;
  GreenKuboInput by_hand;
  by_hand.points = {expected};
  const GreenKuboInput input = read(minimal);
  EXPECT_EQ(green_kubo_resolved_toml(input), green_kubo_resolved_toml(by_hand));
  EXPECT_EQ(input.threads, 0);
  EXPECT_EQ(input.checkpoint_interval, 10.0);
}

const std::string all_keys = R"(title = "all keys"
[system]
particles = 100
energy_per_particle = 1.5
density = 0.9
dimension = 2
reading = "md"
[kernel]
name = "lucy"
range = 2.5
[run]
)" + testing::run_keys +
                             R"(integrator = "rk4"
preparation = 10
energy_band = 0.002
[correlation]
method = "multiple-tau"
length = 50
cutoff = 20
diffusion = true
thermal_conductivity = true
pairs = ["pressure pressure", "pxy kinetic_temperature"]
[output]
sample_interval = 0.1
frame_interval = 10
series = true
)";

TEST_F(GreenKuboInputTest, EveryKeyReachesItsPlace) {
  const GreenKuboInput input = read(all_keys);
  testing::expect_run_keys(input);
  const auto& point = input.points.front();
  EXPECT_EQ(input.title, "all keys");
  EXPECT_EQ(point.particles, 100);
  EXPECT_EQ(point.energy_per_particle, 1.5);
  EXPECT_EQ(point.density, 0.9);
  EXPECT_EQ(point.range, 2.5);
  EXPECT_EQ(point.integrator, motion::Integrator::runge_kutta_4);
  EXPECT_EQ(point.preparation, 10.0);
  EXPECT_EQ(point.energy_band, 0.002);
  EXPECT_EQ(point.method, cases::CorrelationMethod::multiple_tau);
  EXPECT_EQ(point.length, 50.0);
  EXPECT_EQ(point.cutoff, 20.0);
  EXPECT_TRUE(point.diffusion);
  EXPECT_TRUE(point.thermal_conductivity);
  EXPECT_EQ(point.pairs, (Texts{"pressure pressure", "pxy kinetic_temperature"}));
  EXPECT_EQ(point.sample_interval, 0.1);
  EXPECT_EQ(point.frame_interval, 10.0);
  EXPECT_TRUE(point.series);
}

TEST_F(GreenKuboInputTest, ParticlesAndEnergiesMultiplyWithTheParticlesOutermost) {
  const auto text = with(minimal, "particles = 64", "particles = [64, 100]");
  const auto both = with(text, "energy_per_particle = 1", "energy_per_particle = [0.5, 1]");
  EXPECT_EQ(states(read(both)), (States{"64 0.5 1000", "64 1 1000", "100 0.5 1000", "100 1 1000"}));
  EXPECT_EQ(states(read(with(both, "duration = 1000", "duration = [2000, 3000]"))),
            (States{"64 0.5 2000", "64 1 3000", "100 0.5 2000", "100 1 3000"}));
  EXPECT_EQ(refusal(with(both, "duration = 1000", "duration = [2000, 3000, 4000]")),
            "a.toml:6: run.duration is a list of 3, but system.energy_per_particle has 2 values; give one number, or "
            "one per entry");
  const GreenKuboInput cut = read(both, {"correlation.cutoff=[70, 150]"});
  EXPECT_EQ(cut.points[2].cutoff, 70.0);
  EXPECT_EQ(cut.points[3].cutoff, 150.0);
}

TEST_F(GreenKuboInputTest, PointTablesAreTheStatesUntilASweptKeyIsSet) {
  const std::string text = minimal +
                           "[[point]]\nparticles = 100\nduration = 3000\n"
                           "[[point]]\nenergy_per_particle = 0.5\npairs = [\"pxy pxy\"]\n";
  EXPECT_EQ(states(read(text)), (States{"100 1 3000", "64 0.5 1000"}));
  EXPECT_EQ(read(text).points[1].pairs, (Texts{"pxy pxy"}));
  EXPECT_EQ(states(read(text, {"system.particles=[144, 196]"})), (States{"144 1 1000", "196 1 1000"}));
  EXPECT_EQ(states(read(text, {"system.energy_per_particle=2"})), (States{"64 2 1000"}));
}

TEST_F(GreenKuboInputTest, ListsOfTextsAreOneValue) {
  EXPECT_TRUE(read(minimal + "pairs = []\n").points.front().pairs.empty());
  const Overrides overrides = {"correlation.pairs=[\"pxy pxy\"]"};
  EXPECT_EQ(read(minimal + "pairs = [\"pressure pressure\"]\n", overrides).points.front().pairs, (Texts{"pxy pxy"}));
  const std::string accepted = "correlation.pairs must be a list of texts, each in quotes and on one line";
  EXPECT_EQ(refusal(minimal + "pairs = \"pxy pxy\"\n"), "a.toml:9: " + accepted + ", but is text");
  EXPECT_EQ(refusal(minimal + "pairs = [\"pxy pxy\", 3]\n"), "a.toml:9: " + accepted + ", but holds a number");
  EXPECT_EQ(refusal(minimal + "pairs = [[\"pxy\", \"pxy\"]]\n"), "a.toml:9: " + accepted + ", but holds a list");
  EXPECT_EQ(refusal(minimal, {"correlation.pairs=pxy"}),
            "--set correlation.pairs=pxy: correlation.pairs = pxy must be a list of texts, each in quotes and on one "
            "line");
  EXPECT_PRED2(starts_with, refusal(minimal + "pairs = [\"pxy\\npxy\"]\n"), "a.toml:9: correlation.pairs = [\"pxy");
  EXPECT_PRED2(starts_with, refusal(minimal + "pairs = [\"pxy pxy\", \"pxy pxz\"]\n"), "a.toml:9: correlation.pairs");
  EXPECT_PRED2(contains, refusal(minimal + "pairs = [\"pxy pxy\", \"pxy pxz\"]\n"), "pxz");
}

TEST_F(GreenKuboInputTest, WhatCannotBeRunIsRefusedAtTheLineOfItsKey) {
  EXPECT_PRED2(starts_with, refusal(with(minimal, "= 64", "= 16")), "a.toml:2: system.particles = 16");
  EXPECT_PRED2(starts_with, refusal(with(minimal, "energy_per_particle = 1", "energy_per_particle = 0.4")),
               "a.toml:3: system.energy_per_particle = 0.4");
  EXPECT_PRED2(starts_with, refusal(minimal + "length = 2000\n"), "a.toml:9: correlation.length = 2000");
  EXPECT_PRED2(starts_with, refusal(minimal, {"correlation.cutoff=500"}),
               "--set correlation.cutoff=500: correlation.cutoff = 500");
  EXPECT_EQ(refusal(minimal + "method = \"direct\"\n"),
            "a.toml:9: correlation.method = \"direct\" must be one of \"fft\", \"multiple-tau\"");
  EXPECT_EQ(refusal(minimal + "length = 0\n"), "a.toml:9: correlation.length = 0 must be a number above 0");
}

TEST_F(GreenKuboInputTest, ShearBelongsElsewhere) {
  const std::string sentence =
      "unknown section [shear]; a Green-Kubo state is at rest, its strain rate zero; [shear] belongs to an input of "
      "`lucy sweep`, `lucy isomorphism` or `lucy shear-flow`";
  EXPECT_EQ(refusal(minimal + "[shear]\nstrain_rate = 0.1\n"), "a.toml:9: " + sentence);
  EXPECT_EQ(refusal(minimal, {"shear.strain_rate=0.1"}), "--set shear.strain_rate=0.1: " + sentence);
  EXPECT_EQ(refusal(minimal + "[output]\nrescale = true\n"),
            "a.toml:10: [output] unknown key 'rescale'; its keys are sample_interval, frame_interval, series");
}

TEST_F(GreenKuboInputTest, TheResolvedTextGivesBackTheSameStates) {
  const auto lists = with(with(minimal, "particles = 64", "particles = [64, 100]"), "energy_per_particle = 1",
                          "energy_per_particle = [0.5, 0.30000000000000004e1]");
  for (const std::string& text :
       {minimal, all_keys, lists, minimal + "pairs = [\"pxy pxy\"]\n[[point]]\n[[point]]\npairs = []\ncutoff = 33\n"}) {
    const GreenKuboInput input = read(text);
    const std::string resolved = green_kubo_resolved_toml(input);
    const GreenKuboInput again = read(resolved);
    EXPECT_EQ(green_kubo_resolved_toml(again), resolved);
    EXPECT_EQ(states(again), states(input));
  }
  EXPECT_PRED2(contains, green_kubo_resolved_toml(read(all_keys)),
               "pairs = [\"pressure pressure\", \"pxy kinetic_temperature\"]\n");
}

TEST(ExplainGreenKubo, SaysWhatIsItsOwn) {
  const Schema schema = green_kubo_schema();
  EXPECT_PRED2(contains, explain(schema, "pairs"), "Unit: none. Default: [].\n      Accepted: a list of texts");
  EXPECT_PRED2(contains, explain(schema, "particles"), "or a list of such numbers (lists multiply)");
  EXPECT_PRED2(contains, explain(schema, "duration"), "one such number per entry of\n      system.energy_per_particle");
  EXPECT_PRED2(contains, explain(schema, "diffusion"), "two dimensions");
  EXPECT_PRED2(contains, explain(schema, "thermal_conductivity"), "In two\n      dimensions");
  EXPECT_PRED2(contains, explain(schema, "cutoff"), "6 decay times");
}

}  // namespace
}  // namespace lucy::files
