// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/couette_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace lucy::cases {
namespace {

CouettePoint couette_point(double strain_rate) {
  CouettePoint point;
  point.particles = 1024;
  point.energy_per_particle = 1.0;
  point.strain_rate = strain_rate;
  point.duration = 2000.0;
  point.replicas = 2;
  point.seed = 77;
  return point;
}

constexpr Sample means = {0.46, 0.54, -0.26, 0.004, 0.80, 0.48, 0.25, 0.49, 0.01};

/// Records whose truth is `means`: every observable relaxes over ten samples, P_xy potential with a part that cancels
/// the fluctuations of P_xy kinetic; `start` standard deviations off at first.
std::vector<CouetteRecord> records(int replicas, std::size_t samples, double start = 0.0, std::uint64_t seed = 1) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  const double phi = 0.9;
  std::vector<CouetteRecord> result(static_cast<std::size_t>(replicas));
  for (CouetteRecord& record : result) {
    record.sample_interval = 0.5;
    record.worst_energy_error = 1e-9 * static_cast<double>(&record - result.data() + 1);
    record.subdivided_steps = 3;
    record.steps = 40000;
    record.energy_rescaled = -1e-7;
    Sample state;
    for (double& value : state) value = start == 0.0 ? normal(generator) : start;
    for (std::size_t i = 0; i < samples; ++i) {
      Sample sample = means;
      for (std::size_t k = 0; k < sample.size(); ++k) {
        sample[k] += 0.01 * state[k];
        state[k] = phi * state[k] + std::sqrt(1.0 - phi * phi) * normal(generator);
      }
      sample[3] -= 0.9 * (sample[2] - means[2]);
      record.samples.push_back(sample);
    }
  }
  return result;
}

TEST(CouetteTable, HasTheColumnsOfTheContract) {
  const std::vector<std::string_view> contract = {"potential_energy", "kinetic_temperature",  "pxy_kinetic",
                                                  "pxy_potential",    "pxx_kinetic",          "pxx_potential",
                                                  "pyy_kinetic",      "pyy_potential",        "viscosity",
                                                  "normal_stress",    "largest_kinetic_share"};
  EXPECT_TRUE(std::equal(quantities.begin(), quantities.end(), contract.begin(), contract.end()));
  EXPECT_EQ(quantity("viscosity"), 8u);
  EXPECT_EQ(status_name(RowStatus::ok), "ok");
  EXPECT_EQ(status_name(RowStatus::too_short), "short");
  EXPECT_EQ(status_name(RowStatus::failed), "failed");
}

TEST(CouetteTable, FindsTheMeansAndWhatFollowsFromThem) {
  const CouettePoint point = couette_point(0.1);
  const TableRow row = summarize(point, 2000.0, records(4, 4000));
  for (std::size_t i = 0; i < observables.size(); ++i) {
    const auto place = std::find(quantities.begin(), quantities.end(), observables[i]) - quantities.begin();
    const statistics::Estimate& estimate = row.estimates[static_cast<std::size_t>(place)];
    EXPECT_NEAR(estimate.value, means[i], 4.0 * estimate.error) << observables[i];
    EXPECT_GT(estimate.error, 0.0) << observables[i];
    EXPECT_LT(estimate.error, 0.001) << observables[i];
  }
  const statistics::Estimate& viscosity = row.estimates[quantity("viscosity")];
  EXPECT_NEAR(viscosity.value, 2.56, 4.0 * viscosity.error);
  const statistics::Estimate& normal_stress = row.estimates[quantity("normal_stress")];
  EXPECT_NEAR(normal_stress.value, (1.28 - 0.74) / 0.01, 4.0 * normal_stress.error);
  EXPECT_EQ(row.effective_samples, viscosity.effective_samples);
  EXPECT_NEAR(row.effective_samples, 16000.0 / 19.0, 300.0);
  EXPECT_EQ(row.replicas, 4);
  EXPECT_EQ(row.duration, 2000.0);
  EXPECT_EQ(row.particles, 1024);
  EXPECT_EQ(row.worst_energy_error, 4e-9);
  EXPECT_EQ(row.subdivided_steps, 12);
  EXPECT_EQ(row.status, RowStatus::ok);
  EXPECT_EQ(row.spread.degrees_of_freedom, 3);
  EXPECT_GT(row.spread.p_value, 1e-3);
  EXPECT_TRUE(row.failure.empty());
}

TEST(CouetteTable, FormsTheViscositySampleBySample) {
  // The parts' fluctuations cancel but for sqrt(0.1^2 + 1) of one part; adding their errors would give 1.7 times that.
  const TableRow row = summarize(couette_point(0.1), 10000.0, records(4, 20000));
  const double kinetic = row.estimates[quantity("pxy_kinetic")].error;
  const double potential = row.estimates[quantity("pxy_potential")].error;
  const double viscosity = row.estimates[quantity("viscosity")].error;
  EXPECT_NEAR(viscosity * 0.1 / kinetic, std::sqrt(1.01), 0.2);
  EXPECT_LT(viscosity * 0.1, 0.75 * std::hypot(kinetic, potential));
}

TEST(CouetteTable, DropsTheStartOfEveryReplicaAndSaysSo) {
  const TableRow row = summarize(couette_point(0.1), 2000.0, records(4, 4000, 30.0));
  EXPECT_GT(row.equilibration_discarded, 10.0) << "two relaxation times";
  EXPECT_LT(row.equilibration_discarded, 200.0);
  const statistics::Estimate& viscosity = row.estimates[quantity("viscosity")];
  EXPECT_NEAR(viscosity.value, 2.56, 4.0 * viscosity.error);
}

TEST(CouetteTable, FindsATransientThatOnlyTheAverageOverReplicasShows) {
  // Two standard deviations off in sixteen replicas: no replica alone need notice.
  const std::vector<CouetteRecord> off = records(16, 2000, 2.0, 5);
  const TableRow row = summarize(couette_point(0.1), 1000.0, off);
  double alone = 0.0;
  int unnoticed = 0;
  for (const CouetteRecord& record : off) {
    const double discarded = summarize(couette_point(0.1), 1000.0, std::span(&record, 1)).equilibration_discarded;
    alone += discarded / 16.0;
    unnoticed += discarded == 0.0;
  }
  EXPECT_GE(unnoticed, 2);
  EXPECT_GE(row.equilibration_discarded, alone + 1.0);
}

TEST(CouetteTable, HasNoViscosityAtZeroRate) {
  CouettePoint point = couette_point(0.0);
  point.target_relative_error = 1e-9;
  const TableRow row = summarize(point, 2000.0, records(2, 4000));
  for (const auto name : {quantity("viscosity"), quantity("normal_stress")}) {
    EXPECT_TRUE(std::isnan(row.estimates[name].value));
    EXPECT_TRUE(std::isnan(row.estimates[name].error));
  }
  EXPECT_EQ(row.status, RowStatus::ok);
  EXPECT_GT(row.effective_samples, 100.0) << "of P_xy";
  EXPECT_TRUE(std::isnan(current_viscosity(point, records(2, 100)).value));
}

TEST(CouetteTable, CallsARunWithoutErrorShort) {
  for (const std::size_t samples : {0u, 1u, 3u}) {
    const TableRow row = summarize(couette_point(0.1), 1.0, records(1, samples));
    EXPECT_EQ(row.status, RowStatus::too_short) << samples;
    EXPECT_TRUE(std::isnan(row.estimates[quantity("viscosity")].error)) << samples;
    EXPECT_TRUE(std::isnan(row.effective_samples)) << samples;
    EXPECT_EQ(std::isnan(row.estimates[quantity("viscosity")].value), samples == 0) << samples;
    EXPECT_EQ(summarize(couette_point(0.0), 1.0, records(1, samples)).status, RowStatus::too_short) << samples;
  }
  EXPECT_EQ(summarize(couette_point(0.1), 0.0, {}).status, RowStatus::too_short);
}

TEST(CouetteTable, CallsATargetThatWasNotReachedShort) {
  CouettePoint point = couette_point(0.1);
  const std::vector<CouetteRecord> recorded = records(2, 2000);
  const statistics::Estimate viscosity = summarize(point, 1000.0, recorded).estimates[quantity("viscosity")];
  point.target_relative_error = 1.01 * viscosity.error / viscosity.value;
  EXPECT_EQ(summarize(point, 1000.0, recorded).status, RowStatus::ok);
  point.target_relative_error = 0.99 * viscosity.error / viscosity.value;
  EXPECT_EQ(summarize(point, 1000.0, recorded).status, RowStatus::too_short);
}

TEST(CouetteTable, SaysNothingMeasuredOfAFailedPoint) {
  const TableRow row = failed_row(couette_point(0.1), "the step could not be made small enough");
  EXPECT_EQ(row.status, RowStatus::failed);
  EXPECT_EQ(row.failure, "the step could not be made small enough");
  EXPECT_EQ(row.strain_rate, 0.1);
  EXPECT_EQ(row.replicas, 2);
  EXPECT_EQ(row.duration, 2000.0);
  for (const statistics::Estimate& estimate : row.estimates) {
    EXPECT_TRUE(std::isnan(estimate.value));
    EXPECT_TRUE(std::isnan(estimate.error));
  }
  EXPECT_TRUE(std::isnan(row.effective_samples));
  EXPECT_TRUE(std::isnan(row.worst_energy_error));
}

TEST(CouetteTable, AnEnergyErrorThatOneReplicaDoesNotKnowIsNotKnown) {
  for (const std::size_t which : {0u, 1u, 2u}) {
    auto unknown = records(3, 4000);
    unknown[which].worst_energy_error = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isnan(summarize(couette_point(0.1), 2000.0, unknown).worst_energy_error));
  }
}

TEST(CouetteTable, GivesEachReplicaItsOwnError) {
  const CouettePoint point = couette_point(0.1);
  const std::vector<CouetteRecord> recorded = records(2, 4000);
  const ReplicaRow row = replica_row(point, 1, recorded[1]);
  EXPECT_EQ(row.replica, 1);
  EXPECT_EQ(row.seed, 77u);
  EXPECT_EQ(row.steps, 40000);
  EXPECT_EQ(row.subdivided_steps, 3);
  EXPECT_EQ(row.energy_rescaled, -1e-7);
  EXPECT_NEAR(row.viscosity, 2.56, 4.0 * row.viscosity_error);
  const statistics::Estimate alone =
      summarize(point, 2000.0, std::span(&recorded[1], 1)).estimates[quantity("viscosity")];
  EXPECT_EQ(row.viscosity, alone.value);
  EXPECT_EQ(row.viscosity_error, alone.error);
  EXPECT_TRUE(std::isnan(replica_row(couette_point(0.0), 0, recorded[0]).viscosity));
}

}  // namespace
}  // namespace lucy::cases
