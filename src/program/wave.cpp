// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy shear-wave` and `lucy temperature-wave` on the way of run_experiment.hpp: shear_wave.csv or
// temperature_wave.csv is the results file, local.csv, forms.csv, amplitude.csv and notes.txt are its companions.
#include <string>
#include <vector>

#include "lucy/files/wave_csv.hpp"
#include "lucy/files/wave_input.hpp"
#include "lucy/files/wave_text.hpp"
#include "program/case_experiment.hpp"
#include "program/closing.hpp"
#include "program/commands.hpp"
#include "program/notes.hpp"
#include "program/run_experiment.hpp"
#include "program/wave_point.hpp"

namespace lucy::program {

namespace {

namespace fs = std::filesystem;

class Waves final : public CaseExperiment<files::WaveInput, WaveStatePoint, cases::WaveRow> {
 public:
  using CaseExperiment::CaseExperiment;

  std::string kind() const override { return std::string(files::command_name(input_.quantity)) + " run"; }
  std::string resolved() const override { return files::wave_resolved_toml(input_); }
  std::string results_file() const override { return files::wave_file_name(input_.quantity); }

  void write_companions(const fs::path& directory) override {
    std::vector<cases::WaveResult> results;
    for (const auto& point : points_) {
      results.push_back(point->result());
      rows_.push_back(point->result().row);
    }
    files::write_local_csv(directory / "local.csv", results);
    files::write_forms_csv(directory / "forms.csv", results);
    files::write_amplitude_csv(directory / "amplitude.csv", input_.quantity, results);
    write_notes(directory / "notes.txt", {failures_of(rows_), warnings_of(rows_), ""});
  }

  void write_results(const fs::path& directory) override {
    files::write_wave_csv(directory / results_file(), input_.quantity, rows_);
  }

  void read_back(const fs::path& directory) override {
    const fs::path table = directory / results_file();
    rows_ = files::read_wave_csv(table, input_.quantity);
    notes_beside(table, rows_, input_.points, [](const cases::WaveRow& row, const cases::WavePoint& point) {
      return files::same_settings(row.settings, point);
    });
  }

  int print(const fs::path& directory, const std::string& closing, bool draw) override {
    program::print("{}", files::format_waves(rows_));
    // "shear_wave", of the results file and of the pictures
    const std::string stem = fs::path(results_file()).stem().string();
    std::vector<Drawing> drawings;
    if (draw) drawings = {{"plot_waves.py", {directory.string()}, directory / (stem + ".png")}};
    print_closing(
        directory, closing, drawings,
        with_point_files({results_file(), "local.csv", "forms.csv", "amplitude.csv", "notes.txt", "input.toml",
                          "provenance.json", stem + ".png", stem + ".svg", "amplitudes.png", "amplitudes.svg"}));
    return tell_failures(rows_);
  }

 private:
  std::string also_seeded_from() const override { return " and all physical settings"; }
};

}  // namespace

int wave(const InputRequest& request, cases::WaveQuantity quantity) {
  Waves experiment(files::read_wave(quantity, request.input, request.overrides));
  return run_experiment(request, experiment);
}

}  // namespace lucy::program
