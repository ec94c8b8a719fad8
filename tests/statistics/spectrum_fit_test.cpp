// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/spectrum_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace lucy::statistics {
namespace {

struct Exponential {
  double variance, time;
};

/// E I_k of a series with C(t) the sum of these, from its definition: the triangle that a finite series lays on C.
std::vector<double> expected_power(const std::vector<Exponential>& parts, std::size_t segment, double interval,
                                   std::size_t ordinates) {
  std::vector<double> correlation(segment, 0.0);
  for (std::size_t j = 0; j < segment; ++j)
    for (const Exponential& part : parts)
      correlation[j] += part.time > 0.0 ? part.variance * std::exp(-interval * static_cast<double>(j) / part.time)
                                        : (j == 0 ? part.variance : 0.0);
  const auto length = static_cast<double>(segment);
  std::vector<double> power;
  for (std::size_t k = 0; k < ordinates; ++k) {
    const double omega = 2.0 * std::numbers::pi * static_cast<double>(k) / length;
    double sum = correlation[0];
    for (std::size_t j = 1; j < segment; ++j)
      sum += 2.0 * (1.0 - static_cast<double>(j) / length) * correlation[j] * std::cos(omega * static_cast<double>(j));
    power.push_back(sum);
  }
  return power;
}

constexpr double interval = 0.5;
constexpr std::size_t segment = 1000;

TEST(SpectrumFit, FindsWhatTheExpectedPeriodogramWasMadeOf) {
  // 20 and 50 relaxation times long: the leakage of so short a segment is in the model.
  for (const double tau : {25.0, 10.0}) {
    const std::vector<double> power = expected_power({{0.7, tau}, {0.3, 0.0}}, segment, interval, 300);
    const LorentzianFit fit = fit_lorentzian(power, segment, 32.0, interval);
    const double expected = 0.7 * tau + 0.3 * 0.5 * interval;
    EXPECT_NEAR(fit.integral, expected, 1e-4 * expected);
    EXPECT_NEAR(fit.relaxation_time, tau, 1e-3 * tau);
    EXPECT_NEAR(fit.background, 0.3 * 0.5 * interval, 1e-3 * expected);
    EXPECT_GT(fit.p_value, 0.999);
    EXPECT_GT(fit.integral_error, 0.0);
    EXPECT_LT(fit.integral_error, 0.3 * expected);
    EXPECT_GE(fit.ordinates, 10);
  }
}

TEST(SpectrumFit, EndsAtItsOwnRelaxationTime) {
  const std::vector<double> power = expected_power({{0.7, 10.0}, {0.3, 0.0}}, segment, interval, 300);
  const LorentzianFit fit = fit_lorentzian(power, segment, 32.0, interval);
  EXPECT_NEAR(fit.highest_frequency * fit.relaxation_time, spectrum_reach, 2e-3 * spectrum_reach);
  const double spacing = 2.0 * std::numbers::pi / (interval * segment);
  EXPECT_EQ(fit.ordinates, static_cast<int>(fit.highest_frequency / spacing) + 1);
  const LorentzianFit again = refit_lorentzian(power, segment, 32.0, interval, fit);
  EXPECT_NEAR(again.integral, fit.integral, 1e-5 * fit.integral);
  EXPECT_EQ(again.ordinates, fit.ordinates);
}

TEST(SpectrumFit, TakesAFastPartForAConstant) {
  const std::vector<double> power = expected_power({{0.3, 25.0}, {1.0, 1.0}}, segment, interval, 300);
  const LorentzianFit fit = fit_lorentzian(power, segment, 32.0, interval);
  EXPECT_NEAR(fit.integral, 8.5, 0.01 * 8.5);
  EXPECT_NEAR(fit.background, 1.0, 0.1);
  EXPECT_NEAR(fit.relaxation_time, 25.0, 0.5);
}

TEST(SpectrumFit, NeedsNoConstant) {
  const std::vector<double> power = expected_power({{2.0, 20.0}}, segment, interval, 300);
  const LorentzianFit fit = fit_lorentzian(power, segment, 32.0, interval);
  EXPECT_NEAR(fit.integral, 40.0, 0.02);
  EXPECT_NEAR(fit.background, 0.0, 0.02);
  EXPECT_GT(fit.integral_error, 0.0);
  EXPECT_LT(fit.integral_error, 12.0);
}

TEST(SpectrumFit, ErrorShrinksWithTheRootOfTheSpectra) {
  const std::vector<double> power = expected_power({{0.7, 10.0}, {0.3, 0.0}}, segment, interval, 300);
  const double few = fit_lorentzian(power, segment, 8.0, interval).integral_error;
  const double many = fit_lorentzian(power, segment, 128.0, interval).integral_error;
  EXPECT_NEAR(few / many, 4.0, 1e-3);
}

TEST(SpectrumFit, DoesWithoutFrequencyZeroWhereTheMeanWasTakenOff) {
  std::vector<double> power = expected_power({{0.7, 10.0}, {0.3, 0.0}}, segment, interval, 300);
  const int ordinates = fit_lorentzian(power, segment, 32.0, interval).ordinates;
  power[0] = 0.0;
  const LorentzianFit fit = fit_lorentzian(power, segment, 32.0, interval);
  EXPECT_NEAR(fit.integral, 7.075, 1e-3);
  EXPECT_EQ(fit.ordinates, ordinates - 1);
}

TEST(SpectrumFit, FindsNothingWhereThereIsNothing) {
  const auto integral_of = [](const std::vector<double>& power) {
    return fit_lorentzian(power, segment, 32.0, interval).integral;
  };
  EXPECT_TRUE(std::isnan(integral_of({})));
  EXPECT_TRUE(std::isnan(integral_of({1.0, 1.0, 1.0})));
  EXPECT_TRUE(std::isnan(integral_of(std::vector<double>(501, 1.0)))) << "a flat spectrum has no width";
  EXPECT_TRUE(std::isnan(integral_of(std::vector<double>(501, 0.0))));
  EXPECT_TRUE(std::isnan(integral_of(expected_power({{1.0, 1e5}}, segment, interval, 300))))
      << "relaxes more slowly than a segment lasts";
  std::vector<double> broken = expected_power({{0.7, 10.0}, {0.3, 0.0}}, segment, interval, 300);
  broken[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(integral_of(broken)));
  EXPECT_TRUE(std::isnan(refit_lorentzian({}, segment, 32.0, interval, {}).integral));
  const LorentzianFit none = fit_lorentzian(broken, segment, 32.0, interval);
  EXPECT_TRUE(std::isnan(refit_lorentzian(std::vector<double>(501, 1.0), segment, 32.0, interval, none).integral));
}

/// One realisation of m averaged spectra.
std::vector<double> sample(const std::vector<double>& expected, double spectra, std::mt19937_64& generator) {
  std::vector<double> power;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const double shape = k == 0 ? 0.5 * spectra : spectra;
    power.push_back(expected[k] * std::gamma_distribution<double>(shape, 1.0 / shape)(generator));
  }
  return power;
}

TEST(SpectrumFit, SurvivesSpectraOfAnyShape) {
  std::mt19937_64 generator(4);
  const std::vector<double> flat(200, 1.0), steep = expected_power({{1.0, 300.0}}, segment, interval, 200),
                                            fast = expected_power({{1e12, 1.0}}, segment, interval, 200);
  for (const std::vector<double>& expected : {flat, steep, fast}) {
    for (int i = 0; i < 60; ++i) {
      const LorentzianFit fit = fit_lorentzian(sample(expected, i % 2 == 0 ? 1.0 : 100.0, generator), segment,
                                               i % 2 == 0 ? 1.0 : 100.0, interval);
      if (std::isnan(fit.integral)) continue;
      EXPECT_GT(fit.integral, 0.0);
      EXPECT_GE(fit.p_value, 0.0);
      EXPECT_LE(fit.p_value, 1.0);
    }
  }
}

TEST(SpectrumFitLong, OneErrorCoversTheTruthAsAGaussianWould) {
  const std::vector<double> expected = expected_power({{0.7, 10.0}, {0.3, 0.0}}, segment, interval, 150);
  std::mt19937_64 generator(12);
  constexpr int realisations = 400;
  int covered = 0, unlikely = 0;
  for (int i = 0; i < realisations; ++i) {
    const LorentzianFit fit = fit_lorentzian(sample(expected, 32.0, generator), segment, 32.0, interval);
    covered += std::abs(fit.integral - 7.075) <= fit.integral_error;
    unlikely += fit.p_value < 0.05;
  }
  EXPECT_NEAR(static_cast<double>(covered) / realisations, 0.683, 3.0 * std::sqrt(0.683 * 0.317 / realisations));
  EXPECT_NEAR(static_cast<double>(unlikely) / realisations, 0.05, 4.0 * std::sqrt(0.05 * 0.95 / realisations));
}

TEST(SpectrumFit, SaysWhenTheSpectrumHasAnotherShape) {
  // A resonance at 0.3 per time, which no Lorentzian about zero has.
  std::vector<double> expected = expected_power({{0.7, 10.0}}, segment, interval, 150);
  for (std::size_t k = 20; k < 28; ++k) expected[k] *= 3.0;
  std::mt19937_64 generator(13);
  const LorentzianFit fit =
      refit_lorentzian(sample(expected, 32.0, generator), segment, 32.0, interval,
                       fit_lorentzian(expected_power({{0.7, 5.0}}, segment, interval, 150), segment, 32.0, interval));
  EXPECT_LT(fit.p_value, 1e-6);
}

}  // namespace
}  // namespace lucy::statistics
