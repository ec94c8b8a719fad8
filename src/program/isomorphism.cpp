// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy isomorphism`: atoms and smooth particles side by side, on the way of run_experiment.hpp. isomorphism.csv is the
// results file, notes.txt its companion.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "lucy/files/isomorphism_csv.hpp"
#include "lucy/files/isomorphism_input.hpp"
#include "lucy/files/isomorphism_text.hpp"
#include "program/closing.hpp"
#include "program/commands.hpp"
#include "program/isomorphism_point.hpp"
#include "program/notes.hpp"
#include "program/run_experiment.hpp"

namespace lucy::program {

namespace {

namespace fs = std::filesystem;

/// 1 after a word on standard error when anything differs between the readings.
int tell_differences(const std::vector<cases::IsomorphismRow>& rows) {
  const auto differing =
      std::ranges::count_if(rows, [](const cases::IsomorphismRow& row) { return row.difference.has_value(); });
  if (differing == 0) return 0;
  std::fflush(stdout);
  const std::string sentence =
      fmt::format("lucy: in {} of {} case{} the two readings differ; what differs first stands above\n", differing,
                  rows.size(), rows.size() == 1 ? "" : "s");
  std::fputs(sentence.c_str(), stderr);
  return 1;
}

class Isomorphism final : public Experiment {
 public:
  explicit Isomorphism(files::IsomorphismInput input) : input_(std::move(input)) {}

  std::string kind() const override { return "isomorphism run"; }
  std::string resolved() const override { return files::isomorphism_resolved_toml(input_); }
  std::string results_file() const override { return "isomorphism.csv"; }
  int threads() const override { return input_.threads; }
  double checkpoint_interval() const override { return input_.checkpoint_interval; }
  std::uint64_t seed() const override { return input_.points.front().seed; }
  std::string generator() const override {
    return "64-bit Mersenne twister (std::mt19937_64), one per replica, seeded from the seed, the replica's number, N, "
           "E/N and the strain rate";
  }

  std::vector<StatePoint*> prepare(const fs::path& /*directory*/,
                                   const files::H5mdAuthorship& /*authorship*/) override {
    std::vector<StatePoint*> points;
    for (const auto& point : input_.points) {
      points_.push_back(std::make_unique<IsomorphismStatePoint>(point));
      points.push_back(points_.back().get());
    }
    return points;
  }

  std::vector<double> seconds_of_points() const override {
    std::vector<double> seconds;
    for (const auto& point : points_) seconds.push_back(point->seconds());
    return seconds;
  }

  void write_companions(const fs::path& directory) override {
    for (const auto& point : points_) rows_.push_back(point->row());
    Notes notes;
    notes.failures = failures_of(rows_);
    for (const auto& row : rows_)
      if (row.status != cases::RowStatus::failed) notes.others += files::isomorphism_verdict(row);
    write_notes(directory / "notes.txt", notes);
  }

  void write_results(const fs::path& directory) override {
    files::write_isomorphism_csv(directory / "isomorphism.csv", rows_);
  }

  void read_back(const fs::path& directory) override {
    const fs::path table = directory / "isomorphism.csv";
    rows_ = files::read_isomorphism_csv(table);
    const auto is_of = [](const cases::IsomorphismRow& row, const cases::IsomorphismPoint& point) {
      return row.particles == point.particles && row.strain_rate == point.strain_rate &&
             row.energy_per_particle == point.energy_per_particle;
    };
    notes_beside(table, rows_, input_.points, is_of);
  }

  int print(const fs::path& directory, const std::string& closing, bool /*draw*/) override {
    program::print("{}", files::format_isomorphism(rows_));
    program::print("\n{}\n", closing);
    print_files(directory, {"isomorphism.csv", "notes.txt", "input.toml", "provenance.json"});
    const int differences = tell_differences(rows_);
    return std::max(differences, tell_failures(rows_));
  }

 private:
  files::IsomorphismInput input_;
  std::vector<std::unique_ptr<IsomorphismStatePoint>> points_;
  std::vector<cases::IsomorphismRow> rows_;
};

}  // namespace

int isomorphism(const InputRequest& request) {
  Isomorphism experiment(files::read_isomorphism(request.input, request.overrides));
  return run_experiment(request, experiment);
}

}  // namespace lucy::program
