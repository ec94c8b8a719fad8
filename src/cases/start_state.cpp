// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/start_state.hpp"

#include <algorithm>
#include <cmath>

#include "cases/refusals.hpp"
#include "lucy/motion/trajectory.hpp"

namespace lucy::cases {

namespace {

constexpr double most_scaling = 0.1;
constexpr double density_tolerance = 1e-6;
// Of the slope of v_x over y. Velocities without a flow come that far in one file out of millions.
constexpr double significant_errors = 5.0;

std::string name_of_start(const CouettePoint& point) { return fmt::format("system.start = \"{}\"", point.start); }

double potential_energy(const CouettePoint& point, const motion::Start<2>& start) {
  return motion::Trajectory<2>(kernel::Lucy<2>(point.range), start, {}, motion::Integrator::runge_kutta_4, {}, Team(1))
      .pair_totals()
      .potential_energy;
}

}  // namespace

motion::Start<2> start_of(const Frame& frame) {
  motion::Start<2> start;
  start.lengths = frame.box;
  start.offset = frame.offset;
  for (std::size_t i = 0; i < frame.position.size(); i += 2) {
    start.position.push_back({frame.position[i], frame.position[i + 1]});
    start.momentum.push_back({frame.momentum[i], frame.momentum[i + 1]});
  }
  return start;
}

motion::Start<2> state_start(const CouettePoint& point) {
  const std::string key = name_of_start(point);
  if (!point.start_frame) refuse(key + " was not read");
  const Frame& frame = *point.start_frame;
  const auto particles = static_cast<std::int64_t>(frame.position.size() / 2);
  const auto n = static_cast<double>(particles);
  if (particles != point.particles)
    refuse(fmt::format("system.particles = {}, but {} has {} particles", point.particles, key, particles));
  if (frame.momentum.size() != frame.position.size()) refuse(key + " has no velocities");
  if (const double density = n / (frame.box[0] * frame.box[1]);
      std::abs(density - point.density) > density_tolerance * density)
    refuse(fmt::format("system.density = {}, but {} has the density {}", point.density, key, density));
  if (std::min(frame.box[0], frame.box[1]) < 2.0 * point.range)
    refuse(fmt::format("{} has a box of {} by {}, below twice kernel.range = {}", key, frame.box[0], frame.box[1],
                       point.range));
  if (point.replicas != 1)
    refuse(fmt::format("run.replicas = {} must be 1 with {}: all would be the same", point.replicas, key));

  motion::Start<2> start = start_of(frame);
  space::Vector<2> total{};
  for (const auto& p : start.momentum)
    for (std::size_t d = 0; d < 2; ++d) total[d] += p[d];
  double kinetic = 0.0;
  for (auto& p : start.momentum) {
    for (std::size_t d = 0; d < 2; ++d) {
      p[d] -= total[d] / n;
      kinetic += 0.5 * p[d] * p[d];
    }
  }
  const double potential = potential_energy(point, start);
  const double wanted = point.energy_per_particle * n - potential;
  const double factor = std::sqrt(std::max(0.0, wanted) / kinetic);
  if (!(std::abs(factor - 1.0) <= most_scaling))
    refuse(
        fmt::format("system.energy_per_particle = {}, but {} has {:.6g}{}", point.energy_per_particle, key,
                    (kinetic + potential) / n,
                    kinetic > wanted ? "; if a flow is in its velocities, system.start_strain_rate takes it out" : ""));
  for (auto& p : start.momentum)
    for (double& component : p) component *= factor;
  return start;
}

void refuse_unfit_start(const CouettePoint& point) { state_start(point); }

void refuse_flow_in_start(const CouettePoint& point) {
  if (!point.start_frame || point.start_frame->momentum.size() < 6) return;
  const Frame& frame = *point.start_frame;
  const std::size_t particles = frame.position.size() / 2;
  const auto n = static_cast<double>(particles);
  double mean_y = 0.0;
  double mean_v = 0.0;
  for (std::size_t i = 0; i < frame.momentum.size(); i += 2) {
    mean_y += frame.position[i + 1] / n;
    mean_v += frame.momentum[i] / n;
  }
  double yy = 0.0;
  double yv = 0.0;
  double vv = 0.0;
  for (std::size_t i = 0; i < frame.momentum.size(); i += 2) {
    const double y = frame.position[i + 1] - mean_y;
    const double v = frame.momentum[i] - mean_v;
    yy += y * y;
    yv += y * v;
    vv += v * v;
  }
  const double slope = yv / yy;
  const double error = std::sqrt(std::max(0.0, vv - slope * yv) / (n - 2.0) / yy);
  if (std::abs(slope) > significant_errors * error)
    refuse(fmt::format(
        "{} has a flow in its velocities, v_x = {:.3g} y (standard error {:.2g}), and does not say its strain "
        "rate: system.start_strain_rate takes it out (0: the velocities are peculiar as they are)",
        name_of_start(point), slope, error));
}

}  // namespace lucy::cases
