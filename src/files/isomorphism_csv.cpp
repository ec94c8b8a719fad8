// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/isomorphism_csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "lucy/files/csv.hpp"
#include "row_cells.hpp"

namespace lucy::files {

namespace {

using cases::Difference;
using cases::IsomorphismRow;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view no_component = "none";

/// The settings that hold one real number each, in front of the thermostat and behind it.
constexpr std::array<std::pair<std::string_view, double IsomorphismRow::*>, 4> state_settings = {{
    {"energy_per_particle", &IsomorphismRow::energy_per_particle},
    {"density", &IsomorphismRow::density},
    {"range", &IsomorphismRow::range},
    {"strain_rate", &IsomorphismRow::strain_rate},
}};
constexpr std::array<std::pair<std::string_view, double IsomorphismRow::*>, 4> other_settings = {{
    {"isentropic_pressure", &IsomorphismRow::pressure},
    {"isentropic_reference_density", &IsomorphismRow::reference_density},
    {"step", &IsomorphismRow::step},
    {"duration", &IsomorphismRow::duration},
}};

void add_difference(CsvLine& line, const IsomorphismRow& row) {
  if (!row.difference) {
    for (int i = 0; i < 4; ++i) line.add(not_a_number);
    line.add(no_component);
    for (int i = 0; i < 2; ++i) line.add(not_a_number);
    return;
  }
  const Difference& difference = *row.difference;
  line.add(static_cast<std::int64_t>(row.differing_replica));
  line.add(difference.step);
  line.add(difference.time);
  if (difference.particle >= 0) {
    line.add(difference.particle);
  } else {
    line.add(not_a_number);
  }
  line.add(difference.component_name());
  line.add(difference.atoms);
  line.add(difference.smooth);
}

std::optional<Difference> read_difference(const RowCells& cells) {
  const std::string& name = cells.text("difference_component");
  if (name == no_component) return std::nullopt;
  Difference difference;
  difference.step = cells.integer("difference_step");
  difference.time = cells.number("difference_time");
  difference.atoms = cells.number("difference_atoms");
  difference.smooth = cells.number("difference_smooth");
  const auto place_in = [&](const auto& names) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
      cells.refuse_choice("difference_component", name,
                          fmt::format("{}, {} or {}", fmt::join(cases::compared_coordinates, ", "),
                                      fmt::join(cases::compared_sums, ", "), no_component));
    return static_cast<int>(found - names.begin());
  };
  if (std::isnan(cells.number("difference_particle"))) {
    difference.component = place_in(cases::compared_sums);
  } else {
    difference.particle = cells.integer("difference_particle");
    difference.component = place_in(cases::compared_coordinates);
  }
  return difference;
}

}  // namespace

std::vector<std::string> isomorphism_columns() {
  std::vector<std::string> columns = {"particles"};
  for (const auto& [name, member] : state_settings) columns.emplace_back(name);
  columns.emplace_back("thermostat");
  for (const auto& [name, member] : other_settings) columns.emplace_back(name);
  for (const auto* name :
       {"replicas", "steps", "comparisons", "identical", "difference_replica", "difference_step", "difference_time",
        "difference_particle", "difference_component", "difference_atoms", "difference_smooth"})
    columns.emplace_back(name);
  for (const auto name : cases::isomorphism_quantities) add_with_error(columns, name);
  for (const auto* name : {"equilibration_discarded", "worst_energy_error", "subdivided_steps", "status"})
    columns.emplace_back(name);
  return columns;
}

void write_isomorphism_csv(const std::filesystem::path& path, std::span<const IsomorphismRow> rows) {
  write_rows(path, isomorphism_columns(), rows, [](CsvLine& line, const IsomorphismRow& row) {
    line.add(row.particles);
    for (const auto& [name, member] : state_settings) line.add(row.*member);
    line.add(std::string_view(row.thermostat));
    for (const auto& [name, member] : other_settings) line.add(row.*member);
    line.add(static_cast<std::int64_t>(row.replicas));
    line.add(row.steps);
    line.add(row.comparisons);
    line.add(row.identical());
    add_difference(line, row);
    for (const auto& estimate : row.estimates) add(line, estimate);
    line.add(row.equilibration_discarded);
    line.add(row.worst_energy_error);
    line.add(row.subdivided_steps);
    line.add(cases::status_name(row.status));
  });
}

std::vector<IsomorphismRow> read_isomorphism_csv(const std::filesystem::path& path) {
  return read_rows<IsomorphismRow>(path, isomorphism_columns(), "isomorphism.csv",
                                   [](const RowCells& cells, IsomorphismRow& row) {
                                     row.particles = cells.integer("particles");
                                     for (const auto& [name, member] : state_settings) row.*member = cells.number(name);
                                     row.thermostat = cells.text("thermostat");
                                     for (const auto& [name, member] : other_settings) row.*member = cells.number(name);
                                     row.replicas = cells.count("replicas");
                                     row.steps = cells.integer("steps");
                                     row.comparisons = cells.integer("comparisons");
                                     row.difference = read_difference(cells);
                                     if (row.difference) row.differing_replica = cells.count("difference_replica");
                                     for (std::size_t i = 0; i < row.estimates.size(); ++i)
                                       row.estimates[i] = cells.estimate(cases::isomorphism_quantities[i]);
                                     row.equilibration_discarded = cells.number("equilibration_discarded");
                                     row.worst_energy_error = cells.number("worst_energy_error");
                                     row.subdivided_steps = cells.integer("subdivided_steps");
                                     row.status = cells.status();
                                   });
}

}  // namespace lucy::files
