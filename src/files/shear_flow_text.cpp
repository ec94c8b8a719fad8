// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/shear_flow_text.hpp"

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

using cases::shear_flow_quantity;
using cases::ShearFlowRow;

/// The equation of state, and the kernel if it is not the usual one.
std::string fluid_text(const cases::ShearFlowPoint& point) {
  const cases::ShearFlowPoint usual;
  std::string text(name_of(spam::equation_of_state_names, point.equation_of_state));
  if (point.weight != usual.weight) text += fmt::format(", {}", name_of(kernel::weight_names, point.weight));
  if (point.range != usual.range) text += fmt::format(", h = {}", format_plain(point.range));
  return text;
}

bool same_particles(std::span<const ShearFlowRow> rows) {
  return std::ranges::all_of(
      rows, [&](const ShearFlowRow& row) { return row.settings.particles == rows.front().settings.particles; });
}

/// A quantity and the unit in which a cell shows it.
struct Column {
  std::string header;
  std::size_t quantity;
  bool over_the_rate = false;
};

std::string cell(const ShearFlowRow& row, const Column& column) {
  const double unit = column.over_the_rate ? row.settings.strain_rate : 1.0;
  const auto& estimate = row[column.quantity];
  return format_with_error(estimate.value / unit, estimate.error / std::abs(unit));
}

/// Rows are numbered, since it takes several settings to tell them apart.
std::string flow_table(std::span<const ShearFlowRow> rows) {
  const std::vector<Column> columns = {{"viscosity", shear_flow_quantity("viscosity")},
                                       {"Newtonian", shear_flow_quantity("viscosity_newtonian")},
                                       {"pressure", shear_flow_quantity("viscosity_pressure")},
                                       {"carried", shear_flow_quantity("viscosity_carried")}};
  std::vector<std::string> header = {"", "fluid", "eta", "rate"};
  const bool with_particles = !same_particles(rows);
  if (with_particles) header.insert(header.begin() + 2, "N");
  for (const Column& column : columns) header.push_back(column.header);
  header.emplace_back("status");
  TextTable table(header, 2);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ShearFlowRow& row = rows[i];
    std::vector<std::string> cells = {fmt::format("{}", i + 1), fluid_text(row.settings)};
    if (with_particles) cells.push_back(fmt::format("{}", row.settings.particles));
    cells.push_back(format_plain(row.settings.viscosity));
    cells.push_back(format_plain(row.settings.strain_rate));
    for (const Column& column : columns) cells.push_back(cell(row, column));
    cells.emplace_back(cases::status_name(row.status));
    table.add(std::move(cells));
  }
  return table.text();
}

std::string numbered_table(std::span<const ShearFlowRow> rows, const std::vector<Column>& columns) {
  std::vector<std::string> header = {"", "rate"};
  for (const Column& column : columns) header.push_back(column.header);
  TextTable table(header, 1, LastColumn::numbers);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<std::string> cells = {fmt::format("{}", i + 1), format_plain(rows[i].settings.strain_rate)};
    for (const Column& column : columns) cells.push_back(cell(rows[i], column));
    table.add(std::move(cells));
  }
  return table.text();
}

/// What the columns mean.
std::string legend(std::span<const ShearFlowRow> rows) {
  std::string text =
      wrapped("", fmt::format("{}Reduced units. In parentheses one standard error, in units of the last digits: "
                              "blocking of each replica's series, pooled over replicas; with Student's factor where "
                              "there are fewer than ten degrees of freedom.",
                              !rows.empty() && same_particles(rows)
                                  ? fmt::format("{} particles. ", rows.front().settings.particles)
                                  : ""));
  text += wrapped("viscosity: ",
                  "-P_xy/rate, the sum of its parts: Newtonian, of the constitutive law with the prescribed eta; "
                  "pressure, the rest of what pairs exert; carried, of the momentum that moving particles carry.");
  text += wrapped("noise kT: ", "K/(N-1) of the peculiar velocities; in a continuum there is no such motion.");
  text += wrapped("heat removed: ",
                  "by the thermostat, which takes the same share of its internal energy from every particle. In a "
                  "steady state as much is made.");
  text += wrapped("gradient/rate: ", "the velocity gradient that the particles measure on average, over the true one.");
  text += wrapped("entropy removed: ", "with the heat. Surplus: made less removed, with its own error.");
  return text + wrapped("least: ", "made at the particle that makes least; below zero, that particle loses entropy.");
}

}  // namespace

std::string shear_flow_label(const cases::ShearFlowPoint& point) {
  return fmt::format("{}, viscosity {}, rate {}", fluid_text(point), format_plain(point.viscosity),
                     format_plain(point.strain_rate));
}

std::string format_shear_flow(std::span<const ShearFlowRow> rows) {
  std::string text = flow_table(rows);
  text += "\nTemperatures; heat per particle and time:\n";
  text += numbered_table(rows, {{"noise kT", shear_flow_quantity("kinetic_temperature")},
                                {"kT", shear_flow_quantity("temperature")},
                                {"heat made", shear_flow_quantity("heating")},
                                {"heat removed", shear_flow_quantity("heat_removed")},
                                {"gradient/rate", shear_flow_quantity("velocity_gradient"), true}});
  text += "\nEntropy per particle and time, made by viscosity and by conduction:\n";
  text += numbered_table(rows, {{"by viscosity", shear_flow_quantity("entropy_viscosity")},
                                {"by conduction", shear_flow_quantity("entropy_conduction")},
                                {"removed", shear_flow_quantity("entropy_removed")},
                                {"surplus", shear_flow_quantity("entropy_surplus")},
                                {"least", shear_flow_quantity("least_entropy_production")}});
  text += '\n' + legend(rows);
  if (std::ranges::any_of(rows, [](const ShearFlowRow& row) { return row.status == cases::RowStatus::too_short; }))
    text += wrapped("short: ",
                    "too short for an error bar, or not steady: the fluid changes all along the run, as it does for "
                    "ever without cooling.");
  return text + remarks_on(rows, [](const ShearFlowRow& row) { return shear_flow_label(row.settings); });
}

}  // namespace lucy::files
