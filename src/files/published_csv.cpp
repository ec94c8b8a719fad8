// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/published_csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "lucy/errors.hpp"
#include "lucy/files/csv.hpp"
#include "lucy/files/table_csv.hpp"

namespace lucy::files {

namespace {

using cases::PublishedCell;
using cases::PublishedRow;
using cases::PublishedTable;

/// Names of the compared quantities in the columns of a published table; the viscosity is not a column.
std::string printed_column(std::string_view quantity) {
  return quantity == "potential_energy" ? "potential_energy_per_particle" : std::string(quantity);
}

/// One line of index.csv.
struct IndexEntry {
  std::string name;
  double energy_per_particle = 0.0;
  std::string errata;  ///< file beside the index; empty: none
  std::string source;
};

std::vector<IndexEntry> read_index(const std::filesystem::path& directory) {
  const CsvFile file(directory / "index.csv");
  const std::size_t name = file.column("name");
  const std::size_t energy = file.column("energy_per_particle");
  const std::size_t errata = file.column("errata");
  const std::size_t source = file.column("source");
  std::vector<IndexEntry> entries;
  for (const auto& row : file.rows())
    entries.push_back({row.cells[name], file.number(row, energy), row.cells[errata], row.cells[source]});
  return entries;
}

std::optional<IndexEntry> find_in_index(const std::filesystem::path& directory, std::string_view name) {
  for (auto& entry : read_index(directory))
    if (entry.name == name) return entry;
  return std::nullopt;
}

/// A cell as printed; an empty one stays unpublished.
PublishedCell printed_cell(const CsvFile& file, const CsvFile::Row& cells, std::size_t column) {
  PublishedCell cell;
  if (cells.cells[column].empty()) return cell;
  cell.value = file.number(cells, column);
  cell.last_digit = unit_of_last_digit(cells.cells[column]);
  return cell;
}

/// Marks the misprinted cells of `table`. The errata repeat what is printed, so that they cannot end up at a wrong
/// cell.
void apply_errata(const std::filesystem::path& path, PublishedTable& table) {
  const CsvFile file(path);
  const std::size_t table_column = file.column("table");
  const std::size_t particles = file.column("particles");
  const std::size_t strain_rate = file.column("strain_rate");
  const std::size_t quantity_column = file.column("quantity");
  const std::size_t printed = file.column("printed");
  const std::size_t reading = file.column("reading");
  const std::size_t why = file.column("why");
  for (const auto& cells : file.rows()) {
    if (cells.cells[table_column] != table.name) continue;
    const std::int64_t number = file.integer(cells, particles);
    const double rate = file.number(cells, strain_rate);
    const auto row = std::ranges::find_if(table.rows, [&](const PublishedRow& candidate) {
      return candidate.particles == number && candidate.strain_rate == rate;
    });
    const auto quantity = std::ranges::find_if(cases::compared_quantities, [&](std::string_view name) {
      return printed_column(name) == cells.cells[quantity_column];
    });
    if (row == table.rows.end() || quantity == cases::compared_quantities.end())
      throw BadInput(fmt::format("{}:{}: {} has no {} at {} particles and strain rate {}", file.path(), cells.line,
                                 table.name, cells.cells[quantity_column], number, rate));
    PublishedCell& cell = row->cells[static_cast<std::size_t>(quantity - cases::compared_quantities.begin())];
    if (cell.value != file.number(cells, printed))
      throw BadInput(fmt::format("{}:{}: the printed value is said to be {}, but {} has {}", file.path(), cells.line,
                                 cells.cells[printed], table.name, cell.value));
    cell.misprint = true;
    if (!cells.cells[reading].empty()) cell.reading = file.number(cells, reading);
    cell.why = cells.cells[why];
  }
}

PublishedTable read_printed(const CsvFile& file, const std::optional<IndexEntry>& entry) {
  PublishedTable table;
  table.name = entry ? entry->name : std::filesystem::path(file.path()).stem().string();
  table.source = entry ? entry->source : file.path();
  const std::size_t particles = file.column("particles");
  const std::size_t strain_rate = file.column("strain_rate");
  const std::size_t run_length = file.column("run_length_in_inverse_rates");
  if (!entry && !file.has_column("energy_per_particle"))
    throw BadInput(
        fmt::format("{}:1: the energy per particle is not known: the file has no column "
                    "energy_per_particle, and its name is not in the index of published tables",
                    file.path()));
  for (const auto& cells : file.rows()) {
    PublishedRow row;
    row.particles = file.integer(cells, particles);
    row.energy_per_particle = file.has_column("energy_per_particle")
                                  ? file.number(cells, file.column("energy_per_particle"))
                                  : entry->energy_per_particle;
    row.strain_rate = file.number(cells, strain_rate);
    row.total_time = file.number(cells, run_length) / std::abs(row.strain_rate);
    if (!(row.total_time > 0.0) || !std::isfinite(row.total_time))
      throw BadInput(
          fmt::format("{}:{}: a strain rate other than zero and a positive run length were expected, found "
                      "{} and {}",
                      file.path(), cells.line, cells.cells[strain_rate], cells.cells[run_length]));
    if (file.has_column("instability_region"))
      row.instability_region = cells.cells[file.column("instability_region")] == "yes";
    for (std::size_t i = 0; i < cases::compared_quantities.size(); ++i) {
      if (cases::compared_quantities[i] == "viscosity") continue;
      row.cells[i] = printed_cell(file, cells, file.column(printed_column(cases::compared_quantities[i])));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// A table of Lucy in the place of the published one: it brings its own errors.
PublishedTable read_own(const std::filesystem::path& path) {
  PublishedTable table;
  table.name = path.string();
  table.source = "a table with errors of its own";
  table.in_print = false;
  for (const cases::TableRow& ours : read_table_csv(path)) {
    PublishedRow row;
    row.particles = ours.particles;
    row.energy_per_particle = ours.energy_per_particle;
    row.strain_rate = ours.strain_rate;
    row.total_time = ours.replicas * (ours.duration - ours.equilibration_discarded);
    for (std::size_t i = 0; i < cases::compared_quantities.size(); ++i) {
      const auto place =
          std::ranges::find(cases::quantities, cases::compared_quantities[i]) - cases::quantities.begin();
      const auto& estimate = ours.estimates[static_cast<std::size_t>(place)];
      row.cells[i].value = estimate.value;
      row.cells[i].standard_error = estimate.error;
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

PublishedTable read_published_table(const std::string& name_or_path, const std::filesystem::path& reference_directory) {
  const bool is_path = name_or_path.ends_with(".csv") || name_or_path.find('/') != std::string::npos;
  const std::filesystem::path given(name_or_path);
  const auto entry = find_in_index(reference_directory, is_path ? given.stem().string() : name_or_path);
  std::error_code error;  // what cannot be looked at will not be readable either
  if ((is_path || !entry) && std::filesystem::is_directory(given, error)) return read_own(given / "table.csv");
  if (!is_path && !entry)
    throw BadInput(fmt::format(
        "there is no published table \"{}\": use {}, or the path of a .csv file or of the directory of a sweep",
        name_or_path, fmt::join(published_table_names(reference_directory), ", ")));
  const std::filesystem::path path = is_path ? given : reference_directory / (name_or_path + ".csv");
  const CsvFile file(path);
  if (file.has_column("viscosity_error")) return read_own(path);
  PublishedTable table = read_printed(file, entry);
  if (entry && !entry->errata.empty()) apply_errata(reference_directory / entry->errata, table);
  for (PublishedRow& row : table.rows) derive_viscosity(row);
  return table;
}

std::vector<std::string> published_table_names(const std::filesystem::path& reference_directory) {
  std::vector<std::string> names;
  for (const auto& entry : read_index(reference_directory)) names.push_back(entry.name);
  return names;
}

std::vector<cases::PublishedGreenKubo> read_published_green_kubo(const std::filesystem::path& path) {
  const CsvFile file(path);
  const auto positive = [&](const CsvFile::Row& cells, std::string_view name) {
    const std::size_t column = file.column(name);
    const double value = file.number(cells, column);
    if (!(value > 0.0) || !std::isfinite(value))
      throw BadInput(fmt::format("{}:{}: {} is {} where a number above 0 was expected", file.path(), cells.line, name,
                                 cells.cells[column]));
    return value;
  };
  std::vector<cases::PublishedGreenKubo> values;
  for (const auto& cells : file.rows()) {
    const auto cell = [&](std::string_view name) { return printed_cell(file, cells, file.column(name)); };
    cases::PublishedGreenKubo value;
    value.particles = file.integer(cells, file.column("particles"));
    value.energy_per_particle = file.number(cells, file.column("energy_per_particle"));
    value.total_time = positive(cells, "total_time");
    positive(cells, "viscosity");
    value.viscosity = cell("viscosity");
    if (file.has_column("viscosity_error")) value.viscosity.standard_error = positive(cells, "viscosity_error");
    value.pressure = cell("pressure");
    value.pressure_kinetic = cell("pressure_kinetic");
    value.source = cells.cells[file.column("source")];
    values.push_back(std::move(value));
  }
  return values;
}

}  // namespace lucy::files
