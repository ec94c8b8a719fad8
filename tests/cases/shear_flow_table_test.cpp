// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows from made-up records, whose means and errors are known.
#include "lucy/cases/shear_flow_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace lucy::cases {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

ShearFlowPoint sheared() {
  ShearFlowPoint p;
  p.particles = 64;
  p.viscosity = 0.5;
  p.conductivity = 0.5;
  p.strain_rate = 0.1;
  p.duration = 400.0;
  return p;
}

ShearFlowSample plain_sample() {
  ShearFlowSample sample;
  sample.averages[shear_flow_average("kinetic_temperature")] = 0.02;
  sample.averages[shear_flow_average("internal_energy")] = 0.98;
  sample.averages[shear_flow_average("pxy_carried")] = -0.005;
  sample.averages[shear_flow_average("pxy_pressure")] = -0.004;
  sample.averages[shear_flow_average("pxy_newtonian")] = -0.049;
  sample.averages[shear_flow_average("work")] = 0.0058;
  sample.instants.fill(0.1);
  sample.instants[shear_flow_instant("entropy_viscosity")] = 0.005;
  sample.instants[shear_flow_instant("entropy_conduction")] = 0.001;
  sample.instants[shear_flow_instant("entropy_removed")] = 0.0055;
  return sample;
}

/// White noise of that size on the stress that particles carry.
ShearFlowRecord record(double noise, unsigned seed, std::size_t samples = 400) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  ShearFlowRecord result;
  result.sample_interval = 1.0;
  for (std::size_t i = 0; i < samples; ++i) {
    result.samples.push_back(plain_sample());
    result.samples.back().averages[shear_flow_average("pxy_carried")] += noise * normal(generator);
  }
  result.steps = static_cast<std::int64_t>(samples);
  return result;
}

TEST(ShearFlowTable, ViscositiesAreStressesOverTheRate) {
  const ShearFlowRecord one = record(0.0, 1);
  const ShearFlowRow row = summarize(sheared(), std::span(&one, 1));
  EXPECT_EQ(row.status, RowStatus::ok);
  EXPECT_NEAR(row[shear_flow_quantity("viscosity")].value, 0.58, 1e-12);
  EXPECT_NEAR(row[shear_flow_quantity("viscosity_excess")].value, 0.08, 1e-12);
  EXPECT_NEAR(row[shear_flow_quantity("viscosity_carried")].value, 0.05, 1e-12);
  EXPECT_NEAR(row[shear_flow_quantity("viscosity_pressure")].value, 0.04, 1e-12);
  EXPECT_NEAR(row[shear_flow_quantity("viscosity_newtonian")].value, 0.49, 1e-12);
  EXPECT_NEAR(row[shear_flow_quantity("entropy_surplus")].value, 0.0005, 1e-15);
  EXPECT_NEAR(row[shear_flow_quantity("kinetic_temperature")].value, 0.02, 1e-15);
  EXPECT_NEAR(row[shear_flow_quantity("least_entropy_production")].value, 0.1, 1e-15);
  EXPECT_EQ(row[shear_flow_quantity("viscosity")].error, 0.0);
  EXPECT_TRUE(row.warnings.empty());
  EXPECT_EQ(row.duration, 400.0);
}

TEST(ShearFlowTable, ANegativeRateHasTheSameViscosity) {
  ShearFlowPoint p = sheared();
  p.strain_rate = -0.1;
  ShearFlowRecord one = record(0.0, 1);
  for (auto& sample : one.samples)
    for (const auto place :
         {shear_flow_average("pxy_carried"), shear_flow_average("pxy_pressure"), shear_flow_average("pxy_newtonian")})
      sample.averages[place] *= -1.0;
  EXPECT_NEAR(summarize(p, std::span(&one, 1))[shear_flow_quantity("viscosity")].value, 0.58, 1e-12);
}

TEST(ShearFlowTable, ErrorsAreThoseOfTheNoise) {
  const std::vector<ShearFlowRecord> records = {record(0.01, 1), record(0.01, 2)};
  const ShearFlowRow row = summarize(sheared(), records);
  const auto& viscosity = row[shear_flow_quantity("viscosity")];
  EXPECT_NEAR(viscosity.value, 0.58, 4.0 * viscosity.error);
  EXPECT_NEAR(viscosity.error, 0.1 / std::sqrt(800.0), 0.2 * 0.1 / std::sqrt(800.0));
  EXPECT_NEAR(row[shear_flow_quantity("viscosity_carried")].error, viscosity.error, 1e-12);
  EXPECT_EQ(row[shear_flow_quantity("viscosity_newtonian")].error, 0.0);
  EXPECT_GT(row.effective_samples, 500.0);
  const auto current = current_viscosity(sheared(), records);
  EXPECT_EQ(current.value, viscosity.value);
  EXPECT_EQ(current.error, viscosity.error);
}

TEST(ShearFlowTable, ARisingTemperatureIsCutAway) {
  ShearFlowRecord one = record(0.001, 1);
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal(0.0, 0.001);
  for (std::size_t i = 0; i < one.samples.size(); ++i)
    one.samples[i].averages[shear_flow_average("kinetic_temperature")] =
        0.02 - 0.02 * std::exp(-static_cast<double>(i) / 20.0) + normal(generator);
  const ShearFlowRow row = summarize(sheared(), std::span(&one, 1));
  EXPECT_GT(row.equilibration_discarded, 20.0);
  EXPECT_LE(row.equilibration_discarded, 200.0);
  const auto& temperature = row[shear_flow_quantity("kinetic_temperature")];
  EXPECT_NEAR(temperature.value, 0.02, 4.0 * temperature.error);
}

TEST(ShearFlowTable, WhatHasNoMeaningDoesNotMakeARowShort) {
  ShearFlowPoint p = sheared();
  p.equation_of_state = spam::EquationOfStateName::isentropic;
  p.viscosity = p.conductivity = 0.0;
  ShearFlowRecord one = record(0.01, 1);
  for (auto& sample : one.samples) {
    sample.instants.fill(unknown);
    sample.instants[shear_flow_instant("pressure")] = 0.5;
    sample.instants[shear_flow_instant("density_wave")] = 0.01;
  }
  const ShearFlowRow row = summarize(p, std::span(&one, 1));
  EXPECT_EQ(row.status, RowStatus::ok);
  for (const auto quantity : {shear_flow_quantity("temperature"), shear_flow_quantity("entropy_surplus"),
                              shear_flow_quantity("velocity_gradient")})
    EXPECT_TRUE(std::isnan(row[quantity].value));
  EXPECT_NEAR(row[shear_flow_quantity("pressure")].value, 0.5, 1e-12);
}

TEST(ShearFlowTable, TooFewSamplesAreShort) {
  const ShearFlowRecord one = record(0.01, 1, 3);
  const ShearFlowRow row = summarize(sheared(), std::span(&one, 1));
  EXPECT_EQ(row.status, RowStatus::too_short);
  EXPECT_TRUE(std::isfinite(row[shear_flow_quantity("viscosity")].value));
  EXPECT_TRUE(std::isnan(row[shear_flow_quantity("viscosity")].error));
  EXPECT_EQ(row.duration, 3.0);
}

TEST(ShearFlowTable, WithoutCoolingNothingHasAnError) {
  ShearFlowPoint p = sheared();
  p.cooling = motion::Cooling::none;
  const ShearFlowRecord one = record(0.01, 1);
  const ShearFlowRow row = summarize(p, std::span(&one, 1));
  EXPECT_EQ(row.status, RowStatus::too_short);
  for (const auto& estimate : row.estimates) EXPECT_TRUE(std::isnan(estimate.error));
  EXPECT_TRUE(std::isnan(row.effective_samples));
  EXPECT_TRUE(row.warnings.empty());
}

TEST(ShearFlowTable, BandsAndReplicasThatDisagreeAreWarnedOf) {
  std::vector<ShearFlowRecord> records = {record(0.01, 1), record(0.01, 2)};
  for (auto& sample : records[0].samples) sample.averages[shear_flow_average("pxy_carried")] -= 0.02;
  for (auto& each : records)
    for (auto& sample : each.samples) sample.instants[shear_flow_instant("density_wave")] = 0.4;
  const ShearFlowRow row = summarize(sheared(), records);
  ASSERT_EQ(row.warnings.size(), 2U);
  EXPECT_NE(row.warnings[0].find("fallen into bands"), std::string::npos);
  EXPECT_NE(row.warnings[0].find("density_wave 0.40"), std::string::npos);
  EXPECT_NE(row.warnings[1].find("replicas differ"), std::string::npos);
}

TEST(ShearFlowTable, ReplicasOfALatticeAtRestCountOnce) {
  const std::vector<ShearFlowRecord> records = {record(0.01, 1), record(0.01, 1)};
  ShearFlowPoint lattice = sheared();
  lattice.disorder = lattice.noise = 0.0;
  const ShearFlowRow row = summarize(lattice, records);
  const ShearFlowRow alone = summarize(lattice, std::span(records).first(1));
  EXPECT_EQ(row[shear_flow_quantity("viscosity")].error, alone[shear_flow_quantity("viscosity")].error);
  ASSERT_EQ(row.warnings.size(), 1U);
  EXPECT_NE(row.warnings[0].find("all replicas are the same"), std::string::npos) << row.warnings[0];
}

TEST(ShearFlowTable, AFlowThatStillHeatsUpIsWarnedOf) {
  ShearFlowRecord one = record(0.01, 5);
  std::mt19937_64 generator(6);
  std::normal_distribution<double> normal;
  const auto with_removed = [&](double removed) {
    for (ShearFlowSample& sample : one.samples) {
      sample.averages[shear_flow_average("heating")] = 0.0058 + 0.0005 * normal(generator);
      sample.averages[shear_flow_average("heat_removed")] = removed + 0.0005 * normal(generator);
    }
    return summarize(sheared(), std::span(&one, 1)).warnings;
  };
  EXPECT_TRUE(with_removed(0.0058).empty());
  const auto warnings = with_removed(0.0050);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("not steady"), std::string::npos) << warnings[0];
}

TEST(ShearFlowTable, AddsUpWhatTheWatchSaw) {
  std::vector<ShearFlowRecord> records = {record(0.01, 1), record(0.01, 2)};
  records[0].worst_energy_error = 1e-8;
  records[1].worst_energy_error = 3e-8;
  records[0].energy_drift = -5e-6;
  records[1].energy_drift = 2e-6;
  records[0].subdivided_steps = 3;
  records[1].subdivided_steps = 4;
  const ShearFlowRow row = summarize(sheared(), records);
  EXPECT_EQ(row.worst_energy_error, 3e-8);
  EXPECT_EQ(row.energy_drift, -5e-6);
  EXPECT_EQ(row.subdivided_steps, 7);
}

TEST(ShearFlowTable, AFailedRowKnowsNothingButWhy) {
  const ShearFlowRow row = failed_row(sheared(), "at time 3, something broke");
  EXPECT_EQ(row.status, RowStatus::failed);
  EXPECT_EQ(row.failure, "at time 3, something broke");
  EXPECT_EQ(row.settings.strain_rate, 0.1);
  for (const auto& estimate : row.estimates) EXPECT_TRUE(std::isnan(estimate.value));
  EXPECT_TRUE(std::isnan(row.energy_drift));
  EXPECT_TRUE(std::isnan(current_viscosity(sheared(), {}).value));
}

}  // namespace
}  // namespace lucy::cases
