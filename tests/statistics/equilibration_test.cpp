// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/equilibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "autoregressive_series.hpp"
#include "lucy/statistics/pooling.hpp"

namespace lucy::statistics {
namespace {

TEST(Equilibration, IsCutAboutTheRelaxationAndTheRestIsUnbiased) {
  // Starts 20 standard deviations off; below one of them after ln 20 = 3 relaxation times.
  constexpr int realisations = 400;
  constexpr std::size_t samples = 5000;
  for (const double phi : {0.9, 0.98}) {
    AutoregressiveSeries source(phi, 21);
    const double relaxation = -1.0 / std::log(phi);
    double cuts = 0.0, means = 0.0, uncut = 0.0;
    int far = 0, covered = 0;
    for (int i = 0; i < realisations; ++i) {
      const std::vector<double> series = source.from(20.0, samples);
      const std::size_t cut = equilibration_cut(series);
      EXPECT_GT(static_cast<double>(cut), 0.9 * relaxation);
      cuts += static_cast<double>(cut) / realisations;
      far += cut > samples / 4;
      const std::vector<double> kept(series.begin() + static_cast<std::ptrdiff_t>(cut), series.end());
      const Estimate estimate = pooled_mean(std::vector<std::vector<double>>{kept});
      means += estimate.value / realisations;
      covered += std::abs(estimate.value) <= estimate.error;
      uncut += pooled_mean(std::vector<std::vector<double>>{series}).value / realisations;
    }
    const double error = source.error_of_mean(samples);
    EXPECT_GT(cuts, 2.0 * relaxation) << "phi = " << phi;
    EXPECT_LT(cuts, 10.0 * relaxation) << "phi = " << phi;
    EXPECT_LT(far, realisations / 25) << "phi = " << phi;
    EXPECT_NEAR(means, 0.0, 0.1 * error + 4.0 * error / std::sqrt(realisations)) << "phi = " << phi;
    EXPECT_GT(uncut, 0.7 * error) << "the test would not notice a missing cut; phi = " << phi;
    EXPECT_GT(static_cast<double>(covered) / realisations, 0.58) << "phi = " << phi;
  }
}

TEST(Equilibration, LeavesStationarySeriesNearlyWhole) {
  constexpr int realisations = 400;
  for (const double phi : {0.0, 0.9}) {
    AutoregressiveSeries source(phi, 22);
    double fraction = 0.0;
    int whole = 0;
    for (int i = 0; i < realisations; ++i) {
      const std::size_t cut = equilibration_cut(source.stationary(3000));
      fraction += static_cast<double>(cut) / 3000.0 / realisations;
      whole += cut < 150;
    }
    EXPECT_LT(fraction, 0.03) << "phi = " << phi;
    EXPECT_GT(static_cast<double>(whole) / realisations, 0.85) << "phi = " << phi;
  }
}

TEST(Equilibration, SeesASingleWildSampleAtTheStart) {
  AutoregressiveSeries source(0.0, 23);
  std::vector<double> series = source.stationary(1000);
  series.front() = 1000.0;
  const std::size_t cut = equilibration_cut(series);
  EXPECT_GE(cut, 1u);
  EXPECT_LE(cut, 100u);
}

TEST(Equilibration, DiscardsAtMostHalf) {
  AutoregressiveSeries source(0.5, 24);
  const std::vector<double> stationary = source.stationary(1000);
  for (const std::size_t end : {300u, 400u, 500u}) {
    std::vector<double> series = stationary;
    for (std::size_t i = 0; i < end; ++i) series[i] += 50.0;
    const std::size_t cut = equilibration_cut(series);
    EXPECT_LE(cut, 500u) << end;
    EXPECT_GE(cut, end);
  }
}

TEST(Equilibration, CutsAStepOffAConstant) {
  std::vector<double> series(1000, 1.0);
  for (std::size_t i = 0; i < 100; ++i) series[i] = 2.0;
  const std::size_t cut = equilibration_cut(series);
  EXPECT_GE(cut, 100u);
  EXPECT_LE(cut, 120u);
}

TEST(Equilibration, LeavesFewSamplesAndConstantsAlone) {
  EXPECT_EQ(equilibration_cut(std::vector<double>{}), 0u);
  EXPECT_EQ(equilibration_cut(std::vector<double>{100.0, 1.0, 1.0, 2.0}), 0u);
  EXPECT_EQ(equilibration_cut(std::vector<double>(5000, 0.3)), 0u);
}

}  // namespace
}  // namespace lucy::statistics
