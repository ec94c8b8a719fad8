// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy green-kubo`: equilibrium states on the way of run_experiment.hpp, with viscosity.csv as the results file and
// correlation.csv, pairs.csv and notes.txt as its companions; or, with --from-series, the same estimators on stresses
// that another program sampled, which takes no time worth a checkpoint.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/checkpoint.hpp"
#include "lucy/files/directory_lock.hpp"
#include "lucy/files/green_kubo_csv.hpp"
#include "lucy/files/green_kubo_input.hpp"
#include "lucy/files/green_kubo_text.hpp"
#include "lucy/files/schema.hpp"
#include "lucy/files/series_file.hpp"
#include "program/build_identity.hpp"
#include "program/case_experiment.hpp"
#include "program/closing.hpp"
#include "program/commands.hpp"
#include "program/green_kubo_point.hpp"
#include "program/notes.hpp"
#include "program/output_directory.hpp"
#include "program/run_experiment.hpp"
#include "program/scheduler.hpp"

namespace lucy::program {

namespace {

namespace fs = std::filesystem;

constexpr double off_time = 0.05;  // of an interval: a time of the file is rounded, not another one

Notes notes_of(const std::vector<cases::GreenKuboRow>& rows) { return {failures_of(rows), warnings_of(rows), ""}; }

/// Returns the exit code. `point_files`: of the states.
int print_rows(const fs::path& directory, const std::vector<cases::GreenKuboRow>& rows, const std::string& closing,
               bool draw, const std::vector<std::string>& point_files) {
  print("{}", files::format_green_kubo(rows));
  std::vector<Drawing> drawings;
  if (draw) drawings = {{"plot_green_kubo.py", {directory.string()}, directory / "correlation.png"}};
  std::vector<std::string> names = {"viscosity.csv", "correlation.csv", "pairs.csv",       "notes.txt",
                                    "input.toml",    "provenance.json", "correlation.png", "correlation.svg"};
  names.insert(names.end(), point_files.begin(), point_files.end());
  print_closing(directory, closing, drawings, names);
  return tell_failures(rows);
}

class GreenKubo final : public CaseExperiment<files::GreenKuboInput, GreenKuboStatePoint, cases::GreenKuboRow> {
 public:
  GreenKubo(files::GreenKuboInput input, bool pictures) : CaseExperiment(std::move(input)), pictures_(pictures) {}

  std::string kind() const override { return "Green-Kubo run"; }
  std::string resolved() const override { return files::green_kubo_resolved_toml(input_); }
  std::string results_file() const override { return "viscosity.csv"; }

  void write_companions(const fs::path& directory) override {
    std::vector<cases::GreenKuboResult> results;
    for (const auto& point : points_) {
      results.push_back(point->result());
      rows_.push_back(point->result().row);
    }
    files::write_correlation_csv(directory / "correlation.csv", results);
    files::write_pairs_csv(directory / "pairs.csv", results);
    write_notes(directory / "notes.txt", notes_of(rows_));
  }

  void write_results(const fs::path& directory) override {
    files::write_viscosity_csv(directory / results_file(), rows_);
  }

  void read_back(const fs::path& directory) override {
    const fs::path table = directory / results_file();
    rows_ = files::read_viscosity_csv(table);
    notes_beside(table, rows_, input_.points, [](const cases::GreenKuboRow& row, const cases::GreenKuboPoint& point) {
      return row.particles == point.particles && row.energy_per_particle == point.energy_per_particle;
    });
  }

  int print(const fs::path& directory, const std::string& closing, bool draw) override {
    return print_rows(directory, rows_, closing, draw && pictures_, with_point_files({}));
  }

 private:
  std::string also_seeded_from() const override { return ", N and E/N"; }

  bool pictures_;
};

/// The columns that are asked for, or else those with the usual names.
/// Where the file has a column of times, its rows must follow each other as --interval says.
void check_times(const files::ColumnFile& file, const SeriesRequest& request) {
  const auto place = std::ranges::find(file.names, "time") - file.names.begin();
  if (static_cast<std::size_t>(place) == file.names.size()) return;
  const auto& time = file.columns[static_cast<std::size_t>(place)];
  for (std::size_t row = 1; row < time.size(); ++row) {
    const double expected = time.front() + static_cast<double>(row) * request.interval;
    if (!(std::abs(time[row] - expected) < off_time * request.interval))
      throw BadInput(fmt::format("{}: row {} has the time {} where --interval = {} from row 1 on, {}, makes it {:.10g}",
                                 request.file.string(), row + 1, time[row], request.interval, time.front(), expected));
  }
}

cases::SampledSeries sampled_series(const SeriesRequest& request) {
  files::ColumnFile file = files::read_columns(request.file);
  cases::SampledSeries series;
  const auto column = [&](const std::string& name) -> const std::vector<double>& {
    return file.columns[files::find_column(file, name, request.file)];
  };
  if (request.difference && (request.pxx || request.pyy))
    throw BadInput("--difference already is (Pxx - Pyy)/2: leave out --pxx and --pyy");
  series.pxy = column(request.pxy);
  if (request.difference) {
    series.stress_difference = column(*request.difference);
  } else {
    const auto& pxx = column(request.pxx.value_or("pxx"));
    const auto& pyy = column(request.pyy.value_or("pyy"));
    series.stress_difference.resize(pxx.size());
    for (std::size_t i = 0; i < pxx.size(); ++i) series.stress_difference[i] = 0.5 * (pxx[i] - pyy[i]);
  }
  const auto above_zero = [](const char* option, double value) {
    if (!(value > 0.0)) throw BadInput(fmt::format("{} = {} must be above 0", option, value));
    return value;
  };
  series.sample_interval = above_zero("--interval", request.interval);
  check_times(file, request);
  series.volume = above_zero("--volume", request.volume);
  series.kinetic_temperature = above_zero("--temperature", request.temperature);
  if (request.length) series.length = above_zero("--length", *request.length);
  if (request.cutoff) series.cutoff = above_zero("--cutoff", *request.cutoff);
  return series;
}

/// What input.toml says of a series: enough to do it again.
std::string series_record(const SeriesRequest& request, const cases::SampledSeries& series) {
  const auto checksum = [&] {
    const auto a = files::crc64(std::as_bytes(std::span(series.pxy)));
    return files::crc64(std::as_bytes(std::span(series.stress_difference)), a);
  };
  std::string text = "# A stress series that was sampled elsewhere, analysed by lucy green-kubo --from-series.\n\n";
  const auto line = [&](const char* key, const files::Value& value) {
    text += fmt::format("{} = {}\n", key, files::toml_text(value));
  };
  line("file", fs::absolute(request.file).lexically_normal().string());
  line("rows", static_cast<std::int64_t>(series.pxy.size()));
  line("checksum", fmt::format("CRC-64 {:016x}", checksum()));
  line("sample_interval", series.sample_interval);
  line("volume", series.volume);
  line("kinetic_temperature", series.kinetic_temperature);
  if (series.length > 0.0) line("length", series.length);
  if (series.cutoff > 0.0) line("cutoff", series.cutoff);
  return text;
}

}  // namespace

int green_kubo(const InputRequest& request, bool pictures) {
  GreenKubo experiment(files::read_green_kubo(request.input, request.overrides), pictures);
  return run_experiment(request, experiment);
}

int green_kubo_series(const SeriesRequest& request) {
  const auto started = std::chrono::system_clock::now();
  const cases::SampledSeries series = sampled_series(request);
  const std::string record = series_record(request, series);
  const fs::path directory = request.out.value_or(fs::path("runs") / request.file.stem());
  const auto look = [&] { look_at_directory(directory, record, "analysis of this series", "viscosity.csv"); };
  look();
  const cases::GreenKuboResult result = cases::summarize_series(series);

  make_directory(directory);
  const files::DirectoryLock lock(directory);
  look();
  files::write_file_atomically(directory / "input.toml", record);
  files::write_correlation_csv(directory / "correlation.csv", {&result, 1});
  write_notes(directory / "notes.txt", notes_of({result.row}));
  files::Provenance provenance = provenance_of(request.command_line);
  provenance.generator = "none";
  provenance.threads = 1;
  provenance.started = started;
  provenance.finished = std::chrono::system_clock::now();
  provenance.wall_seconds_of_this_session = std::chrono::duration<double>(provenance.finished - started).count();
  provenance.wall_seconds_of_points = {provenance.wall_seconds_of_this_session};
  files::write_provenance(directory / "provenance.json", provenance);
  files::write_viscosity_csv(directory / "viscosity.csv", {&result.row, 1});
  return print_rows(
      directory, {result.row},
      fmt::format("{} rows of {}, one every {}.", series.pxy.size(), request.file.string(), series.sample_interval),
      request.pictures, {});
}

}  // namespace lucy::program
