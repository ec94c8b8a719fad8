// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/measure/periodogram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace lucy::measure {
namespace {

std::vector<double> white_noise(std::size_t length, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<double> series(length);
  for (double& x : series) x = normal(generator);
  return series;
}

Periodogram of(std::size_t segment, const std::vector<double>& series) {
  Periodogram periodogram(segment);
  for (const double x : series) periodogram.add(x);
  return periodogram;
}

TEST(Periodogram, EqualsTheSumOfItsDefinitionForEveryLength) {
  for (const std::size_t segment : {2, 3, 8, 15, 31, 100}) {
    const std::vector<double> series = white_noise(3 * segment, segment);
    const Spectrum result = of(segment, series).result();
    EXPECT_EQ(result.segment, segment);
    EXPECT_EQ(result.segments, 3);
    ASSERT_EQ(result.power.size(), segment / 2 + 1);
    for (std::size_t k = 0; k < result.power.size(); ++k) {
      const double omega = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(segment);
      double power = 0.0;
      for (std::size_t s = 0; s < 3; ++s) {
        std::complex<double> sum = 0.0;
        for (std::size_t n = 0; n < segment; ++n)
          sum += series[s * segment + n] * std::polar(1.0, -omega * static_cast<double>(n));
        power += std::norm(sum) / static_cast<double>(segment) / 3.0;
      }
      EXPECT_NEAR(result.power[k], power, 1e-11) << "k = " << k << " of " << segment;
    }
  }
}

TEST(Periodogram, AddsUpToTheMeanSquare) {
  // Parseval: sum over all S frequencies of I_k/S; those above S/2 mirror those below.
  for (const std::size_t segment : {64, 65}) {
    const std::vector<double> series = white_noise(10 * segment, 1);
    double squares = 0.0;
    for (const double x : series) squares += x * x;
    const Spectrum result = of(segment, series).result();
    double sum = 0.0;
    for (std::size_t k = 0; k < result.power.size(); ++k) {
      const bool alone = k == 0 || 2 * k == segment;
      sum += (alone ? 1.0 : 2.0) * result.power[k];
    }
    EXPECT_NEAR(sum / static_cast<double>(segment), squares / static_cast<double>(series.size()), 1e-13);
  }
}

TEST(Periodogram, PutsASineIntoOneBin) {
  Periodogram periodogram(128);
  for (int n = 0; n < 5 * 128; ++n) periodogram.add(3.0 * std::sin(2.0 * std::numbers::pi * 10.0 * n / 128.0 + 0.7));
  const Spectrum result = periodogram.result();
  for (std::size_t k = 0; k < result.power.size(); ++k)
    EXPECT_NEAR(result.power[k], k == 10 ? 9.0 * 128.0 / 4.0 : 0.0, 1e-10) << "k = " << k;
}

TEST(Periodogram, IsFlatForWhiteNoiseAndScattersAsExponentialVariates) {
  constexpr std::size_t segment = 64, segments = 4000;
  const Spectrum result = of(segment, white_noise(segment * segments, 2)).result();
  double squares = 0.0;
  for (std::size_t k = 0; k < result.power.size(); ++k) {
    const bool alone = k == 0 || 2 * k == segment;  // one degree of freedom, not two
    const double error = std::sqrt((alone ? 2.0 : 1.0) / segments);
    EXPECT_NEAR(result.power[k], 1.0, 4.0 * error) << "k = " << k;
    squares += std::pow((result.power[k] - 1.0) / error, 2);
  }
  const auto bins = static_cast<double>(result.power.size());
  EXPECT_NEAR(squares / bins, 1.0, 4.0 * std::sqrt(2.0 / bins));
}

TEST(Periodogram, LeavesAnUnfinishedSegmentOut) {
  std::vector<double> series = white_noise(15, 3);
  EXPECT_TRUE(of(16, series).result().power.empty());
  series.push_back(1.0);
  const Spectrum whole = of(16, series).result();
  EXPECT_EQ(whole.segments, 1);
  series.push_back(100.0);
  EXPECT_EQ(of(16, series).result().power, whole.power);
}

TEST(Periodogram, GoesOnFromASavedStateWithTheSameBits) {
  const std::vector<double> series = white_noise(100, 4);
  const Spectrum expected = of(16, series).result();
  Periodogram running(16);
  for (std::size_t i = 0; i < series.size(); ++i) {
    ArchiveWriter saved;
    running.save(saved);
    Periodogram resumed = of(16, white_noise(21, 5));
    ArchiveReader reader(saved.bytes());
    resumed.load(reader);
    EXPECT_TRUE(reader.exhausted());
    for (std::size_t j = i; j < series.size(); ++j) resumed.add(series[j]);
    EXPECT_EQ(resumed.result().power, expected.power) << "saved after " << i << " samples";
    EXPECT_EQ(resumed.result().segments, 6);
    running.add(series[i]);
  }
}

TEST(Periodogram, RefusesASavedStateOfAnotherLengthOrATruncatedOne) {
  Periodogram periodogram = of(16, white_noise(40, 6));
  const std::vector<double> before = periodogram.result().power;
  ArchiveWriter other;
  of(15, white_noise(40, 7)).save(other);
  ArchiveReader reader(other.bytes());
  EXPECT_THROW(periodogram.load(reader), RunFailed);
  ArchiveWriter saved;
  periodogram.save(saved);
  for (std::size_t length = 0; length < saved.bytes().size(); ++length) {
    ArchiveReader truncated(std::span(saved.bytes()).first(length));
    EXPECT_THROW(periodogram.load(truncated), RunFailed);
  }
  EXPECT_EQ(periodogram.result().power, before);
}

TEST(Periodogram, PoolsTheSegmentsOfAnotherSeries) {
  const std::vector<double> first = white_noise(16 * 3, 8), second = white_noise(16 * 5, 9);
  std::vector<double> both = first;
  both.insert(both.end(), second.begin(), second.end());
  Periodogram pooled = of(16, first);
  pooled.add(50.0);  // begins a segment that the other one does not finish
  pooled.merge(of(16, second));
  const Spectrum result = pooled.result();
  const Spectrum expected = of(16, both).result();
  EXPECT_EQ(result.segments, 8);
  for (std::size_t k = 0; k < expected.power.size(); ++k) EXPECT_NEAR(result.power[k], expected.power[k], 1e-13);
  EXPECT_THROW(pooled.merge(Periodogram(17)), std::invalid_argument);
  EXPECT_THROW(Periodogram(1), std::invalid_argument);
}

}  // namespace
}  // namespace lucy::measure
