// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy shear-wave` and `lucy temperature-wave` on the way of run_experiment.hpp: shear_wave.csv or
// temperature_wave.csv is the results file, local.csv, forms.csv, amplitude.csv and notes.txt are its companions.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "lucy/files/wave_csv.hpp"
#include "lucy/files/wave_input.hpp"
#include "lucy/files/wave_text.hpp"
#include "program/closing.hpp"
#include "program/commands.hpp"
#include "program/notes.hpp"
#include "program/run_experiment.hpp"
#include "program/scheduler.hpp"
#include "program/wave_point.hpp"

namespace lucy::program {

namespace {

namespace fs = std::filesystem;

/// "shear_wave", of the results file and of the pictures.
std::string stem_of(cases::WaveQuantity quantity) { return fs::path(files::wave_file_name(quantity)).stem().string(); }

class Waves final : public Experiment {
 public:
  explicit Waves(files::WaveInput input) : input_(std::move(input)) {}

  std::string kind() const override { return std::string(files::command_name(input_.quantity)) + " run"; }
  std::string resolved() const override { return files::wave_resolved_toml(input_); }
  std::string results_file() const override { return files::wave_file_name(input_.quantity); }
  int threads() const override { return input_.threads; }
  double checkpoint_interval() const override { return input_.checkpoint_interval; }
  std::uint64_t seed() const override { return input_.points.front().seed; }
  std::string generator() const override {
    return "64-bit Mersenne twister (std::mt19937_64), one per replica, seeded from the seed, the replica's number and "
           "all physical settings";
  }

  std::vector<StatePoint*> prepare(const fs::path& directory, const files::H5mdAuthorship& authorship) override {
    std::vector<StatePoint*> points;
    for (const auto& point : input_.points) {
      points_.push_back(
          std::make_unique<WaveStatePoint>(point, directory / point_file_name(points_.size()), authorship));
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
    std::vector<cases::WaveResult> results;
    Notes notes;
    for (const auto& point : points_) {
      results.push_back(point->result());
      const cases::WaveRow& row = rows_.emplace_back(point->result().row);
      if (!row.warnings.empty()) notes.warnings[rows_.size() - 1] = row.warnings;
    }
    notes.failures = failures_of(rows_);
    files::write_local_csv(directory / "local.csv", results);
    files::write_forms_csv(directory / "forms.csv", results);
    files::write_amplitude_csv(directory / "amplitude.csv", input_.quantity, results);
    write_notes(directory / "notes.txt", notes);
  }

  void write_results(const fs::path& directory) override {
    files::write_wave_csv(directory / results_file(), input_.quantity, rows_);
  }

  void read_back(const fs::path& directory) override {
    const fs::path table = directory / results_file();
    rows_ = files::read_wave_csv(table, input_.quantity);
    const auto is_of = [](const cases::WaveRow& row, const cases::WavePoint& point) {
      return files::same_settings(row.settings, point);
    };
    const Notes notes = notes_beside(table, rows_, input_.points, is_of);
    for (const auto& [row, sentences] : notes.warnings)
      if (row < rows_.size()) rows_[row].warnings = sentences;
  }

  int print(const fs::path& directory, const std::string& closing, bool draw) override {
    const std::string stem = stem_of(input_.quantity);
    program::print("{}", files::format_waves(rows_));
    program::print("\n{}\n", closing);
    std::fflush(stdout);
    const fs::path picture = directory / (stem + ".png");
    std::error_code error;
    if (draw && !fs::exists(picture, error)) program::draw({{"plot_waves.py", {directory.string()}, picture}});
    std::vector<std::string> names = {results_file(), "local.csv",      "forms.csv",       "amplitude.csv",
                                      "notes.txt",    "input.toml",     "provenance.json", stem + ".png",
                                      stem + ".svg",  "amplitudes.png", "amplitudes.svg"};
    for (std::size_t i = 0; i < rows_.size(); ++i) names.push_back(point_file_name(i));
    print_files(directory, names);
    return tell_failures(rows_);
  }

 private:
  files::WaveInput input_;
  std::vector<std::unique_ptr<WaveStatePoint>> points_;
  std::vector<cases::WaveRow> rows_;
};

}  // namespace

int wave(const InputRequest& request, cases::WaveQuantity quantity) {
  Waves experiment(files::read_wave(quantity, request.input, request.overrides));
  return run_experiment(request, experiment);
}

}  // namespace lucy::program
