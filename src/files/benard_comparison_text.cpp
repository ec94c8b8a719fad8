// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/benard_comparison_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "choice_names.hpp"
#include "lucy/files/table_text.hpp"
#include "text_layout.hpp"

namespace lucy::files {

namespace {

using cases::BenardBeside;
using cases::BenardComparedRow;
using cases::BenardComparison;
using cases::BenardSource;

std::string_view quantity_text(std::string_view quantity) {
  if (quantity == "kinetic_energy_total") return "kinetic energy, total";
  if (quantity == "kinetic_energy_smoothed") return "kinetic energy, smoothed";
  if (quantity == "kinetic_energy_field") return "kinetic energy, field";
  if (quantity == "nusselt_hot") return "Nusselt number, hot";
  if (quantity == "nusselt_cold") return "Nusselt number, cold";
  return "kinetic energy, continuum";
}

std::string_view source_text(BenardSource source) {
  if (source == BenardSource::effective_grid) return "effective grid";
  return source == BenardSource::published ? "print" : "grid";
}

std::string value_text(const BenardBeside& beside) {
  if (!(beside.last_digit > 0.0)) return format_with_error(beside.value, beside.error);
  return fixed(beside.value, std::max(0, static_cast<int>(std::lround(-std::log10(beside.last_digit)))));
}

/// "-7.8(5) %  -16.5"
std::string difference_text(const BenardBeside& beside) {
  std::string per_cent = format_with_error(beside.per_cent, beside.per_cent_error);
  if (beside.per_cent > 0.0) per_cent.insert(0, "+");
  return fmt::format("{} %  {:>6}", per_cent, signed_errors(beside.z));
}

/// Those that have a number beside the particles' or the continuum's, in the order of their names.
std::vector<BenardSource> sources_of(const BenardComparison& comparison) {
  std::vector<BenardSource> sources;
  for (const auto& [name, source] : cases::benard_source_names)
    for (const BenardComparedRow& row : comparison.rows)
      if (std::ranges::find(row.beside, source, &BenardBeside::source) != row.beside.end()) {
        sources.push_back(source);
        break;
      }
  return sources;
}

std::string table_of(const BenardComparison& comparison) {
  const std::vector<BenardSource> sources = sources_of(comparison);
  std::vector<std::string> header = {"", "particles"};
  for (const BenardSource source : sources) header.emplace_back(source_text(source));
  TextTable table(header, 1, LastColumn::numbers);
  for (const BenardComparedRow& row : comparison.rows) {
    // The continuum's kinetic energy is no number of the particles: it stands in its own column.
    const bool continuum = row.quantity == "kinetic_energy_continuum";
    const std::string value = format_with_error(row.value, row.error);
    std::vector<std::string> values = {std::string(quantity_text(row.quantity)), continuum ? "" : value};
    std::vector<std::string> differences = {"", ""};
    for (const BenardSource source : sources) {
      const auto beside = std::ranges::find(row.beside, source, &BenardBeside::source);
      const bool there = beside != row.beside.end();
      values.push_back(there ? value_text(*beside) : continuum && source == BenardSource::grid ? value : "");
      differences.push_back(there ? difference_text(*beside) : "");
    }
    table.add(values);
    if (!row.beside.empty()) table.add(differences);
  }
  return table.text();
}

}  // namespace

std::string benard_particles_text(const cases::BenardPoint& point) {
  std::string text =
      fmt::format("{}, N = {}, ", name_of(cases::benard_fluid_names, point.equation_of_state), point.particles);
  if (std::isfinite(*point.rayleigh))
    text += fmt::format("Ra = {}", format_plain(*point.rayleigh));
  else
    text += fmt::format("eta = {}, k = {}", format_plain(*point.viscosity), format_plain(*point.conductivity));
  text += fmt::format("; {}, h = {}; {} x {}", name_of(kernel::weight_names, point.weight), format_plain(point.range),
                      format_plain(point.height), format_plain(cases::width_of(point)));
  if (point.sides == grid::Sides::walls) text += ", four walls";
  return text + fmt::format(", {}", name_of(space::wall_kind_names, point.wall));
}

std::string format_benard_comparison(std::span<const BenardComparison> comparisons) {
  std::string text;
  bool printed = false;
  std::vector<std::string> alone;
  for (const BenardComparison& comparison : comparisons) {
    const std::string particles = benard_particles_text(comparison.particles.settings);
    text += wrapped("", particles) + table_of(comparison) + '\n';
    printed = printed || std::ranges::count(sources_of(comparison), BenardSource::published) > 0;
    if (!comparison.grid) alone.push_back(particles);
  }
  text += wrapped("",
                  "Reduced units; kinetic energy per mass. In parentheses one standard error, in units of the last "
                  "digits; of the grid, that of its extrapolation. Below a number: by how much that of the particles "
                  "differs from it, in per cent of it and in combined standard errors.");
  if (printed)
    text += wrapped("print: ",
                    "of its error only the rounding of the last digit is known, and not which kinetic energy of "
                    "particles it is. In the line of the continuum the grid is compared with it.");
  for (const BenardComparison& comparison : comparisons)
    if (comparison.effective)
      text += wrapped("effective grid: ", fmt::format("at Ra = {} with eta = {}, k = {} beside {}",
                                                      format_plain(*comparison.effective->settings.rayleigh),
                                                      format_plain(*comparison.effective->settings.viscosity),
                                                      format_plain(*comparison.effective->settings.conductivity),
                                                      benard_particles_text(comparison.particles.settings)));
  for (const std::string& particles : alone) text += wrapped("no grid: ", particles);
  return text;
}

}  // namespace lucy::files
