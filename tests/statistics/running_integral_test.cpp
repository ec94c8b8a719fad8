// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/running_integral.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "autoregressive_series.hpp"

namespace lucy::statistics {
namespace {

TEST(RunningIntegral, IsExactForStraightLinesOnUnequalTimes) {
  const std::vector<double> times = {0.0, 0.5, 0.75, 2.0, 5.0};
  std::vector<double> values;
  for (const double time : times) values.push_back(3.0 - time);
  const std::vector<double> integral = running_integral(times, values);
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(integral[i], 3.0 * times[i] - 0.5 * times[i] * times[i], 1e-14);
  EXPECT_TRUE(running_integral({}, {}).empty());
}

TEST(RunningIntegral, IsReadBetweenItsTimesOnAStraightLineAndNotBeyond) {
  const std::vector<double> times = {0.0, 1.0, 3.0}, values = {2.0, 4.0, 0.0};
  EXPECT_EQ(value_at(times, values, 0.0), 2.0);
  EXPECT_EQ(value_at(times, values, 0.5), 3.0);
  EXPECT_EQ(value_at(times, values, 1.0), 4.0);
  EXPECT_EQ(value_at(times, values, 2.5), 1.0);
  EXPECT_EQ(value_at(times, values, 3.0), 0.0);
  EXPECT_TRUE(std::isnan(value_at(times, values, 3.0000001)));
  EXPECT_TRUE(std::isnan(value_at(times, values, std::nan(""))));
  EXPECT_TRUE(std::isnan(value_at({}, {}, 0.0)));
}

/// C(t) = exp(-t/tau) at equal intervals.
struct Exponential {
  std::vector<double> times, values;

  Exponential(double tau, double interval, double longest) {
    for (int i = 0; interval * i <= longest; ++i) {
      times.push_back(interval * i);
      values.push_back(std::exp(-times.back() / tau));
    }
  }
};

TEST(NoiseEnvelope, IsThatOfAnExponential) {
  // R(s) = (tau + s) exp(-s/tau), and its double integral with x = t/tau: tau^3 [2 x - 3 + (3 + x) exp(-x)].
  const double tau = 20.0, total = 1e4;
  const Exponential c(tau, 0.1, 400.0);
  const std::vector<double> envelope = noise_envelope(c.times, c.values, total);
  EXPECT_EQ(envelope.front(), 0.0);
  for (std::size_t i = 10; i < c.times.size(); i += 10) {
    const double x = c.times[i] / tau;
    const double variance = 2.0 * tau * tau * tau / total * (2.0 * x - 3.0 + (3.0 + x) * std::exp(-x));
    EXPECT_NEAR(envelope[i], std::sqrt(variance), 2e-3 * std::sqrt(variance)) << c.times[i];
  }
  EXPECT_TRUE(noise_envelope({}, {}, total).empty());
}

TEST(NoiseEnvelope, IsWhatIndependentSeriesScatterBy) {
  const double phi = 0.9, tau = -1.0 / std::log(phi);
  const std::size_t length = 3000, lags = 60;
  const int realisations = 500;
  AutoregressiveSeries source(phi, 17);
  std::vector<double> times, squares(lags, 0.0);
  for (std::size_t k = 0; k < lags; ++k) times.push_back(static_cast<double>(k));
  for (int r = 0; r < realisations; ++r) {
    const std::vector<double> a = source.stationary(length), b = source.stationary(length);
    std::vector<double> correlation(lags, 0.0);
    for (std::size_t k = 0; k < lags; ++k) {
      for (std::size_t i = 0; i + k < length; ++i) correlation[k] += a[i] * b[i + k];
      correlation[k] /= static_cast<double>(length - k);
    }
    const std::vector<double> integral = running_integral(times, correlation);
    for (std::size_t k = 0; k < lags; ++k) squares[k] += integral[k] * integral[k];
  }
  const Exponential c(tau, 1.0, static_cast<double>(lags - 1));
  const std::vector<double> envelope = noise_envelope(c.times, c.values, static_cast<double>(length));
  for (const std::size_t k : {1, 5, 20, 59}) {
    // A standard deviation from n values has an error of 1/sqrt(2 n); the end effects of 3000 samples are 1 %.
    EXPECT_NEAR(std::sqrt(squares[k] / realisations) / envelope[k], 1.0, 0.01 + 4.0 / std::sqrt(2.0 * realisations));
  }
}

}  // namespace
}  // namespace lucy::statistics
