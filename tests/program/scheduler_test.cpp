// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/scheduler.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <optional>
#include <thread>

#include "files/scratch.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/table_csv.hpp"
#include "program/couette_point.hpp"

namespace lucy::program {
namespace {

using files::testing::contents;
using files::testing::ScratchFolder;

std::vector<cases::CouettePoint> two_points() {
  cases::CouettePoint point;
  point.particles = 36;
  point.energy_per_particle = 1.0;
  point.equilibration = 3.0;
  point.duration = 20.0;
  point.replicas = 2;
  point.strain_rate = 0.5;
  std::vector<cases::CouettePoint> points(2, point);
  points[1].strain_rate = 1.0;
  points[1].duration = 30.0;
  return points;
}

Scheduler::Settings settings_in(const ScratchFolder& folder, int threads) {
  Scheduler::Settings settings;
  settings.checkpoints = folder / "checkpoints";
  std::filesystem::create_directories(settings.checkpoints);
  settings.threads = threads;
  settings.build = "this build";
  return settings;
}

/// A scheduler with the points that it runs.
class RunOfPoints {
 public:
  RunOfPoints(const std::vector<cases::CouettePoint>& settings_of_points, const ScratchFolder& folder,
              const Scheduler::Settings& settings) {
    for (const auto& point : settings_of_points) {
      const auto series = folder / point_file_name(points_.size());
      points_.push_back(std::make_unique<CouetteStatePoint>(point, series, files::H5mdAuthorship{}));
      all_.push_back(points_.back().get());
    }
    scheduler_.emplace(all_, settings);
  }

  Scheduler* operator->() { return &*scheduler_; }
  std::vector<PointResult> results() const {
    std::vector<PointResult> results;
    for (const auto& point : points_) results.push_back(point->result());
    return results;
  }

 private:
  std::vector<std::unique_ptr<CouetteStatePoint>> points_;
  std::vector<StatePoint*> all_;
  std::optional<Scheduler> scheduler_;
};

std::string table_of(const ScratchFolder& folder, const RunOfPoints& run) {
  std::vector<cases::TableRow> rows;
  for (const auto& result : run.results()) rows.push_back(result.row);
  files::write_table_csv(folder / "table.csv", rows);
  return contents(folder / "table.csv");
}

std::string finished_table(const std::vector<cases::CouettePoint>& points, int threads) {
  const ScratchFolder folder;
  RunOfPoints run(points, folder, settings_in(folder, threads));
  EXPECT_FALSE(run->resumes());
  EXPECT_TRUE(run->run());
  EXPECT_EQ(run->state().points_done, 2u);
  EXPECT_DOUBLE_EQ(run->state().fraction, 1.0);
  return table_of(folder, run);
}

TEST(Scheduler, GivesTheSameBitsOnAnyNumberOfThreads) {
  const std::string alone = finished_table(two_points(), 1);
  EXPECT_EQ(finished_table(two_points(), 3), alone);
}

TEST(Scheduler, GoesOnWhereItWasStopped) {
  const std::string uninterrupted = finished_table(two_points(), 2);
  const ScratchFolder folder;
  int sessions = 0;
  for (;; ++sessions) {
    ASSERT_LT(sessions, 100);
    auto settings = settings_in(folder, 2);
    std::atomic<int> questions = 0;
    settings.stop_asked = [&questions] { return ++questions > 40; };
    RunOfPoints run(two_points(), folder, settings);
    EXPECT_EQ(run->resumes(), sessions > 0);
    if (run->run()) {
      EXPECT_EQ(table_of(folder, run), uninterrupted);
      break;
    }
  }
  EXPECT_GE(sessions, 3);
}

TEST(Scheduler, CanBeWatchedWhileItRuns) {
  const std::string unwatched = finished_table(two_points(), 2);
  const ScratchFolder folder;
  auto settings = settings_in(folder, 2);
  settings.watched = true;
  RunOfPoints run(two_points(), folder, settings);
  std::atomic<bool> running = true;
  double fraction = 0.0;
  std::thread watcher([&] {
    while (running) {
      const RunState state = run->state();
      EXPECT_EQ(state.points, 2u);
      EXPECT_GE(state.fraction, fraction);
      EXPECT_LE(state.fraction, 1.0);
      fraction = state.fraction;
    }
  });
  EXPECT_TRUE(run->run());
  running = false;
  watcher.join();
  EXPECT_EQ(table_of(folder, run), unwatched);
}

TEST(Scheduler, RunsOnUntilTheErrorIsSmallEnough) {
  auto points = two_points();
  for (auto& point : points) {
    point.target_relative_error = 0.05;
    point.maximum_duration = 2000.0;
  }
  const ScratchFolder folder;
  RunOfPoints run(points, folder, settings_in(folder, 2));
  ASSERT_TRUE(run->run());
  for (const auto& result : run.results()) {
    const auto viscosity = result.row.estimates[cases::quantity("viscosity")];
    EXPECT_EQ(result.row.status, cases::RowStatus::ok);
    EXPECT_LE(viscosity.error, 0.05 * viscosity.value);
    const double doublings = std::log2(result.row.duration / (result.row.strain_rate == 0.5 ? 20.0 : 30.0));
    EXPECT_GT(doublings, 0.0);
    EXPECT_EQ(doublings, std::round(doublings));
  }
}

TEST(Scheduler, GivesUpOnATargetAtTheMaximum) {
  auto points = two_points();
  points[0].target_relative_error = 1e-6;
  points[0].maximum_duration = 50.0;
  const ScratchFolder folder;
  RunOfPoints run(points, folder, settings_in(folder, 2));
  ASSERT_TRUE(run->run());
  EXPECT_EQ(run.results()[0].row.status, cases::RowStatus::too_short);
  EXPECT_DOUBLE_EQ(run.results()[0].row.duration, 50.0);
  EXPECT_DOUBLE_EQ(run.results()[1].row.duration, 30.0);
}

TEST(Scheduler, LetsOnePointFailAndTheOthersGoOn) {
  auto points = two_points();
  points[1].energy_tolerance = 1e-18;
  const ScratchFolder folder;
  RunOfPoints run(points, folder, settings_in(folder, 2));
  ASSERT_TRUE(run->run());
  const auto results = run.results();
  EXPECT_NE(results[0].row.status, cases::RowStatus::failed);
  EXPECT_EQ(results[1].row.status, cases::RowStatus::failed);
  EXPECT_NE(results[1].row.failure, "");
  EXPECT_TRUE(std::isnan(results[1].row.estimates[cases::quantity("viscosity")].value));
  EXPECT_EQ(results[1].replicas.size(), 2u);
  EXPECT_TRUE(std::filesystem::exists(folder / "point_001.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder / "point_002.h5"));
}

TEST(Scheduler, DoesNotTakeUpTheCheckpointsOfAnotherBuild) {
  const ScratchFolder folder;
  {
    RunOfPoints run(two_points(), folder, settings_in(folder, 2));
    ASSERT_TRUE(run->run());
  }
  auto settings = settings_in(folder, 2);
  settings.build = "another build";
  int told = 0;
  settings.say = [&told](const std::string&) { ++told; };
  RunOfPoints run(two_points(), folder, settings);
  EXPECT_FALSE(run->resumes());
  EXPECT_GE(told, 4);
}

TEST(Scheduler, EndsWhenTheDiskRefuses) {
  const ScratchFolder folder;
  auto settings = settings_in(folder, 2);
  settings.checkpoints = folder / "not there";
  RunOfPoints run(two_points(), folder, settings);
  EXPECT_NE(files::testing::message_of<RunFailed>([&] { run->run(); }).find("point_00"), std::string::npos);
}

}  // namespace
}  // namespace lucy::program
