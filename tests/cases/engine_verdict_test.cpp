// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines of a verdict: what agrees, what differs, what is only shown.
#include "lucy/cases/engine_verdict.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <utility>
#include <vector>

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
}

TEST(EngineVerdict, AForceThatIsNoNumberOrIsMissingIsSeen) {
  const PointSums right = evaluate(kernel::Lucy<2>(3.0), lattice_frame(0.0));
  const PointAllowance allowed = {1e-10, 1e-10, 1e-10, 1e-10, 1e-10};
  for (const auto& line : compare_points("p", right, right, allowed)) EXPECT_TRUE(line.agrees());
  for (const std::size_t which : {std::size_t{0}, std::size_t{17}, right.forces.size() - 1}) {
    PointSums wrong = right;
    wrong.forces[which] = nan;
    EXPECT_FALSE(compare_points("p", right, wrong, allowed)[1].agrees());
    EXPECT_FALSE(compare_points("p", wrong, right, allowed)[1].agrees());
  }
  for (const std::size_t which : {0u, 1u, 2u}) {
    PointSums wrong = right;
    wrong.potential[which] = nan;
    EXPECT_FALSE(compare_points("p", right, wrong, allowed)[4].agrees());
  }
  PointSums shorter = right;
  shorter.forces.pop_back();
  EXPECT_FALSE(compare_points("p", right, shorter, allowed)[1].agrees());
  EXPECT_FALSE(compare_points("p", right, shorter, allowed)[2].agrees());
}

TEST(EngineVerdict, FourStandardErrorsAreTheLimit) {
  const statistics::Estimate ours = {1.0, 0.3, 100.0, 50};
  const auto line = [&](double value) { return compare_estimates("p", "q", ours, {value, 0.4, 100.0, 50}, 2.0); };
  EXPECT_NEAR(line(2.9).difference, 3.8, 1e-12);
  EXPECT_TRUE(line(2.9).agrees());
  EXPECT_FALSE(line(3.1).agrees());
  EXPECT_FALSE(line(-1.1).agrees());
}

TEST(EngineVerdict, WhatHasNoErrorBarDoesNotAgree) {
  const VerdictLine line = compare_estimates("p", "q", {1.0, nan, nan, 0}, {1.0, 0.1, 100.0, 50}, 1.0);
  EXPECT_TRUE(line.judged);
  EXPECT_FALSE(line.agrees());
}

TEST(EngineVerdict, WhatIsTooUncertainDoesNotAgree) {
  const statistics::Estimate ours = {1.0, 0.3, 100.0, 50};
  EXPECT_TRUE(compare_estimates("p", "q", ours, {1.0, 0.4, 100.0, 50}, 2.0).agrees());
  EXPECT_FALSE(compare_estimates("p", "q", ours, {1.0, 0.4, 100.0, 50}, 1.9).agrees());
}

TEST(EngineVerdict, ASmallPartOfThePressureIsHeldAgainstBothParts) {
  TableRow row;
  const auto set = [&](std::string_view name, double value, double error) {
    const auto place = static_cast<std::size_t>(std::ranges::find(quantities, name) - quantities.begin());
    row.estimates[place] = {value, error, 100.0, 50};
  };
  set("pxy_kinetic", -0.3, 0.001);
  set("pxy_potential", 0.001, 0.001);
  set("kinetic_temperature", 0.001, 0.001);
  constexpr std::array<std::string_view, 3> names = {"pxy_kinetic", "pxy_potential", "kinetic_temperature"};
  const auto lines = compare_rows("p", row, row, names);
  EXPECT_TRUE(lines[0].agrees());
  EXPECT_TRUE(lines[1].agrees());
  EXPECT_FALSE(lines[2].agrees());
}

/// A stress with a relaxation time of two, and kT = 1: an Ornstein-Uhlenbeck process, sampled.
CouetteRecord noisy_stress(double size, unsigned seed) {
  constexpr double interval = 0.2;
  const double memory = std::exp(-interval / 2.0);
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  CouetteRecord record;
  record.sample_interval = interval;
  double shear = 0.0;
  double difference = 0.0;
  for (int i = 0; i < 50000; ++i) {
    shear = memory * shear + size * std::sqrt(1.0 - memory * memory) * normal(generator);
    difference = memory * difference + size * std::sqrt(1.0 - memory * memory) * normal(generator);
    Sample sample{};
    sample[2] = shear;       // pxy, kinetic
    sample[4] = difference;  // pxx; pyy is opposite
    sample[6] = -difference;
    record.samples.push_back(sample);
  }
  return record;
}

TEST(EngineVerdict, StressesOfTheSameSizeAgreeInTheirAutocorrelationAndOthersDoNot) {
  CouettePoint point;
  point.particles = 100;
  TableRow row;
  row.estimates[quantity("kinetic_temperature")] = {1.0, 0.001, 100.0, 50};
  const CouetteRecord ours = noisy_stress(0.1, 1);
  const auto same = compare_green_kubo(point, ours, row, noisy_stress(0.1, 2), row);
  ASSERT_EQ(same.size(), 3u);
  for (const VerdictLine& line : same) EXPECT_TRUE(line.agrees()) << line.quantity << ' ' << line.difference;
  EXPECT_NEAR(same[0].lucy, 100.0 * 0.01 * 2.0 * (1.0 - std::exp(-2.5)), 4.0 * same[0].lucy_error);
  EXPECT_LT(same[0].lucy_error, 0.1 * same[0].lucy);
  for (const VerdictLine& line : compare_green_kubo(point, ours, row, noisy_stress(0.13, 3), row))
    EXPECT_FALSE(line.agrees()) << line.quantity << ' ' << line.difference;
}

TEST(EngineVerdict, HeatIsJudgedByTheWorseEngine) {
  EXPECT_TRUE(compare_heat("p", "heat", 0.9999, 1.0001).agrees());
  EXPECT_FALSE(compare_heat("p", "heat", 0.9, 1.0001).agrees());
  EXPECT_FALSE(compare_heat("p", "heat", 0.9999, 1.1).agrees());
  EXPECT_FALSE(compare_heat("p", "heat", nan, 1.0).agrees());
  EXPECT_FALSE(compare_heat("p", "heat", 1.0, nan).agrees());
  EXPECT_TRUE(compare_heat("p", "heat", std::nullopt, 1.0001).agrees());
}

TEST(EngineVerdict, HeatAndTheChangeOfEnergyMakeUpTheWork) {
  CouettePoint point;
  point.particles = 50;
  point.density = 2.0;
  point.strain_rate = 0.5;
  point.equilibration = 1.0;
  EngineSeries series;
  double heat = 3.0;
  for (int i = 0; i <= 40; ++i) {
    const double time = 0.25 * i;
    Sample sample{};
    sample[2] = -0.2 - 0.01 * time;  // straight: trapezoids are exact
    sample[3] = -0.1;
    series.time.push_back(time);
    series.instants.push_back(sample);
    const double work = 0.5 * 25.0 * (0.3 * time + 0.005 * time * time);
    series.energy.push_back(0.125 * work);
    series.heat.push_back(heat + 0.875 * work);
  }
  EXPECT_NEAR(heat_over_work(point, series), 1.0, 1e-12);
  for (double& value : series.heat) value *= 2.0;  // a thermostat that counts twice
  EXPECT_NEAR(heat_over_work(point, series), 1.875, 1e-12);
  series.time.resize(4);  // nothing after the equilibration
  EXPECT_TRUE(std::isnan(heat_over_work(point, series)));
}

/// Two particles, one of which drifts away as `size` exp(`growth` t).
std::vector<Frame> drifting(double size, double growth) {
  std::vector<Frame> frames;
  for (int i = 0; i <= 30; ++i) {
    Frame frame;
    frame.box = {10.0, 10.0};
    frame.position = {5.0, 5.0, 2.0 + size * std::exp(growth * i), 2.0};
    frames.push_back(frame);
  }
  return frames;
}

TEST(EngineVerdict, TrajectoriesMustPartWhenTheIntegratorsDoAndNotBefore) {
  const auto runge_kutta = drifting(0.0, 0.0);
  const auto verlet = drifting(1e-6, 1.0);
  const auto judged = [&](const std::vector<Frame>& other) {
    const auto lines = compare_trajectories("p", {1.0, runge_kutta, verlet, other}, 0.01);
    EXPECT_EQ(lines.size(), 2u);
    return std::pair(lines[0].agrees(), lines[1].agrees());
  };
  EXPECT_EQ(judged(verlet), std::pair(true, true));
  EXPECT_EQ(judged(drifting(1.3e-6, 1.0)), std::pair(false, false));  // another start
  EXPECT_EQ(judged(runge_kutta), std::pair(false, false));            // no Verlet: parts from it at once
  auto late = verlet;
  for (std::size_t i = 12; i < late.size(); ++i) late[i].position[2] += 1.0;  // at 11, with Verlet till then
  EXPECT_EQ(judged(late), std::pair(true, false));
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
