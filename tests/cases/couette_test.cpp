// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/couette.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lucy/cases/couette_table.hpp"
#include "lucy/errors.hpp"

namespace lucy::cases {
namespace {

CouettePoint point(std::int64_t particles, double energy, double rate, double duration) {
  CouettePoint p;
  p.particles = particles;
  p.energy_per_particle = energy;
  p.strain_rate = rate;
  p.duration = duration;
  return p;
}

void finish(CouetteRun& run, double duration) {
  while (run.intervals_done() < run.intervals_needed(duration)) run.advance_one_sample();
}

void expect_within_four_errors(const TableRow& row, const char* name, double published, double last_digit) {
  const auto& estimate = row.estimates[static_cast<std::size_t>(std::find(quantities.begin(), quantities.end(), name) -
                                                                quantities.begin())];
  // Print rounds to the last digit, and its run was about as long as ours or longer: our error stands for both.
  const double combined = std::hypot(std::sqrt(2.0) * estimate.error, last_digit / std::sqrt(12.0));
  EXPECT_NEAR(estimate.value, published, 4.0 * combined) << name;
  EXPECT_LT(estimate.error, 0.05 * std::abs(published) + 0.001) << name;
}

// Posch, Hoover and Kum (1995), Table II (E = N, N = 1024, rate 0.5) and Table I (E = N/2, rate 1).
TEST(CouetteLong, AShortRunAgreesWithThePublishedRows) {
  {
    const CouettePoint p = point(1024, 1.0, 0.5, 300.0);
    CouetteRun run(p, 0);
    finish(run, p.duration);
    const TableRow row = summarize(p, p.duration, std::span(&run.record(), 1));
    EXPECT_EQ(row.status, RowStatus::ok);
    expect_within_four_errors(row, "pxy_kinetic", -0.2124, 1e-4);
    expect_within_four_errors(row, "pxy_potential", 0.0012, 1e-4);
    expect_within_four_errors(row, "pxx_kinetic", 0.9761, 1e-4);
    expect_within_four_errors(row, "pxx_potential", 0.4775, 1e-4);
    expect_within_four_errors(row, "pyy_kinetic", 0.1057, 1e-4);
    expect_within_four_errors(row, "pyy_potential", 0.4951, 1e-4);
    expect_within_four_errors(row, "potential_energy", 0.459, 1e-3);
  }
  {
    const CouettePoint p = point(1024, 0.5, 1.0, 200.0);
    CouetteRun run(p, 0);
    finish(run, p.duration);
    const TableRow row = summarize(p, p.duration, std::span(&run.record(), 1));
    expect_within_four_errors(row, "pxy_kinetic", -0.0218, 1e-4);
    expect_within_four_errors(row, "pxy_potential", -0.0074, 1e-4);  // the sign is wrong in print
    expect_within_four_errors(row, "pxx_kinetic", 0.0941, 1e-4);
    expect_within_four_errors(row, "pyy_kinetic", 0.0212, 1e-4);
    expect_within_four_errors(row, "potential_energy", 0.442, 1e-3);
  }
}

TEST(Couette, ASavedRunGoesOnWithTheSameBits) {
  CouettePoint p = point(100, 1.0, 0.3, 20.0);
  p.equilibration = 3.0;
  p.sample_interval = 0.5;
  CouetteRun whole(p, 1);
  finish(whole, p.duration);
  for (int stop : {1, 5, 17, 44}) {
    CouetteRun first(p, 1);
    for (int i = 0; i < stop; ++i) first.advance_one_sample();
    ArchiveWriter archive;
    first.save(archive);
    CouetteRun second(p, 1);
    ArchiveReader reader(archive.bytes());
    second.load(reader);
    EXPECT_TRUE(reader.exhausted());
    EXPECT_EQ(second.intervals_done(), stop);
    finish(second, p.duration);
    EXPECT_EQ(second.record().samples, whole.record().samples);
    EXPECT_EQ(second.record().energy_rescaled, whole.record().energy_rescaled);
    EXPECT_EQ(second.frame().position, whole.frame().position);
    EXPECT_EQ(second.frame().momentum, whole.frame().momentum);
  }
}

TEST(Couette, TheNumberOfThreadsInsideASystemChangesNothing) {
  CouettePoint p = point(4096, 1.0, 0.3, 2.0);
  p.equilibration = 0.0;
  CouetteRun alone(p, 0, 1);
  CouetteRun together(p, 0, 2);
  finish(alone, p.duration);
  finish(together, p.duration);
  EXPECT_EQ(alone.record().samples, together.record().samples);
}

TEST(Couette, ReplicasDifferAndRowsRepeat) {
  const CouettePoint p = point(100, 1.0, 0.3, 2.0);
  EXPECT_NE(replica_seed(p, 0), replica_seed(p, 1));
  CouettePoint other = p;
  other.strain_rate = 0.4;
  EXPECT_NE(replica_seed(p, 0), replica_seed(other, 0));
  other = p;
  other.duration = 50.0;
  EXPECT_EQ(replica_seed(p, 0), replica_seed(other, 0));
}

TEST(Couette, EverySettingReachesTheMotion) {
  const CouettePoint plain = point(100, 1.0, 0.5, 3.0);
  const auto last_sample = [](CouettePoint p, auto change) {
    p.equilibration = 0.0;
    change(p);
    CouetteRun run(p, 0);
    finish(run, p.duration);
    return run.record().samples.back();
  };
  const Sample base = last_sample(plain, [](auto&) {});
  EXPECT_EQ(base, last_sample(plain, [](auto&) {}));
  EXPECT_NE(base, last_sample(plain, [](auto& p) { p.thermostat = motion::Thermostat::none; }));
  const Sample kept = last_sample(plain, [](auto& p) { p.thermostat = motion::Thermostat::isokinetic; });
  EXPECT_NE(base, kept);
  const auto warm = last_sample(plain, [](auto& p) {
    p.thermostat = motion::Thermostat::isokinetic;
    p.kinetic_temperature = 0.9;
  });
  EXPECT_NEAR(warm[1], 0.9, 1e-9);
  const auto hoover = [](double tau) {
    return [tau](auto& p) {
      p.thermostat = motion::Thermostat::nose_hoover;
      p.relaxation_time = tau;
    };
  };
  EXPECT_NE(last_sample(plain, hoover(0.5)), last_sample(plain, hoover(2.0)));
  EXPECT_NE(base, last_sample(plain, [](auto& p) { p.rescale = false; }));
  EXPECT_NE(base, last_sample(plain, [](auto& p) { p.energy_tolerance = 1e-12; }));
  EXPECT_NE(base, last_sample(plain, [](auto& p) { p.range = 2.5; }));
  const auto thin = last_sample(plain, [](auto& p) { p.density = 0.5; });
  EXPECT_LT(thin[5] + thin[7], 0.5 * (base[5] + base[7]));  // potential pressure
}

TEST(Couette, AllReplicasOfAnIsokineticPointHaveOneTemperature) {
  CouettePoint p = point(100, 1.0, 0.5, 2.0);
  p.thermostat = motion::Thermostat::isokinetic;
  CouetteRun first(p, 0);
  CouetteRun second(p, 1);
  finish(first, p.duration);
  finish(second, p.duration);
  EXPECT_NEAR(first.record().samples.back()[1], second.record().samples.back()[1], 1e-9);
}

TEST(Couette, ShearWithoutAThermostatHasNoErrorBar) {
  CouettePoint p = point(100, 1.0, 0.3, 100.0);
  p.thermostat = motion::Thermostat::none;
  CouetteRun run(p, 0);
  finish(run, p.duration);
  const TableRow row = summarize(p, p.duration, std::span(&run.record(), 1));
  EXPECT_EQ(row.status, RowStatus::too_short);
  for (const auto& estimate : row.estimates) EXPECT_TRUE(std::isnan(estimate.error));
  EXPECT_GT(row.estimates[quantity("kinetic_temperature")].value, 1.0);  // it has heated up
}

TEST(Couette, ATargetIsMetOnlyFromManyEffectiveSamples) {
  CouettePoint p = point(100, 1.0, 0.5, 10.0);
  p.target_relative_error = 0.1;
  statistics::Estimate estimate{1.0, 0.05, 400.0, 30};
  EXPECT_TRUE(target_reached(p, estimate));
  estimate.effective_samples = 10.0;
  EXPECT_FALSE(target_reached(p, estimate));
  estimate = {1.0, 0.2, 400.0, 30};
  EXPECT_FALSE(target_reached(p, estimate));
  estimate = {1.0, std::nan(""), std::nan(""), 0};
  EXPECT_FALSE(target_reached(p, estimate));
  p.strain_rate = 0.0;
  EXPECT_TRUE(target_reached(p, estimate));
}

TEST(Couette, RecordsTheWholeDurationAndNothingOfTheEquilibration) {
  CouettePoint p = point(64, 1.0, 0.3, 7.3);
  p.equilibration = 2.0;
  p.step = 0.03;
  CouetteRun run(p, 0);
  finish(run, p.duration);
  const auto& record = run.record();
  EXPECT_GE(record.sample_interval * static_cast<double>(record.samples.size()), 7.3 - 1e-9);
  EXPECT_LT(record.sample_interval * static_cast<double>(record.samples.size()), 7.3 + record.sample_interval + 1e-9);
}

TEST(Couette, EnergyStressAndTemperatureAddUpInEverySample) {
  CouettePoint p = point(256, 1.0, 0.3, 10.0);
  CouetteRun run(p, 0);
  finish(run, p.duration);
  for (const Sample& sample : run.record().samples) {
    const double kinetic = 0.5 * (sample[4] + sample[6]);  // per volume, and n = 1
    EXPECT_NEAR(sample[0] + kinetic, 1.0, 1e-9);
    EXPECT_NEAR(sample[1] * 255.0, kinetic * 256.0, 1e-9);
    EXPECT_GT(sample[8], 1.0 / 256.0);
    EXPECT_LT(sample[8], 0.2);
  }
}

TEST(Couette, FramesFallOnTheirIntervalAndLieInTheBox) {
  CouettePoint p = point(64, 1.0, 0.7, 10.0);
  p.equilibration = 1.0;
  p.frame_interval = 2.5;
  validate(p);
  CouetteRun run(p, 0);
  int frames = 0;
  while (run.intervals_done() < run.intervals_needed(p.duration)) {
    run.advance_one_sample();
    if (!run.frame_due()) continue;
    ++frames;
    const Frame frame = run.frame();
    EXPECT_NEAR(std::remainder(frame.time - 1.0, 2.5), 0.0, 1e-9);
    const double offset = 0.7 * 8.0 * frame.time;
    EXPECT_NEAR(std::remainder(frame.offset - offset, 8.0), 0.0, 1e-9);
    for (double x : frame.position) {
      EXPECT_GE(x, 0.0);
      EXPECT_LT(x, 8.0);
    }
  }
  EXPECT_EQ(frames, 5);
}

void expect_refusal(const CouettePoint& p, const std::string& key) {
  try {
    validate(p);
    ADD_FAILURE() << key << " was accepted";
  } catch (const BadInput& refusal) {
    EXPECT_NE(std::string(refusal.what()).find(key), std::string::npos) << refusal.what();
  }
}

TEST(Couette, RefusesWhatCannotBeRun) {
  const CouettePoint good = point(1024, 1.0, 0.1, 100.0);
  EXPECT_NO_THROW(validate(good));
  const auto with = [&](auto change) {
    CouettePoint p = good;
    change(p);
    return p;
  };
  expect_refusal(with([](auto& p) { p.particles = 25; }), "system.particles = 25");
  expect_refusal(with([](auto& p) { p.particles = 1021; }), "system.particles = 1021");
  expect_refusal(with([](auto& p) { p.energy_per_particle = 0.413; }), "system.energy_per_particle");
  expect_refusal(with([](auto& p) { p.step = 0.21; }), "run.step");
  expect_refusal(with([](auto& p) { p.dimension = 3; }), "system.dimension");
  expect_refusal(with([](auto& p) { p.kernel = "gauss"; }), "kernel.name");
  expect_refusal(with([](auto& p) { p.range = 17.0; }), "kernel.range");
  expect_refusal(with([](auto& p) { p.strain_rate = 20.0; }), "shear.strain_rate");
  expect_refusal(with([](auto& p) { p.frame_interval = 0.123; }), "output.frame_interval");
  expect_refusal(with([](auto& p) { p.sample_interval = 1000.0; }), "output.sample_interval");
  expect_refusal(with([](auto& p) { p.energy_per_particle = 0.41305; }), "system.energy_per_particle");
  expect_refusal(with([](auto& p) { p.duration = 1e18; }), "run.duration");
  expect_refusal(with([](auto& p) { p.step = 1e-300; }), "run.step");
  expect_refusal(with([](auto& p) { p.equilibration = -1.0; }), "run.equilibration");
  expect_refusal(with([](auto& p) { p.energy_tolerance = 0.0; }), "run.energy_tolerance");
  expect_refusal(with([](auto& p) { p.kinetic_temperature = -0.5; }), "system.kinetic_temperature");
  expect_refusal(with([](auto& p) { p.relaxation_time = 0.0; }), "shear.relaxation_time");
  expect_refusal(with([](auto& p) { p.strain_rate = std::nan(""); }), "shear.strain_rate");
  expect_refusal(with([](auto& p) { p.integrator = motion::Integrator::velocity_verlet; }), "run.integrator");
}

}  // namespace
}  // namespace lucy::cases
