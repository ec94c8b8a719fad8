// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/benard_grid_csv.hpp"

#include <array>
#include <optional>
#include <string_view>

#include "choice_names.hpp"
#include "lucy/files/csv.hpp"
#include "row_cells.hpp"

namespace lucy::files {

namespace {

using cases::BenardGridPoint;
using cases::BenardGridRow;

struct Setting {
  std::string_view name;
  std::optional<double> BenardGridPoint::*member;
};
constexpr std::array<Setting, 8> settings = {{
    {"rayleigh", &BenardGridPoint::rayleigh},
    {"width", &BenardGridPoint::width},
    {"gravity", &BenardGridPoint::gravity},
    {"viscosity", &BenardGridPoint::viscosity},
    {"conductivity", &BenardGridPoint::conductivity},
    {"roll_velocity", &BenardGridPoint::roll_velocity},
    {"step", &BenardGridPoint::step},
    {"duration", &BenardGridPoint::duration},
}};

struct Edge {
  std::string_view name;
  double BenardGridPoint::*member;
};
constexpr std::array<Edge, 3> edges = {{
    {"height", &BenardGridPoint::height},
    {"hot", &BenardGridPoint::hot},
    {"cold", &BenardGridPoint::cold},
}};

struct Quantity {
  std::string_view name;
  double BenardGridRow::*member;
};
constexpr std::array<Quantity, 11> quantities = {{
    {"time", &BenardGridRow::time},
    {"kinetic_energy", &BenardGridRow::kinetic_energy},
    {"nusselt_hot", &BenardGridRow::nusselt_hot},
    {"nusselt_cold", &BenardGridRow::nusselt_cold},
    {"nusselt_sides", &BenardGridRow::nusselt_sides},
    {"largest_speed", &BenardGridRow::largest_speed},
    {"energy_imbalance", &BenardGridRow::energy_imbalance},
    {"mass_error", &BenardGridRow::mass_error},
    {"change", &BenardGridRow::change},
    {"growth_rate", &BenardGridRow::growth_rate},
    {"growth_rate_error", &BenardGridRow::growth_rate_error},
}};

/// What says of which fluid in which cell a line of a companion is.
const std::vector<std::string> family_columns = {
    "equation_of_state", "transport", "side", "height", "width", "hot", "cold"};

void add_family(CsvLine& line, const BenardGridPoint& point) {
  line.add(name_of(cases::benard_fluid_names, point.equation_of_state));
  line.add(name_of(grid::transport_names, point.transport));
  line.add(name_of(grid::sides_names, point.sides));
  for (const double number : {point.height, *point.width, point.hot, point.cold}) line.add(number);
}

void add(CsvLine& line, const cases::Extrapolated& number) {
  line.add(number.value);
  line.add(number.error);
}

}  // namespace

std::vector<std::string> benard_grid_columns() {
  std::vector<std::string> columns = {"find", "equation_of_state", "transport", "side", "cells"};
  for (const Edge& edge : edges) columns.emplace_back(edge.name);
  for (const Setting& setting : settings) columns.emplace_back(setting.name);
  for (const Quantity& quantity : quantities) columns.emplace_back(quantity.name);
  columns.emplace_back("status");
  return columns;
}

void write_benard_grid_csv(const std::filesystem::path& path, std::span<const BenardGridRow> rows) {
  write_rows(path, benard_grid_columns(), rows, [](CsvLine& line, const BenardGridRow& row) {
    line.add(name_of(cases::benard_goal_names, row.settings.find));
    line.add(name_of(cases::benard_fluid_names, row.settings.equation_of_state));
    line.add(name_of(grid::transport_names, row.settings.transport));
    line.add(name_of(grid::sides_names, row.settings.sides));
    line.add(static_cast<std::int64_t>(row.settings.cells));
    for (const Edge& edge : edges) line.add(row.settings.*edge.member);
    for (const Setting& setting : settings) line.add((row.settings.*setting.member).value());
    for (const Quantity& quantity : quantities) line.add(row.*quantity.member);
    line.add(cases::status_name(row.status));
  });
}

std::vector<BenardGridRow> read_benard_grid_csv(const std::filesystem::path& path) {
  return read_rows<BenardGridRow>(
      path, benard_grid_columns(), "benard_grid.csv", [](const RowCells& cells, BenardGridRow& row) {
        BenardGridPoint& point = row.settings;
        point.find = cells.choice("find", cases::benard_goal_names);
        point.equation_of_state = cells.choice("equation_of_state", cases::benard_fluid_names);
        point.transport = cells.choice("transport", grid::transport_names);
        point.sides = cells.choice("side", grid::sides_names);
        point.cells = cells.count("cells");
        for (const Edge& edge : edges) point.*edge.member = cells.number(edge.name);
        for (const Setting& setting : settings) point.*setting.member = cells.number(setting.name);
        for (const Quantity& quantity : quantities) row.*quantity.member = cells.number(quantity.name);
        row.status = cells.status();
      });
}

void write_benard_limits_csv(const std::filesystem::path& path, std::span<const cases::BenardGridLimit> limits) {
  if (limits.empty()) return;
  std::vector<std::string> columns = family_columns;
  for (const auto* name : {"rayleigh", "viscosity", "conductivity", "meshes", "finest_cells"})
    columns.emplace_back(name);
  for (const auto* name : {"kinetic_energy", "nusselt_hot", "nusselt_cold"}) add_with_error(columns, name);
  write_rows(path, columns, limits, [](CsvLine& line, const cases::BenardGridLimit& limit) {
    add_family(line, limit.settings);
    for (const auto& number : {limit.settings.rayleigh, limit.settings.viscosity, limit.settings.conductivity})
      line.add(number.value());
    line.add(static_cast<std::int64_t>(limit.meshes));
    line.add(static_cast<std::int64_t>(limit.settings.cells));
    for (const auto& number : {limit.kinetic_energy, limit.nusselt_hot, limit.nusselt_cold}) add(line, number);
  });
}

void write_critical_csv(const std::filesystem::path& path, std::span<const cases::CriticalRayleigh> found) {
  if (found.empty()) return;
  std::vector<std::string> columns = family_columns;
  for (const auto* name : {"route", "cells", "points"}) columns.emplace_back(name);
  add_with_error(columns, "critical_rayleigh");
  write_rows(path, columns, found, [](CsvLine& line, const cases::CriticalRayleigh& critical) {
    add_family(line, critical.settings);
    line.add(name_of(cases::critical_route_names, critical.route));
    line.add(critical.cells > 0 ? fmt::format("{}", critical.cells) : "extrapolated");
    line.add(static_cast<std::int64_t>(critical.points));
    add(line, critical.rayleigh);
  });
}

}  // namespace lucy::files
