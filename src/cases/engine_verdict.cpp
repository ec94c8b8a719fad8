// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/engine_verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lucy/cases/start_state.hpp"
#include "lucy/motion/trajectory.hpp"

namespace lucy::cases {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double most_standard_errors = 4.0;

double largest_difference(std::span<const double> a, std::span<const double> b) {
  double largest = a.size() == b.size() ? 0.0 : not_a_number;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    if (const double difference = std::abs(a[i] - b[i]); !(difference <= largest)) largest = difference;
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
                              const statistics::Estimate& other) {
  VerdictLine line = {part,        quantity,    lucy.value,   lucy.error,
                      other.value, other.error, not_a_number, most_standard_errors};
  line.difference = (other.value - lucy.value) / std::hypot(lucy.error, other.error);
  line.in_standard_errors = true;
  return line;
}

std::vector<VerdictLine> compare_rows(const std::string& part, const TableRow& lucy, const TableRow& other,
                                      std::span<const std::string_view> names) {
  std::vector<VerdictLine> lines;
  for (const auto name : names) {
    const auto place = static_cast<std::size_t>(std::ranges::find(quantities, name) - quantities.begin());
    lines.push_back(compare_estimates(part, std::string(name), lucy.estimates[place], other.estimates[place]));
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

}  // namespace lucy::cases
