// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/engine_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lucy/cases/green_kubo_table.hpp"
#include "lucy/cases/place_of.hpp"
#include "lucy/cases/start_state.hpp"
#include "lucy/motion/trajectory.hpp"

namespace lucy::cases {

namespace {

// Where the first of two parts stands in cases::observables.
constexpr std::size_t pxy = place_of(observables, "pxy_kinetic");
constexpr std::size_t pxx = place_of(observables, "pxx_kinetic");
constexpr std::size_t pyy = place_of(observables, "pyy_kinetic");

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double most_standard_errors = 4.0;
constexpr double most_uncertain = 0.25;
constexpr double together_beyond_integrators = 1.5;  // of the time that Verlet stays with Runge-Kutta
constexpr double parting_tolerance = 0.01;           // relative; the same integrators part at the same time
constexpr double heat_tolerance = 2e-3;              // trapezoids between rows of a series, an integrator with a step

double largest_difference(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) return not_a_number;
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::abs(a[i] - b[i]);
    if (std::isnan(difference)) return difference;
    largest = std::max(largest, difference);
  }
  return largest;
}

double typical_difference(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) return not_a_number;
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// A line without a number of either side.
VerdictLine difference_line(const std::string& part, const std::string& quantity, double difference, double allowed) {
  return {part, quantity, not_a_number, 0.0, not_a_number, 0.0, difference, allowed};
}

/// V/kT int_0^end C dt of a series at equilibrium, C as in green_kubo_table.hpp, as the mean of what every instant has
/// to say of it, P(t) int_0^end P(t + s) ds: its error needs no blocks as long as many decay times.
statistics::Estimate integral_to(double end, const SampledSeries& series) {
  const auto steps = static_cast<std::size_t>(std::llround(end / series.sample_interval));
  std::vector<double> instants;
  const auto add = [&](const std::vector<double>& stress) {
    instants.resize(stress.size() > steps ? stress.size() - steps : 0, 0.0);
    double inside = 0.0;  // of the window that begins here, its first sample not counted
    for (std::size_t i = 1; i <= std::min(steps, stress.size() - 1); ++i) inside += stress[i];
    for (std::size_t i = 0; i < instants.size(); ++i) {
      const double trapezoids = inside + 0.5 * (stress[i] - stress[i + steps]);
      instants[i] += 0.5 * stress[i] * trapezoids * series.sample_interval * series.volume / series.kinetic_temperature;
      if (i + 1 + steps < stress.size()) inside += stress[i + 1 + steps] - stress[i + 1];
    }
  };
  add(series.pxy);
  add(series.stress_difference);
  return statistics::pooled_mean(std::span<const std::vector<double>>(&instants, 1));
}

}  // namespace

bool VerdictLine::agrees() const { return !judged || std::abs(difference) <= allowed; }

PointSums evaluate(const kernel::Lucy<2>& kernel, const Frame& frame) {
  const motion::Trajectory<2> state(kernel, start_of(frame), {}, motion::Integrator::runge_kutta_4, {}, Team(1));
  const auto& kinetic = state.kinetic();
  const auto& pair = state.pair_totals();
  const double volume = state.volume();
  PointSums sums;
  sums.potential_energy = pair.potential_energy;
  sums.kinetic = {kinetic.momentum_flux(0, 0) / volume, kinetic.momentum_flux(1, 1) / volume,
                  kinetic.momentum_flux(0, 1) / volume};
  sums.potential = {pair.virial(0, 0) / volume, pair.virial(1, 1) / volume, pair.virial(0, 1) / volume};
  sums.forces = state.forces();
  return sums;
}

std::vector<VerdictLine> compare_points(const std::string& part, const PointSums& lucy, const PointSums& other,
                                        const PointAllowance& allowed) {
  const double n = 0.5 * static_cast<double>(lucy.forces.size());
  const double energy = lucy.potential_energy / n;
  const double other_energy = other.potential_energy / n;
  return {
      {part, "potential energy per particle", energy, 0.0, other_energy, 0.0, other_energy - energy, allowed.energy},
      difference_line(part, "forces: largest difference", largest_difference(lucy.forces, other.forces),
                      allowed.largest_force),
      difference_line(part, "forces: r.m.s. difference", typical_difference(lucy.forces, other.forces),
                      allowed.typical_force),
      difference_line(part, "kinetic pressure: worst of xx yy xy", largest_difference(lucy.kinetic, other.kinetic),
                      allowed.kinetic),
      difference_line(part, "potential pressure: worst of xx yy xy",
                      largest_difference(lucy.potential, other.potential), allowed.potential)};
}

VerdictLine compare_estimates(const std::string& part, const std::string& quantity, const statistics::Estimate& lucy,
                              const statistics::Estimate& other, double scale) {
  VerdictLine line = {part,        quantity,    lucy.value,   lucy.error,
                      other.value, other.error, not_a_number, most_standard_errors};
  const double error = std::hypot(lucy.error, other.error);
  if (error <= most_uncertain * scale) line.difference = (other.value - lucy.value) / error;
  line.in_standard_errors = true;
  return line;
}

std::vector<VerdictLine> compare_rows(const std::string& part, const TableRow& lucy, const TableRow& other,
                                      std::span<const std::string_view> names) {
  const auto place = [](std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(quantities, name) - quantities.begin());
  };
  const auto scale = [&](std::string_view name) {
    const std::string component(name.substr(0, name.find('_')));
    if (name != component + "_kinetic" && name != component + "_potential")
      return std::abs(lucy.estimates[place(name)].value);
    double sum = 0.0;
    for (const char* which : {"_kinetic", "_potential"})
      sum += std::abs(lucy.estimates[place(component + which)].value);
    return sum;
  };
  std::vector<VerdictLine> lines;
  for (const auto name : names)
    lines.push_back(compare_estimates(part, std::string(name), lucy.estimates[place(name)],
                                      other.estimates[place(name)], scale(name)));
  return lines;
}

std::vector<VerdictLine> compare_green_kubo(const CouettePoint& point, const CouetteRecord& lucy,
                                            const TableRow& lucy_row, const CouetteRecord& other,
                                            const TableRow& other_row) {
  const auto series_of = [&](const CouetteRecord& record, const TableRow& row) {
    SampledSeries series;
    for (const Sample& sample : record.samples) {
      series.pxy.push_back(sample[pxy] + sample[pxy + 1]);
      series.stress_difference.push_back(0.5 * (sample[pxx] + sample[pxx + 1] - sample[pyy] - sample[pyy + 1]));
    }
    series.sample_interval = record.sample_interval;
    series.volume = static_cast<double>(point.particles) / point.density;
    series.kinetic_temperature = row.estimates[quantity("kinetic_temperature")].value;
    return series;
  };
  const SampledSeries our_series = series_of(lucy, lucy_row);
  const SampledSeries their_series = series_of(other, other_row);
  const std::string part = fmt::format("Green-Kubo at E/N = {}", point.energy_per_particle);
  const statistics::Estimate ours = integral_to(green_kubo_time, our_series);
  std::vector<VerdictLine> lines = {
      compare_estimates(part, fmt::format("stress autocorrelation to t = {}", green_kubo_time), ours,
                        integral_to(green_kubo_time, their_series), std::abs(ours.value))};
  const GreenKuboRow here = summarize_series(our_series).row;
  const GreenKuboRow there = summarize_series(their_series).row;
  for (const auto& [name, place] :
       {std::pair("viscosity", green_kubo_quantity("viscosity")),
        std::pair("viscosity by the spectrum", green_kubo_quantity("viscosity_spectrum"))}) {
    const statistics::Estimate& mine = here.estimates[place];
    lines.push_back(compare_estimates(part, name, mine, there.estimates[place], std::abs(mine.value)));
    lines.back().judged = !std::isnan(lines.back().difference);
  }
  return lines;
}

double separation(const Frame& a, const Frame& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.position.size(); i += 2) {
    double y = b.position[i + 1] - a.position[i + 1];
    const double above = std::round(y / a.box[1]);
    y -= above * a.box[1];
    double x = b.position[i] - a.position[i] - above * a.offset;
    x -= std::round(x / a.box[0]) * a.box[0];
    sum += x * x + y * y;
  }
  return std::sqrt(sum / (0.5 * static_cast<double>(a.position.size())));
}

double parting_time(std::span<const double> separations, double interval, double distance) {
  for (std::size_t i = 0; i < separations.size(); ++i) {
    if (separations[i] <= distance) continue;
    const auto entry = static_cast<double>(i);
    if (i == 0 || !(separations[i - 1] > 0.0)) return entry * interval;
    const double back = std::log(separations[i] / distance) / std::log(separations[i] / separations[i - 1]);
    return (entry - back) * interval;
  }
  return static_cast<double>(separations.size()) * interval;
}

std::vector<VerdictLine> compare_trajectories(const std::string& part, const Trajectories& trajectories,
                                              double distance) {
  const std::size_t frames =
      std::min({trajectories.runge_kutta.size(), trajectories.verlet.size(), trajectories.other.size()});
  const auto parting = [&](std::span<const Frame> a, std::span<const Frame> b) {
    std::vector<double> separations;
    for (std::size_t i = 0; i < frames; ++i) separations.push_back(separation(a[i], b[i]));
    return parting_time(separations, trajectories.interval, distance);
  };
  const double end = static_cast<double>(frames) * trajectories.interval;  // for those that never part
  VerdictLine integrators = {part, "from Lucy's Runge-Kutta: Lucy's Verlet; LAMMPS's"};
  integrators.lucy = parting(trajectories.runge_kutta, trajectories.verlet);
  integrators.other = parting(trajectories.runge_kutta, trajectories.other);
  integrators.difference = integrators.lucy < end ? integrators.other / integrators.lucy - 1.0 : not_a_number;
  integrators.allowed = parting_tolerance;
  VerdictLine same = {part, "from Lucy's Verlet: at least; LAMMPS's"};
  same.lucy = std::min(together_beyond_integrators * integrators.lucy, end);
  same.other = parting(trajectories.verlet, trajectories.other);
  same.difference = std::min(0.0, same.other - same.lucy);
  return {integrators, same};
}

double heat_over_work(const CouettePoint& point, const EngineSeries& series) {
  const double volume = static_cast<double>(point.particles) / point.density;
  const auto first =
      static_cast<std::size_t>(std::ranges::lower_bound(series.time, point.equilibration) - series.time.begin());
  if (first + 1 >= series.time.size()) return not_a_number;
  const auto stress = [&](std::size_t row) { return series.instants[row][pxy] + series.instants[row][pxy + 1]; };
  double work = 0.0;
  for (std::size_t i = first + 1; i < series.time.size(); ++i)
    work -= point.strain_rate * volume * 0.5 * (stress(i) + stress(i - 1)) * (series.time[i] - series.time[i - 1]);
  return (series.heat.back() - series.heat[first] + series.energy.back() - series.energy[first]) / work;
}

double heat_over_work(const CouettePoint& point, const CouetteRecord& record, const TableRow& row) {
  const double power = point.strain_rate * point.strain_rate * row.estimates[quantity("viscosity")].value;
  const double work = power / point.density * static_cast<double>(record.steps) * point.step;  // per particle
  return 1.0 - record.energy_rescaled / work;
}

VerdictLine compare_heat(const std::string& part, const std::string& quantity, std::optional<double> lucy,
                         double other) {
  VerdictLine line = {part, quantity, lucy.value_or(not_a_number), 0.0, other, 0.0, other - 1.0, heat_tolerance};
  if (lucy && (std::isnan(*lucy) || std::abs(*lucy - 1.0) > std::abs(line.difference))) line.difference = *lucy - 1.0;
  return line;
}

}  // namespace lucy::cases
