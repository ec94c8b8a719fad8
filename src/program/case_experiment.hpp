// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the experiments of all cases have in common: an Input, whose points become state points of the kind Point
// (case_point.hpp), whose results become the Rows of the results file.
#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "program/experiment.hpp"
#include "program/scheduler.hpp"

namespace lucy::program {

template <class Input, class Point, class Row>
class CaseExperiment : public Experiment {
 public:
  explicit CaseExperiment(Input input) : input_(std::move(input)) {}

  int threads() const final { return input_.threads; }
  double checkpoint_interval() const final { return input_.checkpoint_interval; }
  std::uint64_t seed() const final { return input_.points.front().seed; }
  std::string generator() const override {
    return "64-bit Mersenne twister (std::mt19937_64), one per replica, seeded from the seed, the replica's number" +
           also_seeded_from();
  }

  Appetite appetite(int threads) const final {
    Appetite largest;
    for (const auto& point : input_.points) {
      if constexpr (requires { point.particles * 1.0; }) {
        const int replicas = std::min(threads, point.replicas);
        const double bytes = static_cast<double>(point.particles) * replicas * Point::bytes_per_particle;
        if (bytes > largest.bytes) largest = {point.particles, replicas, bytes};
      }
    }
    return largest;
  }

  std::vector<StatePoint*> prepare(const std::filesystem::path& directory,
                                   const files::H5mdAuthorship& authorship) final {
    std::vector<StatePoint*> points;
    for (const auto& point : input_.points) {
      points_.push_back(std::make_unique<Point>(point, directory / point_file_name(points_.size()), authorship));
      points.push_back(points_.back().get());
    }
    return points;
  }

  std::vector<double> seconds_of_points() const final {
    std::vector<double> seconds;
    for (const auto& point : points_) seconds.push_back(point->seconds());
    return seconds;
  }

 protected:
  /// Ends the sentence on the generator: ", N and E/N".
  virtual std::string also_seeded_from() const { return ""; }

  std::vector<std::string> with_point_files(std::vector<std::string> names) const {
    for (std::size_t i = 0; i < input_.points.size(); ++i) names.push_back(point_file_name(i));
    return names;
  }

  Input input_;
  std::vector<std::unique_ptr<Point>> points_;
  std::vector<Row> rows_;
};

}  // namespace lucy::program
