// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `lucy viscosity`: the routes to the viscosity side by side. Nothing is run. Into the directory of the Green-Kubo run,
// or another, go viscosities.csv, sweep_fit.csv, nemd.csv and viscosities.png, .svg, in place of earlier ones.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "lucy/cases/viscosities.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/directory_lock.hpp"
#include "lucy/files/green_kubo_csv.hpp"
#include "lucy/files/green_kubo_input.hpp"
#include "lucy/files/green_kubo_text.hpp"
#include "lucy/files/input.hpp"
#include "lucy/files/published_csv.hpp"
#include "lucy/files/table_csv.hpp"
#include "lucy/files/table_text.hpp"
#include "lucy/files/viscosities_csv.hpp"
#include "program/closing.hpp"
#include "program/commands.hpp"
#include "program/data_directory.hpp"
#include "program/output_directory.hpp"

namespace lucy::program {

namespace {

namespace fs = std::filesystem;

/// The results file `name` of `given`, which is that file or the directory of `what`.
fs::path results_of(const fs::path& given, std::string_view name, std::string_view what) {
  std::error_code error;  // what cannot be looked at will not be readable either
  if (!fs::is_directory(given, error)) return given;
  fs::path path = given / name;
  if (!fs::exists(path, error))
    throw BadInput(
        fmt::format("{} holds no {}, as the directory of a finished {} does (first the sweep, then the "
                    "Green-Kubo run)",
                    given.string(), name, what));
  return path;
}

/// What neither table says of a state, but its input does.
struct Fluid {
  std::string input = {};  ///< where it stands
  std::int64_t particles = 0;
  double energy_per_particle = 0.0;
  int dimension = 2;
  double density = 0.0;
  std::string kernel = {};
  double range = 0.0;

  std::string text() const {
    return fmt::format("density {}, kernel {} of range {} in {} dimensions", files::format_plain(density), kernel,
                       files::format_plain(range), dimension);
  }
  bool same_as(const Fluid& other) const {
    return dimension == other.dimension && kernel == other.kernel && cases::nearly_equal(density, other.density) &&
           cases::nearly_equal(range, other.range);
  }
  bool of_the_paper() const { return same_as({.density = 1.0, .kernel = "lucy", .range = 3.0}); }
};

/// The fluids of the input.toml beside a results file; none when there is no such input.
template <class Read>
std::vector<Fluid> fluids_beside(const fs::path& results, const Read& read) {
  const fs::path path = results.parent_path() / "input.toml";
  std::error_code error;
  std::vector<Fluid> fluids;
  if (!fs::exists(path, error)) return fluids;
  for (const auto& point : read(path).points)
    fluids.push_back({.input = path.string(),
                      .particles = point.particles,
                      .energy_per_particle = point.energy_per_particle,
                      .dimension = point.dimension,
                      .density = point.density,
                      .kernel = point.kernel,
                      .range = point.range});
  return fluids;
}

std::string state_text(std::int64_t particles, double energy_per_particle) {
  return fmt::format("N = {}, E/N = {}", particles, files::format_plain(energy_per_particle));
}

void require_one_fluid_per_state(std::span<const Fluid> fluids) {
  for (const Fluid& one : fluids)
    for (const Fluid& other : fluids)
      if (cases::same_equilibrium_state(one, other) && !one.same_as(other))
        throw BadInput(fmt::format("{} is not one fluid: {} has {}\nlucy: {} has {}",
                                   state_text(one.particles, one.energy_per_particle), one.input, one.text(),
                                   other.input, other.text()));
}

/// The states of `rows` that `others` do not have, or all without any others; each once.
template <class Row, class Other>
std::vector<std::string> states_only_in(const std::vector<Row>& rows, const std::vector<Other>& others) {
  std::vector<std::string> states;
  for (const Row& row : rows) {
    if (std::ranges::any_of(others, [&](const Other& other) { return cases::same_equilibrium_state(row, other); }))
      continue;
    std::string state = state_text(row.particles, row.energy_per_particle);
    if (std::ranges::find(states, state) == states.end()) states.push_back(std::move(state));
  }
  return states;
}

void print_states_only_in(const std::string& results, const std::vector<std::string>& states) {
  if (!states.empty()) program::print("Only in {}: {}.\n", results, fmt::join(states, "; "));
}

}  // namespace

int viscosity(std::span<const fs::path> sweeps, const fs::path& green_kubo, const std::optional<fs::path>& out) {
  std::vector<cases::TableRow> sheared;
  std::vector<Fluid> fluids;
  std::string sweep_tables;
  std::vector<fs::path> tables;
  for (const fs::path& sweep : sweeps) {
    const fs::path table = results_of(sweep, "table.csv", "sweep");
    std::error_code error;  // tables that are not there are told of below
    for (const fs::path& other : tables)
      if (fs::equivalent(table, other, error))
        throw BadInput(fmt::format("{} is given twice, as {} and as {}: its rows would count twice", table.string(),
                                   table.string(), other.string()));
    tables.push_back(table);
    std::ranges::move(files::read_table_csv(table), std::back_inserter(sheared));
    std::ranges::move(fluids_beside(table, [](const fs::path& path) { return files::read_sweep(path); }),
                      std::back_inserter(fluids));
    sweep_tables += (sweep_tables.empty() ? "" : ", ") + table.string();
  }
  const fs::path green_kubo_table = results_of(green_kubo, "viscosity.csv", "Green-Kubo run");
  const auto at_rest = files::read_viscosity_csv(green_kubo_table);
  if (std::ranges::any_of(at_rest, [](const cases::GreenKuboRow& row) { return row.particles == 0; }))
    throw BadInput(
        fmt::format("{} is of a stress series that was sampled elsewhere: it has no number of particles and no "
                    "energy to be matched by",
                    green_kubo_table.string()));
  const auto published = files::read_published_green_kubo(data_directory() / "reference" / "posch1995_green_kubo.csv");
  std::ranges::move(fluids_beside(green_kubo_table, [](const fs::path& path) { return files::read_green_kubo(path); }),
                    std::back_inserter(fluids));

  std::vector<cases::SideBySide> states;
  for (const cases::GreenKuboRow& row : at_rest) {
    std::vector<Fluid> of_state;
    std::ranges::copy_if(fluids, std::back_inserter(of_state),
                         [&](const Fluid& fluid) { return cases::same_equilibrium_state(fluid, row); });
    const bool of_the_paper = std::ranges::all_of(of_state, &Fluid::of_the_paper);
    for (auto& state : cases::side_by_side(sheared, std::span(&row, 1), published, of_the_paper)) {
      require_one_fluid_per_state(of_state);
      states.push_back(std::move(state));
    }
  }
  const auto only_sheared = states_only_in(sheared, at_rest);
  const auto only_at_rest = states_only_in(at_rest, sheared);
  if (states.empty())
    throw BadInput(fmt::format("there is nothing to lay side by side: no state of {} ({}) is in {} ({})", sweep_tables,
                               fmt::join(only_sheared, "; "), green_kubo_table.string(),
                               fmt::join(only_at_rest, "; ")));

  fs::path directory = out.value_or(green_kubo_table.parent_path());
  if (directory.empty()) directory = ".";
  make_directory(directory);
  const files::DirectoryLock lock(directory);
  files::write_viscosities_csv(directory / "viscosities.csv", states);
  files::write_sweep_fit_csv(directory / "sweep_fit.csv", states);
  files::write_nemd_csv(directory / "nemd.csv", states);
  std::error_code error;  // a picture that cannot be removed cannot be replaced either, and the script says so
  for (const char* picture : {"viscosities.png", "viscosities.svg"}) fs::remove(directory / picture, error);

  print("{}", files::format_side_by_side(states));
  print_states_only_in(sweep_tables, only_sheared);
  print_states_only_in(green_kubo_table.string(), only_at_rest);
  std::fflush(stdout);
  draw({{"plot_viscosities.py", {directory.string()}, directory / "viscosities.png"}});
  print_files(directory, {"viscosities.csv", "sweep_fit.csv", "nemd.csv", "viscosities.png", "viscosities.svg"});
  return 0;
}

}  // namespace lucy::program
