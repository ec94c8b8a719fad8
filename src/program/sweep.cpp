// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy sweep`: a table of Couette points. The way from input to pictures is that of run_experiment.hpp; table.csv is
// the results file, replicas.csv and notes.txt are its companions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <system_error>
#include <vector>

#include "lucy/errors.hpp"
#include "lucy/files/input.hpp"
#include "lucy/files/table_csv.hpp"
#include "lucy/files/table_text.hpp"
#include "program/case_experiment.hpp"
#include "program/closing.hpp"
#include "program/commands.hpp"
#include "program/couette_point.hpp"
#include "program/notes.hpp"
#include "program/run_experiment.hpp"

namespace lucy::program {

namespace {

using files::format_plain;
namespace fs = std::filesystem;

/// One line on what the watch over the energy saw, over all rows that did not fail.
std::string energy_note(const std::vector<PointResult>& results) {
  double worst = 0.0;
  double most = 0.0;
  std::int64_t steps = 0;
  std::int64_t subdivided = 0;
  for (const auto& result : results) {
    for (const auto& replica : result.replicas) {
      if (result.row.status == cases::RowStatus::failed) continue;
      worst = std::max(worst, replica.worst_energy_error);
      if (std::abs(replica.energy_rescaled) > std::abs(most)) most = replica.energy_rescaled;
      steps += replica.steps;
      subdivided += replica.subdivided_steps;
    }
  }
  if (steps == 0) return "";
  const std::string rescaled =
      most == 0.0
          ? "nothing was rescaled"
          : fmt::format("rescaling put back {} over the run of the replica that needed most", format_plain(most, 2));
  return fmt::format("Energy per particle: largest error of one step {};\n{}.\nSteps subdivided: {} of {}.",
                     format_plain(worst, 2), rescaled, subdivided, steps);
}

/// What a reader has to know beside the table, one or two lines each.
std::vector<std::string> notes_on(const std::vector<cases::CouettePoint>& points,
                                  const std::vector<PointResult>& results) {
  std::vector<std::string> notes;
  if (std::string note = energy_note(results); !note.empty()) notes.push_back(std::move(note));
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i].row.spread.contradicts_errors())
      notes.push_back(
          fmt::format("Warning: {}: the replicas differ by more than their error bars allow (chi squared {} for "
                      "{} degrees\nof freedom, p = {}): do not believe the error bar, run longer.",
                      point_label(points[i]), format_plain(results[i].row.spread.chi_squared, 3),
                      results[i].row.spread.degrees_of_freedom, format_plain(results[i].row.spread.p_value, 2)));
  return notes;
}

std::vector<Drawing> drawings_of(const fs::path& directory, const std::vector<cases::CouettePoint>& points) {
  std::vector<Drawing> drawings = {{"plot_viscosity.py", {directory.string()}, directory / "viscosity.png"}};
  std::error_code error;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto series = directory / point_file_name(i);
    const auto picture = directory / fmt::format("configuration_{:03}.png", i + 1);
    if (points[i].frame_interval > 0.0 && fs::exists(series, error))
      drawings.push_back({"plot_configuration.py", {series.string(), picture.string()}, picture});
  }
  return drawings;
}

class Sweep final : public CaseExperiment<files::SweepInput, CouetteStatePoint, cases::TableRow> {
 public:
  using CaseExperiment::CaseExperiment;

  std::string kind() const override { return "sweep"; }
  std::string resolved() const override { return files::resolved_toml(input_); }
  std::string results_file() const override { return "table.csv"; }

  void write_companions(const fs::path& directory) override {
    std::vector<PointResult> results;
    std::vector<cases::ReplicaRow> replicas;
    for (const auto& point : points_) {
      results.push_back(point->result());
      rows_.push_back(point->result().row);
      replicas.insert(replicas.end(), point->result().replicas.begin(), point->result().replicas.end());
    }
    Notes notes;
    for (const auto& note : notes_on(input_.points, results)) notes_ += note + '\n';
    notes.others = notes_;
    notes.failures = failures_of(rows_);
    files::write_replicas_csv(directory / "replicas.csv", replicas);
    write_notes(directory / "notes.txt", notes);
  }

  void write_results(const fs::path& directory) override { files::write_table_csv(directory / "table.csv", rows_); }

  void read_back(const fs::path& directory) override {
    const fs::path table = directory / "table.csv";
    rows_ = files::read_table_csv(table);
    const auto is_of = [](const cases::TableRow& row, const cases::CouettePoint& point) {
      return row.particles == point.particles && row.strain_rate == point.strain_rate &&
             row.energy_per_particle == point.energy_per_particle;
    };
    notes_ = notes_beside(table, rows_, input_.points, is_of).others;
  }

  int print(const fs::path& directory, const std::string& closing, bool draw) override {
    program::print("{}", files::format_table(rows_));
    if (!notes_.empty()) program::print("\n{}", notes_);
    std::vector<std::string> names = {"table.csv",       "replicas.csv",  "notes.txt",    "input.toml",
                                      "provenance.json", "viscosity.png", "viscosity.svg"};
    for (std::size_t i = 0; i < input_.points.size(); ++i) {
      names.push_back(point_file_name(i));
      names.push_back(fmt::format("configuration_{:03}.png", i + 1));
    }
    print_closing(directory, closing, draw ? drawings_of(directory, input_.points) : std::vector<Drawing>(), names);
    return tell_failures(rows_);
  }

 private:
  std::string also_seeded_from() const override { return ", N, E/N and the strain rate"; }

  std::string notes_;
};

}  // namespace

int sweep(const InputRequest& request) {
  Sweep experiment(files::read_sweep(request.input, request.overrides));
  return run_experiment(request, experiment);
}

}  // namespace lucy::program
