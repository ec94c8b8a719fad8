// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/prediction.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lucy::program {
namespace {

cases::CouettePoint small_point() {
  cases::CouettePoint point;
  point.particles = 36;
  point.energy_per_particle = 1.0;
  point.strain_rate = 0.5;
  point.equilibration = 5.0;
  point.duration = 20.0;
  return point;
}

TEST(RecordedDurations, AreTheDurationAloneWithoutATarget) {
  EXPECT_EQ(recorded_durations(small_point()), std::vector<double>{20.0});
}

TEST(RecordedDurations, DoubleUpToTenTimesTheDuration) {
  auto point = small_point();
  point.target_relative_error = 0.01;
  EXPECT_EQ(recorded_durations(point), (std::vector<double>{20.0, 40.0, 80.0, 160.0, 200.0}));
}

TEST(RecordedDurations, EndAtTheStatedMaximum) {
  auto point = small_point();
  point.target_relative_error = 0.01;
  point.maximum_duration = 80.0;
  EXPECT_EQ(recorded_durations(point), (std::vector<double>{20.0, 40.0, 80.0}));
  point.maximum_duration = 20.0;
  EXPECT_EQ(recorded_durations(point), std::vector<double>{20.0});
}

TEST(RecordedDurations, DoNotGrowAtZeroRateWhereThereIsNoViscosity) {
  auto point = small_point();
  point.target_relative_error = 0.01;
  point.strain_rate = 0.0;
  EXPECT_EQ(recorded_durations(point).size(), 1u);
}

TEST(SampleIntervals, AreThoseOfTheRunItself) {
  for (const double equilibration : {0.0, 0.3, 5.0, 7.77}) {
    auto point = small_point();
    point.equilibration = equilibration;
    const cases::CouetteRun run(point, 0);
    for (const double duration : {point.duration, 2.0 * point.duration})
      EXPECT_EQ(sample_intervals(point, duration), run.intervals_needed(duration)) << equilibration;
  }
}

TEST(TimeOnWorkers, TakesTheLongestFirst) {
  EXPECT_DOUBLE_EQ(time_on_workers({}, 2), 0.0);
  EXPECT_DOUBLE_EQ(time_on_workers({1.0, 1.0, 4.0}, 1), 6.0);
  EXPECT_DOUBLE_EQ(time_on_workers({1.0, 1.0, 4.0}, 2), 4.0);
  EXPECT_DOUBLE_EQ(time_on_workers({3.0, 3.0, 3.0}, 2), 6.0);
  EXPECT_DOUBLE_EQ(time_on_workers({3.0, 3.0, 3.0}, 8), 3.0);
}

TEST(DurationText, IsForPeople) {
  EXPECT_EQ(duration_text(0.04), "0.0 s");
  EXPECT_EQ(duration_text(9.9), "9.9 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(59.6), "1 min 00 s");
  EXPECT_EQ(duration_text(65.0), "1 min 05 s");
  EXPECT_EQ(duration_text(3600.0 * 3 + 60.0 * 12), "3 h 12 min");
  EXPECT_EQ(duration_text(86400.0 * 2 + 3600.0 * 4), "2 d 04 h");
  EXPECT_EQ(duration_text(std::numeric_limits<double>::infinity()), "unknown");
  EXPECT_EQ(duration_text(std::numeric_limits<double>::quiet_NaN()), "unknown");
}

TEST(SizeText, IsForPeople) {
  EXPECT_EQ(size_text(350e3), "350 kB");
  EXPECT_EQ(size_text(12.3e6), "12 MB");
  EXPECT_EQ(size_text(3.4e9), "3.4 GB");
}

}  // namespace
}  // namespace lucy::program
