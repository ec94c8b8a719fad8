// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/benard_grid_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "choice_names.hpp"
#include "lucy/files/table_text.hpp"
#include "text_layout.hpp"

namespace lucy::files {

namespace {

using cases::BenardGoal;
using cases::BenardGridPoint;
using cases::BenardGridRow;
using cases::RowStatus;

/// "ideal-gas"; "ideal-gas, walls, kinematic, T 1.05 to 0.95"
std::string family_text(const BenardGridPoint& point) {
  const BenardGridPoint usual;
  std::string text(name_of(cases::benard_fluid_names, point.equation_of_state));
  if (point.sides != usual.sides) text += fmt::format(", {}", name_of(grid::sides_names, point.sides));
  if (point.transport != usual.transport) text += fmt::format(", {}", name_of(grid::transport_names, point.transport));
  if (point.hot != usual.hot || point.cold != usual.cold)
    text += fmt::format(", T {} to {}", format_plain(point.hot), format_plain(point.cold));
  return text;
}

std::string number(const cases::Extrapolated& number) { return format_with_error(number.value, number.error); }

std::string share(double value) { return std::isfinite(value) ? fixed(100.0 * value, 3) + " %" : std::string("nan"); }

std::vector<BenardGridRow> rows_of(std::span<const BenardGridRow> rows, BenardGoal goal) {
  std::vector<BenardGridRow> those;
  std::ranges::copy_if(rows, std::back_inserter(those),
                       [&](const BenardGridRow& row) { return row.settings.find == goal; });
  return those;
}

std::string steady_table(std::span<const BenardGridRow> rows) {
  TextTable table({"fluid", "Ra", "cells", "kinetic energy", "Nusselt hot", "cold", "sides", "largest speed",
                   "imbalance", "status"},
                  1);
  for (const BenardGridRow& row : rows)
    table.add({family_text(row.settings), format_plain(*row.settings.rayleigh), fmt::format("{}", row.settings.cells),
               format_plain(row.kinetic_energy, 5), fixed(row.nusselt_hot, 4), fixed(row.nusselt_cold, 4),
               fixed(row.nusselt_sides, 4), fixed(row.largest_speed, 4), share(row.energy_imbalance),
               std::string(cases::status_name(row.status))});
  return table.text();
}

std::string limits_table(std::span<const cases::BenardGridLimit> limits) {
  TextTable table({"fluid", "Ra", "kinetic energy", "Nusselt hot", "Nusselt cold", "meshes"}, 1, LastColumn::numbers);
  for (const auto& limit : limits)
    table.add({family_text(limit.settings), format_plain(*limit.settings.rayleigh), number(limit.kinetic_energy),
               number(limit.nusselt_hot), number(limit.nusselt_cold), fmt::format("{}", limit.meshes)});
  return table.text();
}

std::string growth_table(std::span<const BenardGridRow> rows) {
  TextTable table({"fluid", "Ra", "cells", "rate L^2/nu", "rate", "kinetic energy", "status"}, 1);
  for (const BenardGridRow& row : rows) {
    const double tau = cases::diffusion_time(row.settings);
    table.add({family_text(row.settings), format_plain(*row.settings.rayleigh), fmt::format("{}", row.settings.cells),
               format_plain(row.growth_rate * tau), format_plain(row.growth_rate), format_plain(row.kinetic_energy, 3),
               std::string(cases::status_name(row.status))});
  }
  return table.text();
}

std::string critical_table(std::span<const cases::CriticalRayleigh> found) {
  TextTable table({"fluid", "by", "cells", "points", "critical Ra"}, 2, LastColumn::numbers);
  for (const auto& critical : found)
    table.add({family_text(critical.settings), std::string(name_of(cases::critical_route_names, critical.route)),
               critical.cells > 0 ? fmt::format("{}", critical.cells) : "extrapolated",
               fmt::format("{}", critical.points), number(critical.rayleigh)});
  return table.text();
}

}  // namespace

std::string benard_grid_label(const BenardGridPoint& point) {
  return fmt::format("{}, Ra = {}, {} cells", family_text(point), format_plain(*cases::resolved(point).rayleigh),
                     point.cells);
}

std::string format_benard_grid(std::span<const BenardGridRow> rows) {
  std::string text;
  const auto steady = rows_of(rows, BenardGoal::steady_state);
  if (!steady.empty()) {
    text += "Steady flows, mesh by mesh:\n" + steady_table(steady);
    const auto limits = cases::limits_of(rows);
    if (!limits.empty()) text += "\nExtrapolated to infinitely many cells:\n" + limits_table(limits);
  }
  const auto growing = rows_of(rows, BenardGoal::growth_rate);
  if (!growing.empty())
    text += std::string(text.empty() ? "" : "\n") + "Growth of small rolls:\n" + growth_table(growing);
  const auto critical = cases::critical_rayleighs(rows);
  if (!growing.empty() && std::ranges::none_of(critical, [](const cases::CriticalRayleigh& one) {
        return one.route == cases::CriticalRayleigh::Route::growth_rates;
      }))
    text += wrapped("",
                    "No critical Rayleigh number: that takes a Rayleigh number at which rolls grow and one at which "
                    "they decay, of one fluid on one mesh.");
  if (!critical.empty()) text += "\nCritical Rayleigh number:\n" + critical_table(critical);

  double mass_error = 0.0;
  for (const BenardGridRow& row : rows)
    if (std::isfinite(row.mass_error)) mass_error = std::max(mass_error, std::abs(row.mass_error));
  text += '\n';
  text += wrapped("", fmt::format("Reduced units; kinetic energy per mass. Heat is counted in that of the fluid at "
                                  "rest; imbalance: heat in less heat out, over that of the floor. Mass is conserved "
                                  "within {:.1g} of itself.",
                                  mass_error));
  text += wrapped("",
                  "Extrapolated: the line in 1/cells^2 through the finest two meshes, in parentheses how far from "
                  "its end the parabola through the finest three ends.");
  if (std::ranges::any_of(rows, [](const BenardGridRow& row) { return row.status == RowStatus::too_short; }))
    text += wrapped("short: ", "not steady within run.tolerance, or too short for a rate; not extrapolated.");
  for (const BenardGridRow& row : rows)
    if (row.status == RowStatus::failed)
      text += wrapped("failed: ", fmt::format("{}{}{}", benard_grid_label(row.settings),
                                              row.failure.empty() ? "" : ": ", row.failure));
  return text;
}

}  // namespace lucy::files
