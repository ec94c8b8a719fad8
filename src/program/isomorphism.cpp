// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy isomorphism`: atoms and smooth particles side by side, on the way of run_experiment.hpp. isomorphism.csv is the
// results file, notes.txt its companion.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "lucy/files/isomorphism_csv.hpp"
#include "lucy/files/isomorphism_input.hpp"
#include "lucy/files/isomorphism_text.hpp"
#include "program/case_experiment.hpp"
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

class Isomorphism final : public CaseExperiment<files::IsomorphismInput, IsomorphismStatePoint, cases::IsomorphismRow> {
 public:
  using CaseExperiment::CaseExperiment;

  std::string kind() const override { return "isomorphism run"; }
  std::string resolved() const override { return files::isomorphism_resolved_toml(input_); }
  std::string results_file() const override { return "isomorphism.csv"; }

  void write_companions(const fs::path& directory) override {
    for (const auto& point : points_) rows_.push_back(point->result());
    Notes notes;
    notes.failures = failures_of(rows_);
    for (const auto& row : rows_)
      if (row.status != cases::RowStatus::failed) notes.others += files::isomorphism_verdict(row);
    write_notes(directory / "notes.txt", notes);
  }

  void write_results(const fs::path& directory) override {
    files::write_isomorphism_csv(directory / results_file(), rows_);
  }

  void read_back(const fs::path& directory) override {
    const fs::path table = directory / results_file();
    rows_ = files::read_isomorphism_csv(table);
    const auto is_of = [](const cases::IsomorphismRow& row, const cases::IsomorphismPoint& point) {
      return row.particles == point.particles && row.strain_rate == point.strain_rate &&
             row.energy_per_particle == point.energy_per_particle;
    };
    notes_beside(table, rows_, input_.points, is_of);
  }

  int print(const fs::path& directory, const std::string& closing, bool /*draw*/) override {
    program::print("{}", files::format_isomorphism(rows_));
    print_closing(directory, closing, {}, {results_file(), "notes.txt", "input.toml", "provenance.json"});
    const int differences = tell_differences(rows_);
    return std::max(differences, tell_failures(rows_));
  }

 private:
  std::string also_seeded_from() const override { return ", N, E/N and the strain rate"; }
};

}  // namespace

int isomorphism(const InputRequest& request) {
  Isomorphism experiment(files::read_isomorphism(request.input, request.overrides));
  return run_experiment(request, experiment);
}

}  // namespace lucy::program
