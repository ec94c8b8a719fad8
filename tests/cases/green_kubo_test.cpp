// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/green_kubo.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/cases/green_kubo_table.hpp"
#include "lucy/errors.hpp"

namespace lucy::cases {
namespace {

GreenKuboPoint small_point() {
  GreenKuboPoint point;
  point.particles = 100;
  point.energy_per_particle = 1.0;
  point.preparation = 10.0;
  point.equilibration = 10.0;
  point.duration = 60.0;
  point.length = 10.0;
  return point;
}

GreenKuboRun finished(const GreenKuboPoint& point, int replica = 0, int threads = 1) {
  GreenKuboRun run(point, replica, threads);
  while (run.intervals_done() < run.intervals_needed()) run.advance_one_interval();
  return run;
}

std::vector<std::byte> state_of(const GreenKuboRun& run) {
  ArchiveWriter archive;
  run.save(archive);
  return archive.bytes();
}

std::string refusal(const GreenKuboPoint& point) {
  try {
    validate(point);
  } catch (const BadInput& refused) {
    return refused.what();
  }
  return "accepted";
}

TEST(GreenKubo, CorrelatesEverySampleOfTheStressInBlocks) {
  GreenKuboPoint point = small_point();
  point.series = true;
  point.length = 20.0;  // too long for a second block
  const GreenKuboRun run = finished(point);
  const auto& series = run.series();
  ASSERT_EQ(series.size(), 300u);
  ASSERT_EQ(run.record().blocks.size(), 1u);
  const CorrelationBlock& block = run.record().blocks.front();
  EXPECT_EQ(block.samples, 300);
  for (const std::size_t lag : {0u, 1u, 7u, 50u}) {
    double whole = 0.0;
    double kinetic = 0.0;
    double difference = 0.0;
    for (std::size_t i = 0; i + lag < series.size(); ++i) {
      const auto pxy = [&](std::size_t at) { return series[at][0] + series[at][1]; };
      const auto half = [&](std::size_t at) {
        return 0.5 * (series[at][2] + series[at][3] - series[at][4] - series[at][5]);
      };
      whole += pxy(i) * pxy(i + lag);
      kinetic += series[i][0] * series[i + lag][0];
      difference += half(i) * half(i + lag);
    }
    const auto pairs = static_cast<double>(series.size() - lag);
    EXPECT_NEAR(block.stress[StressCorrelation::xy].value[lag], whole / pairs, 1e-15);
    EXPECT_NEAR(block.stress[StressCorrelation::xy_kinetic].value[lag], kinetic / pairs, 1e-15);
    EXPECT_NEAR(block.stress[StressCorrelation::difference].value[lag], difference / pairs, 1e-15);
  }
}

TEST(GreenKubo, BothCorrelatorsAgreeOnTheFirstLags) {
  GreenKuboPoint point = small_point();
  const GreenKuboRun fft = finished(point);
  point.method = CorrelationMethod::multiple_tau;
  const GreenKuboRun multiple_tau = finished(point);
  const auto& a = fft.record().blocks.front().stress;
  const auto& b = multiple_tau.record().blocks.front().stress;
  for (std::size_t which = 0; which < stress_correlations; ++which)
    for (std::size_t lag = 0; lag < 16; ++lag) EXPECT_NEAR(a[which].value[lag], b[which].value[lag], 1e-15) << which;
  EXPECT_LE(b[0].lag.back(), a[0].lag.back());
  EXPECT_GE(b[0].lag.back(), 0.5 * a[0].lag.back());
}

TEST(GreenKubo, EveryBlockIsFilledAndTheLastTakesTheRest) {
  GreenKuboPoint point = small_point();
  point.duration = 212.2;  // 1070 samples in intervals of 10, blocks of at least 127
  EXPECT_EQ(block_count(point), 8);
  const GreenKuboRun run = finished(point);
  std::int64_t samples = 0;
  ASSERT_EQ(run.record().blocks.size(), 8u);
  for (const auto& block : run.record().blocks) samples += block.samples;
  EXPECT_EQ(samples, 1070);
  EXPECT_EQ(run.record().blocks[0].samples, 133);
  EXPECT_EQ(run.record().blocks[7].samples, 139);
  EXPECT_EQ(run.record().blocks[0].spectrum.segments, 1);
  EXPECT_EQ(run.record().blocks[0].spectrum.segment, 133u);
}

TEST(GreenKubo, KeepsTheEnergyThroughPreparationAndRest) {
  GreenKuboPoint point = small_point();
  for (const auto integrator : {motion::Integrator::velocity_verlet, motion::Integrator::runge_kutta_4}) {
    point.integrator = integrator;
    const GreenKuboRun run = finished(point);
    // E/N = Phi/N + K/N at every interval, K from kT and the N - 1 of its definition.
    for (const EquilibriumSample& sample : run.record().samples)
      EXPECT_NEAR(sample[3] + sample[0] * 0.99, point.energy_per_particle, 1e-4);
    EXPECT_LT(run.record().largest_energy_error, 1e-4);
    EXPECT_GT(run.record().largest_energy_error, 0.0);
    EXPECT_GE(run.record().largest_energy_error, std::abs(run.record().energy_drift));
  }
}

TEST(GreenKubo, EndsWhenTheEnergyLeavesItsBand) {
  GreenKuboPoint point = small_point();
  point.step = 0.2;
  point.energy_band = 1e-8;
  try {
    finished(point);
    FAIL() << "the band was kept";
  } catch (const RunFailed& failure) {
    EXPECT_NE(std::string(failure.what()).find("run.energy_band = 1e-08 about system.energy_per_particle = 1"),
              std::string::npos)
        << failure.what();
  }
}

TEST(GreenKubo, GoesOnFromEverySavedStateWithTheSameBits) {
  GreenKuboPoint point = small_point();
  point.duration = 30.0;
  point.series = true;
  point.diffusion = true;
  point.thermal_conductivity = true;
  point.pairs = {"pressure pressure", "pxx_kinetic pyy_potential"};
  for (const auto method : {CorrelationMethod::fft, CorrelationMethod::multiple_tau}) {
    point.method = method;
    const std::vector<std::byte> whole = state_of(finished(point));
    GreenKuboRun run(point, 0);
    while (run.intervals_done() < run.intervals_needed()) {
      run.advance_one_interval();
      const std::vector<std::byte> bytes = state_of(run);
      run = GreenKuboRun(point, 0);
      ArchiveReader archive(bytes);
      run.load(archive);
      EXPECT_TRUE(archive.exhausted());
    }
    EXPECT_EQ(state_of(run), whole);
  }
}

TEST(GreenKubo, ThreadsInsideASystemChangeNoBit) {
  GreenKuboPoint point = small_point();
  point.particles = 1024;
  point.duration = 10.0;
  point.length = 2.0;
  point.thermal_conductivity = true;
  EXPECT_EQ(state_of(finished(point, 0, 3)), state_of(finished(point, 0, 1)));
}

TEST(GreenKubo, ReplicasDiffer) {
  const GreenKuboPoint point = small_point();
  EXPECT_NE(finished(point, 0).record().samples, finished(point, 1).record().samples);
  EXPECT_NE(replica_seed(point, 0), replica_seed(point, 1));
}

TEST(GreenKubo, VelocitiesBeginWithTheTemperatureAndHeatFluxesCorrelatePositively) {
  GreenKuboPoint point = small_point();
  point.diffusion = true;
  point.thermal_conductivity = true;
  point.pairs = {"heat_flux_x heat_flux_x", "heat_flux_y heat_flux_y", "kinetic_temperature kinetic_temperature"};
  const GreenKuboRun run = finished(point);
  const auto& others = run.record().blocks.front().others;
  ASSERT_EQ(others.size(), 5u);
  double temperature = 0.0;
  for (const auto& sample : run.record().samples) temperature += sample[0];
  temperature /= static_cast<double>(run.record().samples.size());
  EXPECT_NEAR(others[0].value[0], temperature * 0.99, 0.02 * temperature);  // <v_x^2> = 2K/(2N)
  EXPECT_NEAR(others[1].value[0], 0.5 * (others[2].value[0] + others[3].value[0]), 1e-14);
  EXPECT_GT(others[1].value[0], 0.0);
  EXPECT_NEAR(others[4].mean_a[0], temperature, 0.02 * temperature);
}

TEST(GreenKubo, TakesCommonMeansOffPairs) {
  GreenKuboPoint point = small_point();
  point.duration = 212.0;
  point.series = true;
  point.pairs = {"pressure pressure", "pxx_kinetic stress_difference"};
  std::vector<GreenKuboRecord> records;
  std::vector<std::vector<StressSample>> series;
  for (int replica = 0; replica < 2; ++replica) {
    const GreenKuboRun run = finished(point, replica);
    records.push_back(run.record());
    series.push_back(run.series());
  }
  const GreenKuboResult result = summarize(point, records);
  ASSERT_EQ(result.others.size(), 2u);
  const auto pressure = [](const StressSample& s) { return 0.5 * (s[2] + s[3] + s[4] + s[5]); };
  const auto difference = [](const StressSample& s) { return 0.5 * (s[2] + s[3] - s[4] - s[5]); };
  double count = 0.0;
  double mean_pressure = 0.0;
  double mean_kinetic = 0.0;
  for (const auto& replica : series) {
    for (const StressSample& sample : replica) {
      mean_pressure += pressure(sample);
      mean_kinetic += sample[2];
      count += 1.0;
    }
  }
  mean_pressure /= count;
  mean_kinetic /= count;
  double same = 0.0;
  double mixed = 0.0;
  for (const auto& replica : series) {
    for (const StressSample& sample : replica) {
      same += (pressure(sample) - mean_pressure) * (pressure(sample) - mean_pressure) / count;
      mixed += (sample[2] - mean_kinetic) * difference(sample) / count;
    }
  }
  EXPECT_NEAR(result.others[0].correlation.value[0], 100.0 * same, 1e-9);
  EXPECT_NEAR(result.others[1].correlation.value[0], 100.0 * mixed, 1e-9);
  EXPECT_GT(mixed, 0.0);
  EXPECT_LT(result.others[1].correlation.error[0], 0.5 * result.others[1].correlation.value[0]);
}

TEST(GreenKubo, ASeriesFromElsewhereGivesTheSameBlocks) {
  GreenKuboPoint point = small_point();
  point.duration = 212.0;
  point.series = true;
  const GreenKuboRun run = finished(point);
  std::vector<double> pxy;
  std::vector<double> difference;
  for (const StressSample& sample : run.series()) {
    pxy.push_back(sample[0] + sample[1]);
    difference.push_back(0.5 * ((sample[2] + sample[3]) - (sample[4] + sample[5])));
  }
  const auto blocks = correlate_series(pxy, difference, lag_count(point), block_count(point));
  ASSERT_EQ(blocks.size(), run.record().blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const CorrelationBlock& mine = run.record().blocks[b];
    EXPECT_EQ(blocks[b].samples, mine.samples);
    EXPECT_EQ(blocks[b].stress[StressCorrelation::xy].value, mine.stress[StressCorrelation::xy].value);
    EXPECT_EQ(blocks[b].stress[StressCorrelation::pure_noise].value, mine.stress[StressCorrelation::pure_noise].value);
    EXPECT_EQ(blocks[b].spectrum.power, mine.spectrum.power);
    EXPECT_TRUE(blocks[b].stress[StressCorrelation::xy_kinetic].value.empty());
  }
}

TEST(GreenKuboPoints, SampleAsFinelyAsTheStressDemands) {
  GreenKuboPoint point = small_point();
  EXPECT_DOUBLE_EQ(sample_interval(point), 0.2);
  point.step = 0.15;
  EXPECT_DOUBLE_EQ(sample_interval(point), 0.15);
  point.step = 0.02;
  point.energy_per_particle = 100.0;  // a thermal particle crosses a quarter of the range in 0.053
  EXPECT_DOUBLE_EQ(sample_interval(point), 0.02);
  point = small_point();
  point.length = 0.0;
  EXPECT_EQ(lag_count(point), 61u);  // a fifth of the duration
  point.duration = 1e5;
  EXPECT_EQ(lag_count(point), 2001u);
  EXPECT_EQ(block_count(point), 16);
}

TEST(GreenKuboPoints, AreRefusedWhenTheyAreUnsound) {
  EXPECT_EQ(refusal(small_point()), "accepted");
  const auto expect = [](const char* words, auto change) {
    GreenKuboPoint point = small_point();
    change(point);
    EXPECT_NE(refusal(point).find(words), std::string::npos) << words << ": " << refusal(point);
  };
  expect("output.sample_interval = 5 must be at most 0.6922", [](auto& p) { p.sample_interval = 5.0; });
  expect("run.step = 0.2 must be at most 0.0753", [](auto& p) { p.step = 0.2, p.energy_per_particle = 50.0; });
  expect("system.energy_per_particle = 0.41 must be above 0.413", [](auto& p) { p.energy_per_particle = 0.41; });
  expect("correlation.length = 100 must be at most run.duration = 60", [](auto& p) { p.length = 100.0; });
  expect("correlation.length = 0.1 must be at least the time between samples, 0.2", [](auto& p) { p.length = 0.1; });
  expect("correlation.cutoff = 11 must be at most the longest time that is correlated, 10",
         [](auto& p) { p.cutoff = 11.0; });
  expect("correlation.pairs: \"pressure\" is not a pair", [](auto& p) { p.pairs = {"pressure"}; });
  expect("names 'pzz', which is not sampled", [](auto& p) { p.pairs = {"pressure pzz"}; });
  expect("run.preparation = -1 must be 0 or above", [](auto& p) { p.preparation = -1.0; });
  expect("make 2e+20 steps", [](auto& p) { p.preparation = 1e19; });
  expect("output.frame_interval = 0.5 must be a multiple of output.sample_interval = 0.2",
         [](auto& p) { p.frame_interval = 0.5; });
  expect("run.energy_band = 0 must be above 0", [](auto& p) { p.energy_band = 0.0; });
  expect("run.step = 0.3 must be above 0 and at most 0.2", [](auto& p) { p.step = 0.3; });
  expect("output.sample_interval = 0.22 must be a whole number of steps", [](auto& p) { p.sample_interval = 0.22; });
  expect("a box of side 5, below twice kernel.range = 3", [](auto& p) { p.particles = 25; });
}

TEST(GreenKuboPoints, NamePairsOfSampledQuantities) {
  EXPECT_EQ(parse_pair("pxy stress_difference"), (std::array<std::size_t, 2>{6, 7}));
  EXPECT_TRUE(mean_is_zero(parse_pair("pxy heat_flux_x")[1]));
  EXPECT_FALSE(mean_is_zero(parse_pair("pressure pxy")[0]));
}

// Posch, Hoover and Kum (1995), Sec. V: N = 1024, E = N.
TEST(GreenKuboLong, AShortRunStandsAtThePublishedPressure) {
  GreenKuboPoint point;
  point.particles = 1024;
  point.energy_per_particle = 1.0;
  point.equilibration = 50.0;
  point.duration = 200.0;
  const GreenKuboRun run = finished(point);
  double kinetic = 0.0;
  double potential = 0.0;
  for (const auto& sample : run.record().samples) {
    kinetic += sample[1] / static_cast<double>(run.record().samples.size());
    potential += sample[2] / static_cast<double>(run.record().samples.size());
  }
  EXPECT_NEAR(kinetic, 0.539, 0.002);
  EXPECT_NEAR(kinetic + potential, 1.024, 0.002);
  const auto& block = run.record().blocks.front();
  const double modulus =
      0.5 * (block.stress[StressCorrelation::xy].value[0] + block.stress[StressCorrelation::difference].value[0]) *
      1024.0 / kinetic;
  EXPECT_NEAR(modulus, 0.55, 0.08);
}

}  // namespace
}  // namespace lucy::cases
