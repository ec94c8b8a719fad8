// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/couette.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/pacing.hpp"
#include "cases/refusals.hpp"
#include "cases/seeds.hpp"
#include "lucy/cases/start_state.hpp"
#include "lucy/errors.hpp"
#include "lucy/motion/trajectory.hpp"

namespace lucy::cases {

namespace {

constexpr double default_sample_interval = 0.5;
constexpr double most_samples = 20000.0;
constexpr double fewest_samples = 10.0;

double kinetic_energy(const motion::Start<2>& start) {
  double sum = 0.0;
  for (const auto& p : start.momentum) sum += 0.5 * (p[0] * p[0] + p[1] * p[1]);
  return sum;
}

}  // namespace

std::uint64_t replica_seed(const CouettePoint& point, int replica) {
  return mixed_seed(point.seed, {static_cast<std::uint64_t>(replica), static_cast<std::uint64_t>(point.particles),
                                 bits(point.energy_per_particle), bits(point.strain_rate)});
}

int sample_steps(const CouettePoint& point) {
  double interval = point.sample_interval;
  if (interval <= 0.0) {
    interval = std::max(default_sample_interval, point.duration / most_samples);
    interval = std::min(interval, point.duration / fewest_samples);
  }
  return interval_steps(interval, point.frame_interval, point.step);
}

void validate(const CouettePoint& point) {
  if (point.dimension != 2) refuse(fmt::format("system.dimension = {} must be 2", point.dimension));
  if (point.kernel != "lucy") refuse(fmt::format("kernel.name = \"{}\" must be \"lucy\"", point.kernel));
  if (!(point.step > 0.0 && point.step <= 0.2)) {
    refuse(fmt::format("run.step = {} must be above 0 and at most 0.2", point.step));
  }
  refuse_unless_above_zero("run.duration", point.duration);
  refuse_unless_above_zero("system.density", point.density);
  refuse_unless_above_zero("kernel.range", point.range);
  refuse_unless_above_zero("run.energy_tolerance", point.energy_tolerance);
  refuse_unless_above_zero("shear.relaxation_time", point.relaxation_time);
  if (point.kinetic_temperature) refuse_unless_above_zero("system.kinetic_temperature", *point.kinetic_temperature);
  if (!std::isfinite(point.strain_rate))
    refuse(fmt::format("shear.strain_rate = {} must be finite", point.strain_rate));
  refuse_unless_at_least_zero("run.equilibration", point.equilibration);
  refuse_endless_run(point.equilibration, point.duration, point.step);
  if (point.particles < 4 || point.particles > 100'000'000) {
    refuse(fmt::format("system.particles = {} must be between 4 and 100000000", point.particles));
  }

  const kernel::Lucy<2> kernel(point.range);
  const auto sites = motion::near_square(point.particles);
  if (!point.start.empty()) {
    refuse_unfit_start(point);
  } else if (sites) {
    const double shortest = static_cast<double>((*sites)[1]) / std::sqrt(point.density);
    if (shortest < 2.0 * point.range) {
      refuse(fmt::format("system.particles = {} at density {} make a box of side {:.4g}, below twice kernel.range = {}",
                         point.particles, point.density, shortest, point.range));
    }
  }
  if (point.start.empty())
    motion::refuse_impossible_start(kernel, point.particles, point.density, point.energy_per_particle);

  if (point.integrator == motion::Integrator::velocity_verlet &&
      (point.strain_rate != 0.0 ||
       (point.thermostat != motion::Thermostat::none && point.thermostat != motion::Thermostat::isoenergetic))) {
    refuse(
        "run.integrator = \"velocity-verlet\" needs shear.strain_rate = 0 and thermostat \"none\" or "
        "\"isoenergetic\" (plain Newtonian motion); use \"rk4\"");
  }
  refuse_large_strain(point.strain_rate, point.step);
  refuse_uneven_intervals(point.sample_interval, point.frame_interval, point.step, point.duration);
}

struct CouetteRun::Implementation {
  using Trajectory = motion::Trajectory<2>;

  Implementation(const CouettePoint& settings, int replica, int threads)
      : point(settings), steps_per_sample(sample_steps(settings)), trajectory(make(settings, replica, threads)) {
    equilibration_intervals = intervals(point.equilibration);
    record.sample_interval = steps_per_sample * point.step;
  }

  static Trajectory make(const CouettePoint& point, int replica, int threads) {
    validate(point);
    const kernel::Lucy<2> kernel(point.range);
    const auto start_of_replica = [&](int number) {
      return point.start.empty() ? motion::lattice_start(kernel, point.particles, point.density,
                                                         point.energy_per_particle, replica_seed(point, number))
                                 : state_start(point);
    };
    const motion::Start<2> start = start_of_replica(replica);
    motion::Shear shear;
    shear.strain_rate = point.strain_rate;
    shear.thermostat = point.thermostat;
    shear.relaxation_time = point.relaxation_time;
    if (point.kinetic_temperature) {
      shear.target_kinetic_energy = *point.kinetic_temperature * static_cast<double>(point.particles - 1);
    } else if (point.thermostat == motion::Thermostat::isokinetic ||
               point.thermostat == motion::Thermostat::nose_hoover) {
      // One temperature for all replicas, though their starts differ a little: that of the first.
      shear.target_kinetic_energy = kinetic_energy(replica == 0 ? start : start_of_replica(0));
    }
    motion::Watch watch;
    watch.energy_tolerance = point.energy_tolerance;
    watch.rescale = point.rescale;
    return Trajectory(kernel, start, shear, point.integrator, watch, Team(threads), point.reading);
  }

  std::int64_t intervals(double time) const { return intervals_in(time, steps_per_sample, point.step); }

  Sample observe() const {
    const double volume = trajectory.volume();
    const auto n = static_cast<double>(point.particles);
    const auto& kinetic = trajectory.kinetic();
    const auto& pair = trajectory.pair_totals();
    return {pair.potential_energy / n,
            kinetic.kinetic_energy() / (n - 1.0),
            kinetic.momentum_flux(0, 1) / volume,
            pair.virial(0, 1) / volume,
            kinetic.momentum_flux(0, 0) / volume,
            pair.virial(0, 0) / volume,
            kinetic.momentum_flux(1, 1) / volume,
            pair.virial(1, 1) / volume,
            kinetic.largest_share()};
  }

  CouettePoint point;
  int steps_per_sample;
  std::int64_t equilibration_intervals = 0;
  std::int64_t done = 0;
  Trajectory trajectory;
  CouetteRecord record;
};

CouetteRun::CouetteRun(const CouettePoint& point, int replica, int threads)
    : self_(std::make_unique<Implementation>(point, replica, threads)) {}
CouetteRun::~CouetteRun() = default;
CouetteRun::CouetteRun(CouetteRun&&) noexcept = default;
CouetteRun& CouetteRun::operator=(CouetteRun&&) noexcept = default;

void CouetteRun::advance_one_sample() {
  Implementation& self = *self_;
  self.trajectory.renew_list(self.point.step);
  Sample sum{};
  for (int step = 0; step < self.steps_per_sample; ++step) {
    self.trajectory.advance(self.point.step);
    const Sample present = self.observe();
    for (std::size_t q = 0; q < sum.size(); ++q) sum[q] += present[q];
  }
  for (double& value : sum) {
    value /= self.steps_per_sample;
    if (!std::isfinite(value))
      throw RunFailed(fmt::format("at time {:.6g} a sum is not a number", self.trajectory.time()));
  }
  if (self.done >= self.equilibration_intervals) self.record.samples.push_back(sum);
  ++self.done;
  const motion::WatchReport& report = self.trajectory.report();
  self.record.worst_energy_error = report.worst_energy_error;
  self.record.steps = report.steps;
  self.record.subdivided_steps = report.subdivided_steps;
  self.record.energy_rescaled = report.energy_rescaled;
}

std::int64_t CouetteRun::intervals_done() const { return self_->done; }

std::int64_t CouetteRun::intervals_needed(double duration) const {
  return self_->equilibration_intervals + self_->intervals(duration);
}

const CouetteRecord& CouetteRun::record() const { return self_->record; }

Frame CouetteRun::frame() const {
  const auto& trajectory = self_->trajectory;
  const auto box = trajectory.box();
  Frame frame;
  frame.step = self_->done * self_->steps_per_sample;
  frame.time = static_cast<double>(frame.step) * self_->point.step;
  frame.offset = box.offset();
  frame.box = box.lengths();
  frame.position = trajectory.positions();
  frame.momentum = trajectory.momenta();
  return frame;
}

bool CouetteRun::frame_due() const {
  const Implementation& self = *self_;
  return frame_falls_on(self.done - self.equilibration_intervals, self.point.frame_interval, self.steps_per_sample,
                        self.point.step);
}

void CouetteRun::save(ArchiveWriter& archive) const {
  const Implementation& self = *self_;
  archive.put(self.done);
  archive.put_sequence(self.record.samples);
  archive.put(self.record.worst_energy_error);
  archive.put(self.record.steps);
  archive.put(self.record.subdivided_steps);
  archive.put(self.record.energy_rescaled);
  self.trajectory.save(archive);
}

void CouetteRun::load(ArchiveReader& archive) {
  Implementation& self = *self_;
  self.done = archive.get<std::int64_t>();
  archive.get_sequence(self.record.samples);
  self.record.worst_energy_error = archive.get<double>();
  self.record.steps = archive.get<std::int64_t>();
  self.record.subdivided_steps = archive.get<std::int64_t>();
  self.record.energy_rescaled = archive.get<double>();
  self.trajectory.load(archive);
}

}  // namespace lucy::cases
