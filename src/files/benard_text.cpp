// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/benard_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "choice_names.hpp"
#include "lucy/files/table_text.hpp"
#include "row_remarks.hpp"
#include "text_layout.hpp"

namespace lucy::files {

namespace {

using cases::benard_quantity;
using cases::BenardPoint;
using cases::BenardRow;

// A longer description of a fluid does not fit into a column of the table.
constexpr std::size_t widest_fluid = 44;

/// The equation of state, and what is not the usual of walls, weight function and temperatures.
std::string fluid_text(const BenardPoint& point) {
  const BenardPoint usual;
  std::string text(name_of(cases::benard_fluid_names, point.equation_of_state));
  if (point.sides != usual.sides) text += fmt::format(", {}", name_of(grid::sides_names, point.sides));
  if (point.wall != usual.wall) text += fmt::format(", {}", name_of(space::wall_kind_names, point.wall));
  if (point.weight != usual.weight) text += fmt::format(", {}", name_of(kernel::weight_names, point.weight));
  if (point.range != usual.range) text += fmt::format(", h = {}", format_plain(point.range));
  if (point.hot != usual.hot || point.cold != usual.cold)
    text += fmt::format(", T {} to {}", format_plain(point.hot), format_plain(point.cold));
  return text;
}

/// What drives the flow, against what: the Rayleigh number, unless it is infinite.
std::string drive_text(const BenardPoint& point, std::string_view before = "") {
  const BenardPoint all = cases::resolved(point);
  if (std::isfinite(*all.rayleigh)) return fmt::format("{}{}", before, format_plain(*all.rayleigh));
  return fmt::format("eta = {}, k = {}", format_plain(*all.viscosity), format_plain(*all.conductivity));
}

/// A quantity under its header; `sign`: that with which it is shown.
struct Column {
  std::string header;
  std::size_t quantity;
  double sign = 1.0;
};

std::string cell(const BenardRow& row, const Column& column) {
  const auto& estimate = row[column.quantity];
  return format_with_error(column.sign * estimate.value, estimate.error);
}

/// Rows are numbered, since it takes several settings to tell them apart.
std::string energy_table(std::span<const BenardRow> rows) {
  const std::vector<Column> columns = {{"K total", benard_quantity("kinetic_energy_total")},
                                       {"K smoothed", benard_quantity("kinetic_energy_smoothed")},
                                       {"K field", benard_quantity("kinetic_energy_field")}};
  const bool narrow =
      std::ranges::all_of(rows, [](const BenardRow& row) { return fluid_text(row.settings).size() <= widest_fluid; });
  std::vector<std::string> header = {"", "fluid", "N", "Ra"};
  for (const Column& column : columns) header.push_back(column.header);
  header.emplace_back("status");
  TextTable table(header, 2);
  std::string below;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const BenardRow& row = rows[i];
    const std::string number = fmt::format("{}", i + 1);
    const std::string fluid = fluid_text(row.settings);
    std::vector<std::string> cells = {
        number, narrow ? fluid : std::string(name_of(cases::benard_fluid_names, row.settings.equation_of_state)),
        fmt::format("{}", row.settings.particles), drive_text(row.settings)};
    for (const Column& column : columns) cells.push_back(cell(row, column));
    cells.emplace_back(cases::status_name(row.status));
    table.add(std::move(cells));
    if (!narrow) below += wrapped(number + ": ", fluid);
  }
  return table.text() + below;
}

std::string numbered_table(std::span<const BenardRow> rows, const std::vector<Column>& columns) {
  std::vector<std::string> header = {""};
  for (const Column& column : columns) header.push_back(column.header);
  TextTable table(header, 1, LastColumn::numbers);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<std::string> cells = {fmt::format("{}", i + 1)};
    for (const Column& column : columns) cells.push_back(cell(rows[i], column));
    table.add(std::move(cells));
  }
  return table.text();
}

bool any_side_walls(std::span<const BenardRow> rows) {
  return std::ranges::any_of(rows, [](const BenardRow& row) { return row.settings.sides == grid::Sides::walls; });
}

std::string heat_table(std::span<const BenardRow> rows) {
  std::vector<Column> columns = {{"Nusselt hot", benard_quantity("nusselt_hot")},
                                 {"by conduction", benard_quantity("conduction_hot")},
                                 {"by work", benard_quantity("work_hot")},
                                 {"Nusselt cold", benard_quantity("nusselt_cold")},
                                 {"by conduction", benard_quantity("conduction_cold"), -1.0},
                                 {"by work", benard_quantity("work_cold"), -1.0}};
  if (any_side_walls(rows)) columns.push_back({"sides", benard_quantity("nusselt_sides")});
  columns.push_back({"imbalance", benard_quantity("energy_imbalance")});
  return numbered_table(rows, columns);
}

/// What the columns mean.
std::string legend(std::span<const BenardRow> rows) {
  std::string text = wrapped("",
                             "Reduced units. In parentheses one standard error, in units of the last digits: blocking "
                             "of each replica's series, pooled over replicas; with Student's factor where there are "
                             "fewer than ten degrees of freedom.");
  text += wrapped("K: ",
                  "kinetic energy per mass. Total: mean of v^2/2 of the particles, their motion about the flow among "
                  "it. Smoothed: the same of the smoothed velocity at the particles. Field: of the flow averaged over "
                  "time on a grid; its error is from leaving out one block of time after another.");
  text += wrapped("Nusselt: ",
                  fmt::format("heat per time into the fluid by the floor (hot){} and out of it by the ceiling (cold), "
                              "over what conduction carries through the fluid at rest; by conduction, and by the work "
                              "of walls on the particles near them.",
                              any_side_walls(rows) ? ", by side walls" : ""));
  return text + wrapped("imbalance: ",
                        "what all walls give, less what the fluid's total energy grows by; in the same "
                        "unit.");
}

}  // namespace

std::string benard_label(const BenardPoint& point) {
  return fmt::format("{}, {} particles, {}", fluid_text(point), point.particles, drive_text(point, "Ra = "));
}

std::string format_benard(std::span<const BenardRow> rows) {
  std::string text = energy_table(rows);
  text += "\nHeat through the walls:\n" + heat_table(rows);
  text += "\nLeast and largest over the particles, averaged over time; amplitude of the rolls:\n";
  text += numbered_table(rows, {{"density from", benard_quantity("density_least")},
                                {"to", benard_quantity("density_largest")},
                                {"temperature from", benard_quantity("temperature_least")},
                                {"to", benard_quantity("temperature_largest")},
                                {"rolls", benard_quantity("roll_amplitude")}});
  text += '\n' + legend(rows);
  if (std::ranges::any_of(rows, [](const BenardRow& row) { return row.status == cases::RowStatus::too_short; }))
    text += wrapped("short: ", "too short for an error bar of everything, or not steady.");
  return text + remarks_on(rows, [](const BenardRow& row) { return benard_label(row.settings); });
}

}  // namespace lucy::files
