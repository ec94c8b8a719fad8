// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/table_csv.hpp"

#include <fmt/format.h>

#include "lucy/files/atomic_file.hpp"
#include "lucy/files/csv.hpp"
#include "row_cells.hpp"

namespace lucy::files {

using cases::TableRow;

std::vector<std::string> table_columns() {
  std::vector<std::string> columns = {"particles", "energy_per_particle", "strain_rate", "step", "duration",
                                      "replicas"};
  for (const auto name : cases::quantities) add_with_error(columns, name);
  for (const auto* name :
       {"effective_samples", "equilibration_discarded", "worst_energy_error", "subdivided_steps", "status"})
    columns.emplace_back(name);
  return columns;
}

void write_table_csv(const std::filesystem::path& path, std::span<const TableRow> rows) {
  write_rows(path, table_columns(), rows, [](CsvLine& line, const TableRow& row) {
    line.add(row.particles);
    line.add(row.energy_per_particle);
    line.add(row.strain_rate);
    line.add(row.step);
    line.add(row.duration);
    line.add(static_cast<std::int64_t>(row.replicas));
    for (const auto& estimate : row.estimates) add(line, estimate);
    line.add(row.effective_samples);
    line.add(row.equilibration_discarded);
    line.add(row.worst_energy_error);
    line.add(row.subdivided_steps);
    line.add(cases::status_name(row.status));
  });
}

void write_replicas_csv(const std::filesystem::path& path, std::span<const cases::ReplicaRow> rows) {
  std::string text =
      "particles,energy_per_particle,strain_rate,replica,seed,viscosity,viscosity_error,energy_rescaled,"
      "worst_energy_error,steps,subdivided_steps\n";
  CsvLine line;
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
  return read_rows<TableRow>(path, table_columns(), "table.csv", [](const RowCells& cells, TableRow& row) {
    row.particles = cells.integer("particles");
    row.energy_per_particle = cells.number("energy_per_particle");
    row.strain_rate = cells.number("strain_rate");
    row.step = cells.number("step");
    row.duration = cells.number("duration");
    row.replicas = cells.count("replicas");
    for (std::size_t i = 0; i < cases::quantities.size(); ++i) row.estimates[i] = cells.estimate(cases::quantities[i]);
    row.effective_samples = cells.number("effective_samples");
    row.equilibration_discarded = cells.number("equilibration_discarded");
    row.worst_energy_error = cells.number("worst_energy_error");
    row.subdivided_steps = cells.integer("subdivided_steps");
    row.status = cells.status();
  });
}

}  // namespace lucy::files
