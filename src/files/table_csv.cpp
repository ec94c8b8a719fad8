// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/table_csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/csv.hpp"

namespace lucy::files {

namespace {

using cases::RowStatus;
using cases::TableRow;

constexpr std::array statuses = {RowStatus::ok, RowStatus::too_short, RowStatus::failed};

std::optional<RowStatus> status_named(std::string_view name) {
  for (const RowStatus status : statuses)
    if (cases::status_name(status) == name) return status;
  return std::nullopt;
}

/// Cells of one line, separated by commas.
class Line {
 public:
  void add(double value) { add(shortest_text(value)); }
  void add(std::int64_t value) { add(fmt::format("{}", value)); }
  void add(std::string_view cell) {
    if (!first_) text_ += ',';
    first_ = false;
    text_ += cell;
  }
  std::string end() {
    first_ = true;
    return std::exchange(text_, {}) + '\n';
  }

 private:
  std::string text_;
  bool first_ = true;
};

}  // namespace

std::vector<std::string> table_columns() {
  std::vector<std::string> columns = {"particles", "energy_per_particle", "strain_rate", "step", "duration",
                                      "replicas"};
  for (const auto name : cases::quantities) {
    columns.emplace_back(name);
    columns.push_back(fmt::format("{}_error", name));
  }
  for (const auto* name :
       {"effective_samples", "equilibration_discarded", "worst_energy_error", "subdivided_steps", "status"})
    columns.emplace_back(name);
  return columns;
}

void write_table_csv(const std::filesystem::path& path, std::span<const TableRow> rows) {
  std::string text = fmt::format("{}\n", fmt::join(table_columns(), ","));
  Line line;
  for (const TableRow& row : rows) {
    line.add(row.particles);
    line.add(row.energy_per_particle);
    line.add(row.strain_rate);
    line.add(row.step);
    line.add(row.duration);
    line.add(static_cast<std::int64_t>(row.replicas));
    for (const auto& estimate : row.estimates) {
      line.add(estimate.value);
      line.add(estimate.error);
    }
    line.add(row.effective_samples);
    line.add(row.equilibration_discarded);
    line.add(row.worst_energy_error);
    line.add(row.subdivided_steps);
    line.add(cases::status_name(row.status));
    text += line.end();
  }
  write_file_atomically(path, text);
}

void write_replicas_csv(const std::filesystem::path& path, std::span<const cases::ReplicaRow> rows) {
  std::string text =
      "particles,energy_per_particle,strain_rate,replica,seed,viscosity,viscosity_error,energy_rescaled,"
      "worst_energy_error,steps,subdivided_steps\n";
  Line line;
  for (const cases::ReplicaRow& row : rows) {
    line.add(row.particles);
    line.add(row.energy_per_particle);
    line.add(row.strain_rate);
    line.add(static_cast<std::int64_t>(row.replica));
    line.add(fmt::format("{}", row.seed));
    line.add(row.viscosity);
    line.add(row.viscosity_error);
    line.add(row.energy_rescaled);
    line.add(row.worst_energy_error);
    line.add(row.steps);
    line.add(row.subdivided_steps);
    text += line.end();
  }
  write_file_atomically(path, text);
}

std::vector<TableRow> read_table_csv(const std::filesystem::path& path) {
  const CsvFile file(path);
  for (const auto& column : table_columns())
    if (!file.has_column(column))
      throw BadInput(fmt::format("{}:1: the header of a table.csv has a column {}; this one has {}", file.path(),
                                 column, fmt::join(file.columns(), ", ")));
  std::vector<TableRow> rows;
  for (const auto& cells : file.rows()) {
    const auto number = [&](std::string_view name) { return file.number(cells, file.column(name)); };
    const auto integer = [&](std::string_view name) { return file.integer(cells, file.column(name)); };
    TableRow row;
    row.particles = integer("particles");
    row.energy_per_particle = number("energy_per_particle");
    row.strain_rate = number("strain_rate");
    row.step = number("step");
    row.duration = number("duration");
    const std::int64_t replicas = integer("replicas");
    if (replicas < 0 || replicas > std::numeric_limits<int>::max())
      throw BadInput(
          fmt::format("{}:{}: replicas is {} where a count was expected", file.path(), cells.line, replicas));
    row.replicas = static_cast<int>(replicas);
    for (std::size_t i = 0; i < cases::quantities.size(); ++i) {
      row.estimates[i].value = number(cases::quantities[i]);
      row.estimates[i].error = number(fmt::format("{}_error", cases::quantities[i]));
      if (row.estimates[i].error < 0.0)
        throw BadInput(fmt::format("{}:{}: {}_error is {} where an error (at least 0, or nan) was expected",
                                   file.path(), cells.line, cases::quantities[i], row.estimates[i].error));
    }
    row.effective_samples = number("effective_samples");
    row.equilibration_discarded = number("equilibration_discarded");
    row.worst_energy_error = number("worst_energy_error");
    row.subdivided_steps = integer("subdivided_steps");
    const std::string& status = cells.cells[file.column("status")];
    const auto known = status_named(status);
    if (!known)
      throw BadInput(fmt::format("{}:{}: status is \"{}\" where ok, short or failed was expected", file.path(),
                                 cells.line, status));
    row.status = *known;
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace lucy::files
