// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/jackknife.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace lucy::statistics {
namespace {

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double error_of_mean(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const auto n = static_cast<double>(values.size());
  return std::sqrt(squares / (n * (n - 1.0)));
}

std::vector<std::vector<double>> single_numbers(const std::vector<double>& values) {
  std::vector<std::vector<double>> blocks;
  for (const double value : values) blocks.push_back({value});
  return blocks;
}

TEST(Jackknife, OfAMeanIsTheErrorOfTheMean) {
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal(5.0, 2.0);
  for (const std::size_t count : {2, 3, 9, 40}) {
    std::vector<double> values(count);
    for (double& value : values) value = normal(generator);
    const double expected = error_of_mean(values) * student_factor(static_cast<int>(count) - 1);
    const BlockAverages averages(single_numbers(values), std::vector<double>(count, 3.0));
    EXPECT_NEAR(averages.mean()[0], mean_of(values), 1e-14);
    EXPECT_NEAR(averages.errors()[0], expected, 1e-12);
    const Estimate estimate =
        jackknife(count, [&](std::size_t b) { return b == count ? averages.mean()[0] : averages.mean_without(b)[0]; });
    EXPECT_NEAR(estimate.value, mean_of(values), 1e-14);
    EXPECT_NEAR(estimate.error, expected, 1e-12);
    EXPECT_EQ(estimate.effective_samples, static_cast<double>(count));
    EXPECT_EQ(estimate.degrees_of_freedom, static_cast<int>(count) - 1);
  }
}

TEST(Jackknife, WeighsBlocksByTheirLengths) {
  const BlockAverages averages({{1.0, 10.0}, {4.0, 20.0}, {2.0, 60.0}}, {1.0, 2.0, 1.0});
  EXPECT_EQ(averages.blocks(), 3u);
  EXPECT_EQ(averages.numbers(), 2u);
  EXPECT_EQ(averages.mean(), (std::vector<double>{2.75, 27.5}));
  EXPECT_EQ(averages.mean_without(1), (std::vector<double>{1.5, 35.0}));
}

TEST(Jackknife, CoversTheTruthOfAFunctionOfMeans) {
  // The ratio of two means that move together.
  std::mt19937_64 generator(8);
  std::normal_distribution<double> normal;
  constexpr std::size_t count = 16;
  constexpr int realisations = 2000;
  int covered = 0;
  for (int r = 0; r < realisations; ++r) {
    std::vector<std::vector<double>> blocks;
    for (std::size_t b = 0; b < count; ++b) {
      const double common = normal(generator);
      blocks.push_back({6.0 + common + normal(generator), 3.0 + common});
    }
    const BlockAverages averages(blocks, std::vector<double>(count, 1.0));
    const auto ratio = [](const std::vector<double>& means) { return means[0] / means[1]; };
    const Estimate estimate =
        jackknife(count, [&](std::size_t b) { return ratio(b == count ? averages.mean() : averages.mean_without(b)); });
    covered += std::abs(estimate.value - 2.0) <= estimate.error;
  }
  EXPECT_NEAR(static_cast<double>(covered) / realisations, 0.6827,
              0.02 + 3.0 * std::sqrt(0.6827 * 0.3173 / realisations));
}

TEST(Jackknife, GivesNoErrorWithoutASecondBlockOrWithOneThatIsNotKnown) {
  const Estimate one = jackknife(2.0, std::vector<double>{2.0});
  EXPECT_EQ(one.value, 2.0);
  EXPECT_TRUE(std::isnan(one.error));
  EXPECT_EQ(one.degrees_of_freedom, 0);
  EXPECT_TRUE(std::isnan(jackknife(2.0, std::vector<double>{1.0, std::nan(""), 3.0}).error));
  EXPECT_TRUE(std::isnan(jackknife(std::nan(""), std::vector<double>{1.0, 3.0}).error));
  EXPECT_EQ(jackknife(std::size_t{1}, [](std::size_t b) { return b == 1 ? 7.0 : std::nan(""); }).value, 7.0);
  EXPECT_TRUE(std::isnan(BlockAverages({{1.0}}, {1.0}).errors()[0]));
  EXPECT_EQ(BlockAverages({}, {}).blocks(), 0u);
  EXPECT_EQ(BlockAverages({}, {}).numbers(), 0u);
}

}  // namespace
}  // namespace lucy::statistics
