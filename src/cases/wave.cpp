// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/wave.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "cases/wave_budget.hpp"
#include "lucy/motion/start.hpp"
#include "lucy/motion/trajectory.hpp"

namespace lucy::cases {

namespace {

using Fluid = motion::FluidTrajectory<2>;
using Atoms = motion::Trajectory<2>;

motion::Watch watch_of(const WavePoint& point) {
  motion::Watch watch;
  watch.energy_tolerance = point.energy_tolerance;
  return watch;
}

std::vector<space::Vector<2>> vectors(const std::vector<double>& flat) {
  std::vector<space::Vector<2>> result;
  for (std::size_t i = 0; i < flat.size(); i += 2) result.push_back({flat[i], flat[i + 1]});
  return result;
}

/// Velocities with the shear wave on them, and no net momentum along x.
std::vector<space::Vector<2>> sheared(const std::vector<double>& velocities, const WaveShape& shape, double amplitude) {
  std::vector<space::Vector<2>> result = vectors(velocities);
  double mean = 0.0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i][0] += amplitude * shape.sine(i);
    mean += result[i][0] / static_cast<double>(result.size());
  }
  for (auto& velocity : result) velocity[0] -= mean;
  return result;
}

/// Internal energies with the temperature wave in them.
std::vector<double> heated(const Fluid& trajectory, const WaveShape& shape, double amplitude) {
  const std::vector<double> densities = trajectory.densities();
  std::vector<double> values = trajectory.temperatures();
  std::visit(
      [&](const auto& state) {
        for (std::size_t i = 0; i < values.size(); ++i)
          values[i] = state.energy(densities[i], values[i] * (1.0 + amplitude * shape.sine(i)));
      },
      trajectory.fluid().fluid().state);
  return values;
}

}  // namespace

struct WaveRun::Implementation {
  Implementation(const WavePoint& settings, int replica, int threads)
      : point((validate(settings), settings)),
        schedule(wave_schedule(settings)),
        wave_vector(cases::wave_vector(settings)),
        team(threads),
        trajectory(start(replica)) {
    record.sample_interval = schedule.sample_interval(point);
    if (schedule.equilibration_steps == 0) superpose();
  }

  std::variant<Fluid, Atoms> start(int replica) const {
    const std::uint64_t seed = replica_seed(point, replica);
    if (point.reading == motion::Reading::spam) return fluid(fluid_start(point, seed));
    return atoms(motion::lattice_start(kernel::Lucy<2>(point.range), point.particles, point.density,
                                       *point.energy_per_particle, seed));
  }

  Fluid fluid(const motion::FluidStart<2>& from) const {
    return Fluid(fluid_of(point), from, 0.0, motion::Cooling::none, watch_of(point), team);
  }

  Atoms atoms(const motion::Start<2>& from) const {
    motion::Shear at_rest;
    at_rest.thermostat = motion::Thermostat::none;
    return Atoms(kernel::Lucy<2>(point.range), from, at_rest, motion::Integrator::runge_kutta_4, watch_of(point), team);
  }

  Fluid with_wave(const Fluid& from) const {
    const WaveShape shape(from.positions(), wave_vector);
    motion::FluidStart<2> next;
    next.lengths = from.box().lengths();
    next.position = vectors(from.positions());
    next.velocity = vectors(from.velocities());
    next.energy = from.energies();
    if (point.quantity == WaveQuantity::shear) {
      next.velocity = sheared(from.velocities(), shape, point.amplitude);
    } else {
      next.energy = heated(from, shape, point.amplitude);
    }
    return fluid(next);
  }

  Atoms with_wave(const Atoms& from) const {
    const WaveShape shape(from.positions(), wave_vector);
    return atoms({from.box().lengths(), vectors(from.positions()), sheared(from.momenta(), shape, point.amplitude)});
  }

  WaveSample sample() const {
    return std::visit([&](const auto& moving) { return wave_sample(point.quantity, moving, wave_vector); }, trajectory);
  }

  void superpose() {
    const double before = sample().amplitude;
    subdivided_before = report().subdivided_steps;
    worst_before = report().worst_energy_error;
    trajectory =
        std::visit([&](const auto& moving) { return std::variant<Fluid, Atoms>(with_wave(moving)); }, trajectory);
    record.samples.push_back(sample());
    record.imposed_amplitude = record.samples.front().amplitude - before;
  }

  const motion::WatchReport& report() const {
    return std::visit([](const auto& moving) -> const motion::WatchReport& { return moving.report(); }, trajectory);
  }

  void renew_list() {
    std::visit([&](auto& moving) { moving.renew_list(point.step); }, trajectory);
  }

  void run(std::int64_t steps) {
    std::visit(
        [&](auto& moving) {
          for (std::int64_t step = 0; step < steps; ++step) moving.advance(point.step);
        },
        trajectory);
    record.steps += steps;
  }

  void equilibrate() {
    const std::int64_t left = schedule.equilibration_steps - done * schedule.steps_per_interval();
    run(std::min(left, schedule.steps_per_interval()));
    if (left <= schedule.steps_per_interval()) superpose();
  }

  void follow() {
    const auto taken = static_cast<std::int64_t>(record.samples.size()) - 1;
    const std::int64_t now = std::min(schedule.samples_per_interval, schedule.samples - taken);
    for (std::int64_t i = 0; i < now; ++i) {
      run(schedule.steps_per_sample);
      record.samples.push_back(sample());
    }
  }

  WavePoint point;
  WaveSchedule schedule;
  double wave_vector;
  Team team;
  std::variant<Fluid, Atoms> trajectory;
  std::int64_t done = 0;
  std::int64_t subdivided_before = 0;  // in the equilibration
  double worst_before = 0.0;
  WaveRecord record;
};

WaveRun::WaveRun(const WavePoint& point, int replica, int threads)
    : self_(std::make_unique<Implementation>(point, replica, threads)) {}
WaveRun::~WaveRun() = default;
WaveRun::WaveRun(WaveRun&&) noexcept = default;
WaveRun& WaveRun::operator=(WaveRun&&) noexcept = default;

void WaveRun::advance_one_interval() {
  Implementation& self = *self_;
  self.renew_list();
  if (self.done < self.schedule.equilibration_intervals()) {
    self.equilibrate();
  } else {
    self.follow();
  }
  ++self.done;
  self.record.subdivided_steps = self.subdivided_before + self.report().subdivided_steps;
  self.record.worst_energy_error = std::max(self.worst_before, self.report().worst_energy_error);
}

std::int64_t WaveRun::intervals_done() const { return self_->done; }

std::int64_t WaveRun::intervals_needed() const { return self_->schedule.intervals(); }

const WaveRecord& WaveRun::record() const { return self_->record; }

bool WaveRun::frame_due() const {
  const Implementation& self = *self_;
  if (self.point.frame_interval <= 0.0 || self.record.samples.empty()) return false;
  const auto between = std::llround(self.point.frame_interval / self.record.sample_interval);
  return (static_cast<std::int64_t>(self.record.samples.size()) - 1) % between == 0;
}

Frame WaveRun::frame() const {
  const Implementation& self = *self_;
  Frame frame;
  frame.step = self.record.steps;
  frame.time = static_cast<double>(frame.step) * self.point.step;
  std::visit(
      [&]<class Moving>(const Moving& moving) {
        frame.box = moving.box().lengths();
        frame.position = moving.positions();
        if constexpr (std::is_same_v<Moving, Fluid>) {
          frame.momentum = moving.velocities();
          frame.internal_energy = moving.energies();
        } else {
          frame.momentum = moving.momenta();
        }
      },
      self.trajectory);
  return frame;
}

void WaveRun::save(ArchiveWriter& archive) const {
  const Implementation& self = *self_;
  archive.put(self.done);
  archive.put(self.subdivided_before);
  archive.put(self.worst_before);
  archive.put(self.record.imposed_amplitude);
  archive.put_sequence(self.record.samples);
  archive.put(self.record.worst_energy_error);
  archive.put(self.record.steps);
  archive.put(self.record.subdivided_steps);
  std::visit([&](const auto& moving) { moving.save(archive); }, self.trajectory);
}

void WaveRun::load(ArchiveReader& archive) {
  Implementation& self = *self_;
  self.done = archive.get<std::int64_t>();
  self.subdivided_before = archive.get<std::int64_t>();
  self.worst_before = archive.get<double>();
  self.record.imposed_amplitude = archive.get<double>();
  archive.get_sequence(self.record.samples);
  self.record.worst_energy_error = archive.get<double>();
  self.record.steps = archive.get<std::int64_t>();
  self.record.subdivided_steps = archive.get<std::int64_t>();
  std::visit([&](auto& moving) { moving.load(archive); }, self.trajectory);
}

}  // namespace lucy::cases
