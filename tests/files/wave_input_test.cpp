// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input files of decaying waves. What all input files share (reading, refusing, overrides) is in
// all_inputs_test.cpp; here are the keys, what belongs to fluids and what to atoms, and what differs between shear and
// temperature.
#include "lucy/files/wave_input.hpp"

#include <gtest/gtest.h>

#include "input_folder.hpp"
#include "shared_sections.hpp"

namespace lucy::files {
namespace {

using cases::WavePoint;
using cases::WaveQuantity;
using testing::contains;
using testing::Overrides;
using testing::starts_with;
using testing::with;

class WaveInputTest : public testing::InputFolder {
 protected:
  WaveInput read(const std::string& text, const Overrides& overrides = {},
                 WaveQuantity quantity = WaveQuantity::shear) const {
    return read_wave(quantity, write(text), overrides);
  }
  std::string refusal(const std::string& text, const Overrides& overrides = {},
                      WaveQuantity quantity = WaveQuantity::shear) const {
    return refusal_from([&] { read(text, overrides, quantity); });
  }
};

/// Lines 1 to 6 of a file that is accepted by both commands.
const std::string minimal = R"([system]
particles = 144

[run]
duration = 100

)";

TEST_F(WaveInputTest, DefaultsAreThoseOfThePoint) {
  for (const auto quantity : {WaveQuantity::shear, WaveQuantity::temperature}) {
    const WaveInput input = read(minimal, {}, quantity);
    ASSERT_EQ(input.points.size(), 1u);
    const WavePoint& point = input.points.front();
    EXPECT_EQ(input.quantity, quantity);
    EXPECT_EQ(point.quantity, quantity);
    EXPECT_EQ(point.reading, motion::Reading::spam);
    EXPECT_FALSE(point.energy_per_particle.has_value());
    EXPECT_EQ(point.amplitude, 0.05);
    EXPECT_EQ(point.mode, 1);
    EXPECT_EQ(point.replicas, 8);
    EXPECT_EQ(point.step, 0.2);
    EXPECT_EQ(point.viscosity, 0.0);
    EXPECT_EQ(input.threads, 0);
  }
}

const std::string all_keys = R"(title = "all keys"
[system]
particles = 100
density = 0.9
dimension = 2
reading = "spam"
)" + testing::fluid_sections +
                             R"([wave]
amplitude = 0.03
mode = 2
[run]
)" + testing::run_keys +
                             R"([output]
sample_interval = 0.8
frame_interval = 8
)";

TEST_F(WaveInputTest, EveryKeyReachesItsPlace) {
  const WaveInput input = read(all_keys);
  testing::expect_run_keys(input);
  const WavePoint& point = input.points.front();
  EXPECT_EQ(input.title, "all keys");
  EXPECT_EQ(point.particles, 100);
  EXPECT_EQ(point.density, 0.9);
  testing::expect_fluid_sections(point);
  EXPECT_EQ(point.amplitude, 0.03);
  EXPECT_EQ(point.mode, 2);
  EXPECT_EQ(point.sample_interval, 0.8);
  EXPECT_EQ(point.frame_interval, 8.0);
}

TEST_F(WaveInputTest, NumbersOfParticlesMakeRowsAndPointTablesMakeTheirOwn) {
  const WaveInput sizes = read(with(minimal, "particles = 144", "particles = [144, 256]"));
  ASSERT_EQ(sizes.points.size(), 2u);
  EXPECT_EQ(sizes.points[1].particles, 256);
  const std::string text = minimal +
                           "[fluid]\nviscosity = 0.3\n[[point]]\n[[point]]\nrange = 4\nname = \"monaghan\"\n"
                           "[[point]]\nreading = \"md\"\nenergy_per_particle = 1\nviscosity = 0\nstep = 0.1\n";
  const WaveInput points = read(text);
  ASSERT_EQ(points.points.size(), 3u);
  EXPECT_EQ(points.points[0].range, 3.0);
  EXPECT_EQ(points.points[1].range, 4.0);
  EXPECT_EQ(points.points[1].viscosity, 0.3);
  EXPECT_EQ(points.points[2].energy_per_particle, 1.0);
  EXPECT_EQ(read(text, {"system.particles=256"}).points.size(), 1u);
}

TEST_F(WaveInputTest, WhatCannotBeRunIsRefusedAtTheLineOfItsKey) {
  EXPECT_PRED2(starts_with, refusal(with(minimal, "= 144", "= 25")), "a.toml:2: system.particles = 25");
  EXPECT_PRED2(starts_with, refusal(minimal + "[wave]\nmode = 4\n"), "a.toml:8: wave.mode = 4 makes a wavelength of 3");
  EXPECT_PRED2(starts_with, refusal(minimal + "[wave]\namplitude = -1\n"), "a.toml:8: wave.amplitude = -1 must be");
  EXPECT_EQ(refusal(minimal, {"run.step=0.6"}),
            "--set run.step=0.6: run.step = 0.6 must be a number above 0 and at most 0.5");
  EXPECT_PRED2(contains, refusal(minimal, {"system.reading=\"md\""}), "system.energy_per_particle is required");
  EXPECT_PRED2(
      contains,
      refusal(minimal + "[fluid]\nviscosity = 0.3\n", {"system.reading=\"md\"", "system.energy_per_particle=1"}),
      "a.toml:8: fluid.viscosity = 0.3 is for smooth particles; with system.reading = \"md\" it must be 0");
  EXPECT_PRED2(contains, refusal(minimal, {"system.energy_per_particle=1"}), "is for system.reading = \"md\"");
  EXPECT_EQ(refusal(minimal + "[kernel]\nname = \"gauss\"\n"),
            "a.toml:8: kernel.name = \"gauss\" must be one of \"lucy\", \"monaghan\"");
  EXPECT_EQ(refusal(minimal + "[shear]\nstrain_rate = 1\n"),
            "a.toml:7: unknown section [shear]; a wave decays in a box at rest; [shear] belongs to an input of `lucy "
            "sweep`, `lucy isomorphism` or `lucy shear-flow`");
}

TEST_F(WaveInputTest, TemperatureWavesAreOfFluidsWithAnEntropy) {
  const auto heat = WaveQuantity::temperature;
  EXPECT_PRED2(contains, refusal(minimal + "reading = \"md\"\n", {}, heat), "unknown key 'reading'");
  EXPECT_PRED2(contains, refusal(minimal, {"system.reading=\"md\""}, heat), "reading");
  EXPECT_PRED2(contains, refusal(minimal, {"fluid.equation_of_state=\"dense-fluid\""}, heat), "entropy");
  EXPECT_EQ(refusal(minimal, {"fluid.equation_of_state=\"dense-fluid\""}), "accepted");
  EXPECT_PRED2(contains, refusal(minimal, {"wave.amplitude=1.5"}, heat), "must be a number above 0 and below 1");
  EXPECT_EQ(refusal(minimal, {"wave.amplitude=1.5"}), "accepted");
}

TEST_F(WaveInputTest, TheResolvedTextGivesBackTheSamePoints) {
  const std::string atoms =
      minimal + "[[point]]\n[[point]]\nreading = \"md\"\nenergy_per_particle = 0.30000000000000004e1\n";
  for (const std::string& text : {minimal, all_keys, atoms}) {
    const WaveInput input = read(text);
    const std::string resolved = wave_resolved_toml(input);
    const WaveInput again = read(resolved);
    EXPECT_EQ(wave_resolved_toml(again), resolved);
    EXPECT_EQ(again.points.size(), input.points.size());
    EXPECT_EQ(again.points.back().energy_per_particle, input.points.back().energy_per_particle);
  }
  EXPECT_NE(wave_resolved_toml(read(minimal)), wave_resolved_toml(read(minimal, {}, WaveQuantity::temperature)));
}

TEST(ExplainWave, TellsOneAmplitudeFromTheOther) {
  EXPECT_PRED2(contains, explain(wave_schema(WaveQuantity::shear), "amplitude"), "v_x = A sin(k y)");
  EXPECT_PRED2(contains, explain(wave_schema(WaveQuantity::temperature), "amplitude"), "1 + A sin(k y)");
}

}  // namespace
}  // namespace lucy::files
