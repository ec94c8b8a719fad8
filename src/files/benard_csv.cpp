// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/benard_csv.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <variant>

#include "choice_names.hpp"
#include "lucy/files/csv.hpp"
#include "row_cells.hpp"

namespace lucy::files {

namespace {

using cases::BenardPoint;
using cases::BenardRow;

/// The settings that hold one real number each; rows have those that may be unset, too, since they are resolved.
struct Setting {
  std::string_view name;
  std::variant<double BenardPoint::*, std::optional<double> BenardPoint::*> member;
};
constexpr std::array<Setting, 12> settings = {{
    {"height", &BenardPoint::height},
    {"width", &BenardPoint::width},
    {"hot", &BenardPoint::hot},
    {"cold", &BenardPoint::cold},
    {"gravity", &BenardPoint::gravity},
    {"rayleigh", &BenardPoint::rayleigh},
    {"viscosity", &BenardPoint::viscosity},
    {"conductivity", &BenardPoint::conductivity},
    {"bulk_viscosity", &BenardPoint::bulk_viscosity},
    {"roll_velocity", &BenardPoint::roll_velocity},
    {"disorder", &BenardPoint::disorder},
    {"step", &BenardPoint::step},
}};

double get(const BenardPoint& point, const Setting& setting) {
  if (const auto* always = std::get_if<double BenardPoint::*>(&setting.member)) return point.**always;
  return (point.*std::get<std::optional<double> BenardPoint::*>(setting.member)).value();
}

void set(BenardPoint& point, const Setting& setting, double value) {
  std::visit([&](auto member) { point.*member = value; }, setting.member);
}

}  // namespace

std::vector<std::string> benard_columns() {
  std::vector<std::string> columns = {"particles", "equation_of_state", "kernel", "range", "side", "wall"};
  for (const Setting& setting : settings) columns.emplace_back(setting.name);
  for (const auto* name : {"density_mean", "duration", "replicas", "equilibration"}) columns.emplace_back(name);
  for (const auto name : cases::benard_quantities) add_with_error(columns, name);
  for (const auto* name : {"effective_samples", "equilibration_discarded", "worst_energy_error", "energy_drift",
                           "subdivided_steps", "reflections", "status"})
    columns.emplace_back(name);
  return columns;
}

void write_benard_csv(const std::filesystem::path& path, std::span<const BenardRow> rows) {
  write_rows(path, benard_columns(), rows, [](CsvLine& line, const BenardRow& row) {
    const BenardPoint& point = row.settings;
    line.add(point.particles);
    line.add(name_of(cases::benard_fluid_names, point.equation_of_state));
    line.add(name_of(kernel::weight_names, point.weight));
    line.add(point.range);
    line.add(name_of(grid::sides_names, point.sides));
    line.add(name_of(space::wall_kind_names, point.wall));
    for (const Setting& setting : settings) line.add(get(point, setting));
    line.add(name_of(spam::density_mean_names, point.density_mean));
    line.add(row.duration);
    line.add(static_cast<std::int64_t>(point.replicas));
    line.add(point.equilibration);
    for (const auto& estimate : row.estimates) add(line, estimate);
    line.add(row.effective_samples);
    line.add(row.equilibration_discarded);
    line.add(row.worst_energy_error);
    line.add(row.energy_drift);
    line.add(row.subdivided_steps);
    line.add(row.reflections);
    line.add(cases::status_name(row.status));
  });
}

std::vector<BenardRow> read_benard_csv(const std::filesystem::path& path) {
  return read_rows<BenardRow>(path, benard_columns(), "benard.csv", [](const RowCells& cells, BenardRow& row) {
    BenardPoint& point = row.settings;
    point.particles = cells.integer("particles");
    point.equation_of_state = cells.choice("equation_of_state", cases::benard_fluid_names);
    point.weight = cells.choice("kernel", kernel::weight_names);
    point.range = cells.number("range");
    point.sides = cells.choice("side", grid::sides_names);
    point.wall = cells.choice("wall", space::wall_kind_names);
    for (const Setting& setting : settings) set(point, setting, cells.number(setting.name));
    point.density_mean = cells.choice("density_mean", spam::density_mean_names);
    row.duration = cells.number("duration");
    point.duration = row.duration;
    point.replicas = cells.count("replicas");
    point.equilibration = cells.number("equilibration");
    for (std::size_t i = 0; i < row.estimates.size(); ++i)
      row.estimates[i] = cells.estimate(cases::benard_quantities[i]);
    row.effective_samples = cells.number("effective_samples");
    row.equilibration_discarded = cells.number("equilibration_discarded");
    row.worst_energy_error = cells.number("worst_energy_error");
    row.energy_drift = cells.number("energy_drift");
    row.subdivided_steps = cells.integer("subdivided_steps");
    row.reflections = cells.integer("reflections");
    row.status = cells.status();
  });
}

}  // namespace lucy::files
