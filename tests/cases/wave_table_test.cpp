// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows from made-up records of known decay: viscosities by every route, parts, windows, stresses and moduli come back,
// and what cannot be known is nan and said.
#include "lucy/cases/wave_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "lucy/statistics/decay_forms.hpp"

namespace lucy::cases {
namespace {

constexpr double nu = 0.4;

WavePoint point_of(WaveQuantity quantity = WaveQuantity::shear) {
  WavePoint point;
  point.quantity = quantity;
  point.particles = 4096;
  point.viscosity = 0.3;
  point.conductivity = 0.3;
  point.noise = 0.01;
  point.step = 0.5;
  point.duration = 1000.0;
  return point;
}

/// Records whose amplitude follows a curve, with noise of its own in each; 70 % of the loss is the operator's, 20 % the
/// pressure forces', 10 % carried.
std::vector<WaveRecord> records_of(const WavePoint& point, const std::function<double(double)>& curve, int replicas,
                                   double noise) {
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  const WaveSchedule schedule = wave_schedule(point);
  std::vector<WaveRecord> records;
  for (int r = 0; r < replicas; ++r) {
    WaveRecord& record = records.emplace_back();
    record.sample_interval = schedule.sample_interval(point);
    record.imposed_amplitude = curve(0.0);
    record.worst_energy_error = 1e-9 * (r + 1);
    record.subdivided_steps = r;
    for (std::int64_t i = 0; i <= schedule.samples; ++i) {
      const double time = static_cast<double>(i) * record.sample_interval;
      const double rate = (curve(time + 1e-4) - curve(std::max(0.0, time - 1e-4))) / (time > 0.0 ? 2e-4 : 1e-4);
      WaveSample& sample = record.samples.emplace_back();
      sample.amplitude = curve(time) + noise * normal(generator);
      sample.parts = {0.7 * rate, 0.2 * rate, 0.1 * rate};
      sample.particle_noise = 0.01 * std::exp(-time / 100.0);
      sample.pressure = 1.1;
    }
  }
  return records;
}

statistics::Estimate of(const WaveRow& row, std::size_t quantity) { return row.estimates[quantity]; }

/// Within four errors of the truth, and these no larger than `largest`.
void expect_known(const statistics::Estimate& estimate, double truth, double largest) {
  EXPECT_GT(estimate.error, 0.0);
  EXPECT_LT(estimate.error, largest);
  EXPECT_NEAR(estimate.value, truth, 4.0 * estimate.error);
}

TEST(WaveTable, FindsTheViscosityOfAnExponentialByEveryRoute) {
  const WavePoint point = point_of();
  const double k = wave_vector(point);
  EXPECT_NEAR(k, 2.0 * std::numbers::pi / 64.0, 1e-15);
  const auto records = records_of(
      point, [&](double time) { return 0.05 * std::exp(-nu * k * k * time); }, 8, 0.0005);
  const WaveResult result = summarize(point, records);
  const WaveRow& row = result.row;
  EXPECT_EQ(row.status, RowStatus::ok);
  EXPECT_TRUE(row.warnings.empty());
  EXPECT_DOUBLE_EQ(row.prescribed, 0.3);
  EXPECT_DOUBLE_EQ(row.imposed_amplitude, 0.05);
  EXPECT_DOUBLE_EQ(row.worst_energy_error, 8e-9);
  EXPECT_EQ(row.subdivided_steps, 28);
  EXPECT_EQ(row.preferred, statistics::DecayForm::exponential);
  EXPECT_TRUE(row.by_likelihood);
  expect_known(of(row, wave_quantity("total")), nu, 0.01);
  expect_known(of(row, wave_quantity("integral")), nu, 0.01);
  expect_known(of(row, wave_quantity("fitted")), nu, 0.01);
  // The operator's share of what the amplitude would have lost without noise.
  expect_known(of(row, wave_quantity("operator")), 0.7 * nu, 0.01);
  expect_known(of(row, wave_quantity("carried")), 0.1 * nu, 0.01);
  expect_known(of(row, wave_quantity("rest")), 0.2 * nu, 0.01);
  EXPECT_NEAR(of(row, wave_quantity("operator")).value + of(row, wave_quantity("rest")).value +
                  of(row, wave_quantity("carried")).value,
              of(row, wave_quantity("total")).value, 1e-15);
  expect_known(of(row, wave_quantity("operator_factor")), 0.7 * nu / 0.3, 0.02);
  // To the time at which a is 5 % of its start, the noise that counts with it.
  EXPECT_NEAR(row.parts_until, -std::log(0.05) / (nu * k * k), 60.0);
  EXPECT_NEAR(of(row, wave_quantity("particle_noise")).value,
              1.0 / row.parts_until * (1.0 - std::exp(-row.parts_until / 100.0)), 1e-4);
  EXPECT_NEAR(of(row, wave_quantity("pressure")).value, 1.1, 1e-14);

  ASSERT_GE(result.local.size(), 4u);
  for (const LocalDiffusivity& local : result.local) {
    EXPECT_NEAR(local.gradient.value, k * local.amplitude.value, 1e-15);
    EXPECT_NEAR(local.value.value, nu, 4.0 * local.value.error);
    EXPECT_LE(local.particle_noise.value, 0.01 * std::exp(-local.begin / 100.0) + 1e-12);
    EXPECT_GE(local.particle_noise.value, 0.01 * std::exp(-local.end / 100.0) - 1e-12);
  }
  ASSERT_EQ(result.forms.size(), 3u);
  EXPECT_TRUE(result.forms[0].preferred);
  double least = 1.0;
  for (const WaveForm& form : result.forms) {
    EXPECT_GE(form.behind.value, 0.0);
    least = std::min(least, form.behind.value);
  }
  EXPECT_EQ(least, 0.0) << "one is the likeliest";
  EXPECT_EQ(result.curve.time.size(), records[0].samples.size());
  EXPECT_NEAR(result.curve.fit[100], 0.05 * std::exp(-nu * k * k * result.curve.time[100]), 5e-4);
  EXPECT_NEAR(result.curve.parts[part_rest][100] / result.curve.parts[part_carried][100], 2.0, 1e-9);
}

TEST(WaveTable, FindsAYieldStress) {
  const WavePoint point = point_of();
  const double k = wave_vector(point);
  const double stress = 0.001;
  statistics::DecayParameters form;
  form.amplitude = 0.05;
  form.rate = 0.3 * k * k;
  form.deceleration = 4.0 * k * stress / std::numbers::pi;  // rho a' = -eta k^2 a - (4/pi) k sigma_y
  const auto curve = [&](double time) { return statistics::decay_form(statistics::DecayForm::yielding, form, time); };
  const WaveRow row = summarize(point, records_of(point, curve, 8, 0.0003)).row;
  EXPECT_EQ(row.preferred, statistics::DecayForm::yielding);
  expect_known(of(row, wave_quantity("yield_stress")), stress, 1e-4);
  expect_known(of(row, wave_quantity("fitted")), 0.3, 0.05);
  EXPECT_GT(of(row, wave_quantity("total")).value, 0.5);
}

TEST(WaveTable, FindsAModulusAndARelaxationTime) {
  WavePoint point = point_of();
  point.density = 1.0;
  const double k = wave_vector(point);
  statistics::DecayParameters form;
  form.amplitude = 0.05;
  form.rate = 0.5 * k * k;
  form.memory_time = 80.0;
  const auto curve = [&](double time) {
    return statistics::decay_form(statistics::DecayForm::viscoelastic, form, time);
  };
  const WaveRow row = summarize(point, records_of(point, curve, 8, 0.0003)).row;
  EXPECT_EQ(row.preferred, statistics::DecayForm::viscoelastic);
  expect_known(of(row, wave_quantity("relaxation_time")), 80.0, 5.0);
  expect_known(of(row, wave_quantity("modulus")), 0.5 / 80.0, 0.001);
  // Whatever the memory, the integral knows nu.
  expect_known(of(row, wave_quantity("integral")), 0.5, 0.05);
}

TEST(WaveTable, HeatHasNoStresses) {
  const WavePoint point = point_of(WaveQuantity::temperature);
  const double k = wave_vector(point);
  const auto records = records_of(
      point, [&](double time) { return 0.05 * std::exp(-nu * k * k * time); }, 4, 1e-4);
  const WaveResult result = summarize(point, records);
  EXPECT_DOUBLE_EQ(result.row.prescribed, 0.15);
  expect_known(of(result.row, wave_quantity("integral")), nu, 0.01);
  // At the start the density is uniform: kappa/(rho c_V), c_V = 1.
  expect_known(of(result.row, wave_quantity("operator_factor")), 0.7 * nu / 0.3, 0.02);
  for (const auto quantity : {wave_quantity("yield_stress"), wave_quantity("modulus")})
    EXPECT_TRUE(std::isnan(of(result.row, quantity).value));
  for (const WaveForm& form : result.forms) EXPECT_TRUE(std::isnan(form.yield_stress.value));
  EXPECT_EQ(rest_name(WaveQuantity::temperature), "heating");
}

TEST(WaveTable, ReplicasOfALatticeAtRestCountOnceAndHaveNoErrors) {
  WavePoint lattice = point_of();
  lattice.noise = 0.0;
  const auto records = records_of(
      lattice, [](double time) { return 0.05 * std::exp(-time / 200.0); }, 4, 0.0);
  const WaveRow row = summarize(lattice, records).row;
  EXPECT_EQ(row.status, RowStatus::too_short);
  EXPECT_TRUE(std::isnan(row.estimates[wave_quantity("total")].error));
  ASSERT_FALSE(row.warnings.empty());
  EXPECT_NE(row.warnings.back().find("All replicas are the same"), std::string::npos) << row.warnings.back();
}

TEST(WaveTable, ASingleReplicaIsShortAndHasNoErrors) {
  const WavePoint point = point_of();
  const double k = wave_vector(point);
  const auto records = records_of(
      point, [&](double time) { return 0.05 * std::exp(-nu * k * k * time); }, 1, 0.0);
  const WaveResult result = summarize(point, records);
  EXPECT_EQ(result.row.status, RowStatus::too_short);
  EXPECT_FALSE(result.row.by_likelihood);
  for (const auto quantity : {wave_quantity("total"), wave_quantity("integral"), wave_quantity("fitted")}) {
    EXPECT_NEAR(of(result.row, quantity).value, nu, 1e-3);
    EXPECT_TRUE(std::isnan(of(result.row, quantity).error));
  }
  for (const WaveForm& form : result.forms) EXPECT_TRUE(std::isnan(form.behind.value));
}

TEST(WaveTable, AWaveThatHardlyDecaysIsShort) {
  WavePoint point = point_of();
  point.viscosity = 0.0;
  const auto records = records_of(
      point, [](double time) { return 0.05 * std::exp(-1e-4 * time); }, 4, 1e-5);
  const WaveRow row = summarize(point, records).row;
  EXPECT_EQ(row.status, RowStatus::too_short);
  ASSERT_EQ(row.warnings.size(), 1u);
  EXPECT_NE(row.warnings[0].find("fell to 90 % of its start"), std::string::npos) << row.warnings[0];
  EXPECT_TRUE(std::isnan(of(row, wave_quantity("operator_factor")).value)) << "nothing is prescribed";
}

TEST(WaveTable, AWaveThatIsLostInNoiseFromTheStartIsShort) {
  const WavePoint point = point_of();
  auto records = records_of(
      point, [](double time) { return 0.05 * std::exp(-0.01 * time); }, 4, 1e-5);
  for (WaveRecord& record : records)
    for (WaveSample& sample : record.samples) sample.amplitude -= 0.06;
  const WaveRow row = summarize(point, records).row;
  EXPECT_EQ(row.status, RowStatus::too_short);
  ASSERT_EQ(row.warnings.size(), 1u);
  EXPECT_NE(row.warnings[0].find("lost in the noise"), std::string::npos) << row.warnings[0];
}

TEST(WaveTable, AFailedPointHasItsSettingsAndItsReason) {
  const WavePoint point = point_of();
  const WaveRow row = failed_row(point, "it was too hot");
  EXPECT_EQ(row.status, RowStatus::failed);
  EXPECT_EQ(row.failure, "it was too hot");
  EXPECT_EQ(row.settings.particles, 4096);
  EXPECT_DOUBLE_EQ(row.prescribed, 0.3);
  for (const auto& estimate : row.estimates) EXPECT_TRUE(std::isnan(estimate.value));
}

}  // namespace
}  // namespace lucy::cases
