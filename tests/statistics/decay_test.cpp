// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/decay.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace lucy::statistics {
namespace {

struct Exponential {
  double amplitude, time;
};

std::vector<double> equal_times(double interval, int count) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) times.push_back(interval * i);
  return times;
}

/// As a correlator in levels gives them: sixteen lags, then eight at twice the spacing, and so on.
std::vector<double> stretched_times(double interval, double longest) {
  std::vector<double> times;
  for (double spacing = interval, time = 0.0; time <= longest; spacing *= 2.0) {
    const double end = 16.0 * spacing;
    for (; time < end && time <= longest; time += spacing) times.push_back(time);
  }
  return times;
}

std::vector<double> sum_of(const std::vector<Exponential>& parts, const std::vector<double>& times) {
  std::vector<double> values;
  for (const double time : times) {
    double value = 0.0;
    for (const Exponential& part : parts) value += part.amplitude * std::exp(-time / part.time);
    values.push_back(value);
  }
  return values;
}

TEST(Decay, FindsAnExponentialExactlyWhateverItsScales) {
  for (const double unit : {1e-3, 1.0, 1e4}) {
    const std::vector<double> times = equal_times(0.2 * unit, 600);
    const ExponentialDecay fit = fit_decay(times, sum_of({{7.0 / unit, 25.0 * unit}}, times));
    EXPECT_NEAR(fit.amplitude, 7.0 / unit, 1e-6 / unit);
    EXPECT_NEAR(fit.time, 25.0 * unit, 1e-5 * unit);
    EXPECT_NEAR(fit.points, 313, 1);
  }
}

TEST(Decay, LooksPastAFastPart) {
  const std::vector<double> times = equal_times(0.2, 1000);
  const ExponentialDecay fit = fit_decay(times, sum_of({{0.04, 13.0}, {0.05, 0.5}}, times));
  EXPECT_NEAR(fit.amplitude, 0.04, 1e-6);
  EXPECT_NEAR(fit.time, 13.0, 1e-3);
}

TEST(Decay, AgreesWithItsWindow) {
  const std::vector<double> times = equal_times(0.05, 8000);
  const std::vector<double> values = sum_of({{0.5, 25.0}, {0.5, 8.0}}, times);
  const ExponentialDecay fit = fit_decay(times, values);
  EXPECT_NEAR(fit.begin, decay_window_begin * fit.time, 1e-3 * fit.time);
  EXPECT_NEAR(fit.end, decay_window_end * fit.time, 1e-3 * fit.time);
  EXPECT_GT(fit.time, 15.0);
  EXPECT_LT(fit.time, 25.0);
  const ExponentialDecay again = fit_decay_in_window(times, values, fit.begin, fit.end);
  EXPECT_NEAR(again.time, fit.time, 1e-6 * fit.time);
  EXPECT_NEAR(again.amplitude, fit.amplitude, 1e-6 * fit.amplitude);
  EXPECT_EQ(again.points, fit.points);
}

TEST(Decay, HardlyDependsOnTheSpacingOfTheLags) {
  const std::vector<Exponential> parts = {{0.5, 25.0}, {0.5, 8.0}};
  const std::vector<double> equal = equal_times(0.1, 4001), stretched = stretched_times(0.1, 400.0);
  const double expected = fit_decay(equal, sum_of(parts, equal)).time;
  EXPECT_NEAR(fit_decay(stretched, sum_of(parts, stretched)).time, expected, 0.03 * expected);
}

TEST(Decay, FitsTheWindowThatIsAskedForAndNothingElse) {
  const std::vector<double> times = equal_times(0.2, 500);
  std::vector<double> values = sum_of({{2.0, 20.0}}, times);
  for (std::size_t i = 1; i < values.size(); ++i)
    if (times[i] < 10.0 || times[i] > 40.0) values[i] = 5.0;
  const ExponentialDecay fit = fit_decay_in_window(times, values, 10.0, 40.0);
  EXPECT_NEAR(fit.amplitude, 2.0, 1e-8);
  EXPECT_NEAR(fit.time, 20.0, 1e-7);
}

TEST(Decay, IsNotFoundWhereThereIsNone) {
  const std::vector<double> times = equal_times(1.0, 100);
  const auto time_of = [&](const std::vector<double>& values) { return fit_decay(times, values).time; };
  EXPECT_TRUE(std::isnan(time_of(std::vector<double>(100, 1.0))));
  EXPECT_TRUE(std::isnan(time_of(std::vector<double>(100, 0.0))));
  EXPECT_TRUE(std::isnan(time_of(sum_of({{-1.0, 10.0}}, times))));
  EXPECT_TRUE(std::isnan(time_of(sum_of({{1.0, -10.0}}, times))));
  EXPECT_TRUE(std::isnan(time_of(sum_of({{1.0, 34.0}}, times)))) << "its window ends beyond the last lag";
  EXPECT_NEAR(time_of(sum_of({{1.0, 32.0}}, times)), 32.0, 1e-4);
  EXPECT_TRUE(std::isnan(time_of(sum_of({{1.0, 0.5}}, times)))) << "too few lags in its window";
  std::vector<double> broken = sum_of({{1.0, 10.0}}, times);
  broken[99] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(time_of(broken)));
  EXPECT_TRUE(std::isnan(fit_decay({}, {}).time));
  EXPECT_TRUE(std::isnan(fit_decay_in_window(times, sum_of({{1.0, 10.0}}, times), 40.0, 5.0).time));
}

TEST(Decay, SurvivesNoise) {
  const std::vector<double> times = equal_times(0.5, 200);
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    std::vector<double> values;
    for (const double time : times)
      values.push_back(std::exp(-time / 10.0) + 0.02 * (i % 100) * normal(generator) * (i % 7 == 0 ? 1e100 : 1.0));
    const ExponentialDecay fit = fit_decay(times, values);
    if (std::isnan(fit.time)) continue;
    ++found;
    EXPECT_GT(fit.time, 0.0);
    EXPECT_GT(fit.amplitude, 0.0);
  }
  EXPECT_GT(found, 50);
}

}  // namespace
}  // namespace lucy::statistics
