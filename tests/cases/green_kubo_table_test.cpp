// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/green_kubo_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "lucy/errors.hpp"
#include "lucy/measure/correlator.hpp"
#include "lucy/statistics/running_integral.hpp"

namespace lucy::cases {
namespace {

using statistics::Estimate;

/// A stationary series with C(t) = variance exp(-t/time).
std::vector<double> relaxing(std::size_t samples, double interval, double variance, double time,
                             std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  const double phi = std::exp(-interval / time);
  std::vector<double> series(samples);
  double value = std::sqrt(variance) * normal(generator);
  for (double& sample : series) {
    sample = value;
    value = phi * value + std::sqrt(variance * (1.0 - phi * phi)) * normal(generator);
  }
  return series;
}

std::vector<double> operator+(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

measure::Correlation correlate(const std::vector<double>& series, std::size_t lags) {
  measure::FftCorrelator correlator(lags);
  for (const double value : series) correlator.add(value);
  return correlator.result();
}

/// V = 200 and kT = 0.5; the stress has a slow kinetic part of relaxation time 20 and a fast potential one, which know
/// nothing of each other: viscosity 400 (0.3 x 20 + 0.1 x 3) = 2520, of which 120 potential, none crossed.
constexpr double interval = 1.0;
constexpr double volume_over_temperature = 400.0;
constexpr double kinetic_truth = 400.0 * 0.3 * 20.0;
constexpr double potential_truth = 400.0 * 0.1 * 3.0;

GreenKuboPoint synthetic_point(double duration) {
  GreenKuboPoint point;
  point.particles = 100;
  point.density = 0.5;
  point.energy_per_particle = 1.0;
  point.step = 0.05;
  point.sample_interval = interval;
  point.duration = duration;
  point.length = 300.0;
  return point;
}

EquilibriumSample equilibrium_sample(std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  return {0.5 + 1e-3 * normal(generator), 0.3 + 1e-3 * normal(generator), 0.6 + 1e-3 * normal(generator),
          0.4 + 1e-3 * normal(generator)};
}

std::vector<GreenKuboRecord> records(const GreenKuboPoint& point, int replicas, std::int64_t blocks,
                                     std::uint64_t seed = 7) {
  std::mt19937_64 generator(seed);
  const auto samples = static_cast<std::size_t>(point.duration / interval);
  const std::size_t lags = lag_count(point);
  std::vector<GreenKuboRecord> result(static_cast<std::size_t>(replicas));
  for (GreenKuboRecord& record : result) {
    record.sample_interval = interval;
    record.interval = 2.0;
    for (std::size_t i = 0; i < samples / 2; ++i) record.samples.push_back(equilibrium_sample(generator));
    const auto part = [&](double variance, double time) {
      return relaxing(samples, interval, variance, time, generator);
    };
    const std::vector<double> xy_slow = part(0.3, 20.0), xy_fast = part(0.1, 3.0), difference_slow = part(0.3, 20.0),
                              difference_fast = part(0.1, 3.0);
    record.blocks = correlate_series(xy_slow + xy_fast, difference_slow + difference_fast, lags, blocks);
    const auto length = static_cast<std::ptrdiff_t>(samples / static_cast<std::size_t>(blocks));
    for (std::ptrdiff_t b = 0; b < blocks; ++b) {
      const auto piece = [&](const std::vector<double>& series) {
        return std::vector<double>(series.begin() + b * length, series.begin() + (b + 1) * length);
      };
      auto& stress = record.blocks[static_cast<std::size_t>(b)].stress;
      stress[xy_kinetic] = correlate(piece(xy_slow), lags);
      stress[xy_potential] = correlate(piece(xy_fast), lags);
      stress[difference_kinetic] = correlate(piece(difference_slow), lags);
      stress[difference_potential] = correlate(piece(difference_fast), lags);
    }
  }
  return result;
}

const Estimate& estimate(const GreenKuboRow& row, std::string_view name) {
  const auto place = std::find(green_kubo_quantities.begin(), green_kubo_quantities.end(), name);
  return row.estimates.at(static_cast<std::size_t>(place - green_kubo_quantities.begin()));
}

void expect_near_truth(const Estimate& found, double truth, double largest_error) {
  EXPECT_NEAR(found.value, truth, 4.0 * found.error);
  EXPECT_GT(found.error, 0.0);
  EXPECT_LT(found.error, largest_error);
}

void expect_unknown(const Estimate& found) {
  EXPECT_TRUE(std::isnan(found.value)) << found.value;
  EXPECT_TRUE(std::isnan(found.error)) << found.error;
}

bool warned_of(const GreenKuboRow& row, const std::string& words) {
  return std::any_of(row.warnings.begin(), row.warnings.end(),
                     [&](const std::string& warning) { return warning.find(words) != std::string::npos; });
}

TEST(GreenKuboTable, FindsTheViscosityAndItsParts) {
  const GreenKuboPoint point = synthetic_point(4000.0);
  const GreenKuboRow row = summarize(point, records(point, 8, 4)).row;
  const double truth = kinetic_truth + potential_truth;
  expect_near_truth(estimate(row, "viscosity"), truth, 0.2 * truth);
  expect_near_truth(estimate(row, "viscosity_spectrum"), truth, 0.2 * truth);
  expect_near_truth(estimate(row, "viscosity_twice_cutoff"), truth, 0.3 * truth);
  expect_near_truth(estimate(row, "viscosity_half_cutoff"), truth - kinetic_truth * std::exp(-3.0), 0.15 * truth);
  expect_near_truth(estimate(row, "viscosity_kinetic"), kinetic_truth, 0.2 * truth);
  expect_near_truth(estimate(row, "viscosity_potential"), potential_truth, 0.05 * truth);
  expect_near_truth(estimate(row, "viscosity_cross"), 0.0, 0.1 * truth);
  expect_near_truth(estimate(row, "viscosity_xy"), truth, 0.3 * truth);
  expect_near_truth(estimate(row, "viscosity_difference"), truth, 0.3 * truth);
  expect_near_truth(estimate(row, "decay_time"), 20.0, 5.0);
  expect_near_truth(estimate(row, "shear_modulus"), volume_over_temperature * 0.4, 10.0);
  expect_near_truth(estimate(row, "kinetic_temperature"), 0.5, 1e-4);
  expect_near_truth(estimate(row, "pressure_kinetic"), 0.3, 1e-4);
  expect_near_truth(estimate(row, "pressure_potential"), 0.6, 1e-4);
  expect_near_truth(estimate(row, "pressure"), 0.9, 1e-4);
  expect_near_truth(estimate(row, "potential_energy"), 0.4, 1e-4);
  expect_unknown(estimate(row, "self_diffusion"));
  expect_unknown(estimate(row, "thermal_conductivity"));
  EXPECT_NEAR(estimate(row, "viscosity_kinetic").value + estimate(row, "viscosity_cross").value +
                  estimate(row, "viscosity_potential").value,
              estimate(row, "viscosity").value, 1e-9 * truth);
  EXPECT_NEAR(0.5 * (estimate(row, "viscosity_xy").value + estimate(row, "viscosity_difference").value),
              estimate(row, "viscosity").value, 1e-9 * truth);
  EXPECT_EQ(row.cutoff, cutoff_in_decay_times * estimate(row, "decay_time").value);
  EXPECT_LT(std::abs(row.spectrum_z), 4.0);
  EXPECT_GT(row.spectrum_p_value, 1e-3);
  EXPECT_EQ(row.blocks, 32);
  EXPECT_EQ(row.replicas, 8);
  EXPECT_EQ(row.duration, 4000.0);
  EXPECT_EQ(row.sample_interval, interval);
  EXPECT_EQ(row.status, RowStatus::ok);
  EXPECT_TRUE(row.warnings.empty()) << row.warnings.front();
}

TEST(GreenKuboTable, DrawsItsCurvesInUnitsOfTheViscosity) {
  const GreenKuboPoint point = synthetic_point(4000.0);
  const GreenKuboResult result = summarize(point, records(point, 8, 4));
  const StressCurves& curves = result.curves;
  ASSERT_EQ(curves.time.size(), 301u);
  EXPECT_EQ(curves.time[20], 20.0);
  for (const Curve* curve : {&curves.xy, &curves.difference, &curves.mean, &curves.integral, &curves.noise_integral,
                             &curves.kinetic, &curves.cross, &curves.potential}) {
    ASSERT_EQ(curve->value.size(), 301u);
    ASSERT_EQ(curve->error.size(), 301u);
  }
  ASSERT_EQ(curves.noise_envelope.size(), 301u);
  EXPECT_EQ(curves.mean.value[0], estimate(result.row, "shear_modulus").value);
  for (const std::size_t i : {0, 10, 40}) {
    const double t = curves.time[i];
    const double truth = volume_over_temperature * (0.3 * std::exp(-t / 20.0) + 0.1 * std::exp(-t / 3.0));
    EXPECT_NEAR(curves.mean.value[i], truth, 4.0 * curves.mean.error[i]);
    EXPECT_NEAR(curves.kinetic.value[i] + curves.cross.value[i] + curves.potential.value[i], curves.mean.value[i],
                1e-9);
  }
  // Two independent components halve the variance of their mean; <P_xy D> is one sample of the same noise.
  for (const std::size_t i : {20, 100, 300}) {
    EXPECT_LT(std::abs(curves.noise_integral.value[i]), 4.0 * std::sqrt(2.0) * curves.noise_envelope[i]);
    EXPECT_NEAR(curves.noise_integral.error[i] / (std::sqrt(2.0) * curves.noise_envelope[i]), 1.0, 0.5);
  }
  // Beyond the decay the running integral scatters as noise does.
  EXPECT_NEAR(curves.integral.error[300] / curves.noise_envelope[300], 1.0, 0.4);
  EXPECT_NEAR(result.decay_amplitude, volume_over_temperature * 0.3, 0.3 * volume_over_temperature * 0.3);
}

TEST(GreenKuboTable, CarriesTheErrorOfTheTemperature) {
  const GreenKuboPoint point = synthetic_point(4000.0);
  std::vector<GreenKuboRecord> replicas = records(point, 4, 4);
  const Estimate before = estimate(summarize(point, replicas).row, "viscosity");
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal(0.5, 10.0);
  for (GreenKuboRecord& record : replicas)
    for (EquilibriumSample& sample : record.samples) sample[0] = normal(generator);
  const GreenKuboRow row = summarize(point, replicas).row;
  const Estimate after = estimate(row, "viscosity"), temperature = estimate(row, "kinetic_temperature");
  EXPECT_GT(temperature.error / std::abs(temperature.value), 0.1);
  EXPECT_NEAR(after.value * temperature.value, before.value * 0.5, 1e-3 * before.value);
  EXPECT_NEAR(std::pow(after.error / after.value, 2),
              std::pow(before.error / before.value, 2) + std::pow(temperature.error / temperature.value, 2), 1e-4);
}

TEST(GreenKuboTable, EndsTheIntegralWhereItIsTold) {
  GreenKuboPoint point = synthetic_point(4000.0);
  const std::vector<GreenKuboRecord> replicas = records(point, 4, 4);
  point.cutoff = 50.0;
  const GreenKuboResult result = summarize(point, replicas);
  EXPECT_EQ(result.row.cutoff, 50.0);
  EXPECT_NEAR(estimate(result.row, "viscosity").value, result.curves.integral.value[50], 1e-9);
  EXPECT_NEAR(estimate(result.row, "viscosity_half_cutoff").value, result.curves.integral.value[25], 1e-9);
  EXPECT_NEAR(estimate(result.row, "viscosity_twice_cutoff").value, result.curves.integral.value[100], 1e-9);
  // At a fixed time the jackknife of the integral is the error of the mean over blocks, kT's beside it.
  EXPECT_NEAR(estimate(result.row, "viscosity").error, result.curves.integral.error[50],
              1e-2 * result.curves.integral.error[50]);
}

TEST(GreenKuboTable, NamesTheKeyThatCutsTheIntegralShort) {
  GreenKuboPoint point = synthetic_point(4000.0);
  point.length = 90.0;
  const GreenKuboRow short_of_cutoff = summarize(point, records(point, 8, 4)).row;
  EXPECT_EQ(short_of_cutoff.cutoff, 90.0);
  EXPECT_GT(estimate(short_of_cutoff, "viscosity").error, 0.0);
  expect_unknown(estimate(short_of_cutoff, "viscosity_twice_cutoff"));
  EXPECT_TRUE(warned_of(short_of_cutoff, "less than 6 decay times"));
  EXPECT_TRUE(warned_of(short_of_cutoff, "Twice the cut-off"));
  EXPECT_TRUE(warned_of(short_of_cutoff, "lengthen correlation.length"));

  point.length = 30.0;
  const GreenKuboRow short_of_decay = summarize(point, records(point, 8, 4)).row;
  expect_unknown(estimate(short_of_decay, "decay_time"));
  EXPECT_EQ(short_of_decay.cutoff, 30.0);
  EXPECT_GT(estimate(short_of_decay, "viscosity").error, 0.0);
  EXPECT_EQ(short_of_decay.status, RowStatus::too_short) << "a cut-off that no rule chose";
  EXPECT_TRUE(warned_of(short_of_decay, "No decay time of the stress correlation"));
  point.cutoff = 25.0;
  EXPECT_EQ(summarize(point, records(point, 8, 4)).row.status, RowStatus::ok) << "a cut-off that was asked for";
  EXPECT_GT(estimate(short_of_decay, "shear_modulus").error, 0.0);
  EXPECT_GT(estimate(short_of_decay, "viscosity_spectrum").error, 0.0);
}

TEST(GreenKuboTable, IsShortWithOneBlockWithFewCutoffsOrWithNothing) {
  const GreenKuboPoint point = synthetic_point(4000.0);
  const GreenKuboRow alone = summarize(point, records(point, 1, 1)).row;
  EXPECT_FALSE(std::isnan(estimate(alone, "viscosity").value));
  EXPECT_TRUE(std::isnan(estimate(alone, "viscosity").error));
  EXPECT_GT(estimate(alone, "viscosity_spectrum").error, 0.0);
  EXPECT_TRUE(std::isnan(alone.spectrum_z));
  EXPECT_EQ(alone.status, RowStatus::too_short);
  EXPECT_TRUE(warned_of(alone, "no error without a second"));

  GreenKuboPoint hurried = synthetic_point(1000.0);
  hurried.length = 200.0;
  const GreenKuboRow few = summarize(hurried, records(hurried, 16, 2)).row;
  EXPECT_GT(estimate(few, "viscosity").error, 0.0);
  EXPECT_EQ(few.status, RowStatus::too_short);
  EXPECT_TRUE(warned_of(few, "less than 10 cut-offs"));
  EXPECT_TRUE(warned_of(few, "lengthen run.duration"));

  std::vector<GreenKuboRecord> unfinished = records(point, 2, 1);
  for (GreenKuboRecord& record : unfinished) record.blocks.clear();
  const GreenKuboResult no_blocks = summarize(point, unfinished);
  expect_unknown(estimate(no_blocks.row, "viscosity"));
  EXPECT_GT(estimate(no_blocks.row, "kinetic_temperature").error, 0.0);
  EXPECT_EQ(no_blocks.row.status, RowStatus::too_short);
  EXPECT_TRUE(warned_of(no_blocks.row, "No block of correlations is complete"));
  EXPECT_TRUE(no_blocks.curves.time.empty());

  const GreenKuboRow nothing = summarize(point, {}).row;
  for (const Estimate& each : nothing.estimates) expect_unknown(each);
  EXPECT_EQ(nothing.blocks, 0);
  EXPECT_EQ(nothing.status, RowStatus::too_short);
  const std::vector<GreenKuboRecord> empty(2);
  EXPECT_EQ(summarize(point, empty).row.status, RowStatus::too_short);
}

TEST(GreenKuboTable, DoesWithoutThePartsWhereOnlyTotalsAreKnown) {
  const GreenKuboPoint point = synthetic_point(4000.0);
  std::vector<GreenKuboRecord> replicas = records(point, 4, 4);
  const GreenKuboRow whole = summarize(point, replicas).row;
  for (GreenKuboRecord& record : replicas)
    for (CorrelationBlock& block : record.blocks)
      for (const auto part : {xy_kinetic, xy_potential, difference_kinetic, difference_potential})
        block.stress[part] = {};
  const GreenKuboResult result = summarize(point, replicas);
  EXPECT_EQ(estimate(result.row, "viscosity").value, estimate(whole, "viscosity").value);
  EXPECT_EQ(estimate(result.row, "viscosity").error, estimate(whole, "viscosity").error);
  for (const auto name : {"viscosity_kinetic", "viscosity_cross", "viscosity_potential"})
    expect_unknown(estimate(result.row, name));
  EXPECT_TRUE(result.curves.kinetic.value.empty());
  EXPECT_TRUE(result.curves.cross.error.empty());
  EXPECT_EQ(result.row.status, RowStatus::ok);
}

TEST(GreenKuboTable, UsesTheLagsThatAllBlocksShare) {
  const GreenKuboPoint point = synthetic_point(4000.0);
  std::vector<GreenKuboRecord> replicas = records(point, 4, 4);
  for (measure::Correlation& correlation : replicas[2].blocks[1].stress) {
    correlation.lag.resize(200);
    correlation.value.resize(200);
    correlation.pairs.resize(200);
  }
  const GreenKuboResult result = summarize(point, replicas);
  EXPECT_EQ(result.curves.time.size(), 200u);
  EXPECT_GT(estimate(result.row, "viscosity").error, 0.0);
}

TEST(GreenKuboTable, AgreesOnStretchedLags) {
  const GreenKuboPoint point = synthetic_point(4000.0);
  std::vector<GreenKuboRecord> replicas = records(point, 8, 4);
  std::mt19937_64 generator(21);
  std::vector<GreenKuboRecord> stretched = replicas;
  for (std::size_t r = 0; r < replicas.size(); ++r) {
    for (std::size_t b = 0; b < 4; ++b) {
      const std::vector<double> series = relaxing(1000, interval, 0.3, 20.0, generator);
      const std::vector<double> other = relaxing(1000, interval, 0.3, 20.0, generator);
      replicas[r].blocks[b].stress = {};
      stretched[r].blocks[b].stress = {};
      measure::MultipleTauCorrelator::Settings settings;
      settings.longest_lag = 300.0;
      measure::MultipleTauCorrelator in_levels(settings), other_in_levels(settings);
      for (const double value : series) in_levels.add(value);
      for (const double value : other) other_in_levels.add(value);
      stretched[r].blocks[b].stress[xy] = in_levels.result();
      stretched[r].blocks[b].stress[difference] = other_in_levels.result();
      replicas[r].blocks[b].stress[xy] = correlate(series, 301);
      replicas[r].blocks[b].stress[difference] = correlate(other, 301);
    }
  }
  const GreenKuboResult equal = summarize(point, replicas), levels = summarize(point, stretched);
  EXPECT_LT(levels.curves.time.size(), 100u);
  const Estimate a = estimate(equal.row, "viscosity"), b = estimate(levels.row, "viscosity");
  EXPECT_NEAR(a.value, b.value, 0.3 * a.error);
  EXPECT_NEAR(a.error / b.error, 1.0, 0.1);
  EXPECT_NEAR(
      statistics::value_at(levels.curves.time, levels.curves.noise_envelope, 100.0) / equal.curves.noise_envelope[100],
      1.0, 0.1);
  EXPECT_TRUE(levels.curves.noise_integral.value.empty());
}

TEST(GreenKuboTable, FindsDiffusionConductivityAndWhateverElseWasAskedFor) {
  GreenKuboPoint point = synthetic_point(4000.0);
  point.diffusion = true;
  point.thermal_conductivity = true;
  point.pairs = {"pressure pressure"};
  std::vector<GreenKuboRecord> replicas = records(point, 4, 4);
  std::mt19937_64 generator(31);
  for (GreenKuboRecord& record : replicas) {
    for (CorrelationBlock& block : record.blocks) {
      block.others.push_back(correlate(relaxing(1000, interval, 0.5, 10.0, generator), 301));
      block.others.push_back(correlate(relaxing(1000, interval, 0.02, 15.0, generator), 301));
      block.others.push_back(correlate(relaxing(1000, interval, 0.1, 5.0, generator), 301));
    }
  }
  const GreenKuboResult result = summarize(point, replicas);
  expect_near_truth(estimate(result.row, "self_diffusion"), 0.5 * 10.0, 2.0);
  // V/(kT^2) = 800.
  expect_near_truth(estimate(result.row, "thermal_conductivity"), 800.0 * 0.02 * 15.0, 100.0);
  ASSERT_EQ(result.others.size(), 3u);
  EXPECT_EQ(result.others[0].name, "velocity velocity");
  EXPECT_EQ(result.others[1].name, "heat_flux heat_flux");
  EXPECT_EQ(result.others[2].name, "pressure pressure");
  const std::array<double, 3> at_zero = {0.5, 800.0 * 0.02, 200.0 * 0.1};
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(result.others[i].time.size(), 301u);
    EXPECT_NEAR(result.others[i].correlation.value[0], at_zero[i], 4.0 * result.others[i].correlation.error[0]);
    EXPECT_LT(result.others[i].correlation.error[0], 0.2 * at_zero[i]);
    EXPECT_EQ(result.others[i].integral.value[0], 0.0);
    EXPECT_GT(result.others[i].integral.error[300], 0.0);
  }
  EXPECT_EQ(result.row.status, RowStatus::ok);
}

TEST(GreenKuboTable, WarnsWhenSamplesAreTooFarApart) {
  const GreenKuboPoint point = synthetic_point(4000.0);
  std::vector<GreenKuboRecord> replicas = records(point, 4, 4);
  for (GreenKuboRecord& record : replicas)
    for (CorrelationBlock& block : record.blocks)
      for (measure::Correlation& correlation : block.stress) correlation.value[0] *= 3.0;
  EXPECT_TRUE(warned_of(summarize(point, replicas).row, "output.sample_interval"));
}

TEST(GreenKuboTable, KeepsTheWorstOfTheReplicas) {
  const GreenKuboPoint point = synthetic_point(4000.0);
  std::vector<GreenKuboRecord> replicas = records(point, 3, 2);
  replicas[0].energy_drift = 2e-6;
  replicas[1].energy_drift = -3e-6;
  replicas[1].largest_energy_error = 4e-6;
  replicas[2].largest_energy_error = 9e-6;
  replicas[2].samples.resize(1500);
  const GreenKuboRow row = summarize(point, replicas).row;
  EXPECT_EQ(row.energy_drift, -3e-6);
  EXPECT_EQ(row.largest_energy_error, 9e-6);
  EXPECT_EQ(row.duration, 3000.0);
}

TEST(GreenKuboTable, SaysWhyAStateFailed) {
  const GreenKuboRow row = failed_row(synthetic_point(4000.0), "it blew up");
  EXPECT_EQ(row.status, RowStatus::failed);
  EXPECT_EQ(row.failure, "it blew up");
  EXPECT_EQ(row.particles, 100);
  EXPECT_EQ(row.energy_per_particle, 1.0);
  EXPECT_EQ(row.duration, 4000.0);
  for (const Estimate& each : row.estimates) expect_unknown(each);
  EXPECT_TRUE(std::isnan(row.cutoff));
  EXPECT_TRUE(std::isnan(row.energy_drift));
}

TEST(GreenKuboTable, KnowsTheViscositySoFar) {
  const GreenKuboPoint point = synthetic_point(4000.0);
  std::vector<GreenKuboRecord> replicas = records(point, 3, 4);
  const Estimate so_far = current_viscosity(point, replicas),
                 at_the_end = estimate(summarize(point, replicas).row, "viscosity");
  EXPECT_EQ(so_far.value, at_the_end.value);
  EXPECT_EQ(so_far.error, at_the_end.error);
  for (GreenKuboRecord& record : replicas) record.blocks.resize(&record == &replicas[0] ? 1 : 0);
  expect_unknown(current_viscosity(point, replicas));
  expect_unknown(current_viscosity(point, {}));
}

SampledSeries sampled_series(std::size_t samples, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  SampledSeries series;
  series.pxy = relaxing(samples, interval, 0.4, 20.0, generator);
  series.stress_difference = relaxing(samples, interval, 0.4, 20.0, generator);
  series.sample_interval = interval;
  series.volume = 200.0;
  series.kinetic_temperature = 0.5;
  return series;
}

TEST(GreenKuboTable, TakesASeriesThatWasSampledElsewhere) {
  const GreenKuboResult result = summarize_series(sampled_series(40000, 3));
  const double truth = volume_over_temperature * 0.4 * 20.0;
  expect_near_truth(estimate(result.row, "viscosity"), truth, 0.2 * truth);
  expect_near_truth(estimate(result.row, "viscosity_spectrum"), truth, 0.2 * truth);
  EXPECT_EQ(result.row.status, RowStatus::ok);
  EXPECT_EQ(result.row.blocks, 16);
  EXPECT_EQ(result.row.duration, 40000.0);
  EXPECT_EQ(result.curves.time.back(), 400.0);
  EXPECT_EQ(estimate(result.row, "kinetic_temperature").value, 0.5);
  expect_unknown(estimate(result.row, "pressure"));
  expect_unknown(estimate(result.row, "viscosity_kinetic"));
  EXPECT_TRUE(std::isnan(result.row.energy_per_particle));
  SampledSeries shorter = sampled_series(40000, 3);
  shorter.length = 250.0;
  shorter.cutoff = 100.0;
  const GreenKuboResult as_told = summarize_series(shorter);
  EXPECT_EQ(as_told.curves.time.back(), 250.0);
  EXPECT_EQ(as_told.row.cutoff, 100.0);
}

TEST(GreenKuboTable, RefusesSeriesThatMakeNoSense) {
  const auto refused = [](auto change) {
    SampledSeries series = sampled_series(2000, 4);
    change(series);
    EXPECT_THROW(summarize_series(series), BadInput);
  };
  refused([](SampledSeries& series) { series.pxy.clear(), series.stress_difference.clear(); });
  refused([](SampledSeries& series) { series.pxy.pop_back(); });
  refused([](SampledSeries& series) { std::ranges::fill(series.pxy, 0.3); });
  refused([](SampledSeries& series) { std::ranges::fill(series.stress_difference, -0.3); });
  refused([](SampledSeries& series) { series.sample_interval = 0.0; });
  refused([](SampledSeries& series) { series.volume = -1.0; });
  refused([](SampledSeries& series) { series.kinetic_temperature = std::nan(""); });
  refused([](SampledSeries& series) { series.length = 3000.0; });
  refused([](SampledSeries& series) { series.length = -1.0; });
  refused([](SampledSeries& series) { series.cutoff = 500.0; });
  for (const std::size_t samples : {1, 2, 5, 30}) {
    const GreenKuboRow row = summarize_series(sampled_series(samples, 5)).row;
    EXPECT_EQ(row.status, RowStatus::too_short) << samples;
    EXPECT_TRUE(std::isnan(estimate(row, "viscosity").error) || row.duration < 10.0 * row.cutoff) << samples;
  }
  SampledSeries still = sampled_series(2000, 4);
  for (std::size_t i = 0; i < 2000; ++i) still.pxy[i] = still.stress_difference[i] = 0.0;
  EXPECT_EQ(summarize_series(still).row.status, RowStatus::too_short);
}

struct Process {
  double slow_variance, fast_variance;
};

class GreenKuboCalibrationLong : public testing::TestWithParam<Process> {};

TEST_P(GreenKuboCalibrationLong, OneErrorCoversTheTruthInTwoOutOfThreeRealisations) {
  const auto [slow, fast] = GetParam();
  constexpr int realisations = 400;
  constexpr std::size_t samples = 10000;
  constexpr double every = 2.0;
  const double truth = slow * 25.0 + fast * 5.0;
  std::mt19937_64 generator(1995);
  int integral = 0, spectrum = 0;
  for (int i = 0; i < realisations; ++i) {
    SampledSeries series;
    const auto component = [&] {
      return relaxing(samples, every, slow, 25.0, generator) + relaxing(samples, every, fast, 5.0, generator);
    };
    series.pxy = component();
    series.stress_difference = component();
    series.sample_interval = every;
    series.volume = 1.0;
    series.kinetic_temperature = 1.0;
    const GreenKuboRow row = summarize_series(series).row;
    const Estimate &first = estimate(row, "viscosity"), &second = estimate(row, "viscosity_spectrum");
    integral += std::abs(first.value - truth) <= first.error;
    spectrum += std::abs(second.value - truth) <= second.error;
  }
  const double three_errors = 3.0 * std::sqrt(0.683 * 0.317 / realisations);
  EXPECT_NEAR(static_cast<double>(integral) / realisations, 0.683, three_errors);
  EXPECT_NEAR(static_cast<double>(spectrum) / realisations, 0.683, three_errors);
}

INSTANTIATE_TEST_SUITE_P(GreenKubo, GreenKuboCalibrationLong, testing::Values(Process{1.0, 0.0}, Process{0.3, 0.5}));

}  // namespace
}  // namespace lucy::cases
