// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy shear-flow`: viscous fluids of smooth particles under shear, on the way of run_experiment.hpp. shear_flow.csv
// is the results file, notes.txt its companion.
#include <string>
#include <vector>

#include "lucy/files/shear_flow_csv.hpp"
#include "lucy/files/shear_flow_input.hpp"
#include "lucy/files/shear_flow_text.hpp"
#include "program/case_experiment.hpp"
#include "program/closing.hpp"
#include "program/commands.hpp"
#include "program/notes.hpp"
#include "program/run_experiment.hpp"
#include "program/shear_flow_point.hpp"

namespace lucy::program {

namespace {

namespace fs = std::filesystem;

class ShearFlow final : public CaseExperiment<files::ShearFlowInput, ShearFlowStatePoint, cases::ShearFlowRow> {
 public:
  using CaseExperiment::CaseExperiment;

  std::string kind() const override { return "shear-flow run"; }
  std::string resolved() const override { return files::shear_flow_resolved_toml(input_); }
  std::string results_file() const override { return "shear_flow.csv"; }

  void write_companions(const fs::path& directory) override {
    for (const auto& point : points_) rows_.push_back(point->result());
    write_notes(directory / "notes.txt", {failures_of(rows_), warnings_of(rows_), ""});
  }

  void write_results(const fs::path& directory) override {
    files::write_shear_flow_csv(directory / results_file(), rows_);
  }

  void read_back(const fs::path& directory) override {
    const fs::path table = directory / results_file();
    rows_ = files::read_shear_flow_csv(table);
    notes_beside(table, rows_, input_.points, [](const cases::ShearFlowRow& row, const cases::ShearFlowPoint& point) {
      return row.settings.particles == point.particles && row.settings.strain_rate == point.strain_rate &&
             row.settings.equation_of_state == point.equation_of_state && row.settings.viscosity == point.viscosity;
    });
  }

  int print(const fs::path& directory, const std::string& closing, bool draw) override {
    program::print("{}", files::format_shear_flow(rows_));
    std::vector<Drawing> drawings;
    if (draw) drawings = {{"plot_shear_flow.py", {directory.string()}, directory / "shear_flow.png"}};
    print_closing(directory, closing, drawings,
                  with_point_files({results_file(), "notes.txt", "input.toml", "provenance.json", "shear_flow.png",
                                    "shear_flow.svg"}));
    return tell_failures(rows_);
  }

 private:
  std::string also_seeded_from() const override { return ", and the settings of fluid, start and shear"; }
};

}  // namespace

int shear_flow(const InputRequest& request) {
  ShearFlow experiment(files::read_shear_flow(request.input, request.overrides));
  return run_experiment(request, experiment);
}

}  // namespace lucy::program
