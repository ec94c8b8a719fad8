// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/benard.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "lucy/cases/benard_table.hpp"
#include "lucy/errors.hpp"

namespace lucy::cases {
namespace {

/// 200 particles, twice as wide as high.
BenardPoint small_cell() {
  BenardPoint point;
  point.particles = 200;
  point.viscosity = 0.3;
  point.conductivity = 0.3;
  point.step = 0.25;
  point.equilibration = 20.0;
  point.duration = 40.0;
  point.cells = 10;
  return point;
}

BenardRecord record_of(const BenardPoint& point, int replica = 0) {
  BenardRun run(point, replica, 1);
  while (run.intervals_done() < interval_count(point)) run.advance_one_interval();
  return run.record();
}

double mean_of(const BenardRecord& record, std::size_t average) {
  double sum = 0.0;
  for (const BenardSample& sample : record.samples) sum += sample.averages[average];
  return sum / static_cast<double>(record.samples.size());
}

TEST(Benard, TheCellIsAsLargeAsItsParticlesAskFor) {
  const BenardPoint periodic = resolved(small_cell());
  EXPECT_DOUBLE_EQ(periodic.height, 10.0);
  EXPECT_DOUBLE_EQ(*periodic.width, 20.0);
  BenardPoint square = small_cell();
  square.particles = 1600;
  square.sides = grid::Sides::walls;
  EXPECT_DOUBLE_EQ(resolved(square).height, 40.0);
  EXPECT_DOUBLE_EQ(*resolved(square).width, 40.0);
}

TEST(Benard, CoefficientsFollowFromTheRayleighNumberAsPublished) {
  BenardPoint point = small_cell();
  point.particles = 5000;
  point.viscosity.reset();
  point.conductivity.reset();
  const auto viscosity_at = [&](double rayleigh) {
    point.rayleigh = rayleigh;
    return *resolved(point).viscosity;
  };
  EXPECT_NEAR(viscosity_at(5000.0), 0.70711, 1e-5);
  EXPECT_NEAR(viscosity_at(10000.0), 0.5, 1e-12);
  EXPECT_NEAR(viscosity_at(40000.0), 0.25, 1e-12);
  point.equation_of_state = spam::EquationOfStateName::van_der_waals;
  EXPECT_NEAR(viscosity_at(5000.0), 0.8165, 1e-4);
  EXPECT_NEAR(viscosity_at(10000.0), 0.5774, 1e-4);
}

TEST(Benard, TheStartHasTheKineticEnergyOfItsRolls) {
  // Mean squares of the patterns' factors are one half each: K/N = A^2/4.
  BenardPoint point = small_cell();
  point.particles = 1800;
  const BenardRun run(point, 0, 1);
  EXPECT_NEAR(run.trajectory().kinetic().kinetic_energy() / 1800.0, 0.085 * 0.085 / 4.0, 1e-12);
}

TEST(Benard, WhatWallsGiveIsWhatTheFluidStores) {
  // The power of the walls is averaged over steps, what is stored is exact: they differ by the error of the average.
  BenardPoint point = small_cell();
  const auto imbalance = [](const BenardRecord& record) {
    return mean_of(record, benard_average("conduction_hot")) + mean_of(record, benard_average("work_hot")) +
           mean_of(record, benard_average("conduction_cold")) + mean_of(record, benard_average("work_cold")) +
           mean_of(record, benard_average("conduction_sides")) + mean_of(record, benard_average("work_sides")) -
           mean_of(record, benard_average("stored"));
  };
  for (const auto sides : {grid::Sides::periodic, grid::Sides::walls}) {
    for (const auto wall : {space::WallKind::mirror_images, space::WallKind::boundary_particles}) {
      point.sides = sides;
      point.particles = sides == grid::Sides::walls ? 144 : 200;
      point.wall = wall;
      point.step = 0.05;
      const BenardRecord record = record_of(point);
      ASSERT_EQ(record.failure, "");
      const double stored = std::abs(mean_of(record, benard_average("stored")));
      EXPECT_GT(stored, 0.01);
      EXPECT_LT(std::abs(imbalance(record)), 0.05 * stored);
    }
  }
}

TEST(Benard, GoesOnFromASavedStateWithTheSameBits) {
  const BenardPoint point = small_cell();
  BenardRun straight(point, 0, 1);
  for (int interval = 0; interval < 12; ++interval) straight.advance_one_interval();
  ArchiveWriter saved;
  straight.save(saved);
  BenardRun loaded(point, 0, 2);
  ArchiveReader archive(saved.bytes());
  loaded.load(archive);
  EXPECT_TRUE(archive.exhausted());
  while (straight.intervals_done() < interval_count(point)) {
    straight.advance_one_interval();
    loaded.advance_one_interval();
  }
  EXPECT_EQ(straight.trajectory().positions(), loaded.trajectory().positions());
  EXPECT_EQ(straight.last().velocity_smoothed, loaded.last().velocity_smoothed);
  ASSERT_EQ(straight.record().samples.size(), loaded.record().samples.size());
  for (std::size_t i = 0; i < straight.record().samples.size(); ++i) {
    EXPECT_EQ(straight.record().samples[i].averages, loaded.record().samples[i].averages);
    EXPECT_EQ(straight.record().samples[i].instants, loaded.record().samples[i].instants);
  }
  EXPECT_EQ(straight.record().blocks.back().column, loaded.record().blocks.back().column);
}

TEST(Benard, ARunThatFailsKeepsWhatItHadAndSaysWhenAndWhy) {
  BenardPoint point = small_cell();
  point.viscosity = 0.02;
  point.conductivity = 20.0;  // diffuses farther than the spacing in one step
  point.step = 1.0;
  point.energy_tolerance = 1e9;
  point.sample_interval = 1.0;
  const BenardRecord record = record_of(point);
  EXPECT_NE(record.failure.find("at time"), std::string::npos) << record.failure;
  EXPECT_NE(record.failure.find("particle"), std::string::npos) << record.failure;
  EXPECT_LT(record.samples.size(), static_cast<std::size_t>(interval_count(point)));
  const BenardRow row = summarize(point, {&record, 1});
  EXPECT_EQ(row.status, RowStatus::failed);
  EXPECT_EQ(row.failure, record.failure);
}

TEST(Benard, AveragesBeginAfterTheEquilibration) {
  BenardPoint point = small_cell();
  const BenardRecord record = record_of(point);
  const BenardRow row = summarize(point, {&record, 1});
  EXPECT_DOUBLE_EQ(row.duration, 40.0);
  EXPECT_EQ(record.samples.size(), static_cast<std::size_t>(interval_count(point)));
  double samples = 0.0;
  for (const double count : record.block_samples) samples += count;
  EXPECT_EQ(samples, static_cast<double>(interval_count(point) - equilibration_intervals(point)));
  // Three ways to look at one motion: smoothing takes out, averaging over time even more.
  EXPECT_LT(row[benard_quantity("kinetic_energy_smoothed")].value, row[benard_quantity("kinetic_energy_total")].value);
  EXPECT_LT(row[benard_quantity("kinetic_energy_field")].value, row[benard_quantity("kinetic_energy_smoothed")].value);
  EXPECT_GT(row[benard_quantity("kinetic_energy_field")].value, 0.0);
}

TEST(Benard, KineticEnergyOfAFlowWithoutNoiseIsTheSameAllThreeWays) {
  // At the start particles move with the rolls; smoothing and the grid's cells take out little of waves so long.
  BenardPoint point = small_cell();
  point.particles = 5000;
  point.cells = 30;
  point.step = 0.01;
  point.sample_interval = 0.01;
  point.equilibration = 0.0;
  point.duration = 0.01;
  const BenardRecord record = record_of(point);
  const BenardSample& sample = record.samples.front();
  const double total = sample.averages[benard_average("kinetic_energy_total")];
  EXPECT_NEAR(sample.instants[benard_instant("kinetic_energy_smoothed")], total, 0.03 * total);
  EXPECT_NEAR(kinetic_energy_of_mean_flow(averaged_moments(point, {&record, 1})), total, 0.03 * total);
  EXPECT_NEAR(sample.instants[benard_instant("roll_amplitude")], 0.085, 0.001);
}

TEST(Benard, RefusesWhatCannotBeRun) {
  const std::vector<std::pair<std::string, std::function<void(BenardPoint&)>>> refused = {
      {"system.particles", [](BenardPoint& p) { p.particles = 201; }},
      {"system.particles", [](BenardPoint& p) { p.height = 9.0; }},
      {"kernel.range", [](BenardPoint& p) { p.range = 4.0; }},
      {"cell.hot", [](BenardPoint& p) { p.hot = 0.4; }},
      {"cell.cold",
       [](BenardPoint& p) {
         p.equation_of_state = spam::EquationOfStateName::van_der_waals;
         p.cold = 0.2;
       }},
      {"fluid.rayleigh", [](BenardPoint& p) { p.viscosity.reset(); }},
      {"fluid.conductivity", [](BenardPoint& p) { p.conductivity = 0.0; }},
      {"run.step", [](BenardPoint& p) { p.step = 3.0; }},
      {"run.duration", [](BenardPoint& p) { p.duration = 0.0; }},
      {"output.cells", [](BenardPoint& p) { p.cells = 2; }},
      {"output.frame_interval", [](BenardPoint& p) { p.frame_interval = 0.3; }},
  };
  for (const auto& [key, spoil] : refused) {
    BenardPoint point = small_cell();
    spoil(point);
    try {
      validate(point);
      FAIL() << key;
    } catch (const BadInput& refusal) {
      EXPECT_NE(std::string(refusal.what()).find(key), std::string::npos) << refusal.what();
    }
  }
  EXPECT_NO_THROW(validate(small_cell()));
}

}  // namespace
}  // namespace lucy::cases
