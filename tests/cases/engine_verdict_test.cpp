// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines of a verdict: what agrees, what differs, what is only shown.
#include "lucy/cases/engine_verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lucy/motion/start.hpp"

namespace lucy::cases {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Frame lattice_frame(double offset) {
  const auto start = motion::lattice_start(kernel::Lucy<2>(3.0), 64, 1.0, 1.0, 5);
  Frame frame;
  frame.box = start.lengths;
  frame.offset = offset;
  for (std::size_t i = 0; i < start.position.size(); ++i)
    for (std::size_t d = 0; d < 2; ++d) {
      frame.position.push_back(start.position[i][d]);
      frame.momentum.push_back(start.momentum[i][d]);
    }
  return frame;
}

/// Every pair with all its images, by brute force.
PointSums slow_sums(const Frame& frame) {
  const kernel::Lucy<2> kernel(3.0);
  PointSums sums;
  const double volume = frame.box[0] * frame.box[1];
  const std::size_t count = frame.position.size();
  sums.forces.assign(count, 0.0);
  for (std::size_t i = 0; i < count; i += 2) {
    sums.kinetic[0] += frame.momentum[i] * frame.momentum[i] / volume;
    sums.kinetic[1] += frame.momentum[i + 1] * frame.momentum[i + 1] / volume;
    sums.kinetic[2] += frame.momentum[i] * frame.momentum[i + 1] / volume;
    for (std::size_t j = 0; j < count; j += 2)
      for (int above = -1; above <= 1; ++above)
        for (int beside = -2; beside <= 2; ++beside) {
          const double x = frame.position[i] - frame.position[j] - beside * frame.box[0] - above * frame.offset;
          const double y = frame.position[i + 1] - frame.position[j + 1] - above * frame.box[1];
          const double r = std::hypot(x, y);
          if (i == j || r >= 3.0) continue;
          const double slope = kernel.slope(r);
          sums.potential_energy += 0.5 * kernel.weight(r);
          sums.forces[i] += slope * x;
          sums.forces[i + 1] += slope * y;
          sums.potential[0] += 0.5 * slope * x * x / volume;
          sums.potential[1] += 0.5 * slope * y * y / volume;
          sums.potential[2] += 0.5 * slope * x * y / volume;
        }
  }
  return sums;
}

TEST(EngineVerdict, EvaluatesATiltedConfigurationAsBruteForceDoes) {
  for (const double offset : {0.0, 2.7, 6.1}) {
    const Frame frame = lattice_frame(offset);
    const PointAllowance rounding = {1e-12, 1e-12, 1e-12, 1e-12, 1e-12};
    for (const VerdictLine& line :
         compare_points("p", evaluate(kernel::Lucy<2>(3.0), frame), slow_sums(frame), rounding))
      EXPECT_TRUE(line.agrees()) << offset << ' ' << line.quantity << ' ' << line.difference;
  }
}

TEST(EngineVerdict, OneForceThatIsOffIsSeen) {
  const Frame frame = lattice_frame(0.0);
  const PointSums right = evaluate(kernel::Lucy<2>(3.0), frame);
  PointSums wrong = right;
  wrong.forces[17] += 1e-9;
  const PointAllowance allowed = {1e-10, 1e-10, 1e-10, 1e-10, 1e-10};
  const auto lines = compare_points("p", right, wrong, allowed);
  EXPECT_FALSE(lines[1].agrees());
  wrong.forces.pop_back();
  EXPECT_FALSE(compare_points("p", right, wrong, allowed)[1].agrees());
}

TEST(EngineVerdict, FourStandardErrorsAreTheLimit) {
  const statistics::Estimate ours = {1.0, 0.3, 100.0, 50};
  const auto line = [&](double value) { return compare_estimates("p", "q", ours, {value, 0.4, 100.0, 50}); };
  EXPECT_NEAR(line(2.9).difference, 3.8, 1e-12);
  EXPECT_TRUE(line(2.9).agrees());
  EXPECT_FALSE(line(3.1).agrees());
  EXPECT_FALSE(line(-1.1).agrees());
}

TEST(EngineVerdict, WhatHasNoErrorBarDoesNotAgree) {
  const VerdictLine line = compare_estimates("p", "q", {1.0, nan, nan, 0}, {1.0, 0.1, 100.0, 50});
  EXPECT_TRUE(line.judged);
  EXPECT_FALSE(line.agrees());
}

TEST(EngineVerdict, ADifferenceThatIsNotKnownDiffers) {
  VerdictLine line = {"p", "q"};
  line.difference = nan;
  line.allowed = 1.0;
  EXPECT_FALSE(line.agrees());
}

TEST(EngineVerdict, DistancesAreThoseOfNearestImages) {
  Frame a;
  a.box = {10.0, 10.0};
  a.offset = 3.0;
  a.position = {5.0, 9.9, 9.9, 5.0};
  Frame b = a;
  b.position = {2.3, 0.2, 0.1, 5.0};  // the image above of the first: 5.3, 10.2
  EXPECT_NEAR(separation(a, b), std::sqrt((0.09 + 0.09 + 0.04) / 2.0), 1e-12);
}

TEST(EngineVerdict, PartingIsFoundBetweenEntriesThatGrowExponentially) {
  EXPECT_NEAR(parting_time(std::vector{1e-6, 1e-4, 1e-2, 1.0}, 2.0, 1e-3), 3.0, 1e-12);
  EXPECT_EQ(parting_time(std::vector{1e-6, 1e-4}, 2.0, 1e-3), 4.0);
  EXPECT_EQ(parting_time(std::vector{0.0, 0.1}, 2.0, 1e-3), 2.0);
}

}  // namespace
}  // namespace lucy::cases
