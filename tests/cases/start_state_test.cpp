// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A flow in the velocities of a start that nobody has spoken of.
#include "lucy/cases/start_state.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "lucy/errors.hpp"

namespace lucy::cases {
namespace {

using ::testing::HasSubstr;

/// Particles of kT = 0.54 in a flow, at density one.
CouettePoint start_with_flow(int particles, double rate, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  const double length = std::sqrt(particles);
  std::uniform_real_distribution<double> place(0.0, length);
  std::normal_distribution<double> thermal(0.0, std::sqrt(0.54));
  Frame frame;
  frame.box = {length, length};
  for (int i = 0; i < particles; ++i) {
    const double y = place(generator);
    frame.position.push_back(place(generator));
    frame.position.push_back(y);
    frame.momentum.push_back(thermal(generator) + rate * y);
    frame.momentum.push_back(thermal(generator));
  }
  CouettePoint point;
  point.start = "sheared.dump";
  point.start_frame = std::make_shared<const Frame>(std::move(frame));
  return point;
}

TEST(StartState, AFlowInItsVelocitiesIsRefusedWithTheKeyThatTakesItOut) {
  for (const auto& [particles, rate] : {std::pair(144, 0.5), std::pair(144, -0.5), std::pair(1024, 0.05)}) {
    try {
      refuse_flow_in_start(start_with_flow(particles, rate, 5));
      FAIL() << particles << " " << rate;
    } catch (const BadInput& refusal) {
      EXPECT_THAT(refusal.what(), HasSubstr("sheared.dump"));
      EXPECT_THAT(refusal.what(), HasSubstr("system.start_strain_rate"));
    }
  }
}

TEST(StartState, ThermalVelocitiesHoldNoFlow) {
  for (std::uint64_t seed = 0; seed < 300; ++seed)
    EXPECT_NO_THROW(refuse_flow_in_start(start_with_flow(64, 0.0, seed)));
}

TEST(StartState, WithoutVelocitiesNothingIsSaidOfTheirFlow) {
  CouettePoint point = start_with_flow(64, 0.5, 1);
  Frame frame = *point.start_frame;
  frame.momentum.clear();
  point.start_frame = std::make_shared<const Frame>(std::move(frame));
  EXPECT_NO_THROW(refuse_flow_in_start(point));
}

}  // namespace
}  // namespace lucy::cases
