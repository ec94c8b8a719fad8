// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/blocking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "autoregressive_series.hpp"

namespace lucy::statistics {
namespace {

TEST(Blocking, GivesTheInefficiencyOfAKnownSeries) {
  for (const double phi : {0.0, 0.5, 0.9, 0.98}) {
    AutoregressiveSeries source(phi, 11);
    const std::vector<double> series = source.stationary(200000);
    const Blocking result = automatic_blocking(series);
    const double exact = (1.0 + phi) / (1.0 - phi);
    const double noise = std::sqrt(2.0 / result.degrees_of_freedom);
    EXPECT_NEAR(result.inefficiency / exact, 1.0, 4.0 * noise) << "phi = " << phi;
    EXPECT_LT(noise, 0.15) << "phi = " << phi;
    EXPECT_NEAR(result.effective_samples, std::min(200000.0, 200000.0 / result.inefficiency), 1e-6);
    EXPECT_NEAR(result.error, source.error_of_mean(series.size()), 2.0 * noise * result.error) << "phi = " << phi;
  }
}

TEST(Blocking, HasDegreesOfFreedomThatMatchTheScatterOfItsOwnError) {
  // 2 <V>^2/var(V) over white noise, where the block length hardly fluctuates.
  AutoregressiveSeries source(0.0, 12);
  double sum = 0.0, squares = 0.0, degrees = 0.0;
  constexpr int realisations = 3000;
  for (int i = 0; i < realisations; ++i) {
    const Blocking result = automatic_blocking(source.stationary(1000));
    const double variance = 1000.0 * result.error * result.error;
    sum += variance;
    squares += variance * variance;
    degrees += result.degrees_of_freedom;
  }
  const double mean = sum / realisations;
  const double scatter = squares / realisations - mean * mean;
  EXPECT_NEAR(degrees / realisations / (2.0 * mean * mean / scatter), 1.0, 0.25);
}

TEST(Blocking, FindsASlowComponentUnderFastNoise) {
  // Noise of ten times the variance hides the slow part from short blocks: g = (10 + 399)/11.
  AutoregressiveSeries fast(0.0, 13), slow(0.995, 14);
  std::vector<double> series = slow.stationary(100000);
  const std::vector<double> noise = fast.stationary(series.size());
  for (std::size_t i = 0; i < series.size(); ++i) series[i] += std::sqrt(10.0) * noise[i];
  const Blocking result = automatic_blocking(series);
  EXPECT_NEAR(result.inefficiency, 409.0 / 11.0, 4.0 * std::sqrt(2.0 / result.degrees_of_freedom) * 409.0 / 11.0);
  EXPECT_GT(result.inefficiency, 20.0);
}

TEST(Blocking, MovesWithTheUnitsOfTheSeries) {
  AutoregressiveSeries source(0.9, 15);
  const std::vector<double> series = source.stationary(5000);
  std::vector<double> scaled;
  for (const double value : series) scaled.push_back(1024.0 * value);
  const Blocking one = automatic_blocking(series), other = automatic_blocking(scaled);
  EXPECT_EQ(one.block_length, other.block_length);
  EXPECT_DOUBLE_EQ(1024.0 * one.error, other.error);
  EXPECT_DOUBLE_EQ(one.inefficiency, other.inefficiency);
}

TEST(Blocking, GivesNoErrorWhereThereIsNothingToJudgeItBy) {
  EXPECT_TRUE(std::isnan(automatic_blocking(std::vector<double>{}).mean));
  for (const std::vector<double>& series : {std::vector{2.0}, std::vector{1.0, 2.0, 3.0}}) {
    const Blocking result = automatic_blocking(series);
    EXPECT_DOUBLE_EQ(result.mean, 2.0);
    EXPECT_TRUE(std::isnan(result.error));
    EXPECT_EQ(result.degrees_of_freedom, 0);
  }
}

TEST(Blocking, RefusesAnErrorToManySeriesThatHaveHardlyMoved) {
  // A hundredth of a relaxation time: a random walk.
  AutoregressiveSeries source(0.9999, 17);
  int refused = 0;
  for (int i = 0; i < 500; ++i) refused += std::isnan(automatic_blocking(source.stationary(100)).error);
  EXPECT_GT(refused, 125);
}

TEST(Blocking, RefusesAnErrorToADrift) {
  std::vector<double> ramp;
  for (int i = 0; i < 1000; ++i) ramp.push_back(i);
  const Blocking result = automatic_blocking(ramp);
  EXPECT_DOUBLE_EQ(result.mean, 499.5);
  EXPECT_TRUE(std::isnan(result.error));
}

TEST(Blocking, GivesAConstantSeriesNoError) {
  const Blocking result = automatic_blocking(std::vector<double>(1000, 0.1));
  EXPECT_EQ(result.mean, 0.1);
  EXPECT_EQ(result.error, 0.0);
  EXPECT_EQ(result.effective_samples, 1000.0);
}

TEST(Blocking, RefusesToAverageWhatIsNotANumber) {
  std::vector<double> series(100, 1.0);
  series[50] = std::nan("");
  EXPECT_TRUE(std::isnan(automatic_blocking(series).mean));
  EXPECT_TRUE(std::isnan(automatic_blocking(series).error));
}

TEST(Blocking, NeverHasMoreEffectiveSamplesThanSamples) {
  for (int replica_count = 1; replica_count <= 4; ++replica_count) {
    AutoregressiveSeries source(0.9, 18);
    std::vector<std::vector<double>> series(static_cast<std::size_t>(replica_count));
    int above = 0;
    for (int i = 0; i < 1000; ++i) {
      for (std::vector<double>& replica : series) replica = source.stationary(5);
      const std::vector<std::span<const double>> replicas(series.begin(), series.end());
      above += automatic_blocking(replicas).effective_samples > 5.0 * replica_count;
    }
    EXPECT_EQ(above, 0) << replica_count << " replicas";
  }
}

TEST(Blocking, DoesNotTakeReplicaMeansThatAgreeByChanceForASmallError) {
  const std::vector<double> excursion = {1.0, 1.0, -1.0, -1.0}, alternating = {1.0, -1.0, 1.0, -1.0};
  const std::vector<std::span<const double>> replicas(4, excursion);
  const Blocking result = automatic_blocking(replicas);
  EXPECT_EQ(result.mean, 0.0);
  EXPECT_EQ(result.degrees_of_freedom, 3);
  // V(2) from window sums 2, 0, -2 in 16 samples.
  EXPECT_NEAR(result.error, std::sqrt(8.0 / 3.0 / (2.0 * (1.0 - 2.0 / 16.0)) / 16.0), 1e-12);
  EXPECT_TRUE(std::isnan(automatic_blocking(std::vector<std::span<const double>>(4, alternating)).error));
  EXPECT_TRUE(std::isnan(automatic_blocking(std::vector<std::span<const double>>(3, excursion)).error));
  EXPECT_TRUE(std::isnan(automatic_blocking(std::vector<std::span<const double>>(2, excursion)).error));
}

TEST(Blocking, WidensTheErrorWhenOneReplicaWentElsewhere) {
  AutoregressiveSeries source(0.5, 16);
  std::vector<std::vector<double>> series;
  for (int r = 0; r < 4; ++r) series.push_back(source.stationary(2000));
  for (double& value : series.back()) value += 4.0;
  const std::vector<std::span<const double>> replicas(series.begin(), series.end());
  const Blocking result = automatic_blocking(replicas);
  EXPECT_NEAR(result.mean, 1.0, 0.1);
  EXPECT_NEAR(result.error, 1.0, 0.1) << "the spread of 0, 0, 0, 4 over sqrt(4)";
  EXPECT_EQ(result.degrees_of_freedom, 3);
}

}  // namespace
}  // namespace lucy::statistics
