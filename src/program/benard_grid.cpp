// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy benard-grid`: convection of a continuum on several meshes, on the way of run_experiment.hpp. benard_grid.csv is
// the results file; extrapolated.csv, critical.csv and notes.txt are its companions.
#include <algorithm>
#include <string>
#include <vector>

#include "lucy/files/benard_grid_csv.hpp"
#include "lucy/files/benard_grid_input.hpp"
#include "lucy/files/benard_grid_text.hpp"
#include "program/benard_grid_point.hpp"
#include "program/case_experiment.hpp"
#include "program/closing.hpp"
#include "program/commands.hpp"
#include "program/notes.hpp"
#include "program/run_experiment.hpp"

namespace lucy::program {

namespace {

namespace fs = std::filesystem;

class BenardGrid final : public CaseExperiment<files::BenardGridInput, BenardGridStatePoint, cases::BenardGridRow> {
 public:
  using CaseExperiment::CaseExperiment;

  std::string kind() const override { return "benard-grid run"; }
  std::string resolved() const override { return files::benard_grid_resolved_toml(input_); }
  std::string results_file() const override { return "benard_grid.csv"; }
  std::string generator() const override { return "none: nothing is random"; }

  void write_companions(const fs::path& directory) override {
    for (const auto& point : points_) rows_.push_back(point->result());
    files::write_benard_limits_csv(directory / "extrapolated.csv", cases::limits_of(rows_));
    files::write_critical_csv(directory / "critical.csv", cases::critical_rayleighs(rows_));
    write_notes(directory / "notes.txt", {failures_of(rows_), {}, ""});
  }

  void write_results(const fs::path& directory) override {
    files::write_benard_grid_csv(directory / results_file(), rows_);
  }

  void read_back(const fs::path& directory) override {
    const fs::path table = directory / results_file();
    rows_ = files::read_benard_grid_csv(table);
    notes_beside(table, rows_, input_.points, [](const cases::BenardGridRow& row, const cases::BenardGridPoint& point) {
      return row.settings.cells == point.cells && row.settings.equation_of_state == point.equation_of_state &&
             row.settings.rayleigh == cases::resolved(point).rayleigh && row.settings.find == point.find;
    });
  }

  int print(const fs::path& directory, const std::string& closing, bool draw) override {
    program::print("{}", files::format_benard_grid(rows_));
    std::vector<Drawing> drawings;
    // Growth rates have a picture of their own.
    const bool flows = std::ranges::any_of(
        rows_, [](const cases::BenardGridRow& row) { return row.settings.find == cases::BenardGoal::steady_state; });
    if (draw)
      drawings = {
          {"plot_benard_grid.py", {directory.string()}, directory / (flows ? "benard_grid.png" : "critical.png")}};
    print_closing(
        directory, closing, drawings,
        with_point_files({results_file(), "extrapolated.csv", "critical.csv", "notes.txt", "input.toml",
                          "provenance.json", "benard_grid.png", "benard_grid.svg", "critical.png", "critical.svg"}));
    return tell_failures(rows_);
  }
};

}  // namespace

int benard_grid(const InputRequest& request) {
  BenardGrid experiment(files::read_benard_grid(request.input, request.overrides));
  return run_experiment(request, experiment);
}

}  // namespace lucy::program
