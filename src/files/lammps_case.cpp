// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/lammps_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string_view>

#include "lammps_scripts.hpp"
#include "lucy/build_record.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/particle_file.hpp"
#include "lucy/files/series_file.hpp"

namespace lucy::files {

namespace {

namespace fs = std::filesystem;

constexpr int entries = 16000;
// Particles overlap, and LAMMPS stops where one pair is nearer than this: with 1e-6 that happens to a million particles
// every 600000 steps.
constexpr double innermost = 1e-12;
constexpr double longest_between_rows = 0.2;  // the fast part of the stress correlation dies within two time units

// Neighbour lists reach beyond the range by a skin, and are good until a pair may have come nearer by that much. At
// rest LAMMPS itself sees when the first particle has gone half of it. Under shear its test counts the motion of the
// box's corners as well and asks for a new list in every step: there the script chooses skin and steps between lists
// together, for two particles as fast as the fastest one, headed for each other, and the flow between them; and it
// looks at the fastest particle again and again. (The typical pair would do with half of that, but lists that are too
// old once in a long while miss forces without a word.) The cost is flat about these skins, for N = 1024 and 16384 at E
// = N: within a tenth at rest for skins of 0.8 to 1.5, under shear for lists used once, twice or three times.
constexpr double skin_at_rest = 1.0;
constexpr double wanted_skin_under_shear = 0.7;
constexpr double longest_approach = 0.8;  // of two particles in one step; beyond, new lists in every step are cheaper
constexpr int most_steps_between_lists = 20;
// The fastest particle may gain that much before lists that were chosen for it are given up. What it gains between two
// looks, 0.2 time units apart, is little beside what its partner in the pair lacks.
constexpr double speed_margin = 1.2;

constexpr int steps_between_restarts = 50'000;

/// `text` with every @name@ replaced.
std::string filled(std::string_view text, const std::map<std::string, std::string, std::less<>>& values) {
  std::string result;
  while (true) {
    const std::size_t begin = text.find('@');
    result += text.substr(0, begin);
    if (begin == std::string_view::npos) return result;
    const std::size_t end = text.find('@', begin + 1);
    result += values.at(std::string(text.substr(begin + 1, end - begin - 1)));
    text.remove_prefix(end + 1);
  }
}

std::string number(double value) { return fmt::format("{}", value); }

std::string table_text(const kernel::Lucy<2>& kernel, const std::string& title) {
  const double first = innermost * innermost;
  const double between = (kernel.range() * kernel.range() - first) / (entries - 1);
  std::string text = fmt::format(
      "# {}: Lucy's function of range {}\n# number, r, phi, -dphi/dr\n\nLUCY\n"
      "N {} RSQ {} {}\n\n",
      title, kernel.range(), entries, innermost, kernel.range());
  for (int i = 0; i < entries; ++i) {
    const double r = i + 1 < entries ? std::sqrt(first + i * between) : kernel.range();
    fmt::format_to(std::back_inserter(text), "{} {} {} {}\n", i + 1, r, kernel.weight(r), r * kernel.slope(r));
  }
  return text;
}

}  // namespace

int series_steps(const cases::CouettePoint& point) {
  return std::max(1, static_cast<int>(longest_between_rows / point.step * (1.0 + 1e-9)));
}

std::int64_t lammps_steps(const cases::CouettePoint& point) {
  return std::llround((point.equilibration + point.duration) / point.step);
}

void write_lammps_case(const fs::path& folder, const LammpsCase& one) {
  using namespace lammps_scripts;
  const cases::CouettePoint& point = one.point;
  const kernel::Lucy<2> kernel(point.range);
  const std::string title =
      fmt::format("Lucy fluid, N = {}, E/N = {}, rate {}, seed {}; written by lucy {}", point.particles,
                  point.energy_per_particle, point.strain_rate, point.seed, build_record().version);
  const double amplitude = kernel.weight_at_zero();
  std::string columns;
  for (const auto name : cases::observables) columns += (columns.empty() ? "" : " ") + std::string(name);

  std::map<std::string, std::string, std::less<>> values = {
      {"title", title},
      {"columns", columns},
      {"entries", fmt::format("{}", entries)},
      {"range", number(point.range)},
      {"twice_amplitude", number(2.0 * amplitude)},
      {"minus_amplitude", number(-amplitude)},
      {"step", number(point.step)},
      {"steps", fmt::format("{}", lammps_steps(point))},
      {"every", fmt::format("{}", series_steps(point))},
      {"rate", number(point.strain_rate)},
      {"temperature", number(one.temperature)},
      {"temperature_from", one.temperature_from},
      {"frame_steps", fmt::format("{}", std::llround(point.frame_interval / point.step))},
      {"relaxation", number(point.relaxation_time)},
      {"skin", number(skin_at_rest)},
      {"wanted_skin", number(wanted_skin_under_shear)},
      {"largest_skin", number(wanted_skin_under_shear + longest_approach)},
      {"longest_approach", number(longest_approach)},
      {"speed_margin", number(speed_margin)},
      {"most_steps", fmt::format("{}", most_steps_between_lists)},
      {"restart_steps", fmt::format("{}", steps_between_restarts)}};
  const auto write = [&](const std::string& name, const std::string& heat, std::string_view pair,
                         std::string_view script) {
    const bool moves = script == nve_script || script == sheared_script;
    values["name"] = name;
    values["heat"] = heat;
    values["read"] = filled(moves ? read_start_or_restart_part : read_start_part, values);
    values["system"] = filled(system_part, values);
    values["going_on"] = filled(going_on_part, values);
    values["variables"] = filled(variables_part, values);
    values["pair"] = filled(pair, values);
    values["series"] = filled(series_part, values);
    values["joined_series"] = filled(joined_series_part, values);
    write_file_atomically(folder / (name + ".in"), filled(script, values));
  };
  write_file_atomically(folder / "lucy.table", table_text(kernel, title));
  write_file_atomically(folder / "start.data",
                        particle_text(ParticleFormat::lammps_data, one.start, 0.0, title + "; peculiar velocities"));
  values["what"] = "by the table";
  write("single_point", "0", table_part, point_script);
  values["what"] = "exact to rounding";
  write("exact_point", "0", exact_part, point_script);
  write("nve", "0", table_part, nve_script);
  if (point.strain_rate != 0.0) write("sheared", "f_thermostat", table_part, sheared_script);
}

TableError table_error(const kernel::Lucy<2>& kernel, double density) {
  constexpr int parts = 16;  // of each interval, where the straight line is compared
  const double first = innermost * innermost;
  const double between = (kernel.range() * kernel.range() - first) / (entries - 1);
  const auto entry = [&](int i) { return std::min(std::sqrt(first + i * between), kernel.range()); };
  TableError error;
  double energy = 0.0;    // integral of |error of phi| 2 pi r dr
  double square = 0.0;    // of (error of the force)^2
  double pressure = 0.0;  // of r |error of the force|
  for (int i = 0; i + 1 < entries; ++i) {
    const double low = entry(i);
    const double high = entry(i + 1);
    for (int part = 0; part < parts; ++part) {
      const double along = (part + 0.5) / parts;
      const double r = std::sqrt(first + (i + along) * between);
      const double of_energy =
          kernel.weight(low) + along * (kernel.weight(high) - kernel.weight(low)) - kernel.weight(r);
      const double of_force =
          r * (kernel.slope(low) + along * (kernel.slope(high) - kernel.slope(low)) - kernel.slope(r));
      error.pair_energy = std::max(error.pair_energy, std::abs(of_energy));
      error.pair_force = std::max(error.pair_force, std::abs(of_force));
      const double area = std::numbers::pi * between / parts;  // 2 pi r dr = pi d(r^2)
      energy += std::abs(of_energy) * area;
      square += of_force * of_force * area;
      pressure += r * std::abs(of_force) * area;
    }
  }
  error.energy = 0.5 * density * energy;
  error.force = std::sqrt(0.5 * density * square);
  error.pressure = 0.25 * density * density * pressure;
  return error;
}

cases::EngineSeries read_lammps_series(const fs::path& path) {
  const ColumnFile file = read_columns(path);
  const auto column = [&](std::string_view name) -> const std::vector<double>& {
    return file.columns[find_column(file, name, path)];
  };
  // Where a run went on from a restart file, times begin again there: the later rows count.
  const auto& times = column("time");
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < times.size(); ++row) {
    while (!rows.empty() && times[rows.back()] >= times[row]) rows.pop_back();
    rows.push_back(row);
  }
  for (std::size_t i = 2; i < rows.size(); ++i) {
    const double interval = times[rows[1]] - times[rows[0]];
    if (!(std::abs(times[rows[i]] - times[rows[i - 1]] - interval) < 0.01 * interval))
      throw BadInput(fmt::format("{} has no row between the times {} and {}, where others lie {:.6g} apart",
                                 path.string(), times[rows[i - 1]], times[rows[i]], interval));
  }
  const auto chosen = [&](std::string_view name) {
    const auto& values = column(name);
    std::vector<double> result;
    for (const std::size_t row : rows) result.push_back(values[row]);
    return result;
  };
  cases::EngineSeries series;
  series.time = chosen("time");
  series.energy = chosen("energy");
  series.heat = chosen("heat");
  series.instants.resize(rows.size());
  for (std::size_t q = 0; q < cases::observables.size(); ++q) {
    const auto values = chosen(cases::observables[q]);
    for (std::size_t row = 0; row < rows.size(); ++row) series.instants[row][q] = values[row];
  }
  return series;
}

cases::CouetteRecord record_of(const cases::EngineSeries& series, const cases::CouettePoint& point) {
  const int between = series_steps(point);
  const int rows = std::max(1, cases::sample_steps(point) / between);
  cases::CouetteRecord record;
  record.sample_interval = rows * between * point.step;
  record.worst_energy_error = std::numeric_limits<double>::quiet_NaN();
  record.steps = lammps_steps(point);
  const double from = point.equilibration + 0.5 * point.step;
  std::size_t row = 0;
  while (row < series.time.size() && series.time[row] < from) ++row;
  for (; row + static_cast<std::size_t>(rows) <= series.time.size(); row += static_cast<std::size_t>(rows)) {
    cases::Sample sum{};
    for (int i = 0; i < rows; ++i)
      for (std::size_t q = 0; q < sum.size(); ++q) sum[q] += series.instants[row + static_cast<std::size_t>(i)][q];
    for (double& value : sum) value /= rows;
    record.samples.push_back(sum);
  }
  return record;
}

cases::PointSums read_lammps_point(const fs::path& folder, const std::string& name) {
  const fs::path values = folder / (name + ".txt");
  const ColumnFile printed = read_columns(values);
  const auto value = [&](const char* column) { return printed.columns[find_column(printed, column, values)].back(); };
  cases::PointSums point;
  point.potential_energy = value("potential_energy");
  point.kinetic = {value("kinetic_xx"), value("kinetic_yy"), value("kinetic_xy")};
  point.potential = {value("potential_xx"), value("potential_yy"), value("potential_xy")};

  // The rows of the dump begin behind the names of its columns.
  const fs::path dump = folder / (name + ".dump");
  const std::string text = read_text_file(dump);
  const std::size_t header = text.find("ITEM: ATOMS");
  const std::size_t first = header == std::string::npos ? header : text.find('\n', header);
  if (first == std::string::npos) throw BadInput(fmt::format("{} has no ITEM: ATOMS", dump.string()));
  const ColumnFile rows = parse_columns(std::string_view(text).substr(first), dump);
  if (rows.columns.size() != 5) throw BadInput(fmt::format("{} has not the columns id x y fx fy", dump.string()));
  for (std::size_t i = 0; i < rows.columns[0].size(); ++i)
    for (const std::size_t column : {3, 4}) point.forces.push_back(rows.columns[column][i]);
  return point;
}

}  // namespace lucy::files
