// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy shear-flow`: viscous fluids of smooth particles under shear, on the way of run_experiment.hpp. shear_flow.csv
// is the results file, notes.txt its companion.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "lucy/files/shear_flow_csv.hpp"
#include "lucy/files/shear_flow_input.hpp"
#include "lucy/files/shear_flow_text.hpp"
#include "program/closing.hpp"
#include "program/commands.hpp"
#include "program/notes.hpp"
#include "program/run_experiment.hpp"
#include "program/scheduler.hpp"
#include "program/shear_flow_point.hpp"

namespace lucy::program {

namespace {

namespace fs = std::filesystem;

class ShearFlow final : public Experiment {
 public:
  explicit ShearFlow(files::ShearFlowInput input) : input_(std::move(input)) {}

  std::string kind() const override { return "shear-flow run"; }
  std::string resolved() const override { return files::shear_flow_resolved_toml(input_); }
  std::string results_file() const override { return "shear_flow.csv"; }
  int threads() const override { return input_.threads; }
  double checkpoint_interval() const override { return input_.checkpoint_interval; }
  std::uint64_t seed() const override { return input_.points.front().seed; }
  std::string generator() const override {
    return "64-bit Mersenne twister (std::mt19937_64), one per replica, seeded from the seed, the replica's number, "
           "and "
           "the settings of fluid, start and shear";
  }

  std::vector<StatePoint*> prepare(const fs::path& directory, const files::H5mdAuthorship& authorship) override {
    std::vector<StatePoint*> points;
    for (const auto& point : input_.points) {
      points_.push_back(
          std::make_unique<ShearFlowStatePoint>(point, directory / point_file_name(points_.size()), authorship));
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
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (!rows_[i].warnings.empty()) notes.warnings[i] = rows_[i].warnings;
    write_notes(directory / "notes.txt", notes);
  }

  void write_results(const fs::path& directory) override {
    files::write_shear_flow_csv(directory / results_file(), rows_);
  }

  void read_back(const fs::path& directory) override {
    const fs::path table = directory / results_file();
    rows_ = files::read_shear_flow_csv(table);
    const auto is_of = [](const cases::ShearFlowRow& row, const cases::ShearFlowPoint& point) {
      return row.settings.particles == point.particles && row.settings.strain_rate == point.strain_rate &&
             row.settings.equation_of_state == point.equation_of_state && row.settings.viscosity == point.viscosity;
    };
    const Notes notes = notes_beside(table, rows_, input_.points, is_of);
    for (const auto& [row, sentences] : notes.warnings)
      if (row < rows_.size()) rows_[row].warnings = sentences;
  }

  int print(const fs::path& directory, const std::string& closing, bool draw) override {
    program::print("{}", files::format_shear_flow(rows_));
    program::print("\n{}\n", closing);
    std::fflush(stdout);
    std::error_code error;
    if (const auto picture = directory / "shear_flow.png"; draw && !fs::exists(picture, error))
      program::draw({{"plot_shear_flow.py", {directory.string()}, picture}});
    std::vector<std::string> names = {results_file(),    "notes.txt",      "input.toml",
                                      "provenance.json", "shear_flow.png", "shear_flow.svg"};
    for (std::size_t i = 0; i < rows_.size(); ++i) names.push_back(point_file_name(i));
    print_files(directory, names);
    return tell_failures(rows_);
  }

 private:
  files::ShearFlowInput input_;
  std::vector<std::unique_ptr<ShearFlowStatePoint>> points_;
  std::vector<cases::ShearFlowRow> rows_;
};

}  // namespace

int shear_flow(const InputRequest& request) {
  ShearFlow experiment(files::read_shear_flow(request.input, request.overrides));
  return run_experiment(request, experiment);
}

}  // namespace lucy::program
