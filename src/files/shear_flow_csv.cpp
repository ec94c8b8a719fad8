// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/shear_flow_csv.hpp"

#include <array>
#include <string_view>

#include "choice_names.hpp"
#include "lucy/files/csv.hpp"
#include "row_cells.hpp"

namespace lucy::files {

namespace {

using cases::ShearFlowRow;

/// The settings that hold one real number each.
struct Setting {
  std::string_view name;
  double cases::FluidSettings::*member;
};
constexpr std::array<Setting, 9> settings = {{
    {"density", &cases::FluidSettings::density},
    {"range", &cases::FluidSettings::range},
    {"start_temperature", &cases::FluidSettings::temperature},
    {"prescribed_viscosity", &cases::FluidSettings::viscosity},
    {"prescribed_bulk_viscosity", &cases::FluidSettings::bulk_viscosity},
    {"prescribed_conductivity", &cases::FluidSettings::conductivity},
    {"start_disorder", &cases::FluidSettings::disorder},
    {"start_noise", &cases::FluidSettings::noise},
    {"step", &cases::FluidSettings::step},
}};

}  // namespace

std::vector<std::string> shear_flow_columns() {
  std::vector<std::string> columns = {"particles", "equation_of_state", "kernel", "cooling", "strain_rate"};
  for (const Setting& setting : settings) columns.emplace_back(setting.name);
  columns.emplace_back("duration");
  columns.emplace_back("replicas");
  for (const auto name : cases::shear_flow_quantities) add_with_error(columns, name);
  for (const auto* name : {"effective_samples", "equilibration_discarded", "worst_energy_error", "energy_drift",
                           "subdivided_steps", "status"})
    columns.emplace_back(name);
  return columns;
}

void write_shear_flow_csv(const std::filesystem::path& path, std::span<const ShearFlowRow> rows) {
  write_rows(path, shear_flow_columns(), rows, [](CsvLine& line, const ShearFlowRow& row) {
    line.add(row.settings.particles);
    line.add(name_of(spam::equation_of_state_names, row.settings.equation_of_state));
    line.add(name_of(kernel::weight_names, row.settings.weight));
    line.add(name_of(motion::cooling_names, row.settings.cooling));
    line.add(row.settings.strain_rate);
    for (const Setting& setting : settings) line.add(row.settings.*setting.member);
    line.add(row.duration);
    line.add(static_cast<std::int64_t>(row.settings.replicas));
    for (const auto& estimate : row.estimates) add(line, estimate);
    line.add(row.effective_samples);
    line.add(row.equilibration_discarded);
    line.add(row.worst_energy_error);
    line.add(row.energy_drift);
    line.add(row.subdivided_steps);
    line.add(cases::status_name(row.status));
  });
}

std::vector<ShearFlowRow> read_shear_flow_csv(const std::filesystem::path& path) {
  return read_rows<ShearFlowRow>(
      path, shear_flow_columns(), "shear_flow.csv", [](const RowCells& cells, ShearFlowRow& row) {
        row.settings.particles = cells.integer("particles");
        row.settings.equation_of_state = cells.choice("equation_of_state", spam::equation_of_state_names);
        row.settings.weight = cells.choice("kernel", kernel::weight_names);
        row.settings.cooling = cells.choice("cooling", motion::cooling_names);
        row.settings.strain_rate = cells.number("strain_rate");
        for (const Setting& setting : settings) row.settings.*setting.member = cells.number(setting.name);
        row.duration = cells.number("duration");
        row.settings.duration = row.duration;
        row.settings.replicas = cells.count("replicas");
        for (std::size_t i = 0; i < row.estimates.size(); ++i)
          row.estimates[i] = cells.estimate(cases::shear_flow_quantities[i]);
        row.effective_samples = cells.number("effective_samples");
        row.equilibration_discarded = cells.number("equilibration_discarded");
        row.worst_energy_error = cells.number("worst_energy_error");
        row.energy_drift = cells.number("energy_drift");
        row.subdivided_steps = cells.integer("subdivided_steps");
        row.status = cells.status();
      });
}

}  // namespace lucy::files
