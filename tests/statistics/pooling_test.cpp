// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/pooling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

#include "autoregressive_series.hpp"

namespace lucy::statistics {
namespace {

struct Coverage {
  double one_sigma, two_sigma;  // fraction of realisations whose bars reach the true mean
  double mean_error;            // in true errors
  double far_too_small;         // fraction of errors below a third of the true one
  double without_error;         // fraction
};

Coverage coverage(double phi, std::size_t samples, int replica_count, int realisations) {
  AutoregressiveSeries source(phi, 2024);
  const double true_error = source.error_of_mean(samples) / std::sqrt(replica_count);
  int one = 0, two = 0, small = 0, none = 0;
  double errors = 0.0;
  std::vector<std::vector<double>> replicas(static_cast<std::size_t>(replica_count));
  for (int i = 0; i < realisations; ++i) {
    for (std::vector<double>& replica : replicas) replica = source.stationary(samples);
    const Estimate estimate = pooled_mean(replicas);
    if (std::isnan(estimate.error)) {
      ++none;
      continue;
    }
    one += std::abs(estimate.value) <= estimate.error;
    two += std::abs(estimate.value) <= 2.0 * estimate.error;
    small += estimate.error < true_error / 3.0;
    errors += estimate.error / true_error;
  }
  const double given = realisations - none;
  return {one / given, two / given, errors / given, small / given, static_cast<double>(none) / realisations};
}

struct Case {
  double phi;
  std::size_t samples;
  int replicas, realisations;
};

void PrintTo(const Case& it, std::ostream* out) {
  *out << "phi " << it.phi << ", " << it.samples << " samples, " << it.replicas << " replicas";
}

class LongSeries : public testing::TestWithParam<Case> {};

TEST_P(LongSeries, AreCoveredAsAGaussianWouldBe) {
  const auto [phi, samples, replicas, realisations] = GetParam();
  const Coverage found = coverage(phi, samples, replicas, realisations);
  // Allowed: 0.02 and 0.015 for the method, and three binomial standard errors.
  EXPECT_NEAR(found.one_sigma, 0.6827, 0.02 + 3.0 * std::sqrt(0.6827 * 0.3173 / realisations));
  EXPECT_NEAR(found.two_sigma, 0.9545, 0.015 + 3.0 * std::sqrt(0.9545 * 0.0455 / realisations));
  EXPECT_NEAR(found.mean_error, 1.0, 0.035);
  EXPECT_EQ(found.far_too_small, 0.0);
  EXPECT_EQ(found.without_error, 0.0);
}

// At least 100 relaxation times: 1.44, 9.5 and 49.5 samples for phi = 0.5, 0.9 and 0.98.
INSTANTIATE_TEST_SUITE_P(Pooling, LongSeries,
                         testing::Values(Case{0.0, 200, 1, 2000}, Case{0.0, 2000, 4, 2000}, Case{0.0, 20000, 1, 1000},
                                         Case{0.5, 200, 1, 2000}, Case{0.5, 2000, 4, 2000}, Case{0.5, 20000, 1, 1000},
                                         Case{0.9, 1000, 1, 2000}, Case{0.9, 1000, 4, 2000}, Case{0.9, 20000, 1, 1000},
                                         Case{0.98, 5000, 1, 2000}, Case{0.98, 5000, 4, 1000},
                                         Case{0.98, 40000, 1, 500}));

class ShortSeries : public testing::TestWithParam<Case> {};

TEST_P(ShortSeries, HaveSensibleErrors) {
  const auto [phi, samples, replicas, realisations] = GetParam();
  const Coverage found = coverage(phi, samples, replicas, realisations);
  EXPECT_NEAR(found.one_sigma, 0.6827, 0.06);
  EXPECT_GT(found.two_sigma, 0.86);
  EXPECT_GT(found.mean_error, 0.97);
  EXPECT_LT(found.mean_error, 1.6);
  EXPECT_LT(found.far_too_small, 0.08);
  EXPECT_LT(found.without_error, 0.12);
}

// 10 to 30 relaxation times.
INSTANTIATE_TEST_SUITE_P(Pooling, ShortSeries,
                         testing::Values(Case{0.9, 95, 1, 2000}, Case{0.9, 95, 4, 2000}, Case{0.9, 285, 1, 2000},
                                         Case{0.9, 285, 4, 2000}, Case{0.98, 500, 1, 2000}, Case{0.98, 500, 4, 2000},
                                         Case{0.98, 1500, 1, 2000}, Case{0.98, 1500, 4, 2000}));

TEST(Pooling, MakesTheReplicaSpreadTheErrorWhereReplicasAreTooShortForBlocks) {
  // A tenth of a relaxation time each: a replica is one sample of the distribution, t-distributed with 3 degrees.
  const Coverage found = coverage(0.999, 100, 4, 2000);
  EXPECT_EQ(found.without_error, 0.0);
  EXPECT_NEAR(found.one_sigma, 0.6827, 0.04);
}

TEST(Pooling, CoversTheTruthWithTwoOrThreeShortReplicasToo) {
  // Half a relaxation time and two, phi = 0.98. Means that agreed by chance used to cover 0.3 to 0.5.
  for (const std::size_t samples : {25, 100}) {
    for (const std::size_t replicas : {2, 3}) {
      const Coverage found = coverage(0.98, samples, replicas, 2000);
      EXPECT_EQ(found.without_error, 0.0);
      EXPECT_NEAR(found.one_sigma, 0.69, 0.05) << samples << " samples, " << replicas << " replicas";
      EXPECT_GT(found.two_sigma, 0.8);
    }
  }
}

TEST(Pooling, CallsTwoReplicasOfAFewSamplesTooShort) {
  AutoregressiveSeries source(0.98, 22);
  for (int i = 0; i < 50; ++i) {
    const std::vector<std::vector<double>> replicas = {source.stationary(3), source.stationary(3)};
    EXPECT_TRUE(std::isnan(pooled_mean(replicas).error));
  }
}

TEST(Pooling, GivesTheMeanOverAllSamples) {
  const std::vector<std::vector<double>> replicas = {{1.0, 2.0, 3.0}, {}, {6.0}, {-1.0, -1.0}, {0.0}, {1.0}};
  const Estimate estimate = pooled_mean(replicas);
  EXPECT_DOUBLE_EQ(estimate.value, 11.0 / 8.0);
  EXPECT_EQ(estimate.degrees_of_freedom, 4);
  // Five replica means with weights 3, 1, 2, 1, 1 of 8, and Student's factor for four degrees of freedom.
  const auto weighted = [&](double samples, double mean) { return samples * (mean - 11.0 / 8.0) / 8.0; };
  double squares = 0.0;
  for (const double part : {weighted(3, 2), weighted(1, 6), weighted(2, -1), weighted(1, 0), weighted(1, 1)})
    squares += part * part;
  EXPECT_NEAR(estimate.error, student_factor(4) * std::sqrt(squares * 5.0 / 4.0), 1e-12);
}

TEST(Pooling, GivesNoErrorWithoutBlocks) {
  EXPECT_TRUE(std::isnan(pooled_mean(std::vector<std::vector<double>>{}).value));
  const Estimate single = pooled_mean(std::vector<std::vector<double>>{{5.0}});
  EXPECT_EQ(single.value, 5.0);
  EXPECT_TRUE(std::isnan(single.error));
  EXPECT_TRUE(std::isnan(single.effective_samples));
  const Estimate two = pooled_mean(std::vector<std::vector<double>>{{5.0}, {7.0}});
  EXPECT_EQ(two.value, 6.0);
  EXPECT_TRUE(std::isnan(two.error)) << "two replicas do not tell their own spread";
}

TEST(Pooling, AppliesStudentsFactorBelowTenDegreesOfFreedom) {
  EXPECT_NEAR(student_factor(1), 1.8373, 1e-4);
  EXPECT_NEAR(student_factor(2), 1.3213, 1e-4);
  EXPECT_NEAR(student_factor(9), 1.0587, 1e-4);
  EXPECT_EQ(student_factor(10), 1.0);
  EXPECT_TRUE(std::isnan(student_factor(0)));
  AutoregressiveSeries source(0.9, 5);
  const std::vector<double> series = source.stationary(200);
  const Blocking blocking = automatic_blocking(series);
  ASSERT_LT(blocking.degrees_of_freedom, 10);
  EXPECT_DOUBLE_EQ(pooled_mean(std::vector<std::vector<double>>{series}).error,
                   blocking.error * student_factor(blocking.degrees_of_freedom));
}

TEST(ReplicaSpread, HasUniformProbabilityForReplicasThatAgree) {
  AutoregressiveSeries source(0.9, 6);
  constexpr int realisations = 1000;
  std::vector<double> probabilities;
  std::vector<std::vector<double>> replicas(4);
  for (int i = 0; i < realisations; ++i) {
    for (std::vector<double>& replica : replicas) replica = source.stationary(2000);
    const ReplicaSpread spread = replica_spread(replicas);
    ASSERT_EQ(spread.degrees_of_freedom, 3);
    probabilities.push_back(spread.p_value);
  }
  std::sort(probabilities.begin(), probabilities.end());
  double distance = 0.0;  // Kolmogorov and Smirnov's; exceeds 1.95/sqrt(n) once in a thousand
  for (std::size_t i = 0; i < probabilities.size(); ++i)
    distance = std::max(distance, std::abs(probabilities[i] - (static_cast<double>(i) + 0.5) / realisations));
  EXPECT_LT(distance, 1.95 / std::sqrt(realisations));
}

TEST(ReplicaSpread, NoticesAReplicaThatWentElsewhere) {
  AutoregressiveSeries source(0.9, 7);
  std::vector<std::vector<double>> replicas;
  for (int r = 0; r < 4; ++r) replicas.push_back(source.stationary(2000));
  for (double& value : replicas[2]) value += 8.0 * source.error_of_mean(2000);
  EXPECT_LT(replica_spread(replicas).p_value, 1e-3);
}

TEST(ReplicaSpread, NeedsTwoReplicasWithErrors) {
  AutoregressiveSeries source(0.5, 8);
  EXPECT_TRUE(std::isnan(replica_spread(std::vector<std::vector<double>>{source.stationary(500)}).p_value));
  EXPECT_TRUE(std::isnan(replica_spread(std::vector<std::vector<double>>{{1.0}, {2.0}}).p_value));
  const std::vector<std::vector<double>> constant(3, std::vector<double>(50, 2.5));
  EXPECT_EQ(replica_spread(constant).p_value, 1.0);
}

}  // namespace
}  // namespace lucy::statistics
