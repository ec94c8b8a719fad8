// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/green_kubo_csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

#include "lucy/files/atomic_file.hpp"
#include "lucy/files/csv.hpp"
#include "row_cells.hpp"

namespace lucy::files {

namespace {

using cases::Curve;
using cases::GreenKuboResult;
using cases::GreenKuboRow;
using cases::StressCurves;

/// The columns behind the quantities that hold one real number each, and where it lies.
constexpr std::array<std::pair<std::string_view, double GreenKuboRow::*>, 8> decisions = {{
    {"spectrum_z", &GreenKuboRow::spectrum_z},
    {"cutoff", &GreenKuboRow::cutoff},
    {"decay_begin", &GreenKuboRow::decay_begin},
    {"decay_end", &GreenKuboRow::decay_end},
    {"spectrum_frequency", &GreenKuboRow::spectrum_frequency},
    {"spectrum_p_value", &GreenKuboRow::spectrum_p_value},
    {"self_diffusion_cutoff", &GreenKuboRow::self_diffusion_cutoff},
    {"thermal_conductivity_cutoff", &GreenKuboRow::thermal_conductivity_cutoff},
}};
constexpr std::array<std::pair<std::string_view, double GreenKuboRow::*>, 3> settings = {{
    {"step", &GreenKuboRow::step},
    {"sample_interval", &GreenKuboRow::sample_interval},
    {"duration", &GreenKuboRow::duration},
}};
constexpr std::array<std::pair<std::string_view, double GreenKuboRow::*>, 2> energies = {{
    {"energy_drift", &GreenKuboRow::energy_drift},
    {"largest_energy_error", &GreenKuboRow::largest_energy_error},
}};

/// The curves of correlation.csv that have an error, in two parts: the noise envelope, which has none, stands between.
constexpr std::array<std::pair<std::string_view, Curve StressCurves::*>, 4> first_curves = {{
    {"C_xy", &StressCurves::xy},
    {"C_difference", &StressCurves::difference},
    {"C_mean", &StressCurves::mean},
    {"integral", &StressCurves::integral},
}};
constexpr std::array<std::pair<std::string_view, Curve StressCurves::*>, 4> last_curves = {{
    {"noise_integral", &StressCurves::noise_integral},
    {"C_kinetic", &StressCurves::kinetic},
    {"C_cross", &StressCurves::cross},
    {"C_potential", &StressCurves::potential},
}};

double at(const std::vector<double>& values, std::size_t i) {
  return i < values.size() ? values[i] : std::numeric_limits<double>::quiet_NaN();
}

void add_point(CsvLine& line, const Curve& curve, std::size_t i) {
  line.add(at(curve.value, i));
  line.add(at(curve.error, i));
}

/// `point`: the line of viscosity.csv, from 1, since two states may have the same energy and number of particles.
void add_state(CsvLine& line, std::size_t point, const GreenKuboRow& row) {
  line.add(static_cast<std::int64_t>(point));
  line.add(row.energy_per_particle);
  line.add(row.particles);
}

}  // namespace

std::vector<std::string> viscosity_columns() {
  std::vector<std::string> columns = {"energy_per_particle", "particles"};
  for (const auto name : cases::green_kubo_quantities) add_with_error(columns, name);
  for (const auto& [name, member] : decisions) columns.emplace_back(name);
  columns.emplace_back("blocks");
  for (const auto& [name, member] : settings) columns.emplace_back(name);
  columns.emplace_back("replicas");
  for (const auto& [name, member] : energies) columns.emplace_back(name);
  columns.emplace_back("status");
  return columns;
}

void write_viscosity_csv(const std::filesystem::path& path, std::span<const GreenKuboRow> rows) {
  write_rows(path, viscosity_columns(), rows, [](CsvLine& line, const GreenKuboRow& row) {
    line.add(row.energy_per_particle);
    line.add(row.particles);
    for (const auto& estimate : row.estimates) add(line, estimate);
    for (const auto& [name, member] : decisions) line.add(row.*member);
    line.add(static_cast<std::int64_t>(row.blocks));
    for (const auto& [name, member] : settings) line.add(row.*member);
    line.add(static_cast<std::int64_t>(row.replicas));
    for (const auto& [name, member] : energies) line.add(row.*member);
    line.add(cases::status_name(row.status));
  });
}

std::vector<GreenKuboRow> read_viscosity_csv(const std::filesystem::path& path) {
  return read_rows<GreenKuboRow>(path, viscosity_columns(), "viscosity.csv",
                                 [](const RowCells& cells, GreenKuboRow& row) {
                                   row.energy_per_particle = cells.number("energy_per_particle");
                                   row.particles = cells.integer("particles");
                                   for (std::size_t i = 0; i < row.estimates.size(); ++i)
                                     row.estimates[i] = cells.estimate(cases::green_kubo_quantities[i]);
                                   for (const auto& [name, member] : decisions) row.*member = cells.number(name);
                                   row.blocks = cells.count("blocks");
                                   for (const auto& [name, member] : settings) row.*member = cells.number(name);
                                   row.replicas = cells.count("replicas");
                                   for (const auto& [name, member] : energies) row.*member = cells.number(name);
                                   row.status = cells.status();
                                 });
}

void write_correlation_csv(const std::filesystem::path& path, std::span<const GreenKuboResult> results) {
  std::vector<std::string> columns = {"point", "energy_per_particle", "particles", "time"};
  for (const auto& [name, member] : first_curves) add_with_error(columns, name);
  columns.emplace_back("noise_envelope");
  for (const auto& [name, member] : last_curves) add_with_error(columns, name);

  std::string text = fmt::format("{}\n", fmt::join(columns, ","));
  CsvLine line;
  for (std::size_t point = 0; point < results.size(); ++point) {
    const GreenKuboResult& result = results[point];
    const StressCurves& curves = result.curves;
    for (std::size_t i = 0; i < curves.time.size(); ++i) {
      add_state(line, point + 1, result.row);
      line.add(curves.time[i]);
      for (const auto& [name, member] : first_curves) add_point(line, curves.*member, i);
      line.add(at(curves.noise_envelope, i));
      for (const auto& [name, member] : last_curves) add_point(line, curves.*member, i);
      text += line.end();
    }
  }
  write_file_atomically(path, text);
}

void write_pairs_csv(const std::filesystem::path& path, std::span<const GreenKuboResult> results) {
  if (std::ranges::all_of(results, [](const GreenKuboResult& result) { return result.others.empty(); })) return;
  std::string text =
      "point,energy_per_particle,particles,pair,time,correlation,correlation_error,integral,integral_error\n";
  CsvLine line;
  for (std::size_t point = 0; point < results.size(); ++point) {
    const GreenKuboResult& result = results[point];
    for (const cases::OtherCurve& other : result.others) {
      for (std::size_t i = 0; i < other.time.size(); ++i) {
        add_state(line, point + 1, result.row);
        line.add(other.name);
        line.add(other.time[i]);
        add_point(line, other.correlation, i);
        add_point(line, other.integral, i);
        text += line.end();
      }
    }
  }
  write_file_atomically(path, text);
}

}  // namespace lucy::files
