// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/benard_grid_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

namespace lucy::cases {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t fewest_for_rate = 6;
constexpr std::size_t fewest_for_line = 3;
constexpr double least_convection = 1e-6;  // K L^2/nu^2 of a flow that is no rest

/// The polynomial through points (x, y), at `where` (Lagrange).
double through_points(std::span<const double> x, std::span<const double> y, double where) {
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    double term = y[i];
    for (std::size_t j = 0; j < x.size(); ++j)
      if (j != i) term *= (where - x[j]) / (x[i] - x[j]);
    sum += term;
  }
  return sum;
}

struct Line {
  double slope = 0.0;
  double intercept = 0.0;
  double slope_error = 0.0;
  double intercept_error = 0.0;
  double covariance = 0.0;
};

Line fitted_line(std::span<const double> x, std::span<const double> y) {
  const auto count = static_cast<double>(x.size());
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / count;
    mean_y += y[i] / count;
  }
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  Line line;
  line.slope = xy / xx;
  line.intercept = mean_y - line.slope * mean_x;
  double squares = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) squares += std::pow(y[i] - line.intercept - line.slope * x[i], 2);
  const double variance = count > 2.0 ? squares / (count - 2.0) : not_a_number;
  line.slope_error = std::sqrt(variance / xx);
  line.intercept_error = std::sqrt(variance * (1.0 / count + mean_x * mean_x / xx));
  line.covariance = -variance * mean_x / xx;
  return line;
}

/// The slope of ln |amplitude| over the last third of the run, and how its halves differ.
void find_growth_rate(const std::vector<BenardGridSample>& samples, BenardGridRow& row) {
  std::vector<double> times;
  std::vector<double> logarithms;
  for (const BenardGridSample& sample : samples) {
    if (3.0 * sample.time < 2.0 * samples.back().time) continue;
    times.push_back(sample.time);
    logarithms.push_back(std::log(std::abs(sample.roll_amplitude)));
  }
  if (times.size() < fewest_for_rate) {
    row.status = RowStatus::too_short;
    return;
  }
  const std::span<const double> x(times);
  const std::span<const double> y(logarithms);
  const std::size_t half = times.size() / 2;
  row.growth_rate = fitted_line(x, y).slope;
  row.growth_rate_error =
      std::abs(fitted_line(x.first(half), y.first(half)).slope - fitted_line(x.last(half), y.last(half)).slope);
}

/// All settings in which rows may differ and still belong together, left out.
auto family_of(const BenardGridPoint& point) {
  return std::tuple(point.height, *point.width, point.sides, point.hot, point.cold, *point.gravity,
                    point.equation_of_state, point.transport, *point.conductivity / *point.viscosity, point.find);
}

/// Rows with equal keys, in the order in which the keys first occur.
template <class Item, class KeyOf>
std::vector<std::vector<Item>> grouped(std::span<const Item> items, const KeyOf& key_of) {
  std::vector<std::vector<Item>> groups;
  for (const Item& item : items) {
    const auto group = std::ranges::find_if(
        groups, [&](const std::vector<Item>& known) { return key_of(known.front()) == key_of(item); });
    if (group == groups.end())
      groups.push_back({item});
    else
      group->push_back(item);
  }
  return groups;
}

/// Ra where the rate is zero: the parabola, and how far the straight line is from it. Nothing without a change of sign.
std::optional<Extrapolated> zero_of_rate(std::vector<BenardGridRow> rows) {
  const auto scaled = [](const BenardGridRow& row) { return row.growth_rate * diffusion_time(row.settings); };
  std::ranges::sort(rows, {}, [&](const BenardGridRow& row) { return std::abs(scaled(row)); });
  rows.erase(
      std::unique(rows.begin(), rows.end(), [&](const auto& a, const auto& b) { return scaled(a) == scaled(b); }),
      rows.end());
  std::vector<double> rates;
  std::vector<double> numbers;
  for (const BenardGridRow& row : rows) {
    rates.push_back(scaled(row));
    numbers.push_back(*row.settings.rayleigh);
  }
  const auto [least, most] = std::ranges::minmax(rates);
  if (rows.size() < 2 || least > 0.0 || most < 0.0) return std::nullopt;
  const std::span<const double> x(rates);
  const std::span<const double> y(numbers);
  const double line = through_points(x.first(2), y.first(2), 0.0);
  if (rows.size() < 3) return Extrapolated{line, not_a_number};
  const double parabola = through_points(x.first(3), y.first(3), 0.0);
  return Extrapolated{parabola, std::abs(parabola - line)};
}

void add_by_growth(const std::vector<BenardGridRow>& family, std::vector<CriticalRayleigh>& found) {
  std::vector<int> cells;
  std::vector<double> numbers;
  CriticalRayleigh all;
  all.settings = family.front().settings;
  double interpolation_error = not_a_number;
  auto meshes = grouped(std::span(family), [](const BenardGridRow& row) { return row.settings.cells; });
  std::ranges::sort(meshes, {}, [](const auto& mesh) { return mesh.front().settings.cells; });
  for (const auto& mesh : meshes) {
    const auto zero = zero_of_rate(mesh);
    if (!zero) continue;
    all.points = static_cast<int>(mesh.size());
    found.push_back(
        {all.settings, CriticalRayleigh::Route::growth_rates, mesh.front().settings.cells, all.points, *zero});
    cells.push_back(mesh.front().settings.cells);
    numbers.push_back(zero->value);
    interpolation_error = zero->error;
  }
  if (cells.size() < 2) return;
  all.rayleigh = extrapolate(cells, numbers);
  all.rayleigh.error = std::hypot(all.rayleigh.error, interpolation_error);
  found.push_back(all);
}

void add_by_line(const std::vector<BenardGridLimit>& family, std::vector<CriticalRayleigh>& found) {
  std::vector<double> x;
  std::vector<double> y;
  for (const BenardGridLimit& limit : family) {
    const double unit = *limit.settings.viscosity / limit.settings.height;
    if (!(limit.kinetic_energy.value > least_convection * unit * unit)) continue;
    x.push_back(1.0 / std::sqrt(*limit.settings.rayleigh));
    y.push_back(limit.kinetic_energy.value);
  }
  if (x.size() < fewest_for_line) return;
  const Line line = fitted_line(x, y);
  const double end = -line.intercept / line.slope;  // Ra_c^(-1/2)
  const double variance =
      std::pow(line.intercept_error, 2) + std::pow(end * line.slope_error, 2) + 2.0 * end * line.covariance;
  CriticalRayleigh critical;
  critical.settings = family.front().settings;
  critical.route = CriticalRayleigh::Route::straight_line;
  critical.points = static_cast<int>(x.size());
  critical.rayleigh.value = 1.0 / (end * end);
  critical.rayleigh.error = 2.0 / std::pow(end, 3) * std::sqrt(std::max(variance, 0.0)) / std::abs(line.slope);
  found.push_back(critical);
}

}  // namespace

BenardGridRow failed_row(const BenardGridPoint& point, const std::string& reason) {
  BenardGridRow row;
  row.settings = resolved(point);
  for (double* number :
       {&row.time, &row.kinetic_energy, &row.nusselt_hot, &row.nusselt_cold, &row.nusselt_sides, &row.largest_speed,
        &row.energy_imbalance, &row.mass_error, &row.change, &row.growth_rate, &row.growth_rate_error})
    *number = not_a_number;
  row.status = RowStatus::failed;
  row.failure = reason;
  return row;
}

BenardGridRow summarize(const BenardGridPoint& point, const BenardGridRecord& record) {
  BenardGridRow row = failed_row(point, record.failure);
  const BenardGridSample& last = record.samples.back();
  row.time = last.time;
  row.kinetic_energy = last.kinetic_energy;
  row.nusselt_hot = last.nusselt_hot;
  row.nusselt_cold = last.nusselt_cold;
  row.nusselt_sides = last.nusselt_sides;
  row.largest_speed = last.largest_speed;
  row.energy_imbalance = (last.nusselt_hot + last.nusselt_sides - last.nusselt_cold) / last.nusselt_hot;
  row.mass_error = last.mass_error;
  if (record.samples.size() > 1) {
    const BenardGridSample& before = record.samples[record.samples.size() - 2];
    row.change =
        (last.kinetic_energy / before.kinetic_energy - 1.0) / (last.time - before.time) * diffusion_time(row.settings);
  }
  if (!record.failure.empty()) return row;
  row.status = RowStatus::ok;
  if (point.find == BenardGoal::growth_rate)
    find_growth_rate(record.samples, row);
  else if (!record.steady)
    row.status = RowStatus::too_short;
  return row;
}

Extrapolated extrapolate(std::span<const int> cells, std::span<const double> values) {
  std::vector<std::pair<int, double>> meshes;
  for (std::size_t i = 0; i < cells.size(); ++i) meshes.emplace_back(cells[i], values[i]);
  std::ranges::sort(meshes, std::ranges::greater{}, &std::pair<int, double>::first);
  meshes.erase(
      std::unique(meshes.begin(), meshes.end(), [](const auto& a, const auto& b) { return a.first == b.first; }),
      meshes.end());
  if (meshes.size() < 2) return {not_a_number, not_a_number};
  std::vector<double> x;
  std::vector<double> y;
  for (const auto& [n, value] : meshes) {
    x.push_back(1.0 / (static_cast<double>(n) * n));
    y.push_back(value);
  }
  const std::span<const double> all_x(x);
  const std::span<const double> all_y(y);
  const double line = through_points(all_x.first(2), all_y.first(2), 0.0);
  if (meshes.size() < 3) return {line, not_a_number};
  return {line, std::abs(through_points(all_x.first(3), all_y.first(3), 0.0) - line)};
}

std::vector<BenardGridLimit> limits_of(std::span<const BenardGridRow> rows) {
  std::vector<BenardGridRow> steady;
  for (const BenardGridRow& row : rows)
    if (row.status == RowStatus::ok && row.settings.find == BenardGoal::steady_state) steady.push_back(row);
  std::vector<BenardGridLimit> limits;
  for (const auto& group : grouped(std::span<const BenardGridRow>(steady), [](const BenardGridRow& row) {
         return std::tuple(family_of(row.settings), *row.settings.viscosity);
       })) {
    std::vector<int> cells;
    for (const BenardGridRow& row : group) cells.push_back(row.settings.cells);
    const auto limit = [&](double BenardGridRow::*quantity) {
      std::vector<double> values;
      for (const BenardGridRow& row : group) values.push_back(row.*quantity);
      return extrapolate(cells, values);
    };
    limits.push_back({group[static_cast<std::size_t>(std::ranges::max_element(cells) - cells.begin())].settings,
                      static_cast<int>(std::set<int>(cells.begin(), cells.end()).size()),
                      limit(&BenardGridRow::kinetic_energy), limit(&BenardGridRow::nusselt_hot),
                      limit(&BenardGridRow::nusselt_cold)});
  }
  return limits;
}

std::vector<CriticalRayleigh> critical_rayleighs(std::span<const BenardGridRow> rows) {
  std::vector<BenardGridRow> growing;
  for (const BenardGridRow& row : rows)
    if (row.status == RowStatus::ok && row.settings.find == BenardGoal::growth_rate) growing.push_back(row);
  std::vector<CriticalRayleigh> found;
  for (const auto& family : grouped(std::span<const BenardGridRow>(growing),
                                    [](const BenardGridRow& row) { return family_of(row.settings); }))
    add_by_growth(family, found);
  const std::vector<BenardGridLimit> limits = limits_of(rows);
  for (const auto& family : grouped(std::span<const BenardGridLimit>(limits),
                                    [](const BenardGridLimit& limit) { return family_of(limit.settings); }))
    add_by_line(family, found);
  return found;
}

}  // namespace lucy::cases
