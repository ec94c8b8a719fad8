// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/benard_comparison_csv.hpp"

#include <cmath>
#include <limits>
#include <string_view>

#include "choice_names.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/csv.hpp"
#include "row_cells.hpp"

namespace lucy::files {

namespace {

/// One line of the file.
struct Line {
  const cases::BenardComparison* comparison = nullptr;
  const cases::BenardComparedRow* row = nullptr;
  const cases::BenardBeside* beside = nullptr;
};

/// Of the flow that a number beside ours is of.
double rayleigh_of(const Line& line) {
  const cases::BenardComparison& all = *line.comparison;
  if (line.beside->source == cases::BenardSource::effective_grid && all.effective)
    return *all.effective->settings.rayleigh;
  return *all.particles.settings.rayleigh;
}

const std::vector<std::string> published_columns = {
    "particles", "equation_of_state", "side", "height", "width", "hot", "cold", "rayleigh", "kinetic_energy", "source"};

}  // namespace

std::vector<std::string> benard_comparison_columns() {
  std::vector<std::string> columns = {
      "particles", "equation_of_state", "kernel",    "range",        "side",    "wall", "height", "width", "hot",
      "cold",      "rayleigh",          "viscosity", "conductivity", "quantity"};
  add_with_error(columns, "value");
  for (const auto* name : {"beside", "beside_rayleigh", "beside_value", "beside_error"}) columns.emplace_back(name);
  for (const auto* name : {"difference", "per_cent"}) add_with_error(columns, name);
  columns.emplace_back("z");
  return columns;
}

void write_benard_comparison_csv(const std::filesystem::path& path,
                                 std::span<const cases::BenardComparison> comparisons) {
  std::vector<Line> lines;
  for (const auto& comparison : comparisons)
    for (const auto& row : comparison.rows)
      for (const auto& beside : row.beside) lines.push_back({&comparison, &row, &beside});
  write_rows(path, benard_comparison_columns(), std::span<const Line>(lines), [](CsvLine& line, const Line& what) {
    const cases::BenardPoint& point = what.comparison->particles.settings;
    line.add(point.particles);
    line.add(name_of(cases::benard_fluid_names, point.equation_of_state));
    line.add(name_of(kernel::weight_names, point.weight));
    line.add(point.range);
    line.add(name_of(grid::sides_names, point.sides));
    line.add(name_of(space::wall_kind_names, point.wall));
    for (const double number : {point.height, cases::width_of(point), point.hot, point.cold, *point.rayleigh,
                                *point.viscosity, *point.conductivity})
      line.add(number);
    line.add(what.row->quantity);
    line.add(what.row->value);
    line.add(what.row->error);
    line.add(name_of(cases::benard_source_names, what.beside->source));
    line.add(rayleigh_of(what));
    const cases::BenardBeside& beside = *what.beside;
    for (const double number : {beside.value, beside.error, beside.difference, beside.difference_error, beside.per_cent,
                                beside.per_cent_error, beside.z})
      line.add(number);
  });
}

std::vector<cases::PublishedBenard> read_published_benard(const std::filesystem::path& path) {
  const CsvFile file(path);
  require_columns(file, published_columns, "table of published convection");
  std::vector<cases::PublishedBenard> prints;
  for (const auto& line : file.rows()) {
    const RowCells cells(file, line);
    const auto positive = [&](std::string_view name) {
      const double value = cells.number(name);
      if (!(value > 0.0) || !std::isfinite(value))
        throw BadInput(fmt::format("{}:{}: {} is {} where a number above 0 was expected", file.path(), line.line, name,
                                   cells.text(name)));
      return value;
    };
    cases::PublishedBenard& print = prints.emplace_back();
    print.particles = cells.count("particles");
    cases::Convection& convection = print.convection;
    convection.equation_of_state = cells.choice("equation_of_state", cases::benard_fluid_names);
    convection.sides = cells.choice("side", grid::sides_names);
    convection.height = positive("height");
    convection.width = positive("width");
    convection.hot = positive("hot");
    convection.cold = positive("cold");
    convection.rayleigh = positive("rayleigh");
    print.kinetic_energy.value = positive("kinetic_energy");
    print.kinetic_energy.last_digit = unit_of_last_digit(cells.text("kinetic_energy"));
    print.source = cells.text("source");
  }
  return prints;
}

}  // namespace lucy::files
