// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy benard`: convection of smooth particles between a hot floor and a cold ceiling, on the way of
// run_experiment.hpp. benard.csv is the results file, notes.txt its companion.
#include <string>
#include <vector>

#include "lucy/files/benard_csv.hpp"
#include "lucy/files/benard_input.hpp"
#include "lucy/files/benard_text.hpp"
#include "program/benard_point.hpp"
#include "program/case_experiment.hpp"
#include "program/closing.hpp"
#include "program/commands.hpp"
#include "program/notes.hpp"
#include "program/run_experiment.hpp"

namespace lucy::program {

namespace {

namespace fs = std::filesystem;

class Benard final : public CaseExperiment<files::BenardInput, BenardStatePoint, cases::BenardRow> {
 public:
  using CaseExperiment::CaseExperiment;

  std::string kind() const override { return "benard run"; }
  std::string resolved() const override { return files::benard_resolved_toml(input_); }
  std::string results_file() const override { return "benard.csv"; }

  void write_companions(const fs::path& directory) override {
    for (const auto& point : points_) rows_.push_back(point->result());
    write_notes(directory / "notes.txt", {failures_of(rows_), warnings_of(rows_), ""});
  }

  void write_results(const fs::path& directory) override { files::write_benard_csv(directory / results_file(), rows_); }

  void read_back(const fs::path& directory) override {
    const fs::path table = directory / results_file();
    rows_ = files::read_benard_csv(table);
    notes_beside(table, rows_, input_.points, [](const cases::BenardRow& row, const cases::BenardPoint& point) {
      return row.settings.particles == point.particles && row.settings.weight == point.weight &&
             row.settings.wall == point.wall && row.settings.equation_of_state == point.equation_of_state &&
             row.settings.rayleigh == cases::resolved(point).rayleigh;
    });
  }

  int print(const fs::path& directory, const std::string& closing, bool draw) override {
    program::print("{}", files::format_benard(rows_));
    std::vector<Drawing> drawings;
    if (draw) drawings = {{"plot_benard.py", {directory.string()}, directory / "benard.png"}};
    print_closing(
        directory, closing, drawings,
        with_point_files({results_file(), "notes.txt", "input.toml", "provenance.json", "benard.png", "benard.svg"}));
    return tell_failures(rows_);
  }

 private:
  std::string also_seeded_from() const override { return ", the number of particles and the disorder of the start"; }
};

}  // namespace

int benard(const InputRequest& request) {
  Benard experiment(files::read_benard(request.input, request.overrides));
  return run_experiment(request, experiment);
}

}  // namespace lucy::program
