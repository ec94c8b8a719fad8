// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keys that inputs share, and where each has to arrive.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "lucy/cases/fluid_settings.hpp"

namespace lucy::files::testing {

/// The keys of [run] that all inputs have; its heading is to stand in front.
inline const std::string run_keys = R"(step = 0.02
equilibration = 7
duration = 500
replicas = 3
seed = 9223372036854775807
energy_tolerance = 1e-7
threads = 5
checkpoint_interval = 2.5
)";

template <class Input>
void expect_run_keys(const Input& input) {
  EXPECT_EQ(input.threads, 5);
  EXPECT_EQ(input.checkpoint_interval, 2.5);
  ASSERT_EQ(input.points.size(), 1u);
  const auto& point = input.points.front();
  EXPECT_EQ(point.step, 0.02);
  EXPECT_EQ(point.equilibration, 7.0);
  EXPECT_EQ(point.duration, 500.0);
  EXPECT_EQ(point.replicas, 3);
  EXPECT_EQ(point.seed, 9223372036854775807u);
  EXPECT_EQ(point.energy_tolerance, 1e-7);
}

/// Sections [kernel], [fluid] and [start].
inline const std::string fluid_sections = R"([kernel]
name = "monaghan"
range = 2.5
[fluid]
equation_of_state = "van-der-waals"
temperature = 1.5
viscosity = 0.25
bulk_viscosity = 0.125
conductivity = 0.75
density_mean = "arithmetic"
[start]
disorder = 0.2
noise = 0.01
uniform = "temperature"
)";

inline void expect_fluid_sections(const cases::FluidSettings& settings) {
  EXPECT_EQ(settings.weight, kernel::WeightName::monaghan);
  EXPECT_EQ(settings.range, 2.5);
  EXPECT_EQ(settings.equation_of_state, spam::EquationOfStateName::van_der_waals);
  EXPECT_EQ(settings.temperature, 1.5);
  EXPECT_EQ(settings.viscosity, 0.25);
  EXPECT_EQ(settings.bulk_viscosity, 0.125);
  EXPECT_EQ(settings.conductivity, 0.75);
  EXPECT_EQ(settings.density_mean, spam::DensityMean::arithmetic);
  EXPECT_EQ(settings.disorder, 0.2);
  EXPECT_EQ(settings.noise, 0.01);
  EXPECT_EQ(settings.uniform, cases::UniformStart::temperature);
}

}  // namespace lucy::files::testing
