// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input file of convecting particles. What all input files share (reading, refusing, overrides) is in
// all_inputs_test.cpp.
#include "lucy/files/benard_input.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "input_folder.hpp"

namespace lucy::files {
namespace {

using testing::contains;
using testing::starts_with;
using testing::with;

using BenardInputTest = testing::FolderReadBy<read_benard>;

/// Lines 1 to 6 of a file that is accepted.
const std::string minimal = R"([system]
particles = 200
[fluid]
rayleigh = 5000
[run]
duration = 100
)";

TEST_F(BenardInputTest, DefaultsAreThoseOfThePoint) {
  cases::BenardPoint expected;
  expected.particles = 200;
  expected.rayleigh = 5000.0;
  expected.duration = 100.0;
  BenardInput by_hand;
  by_hand.points = {expected};
  EXPECT_EQ(benard_resolved_toml(read(minimal)), benard_resolved_toml(by_hand));
  EXPECT_EQ(read(minimal).points.front().height, 0.0);  // what makes the density 1
  EXPECT_EQ(read(minimal).points.front().step, 0.5);
}

const std::string all_keys = R"(title = "all keys"
[system]
particles = 288
[cell]
height = 12
width = 24
side = "walls"
wall = "boundary-particles"
hot = 2
cold = 1
gravity = 0.1
[kernel]
name = "monaghan"
range = 2.5
[fluid]
equation_of_state = "van-der-waals"
viscosity = 0.4
conductivity = 0.3
bulk_viscosity = 0.125
density_mean = "arithmetic"
[start]
roll_velocity = 0.01
disorder = 0.2
[run]
step = 0.02
equilibration = 8
duration = 500
replicas = 3
seed = 9223372036854775807
energy_tolerance = 1e-7
threads = 5
checkpoint_interval = 2.5
[output]
cells = 10
sample_interval = 0.5
frame_interval = 10
)";

TEST_F(BenardInputTest, EveryKeyReachesItsPlace) {
  const BenardInput input = read(all_keys);
  EXPECT_EQ(input.title, "all keys");
  EXPECT_EQ(input.threads, 5);
  EXPECT_EQ(input.checkpoint_interval, 2.5);
  ASSERT_EQ(input.points.size(), 1u);
  const cases::BenardPoint& point = input.points.front();
  EXPECT_EQ(point.particles, 288);
  EXPECT_EQ(point.height, 12.0);
  EXPECT_EQ(*point.width, 24.0);
  EXPECT_EQ(point.sides, grid::Sides::walls);
  EXPECT_EQ(point.wall, space::WallKind::boundary_particles);
  EXPECT_EQ(point.hot, 2.0);
  EXPECT_EQ(point.cold, 1.0);
  EXPECT_EQ(*point.gravity, 0.1);
  EXPECT_EQ(point.weight, kernel::WeightName::monaghan);
  EXPECT_EQ(point.range, 2.5);
  EXPECT_EQ(point.equation_of_state, spam::EquationOfStateName::van_der_waals);
  EXPECT_FALSE(point.rayleigh.has_value());
  EXPECT_EQ(*point.viscosity, 0.4);
  EXPECT_EQ(*point.conductivity, 0.3);
  EXPECT_EQ(point.bulk_viscosity, 0.125);
  EXPECT_EQ(point.density_mean, spam::DensityMean::arithmetic);
  EXPECT_EQ(*point.roll_velocity, 0.01);
  EXPECT_EQ(point.disorder, 0.2);
  EXPECT_EQ(point.step, 0.02);
  EXPECT_EQ(point.equilibration, 8.0);
  EXPECT_EQ(point.duration, 500.0);
  EXPECT_EQ(point.replicas, 3);
  EXPECT_EQ(point.seed, 9223372036854775807u);
  EXPECT_EQ(point.energy_tolerance, 1e-7);
  EXPECT_EQ(point.cells, 10);
  EXPECT_EQ(point.sample_interval, 0.5);
  EXPECT_EQ(point.frame_interval, 10.0);
}

TEST_F(BenardInputTest, ListsMultiplyWithTheRayleighNumbersInside) {
  const auto input = read(with(with(minimal, "= 5000", "= [5000, 10000]"), "duration = 100", "duration = [100, 50]") +
                          "[kernel]\nname = [\"lucy\", \"monaghan\"]\nrange = [2.5, 3]\n");
  ASSERT_EQ(input.points.size(), 8u);
  EXPECT_EQ(*input.points[1].rayleigh, 10000.0);
  EXPECT_EQ(input.points[1].duration, 50.0);
  EXPECT_EQ(input.points[2].range, 3.0);
  EXPECT_EQ(input.points[3].weight, kernel::WeightName::lucy);
  EXPECT_EQ(input.points[4].weight, kernel::WeightName::monaghan);
  EXPECT_EQ(read(minimal, {"system.particles=[200,800]"}).points[1].particles, 800);

  const std::string points =
      minimal + "[[point]]\nwall = \"boundary-particles\"\n[[point]]\nkernel.name = \"monaghan\"\n";
  EXPECT_EQ(read(points).points[0].wall, space::WallKind::boundary_particles);
  EXPECT_EQ(read(points).points[1].weight, kernel::WeightName::monaghan);
  EXPECT_EQ(read(points, {"kernel.range=2.5"}).points[1].range, 2.5);
  EXPECT_EQ(read(points, {"fluid.rayleigh=[1,2,3]"}).points.size(), 3u);  // which drops the tables
}

TEST_F(BenardInputTest, WhatCannotBeRunIsRefusedAtTheLineOfItsKey) {
  EXPECT_PRED2(starts_with, refusal(with(minimal, "= 200", "= 201")), "a.toml:2: system.particles = 201");
  EXPECT_PRED2(starts_with, refusal(minimal + "[cell]\nhot = 0.2\n"), "a.toml:8: cell.hot = 0.2 must be above");
  EXPECT_PRED2(starts_with, refusal(minimal, {"fluid.viscosity=1"}), "a.toml:4: fluid.rayleigh = 5000 leaves nothing");
  EXPECT_PRED2(starts_with, refusal(with(minimal, "rayleigh = 5000", "")), "a.toml: fluid.rayleigh is missing");
  EXPECT_PRED2(starts_with, refusal(minimal, {"run.step=2"}),
               "--set run.step=2: run.step = 2 must be a number above 0 and at most 1");
  EXPECT_PRED2(starts_with, refusal(minimal + "[kernel]\nrange = 8\n"), "a.toml:");
  EXPECT_PRED2(contains, refusal(minimal + "[kernel]\nname = \"cone\"\n"),
               "a.toml:8: kernel.name = \"cone\" must be one of \"lucy\", \"monaghan\"");
  EXPECT_PRED2(contains, refusal(minimal + "[kernel]\nname = []\n"), "or a list of such words, but is an empty list");
  EXPECT_PRED2(contains, refusal(minimal, {"cell.wall='glass'"}), "\"mirror-images\", \"boundary-particles\"");
  EXPECT_PRED2(contains, refusal(minimal, {"fluid.equation_of_state='isentropic'"}), "one of \"ideal-gas\"");
  EXPECT_EQ(refusal(minimal + "[grid]\ncells = 20\n"),
            "a.toml:7: unknown section [grid]; particles need none; [grid] belongs to an input of `lucy benard-grid`");
  EXPECT_PRED2(contains, refusal(minimal, {"fluid.transport='kinematic'"}), "`lucy benard-grid`");
}

TEST_F(BenardInputTest, TheResolvedTextGivesBackTheSameRows) {
  for (const std::string& text : {minimal, all_keys, with(minimal, "= 5000", "= [5000, 0.30000000000000004e5]"),
                                  with(minimal, "rayleigh = 5000", "viscosity = 0\nconductivity = 0.1"),
                                  minimal + "[[point]]\nseed = 2\n[[point]]\nequation_of_state = \"dense-fluid\"\n"}) {
    const BenardInput input = read(text);
    const std::string resolved = benard_resolved_toml(input);
    const BenardInput again = read(resolved);
    EXPECT_EQ(benard_resolved_toml(again), resolved);
    EXPECT_EQ(again.points.size(), input.points.size());
  }
}

TEST(ExplainBenard, SaysWhatIsItsOwn) {
  EXPECT_PRED2(contains, explain(benard_schema(), "cell.height"), "(particles/2)^(1/2) with periodic sides");
  EXPECT_PRED2(contains, explain(benard_schema(), "kernel.name"), "or a list of such words (lists multiply)");
}

TEST(BenardInput, EveryShippedFileIsSound) {
  const std::filesystem::path inputs = std::filesystem::path(LUCY_SOURCE_DIRECTORY) / "inputs";
  for (const char* name : {"ra5000", "ra10000", "ra40000", "square", "800", "van_der_waals_512", "van_der_waals_5000",
                           "freezing", "pairing", "walls", "quick"})
    EXPECT_NO_THROW(read_benard(inputs / (std::string("benard_") + name + ".toml"))) << name;
}

}  // namespace
}  // namespace lucy::files
