// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/shear_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <numeric>

#include "cases/pacing.hpp"
#include "cases/refusals.hpp"
#include "cases/seeds.hpp"
#include "lucy/errors.hpp"

namespace lucy::cases {

namespace {

using Trajectory = motion::FluidTrajectory<2>;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double usual_sample_interval = 1.0;
constexpr double fewest_samples = 10.0;
constexpr double longest_step = 0.2;

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::int64_t intervals(const ShearFlowPoint& point, double time) {
  return intervals_in(time, sample_steps(point), point.step);
}

double density_wave(const Trajectory& trajectory) {
  const std::vector<double> positions = trajectory.positions();
  const double wave_vector = 2.0 * std::numbers::pi / trajectory.box().lengths()[1];
  std::complex<double> sum = 0.0;
  for (std::size_t y = 1; y < positions.size(); y += 2) sum += std::polar(1.0, wave_vector * positions[y]);
  return 2.0 * std::abs(sum) / static_cast<double>(trajectory.particles());
}

/// Of the present state.
std::array<double, shear_flow_averages.size()> averages_of(const Trajectory& trajectory, double strain_rate) {
  const auto n = static_cast<double>(trajectory.particles());
  const double volume = trajectory.volume();
  const double carried = trajectory.kinetic().momentum_flux(0, 1);
  const double pairs = trajectory.fluid().virial_xy();
  const double newtonian = trajectory.viscous_stress_xy();
  std::array<double, shear_flow_averages.size()> averages{};
  averages[shear_flow_average("kinetic_temperature")] = trajectory.kinetic().kinetic_energy() / (n - 1.0);
  averages[shear_flow_average("internal_energy")] = trajectory.internal_energy() / n;
  averages[shear_flow_average("pxy_carried")] = carried / volume;
  averages[shear_flow_average("pxy_pressure")] = (pairs - newtonian) / volume;
  averages[shear_flow_average("pxy_newtonian")] = newtonian / volume;
  averages[shear_flow_average("work")] = -strain_rate * (carried + pairs) / n;
  averages[shear_flow_average("heating")] = mean(trajectory.energy_rates());
  averages[shear_flow_average("heat_removed")] = trajectory.cooling_rate() * trajectory.internal_energy() / n;
  return averages;
}

std::array<double, shear_flow_instants.size()> instants_of(const Trajectory& trajectory) {
  std::array<double, shear_flow_instants.size()> instants;
  instants.fill(not_a_number);
  const std::vector<double> densities = trajectory.densities();
  std::vector<double> pressures = trajectory.pressures();
  for (std::size_t i = 0; i < pressures.size(); ++i) pressures[i] /= densities[i];
  instants[shear_flow_instant("pressure")] =
      mean(pressures) * static_cast<double>(trajectory.particles()) / trajectory.volume();
  instants[shear_flow_instant("density_wave")] = density_wave(trajectory);

  constexpr std::size_t of_one_particle = 6;  // dv_x/dx, dv_x/dy, ...
  const std::vector<double> gradients = trajectory.gradients();
  if (!gradients.empty()) {
    double sum = 0.0;
    for (std::size_t i = 1; i < gradients.size(); i += of_one_particle) sum += gradients[i];
    instants[shear_flow_instant("velocity_gradient")] = sum / static_cast<double>(trajectory.particles());
  }

  if (!spam::has_temperature(trajectory.fluid().fluid().state)) return instants;
  const std::vector<double> temperatures = trajectory.temperatures();
  const std::vector<double> energies = trajectory.energies();
  const std::vector<double> produced = trajectory.entropy_production();  // viscosity, conduction
  double viscosity = 0.0;
  double conduction = 0.0;
  double removed = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < temperatures.size(); ++i) {
    viscosity += produced[2 * i];
    conduction += produced[2 * i + 1];
    removed += trajectory.cooling_rate() * energies[i] / temperatures[i];
    least = std::min(least, produced[2 * i] + produced[2 * i + 1]);
  }
  const auto n = static_cast<double>(trajectory.particles());
  instants[shear_flow_instant("temperature")] = mean(temperatures);
  instants[shear_flow_instant("entropy_viscosity")] = viscosity / n;
  instants[shear_flow_instant("entropy_conduction")] = conduction / n;
  instants[shear_flow_instant("entropy_removed")] = removed / n;
  instants[shear_flow_instant("least_entropy_production")] = least;
  return instants;
}

}  // namespace

int sample_steps(const ShearFlowPoint& point) {
  const double interval = point.sample_interval > 0.0
                              ? point.sample_interval
                              : std::min(usual_sample_interval, point.duration / fewest_samples);
  return interval_steps(interval, point.frame_interval, point.step);
}

std::int64_t equilibration_intervals(const ShearFlowPoint& point) { return intervals(point, point.equilibration); }

std::int64_t interval_count(const ShearFlowPoint& point) {
  return equilibration_intervals(point) + intervals(point, point.duration);
}

void validate(const ShearFlowPoint& point) {
  if (point.dimension != 2) refuse(fmt::format("system.dimension = {} must be 2", point.dimension));
  refuse_unless_above_zero("system.density", point.density);
  refuse_unless_above_zero("kernel.range", point.range);
  refuse_unless_above_zero("fluid.temperature", point.temperature);
  refuse_unless_at_least_zero("start.disorder", point.disorder);
  refuse_unless_at_least_zero("start.noise", point.noise);
  if (point.strain_rate == 0.0 || !std::isfinite(point.strain_rate))
    refuse(fmt::format("shear.strain_rate = {} must be finite and not 0", point.strain_rate));
  if (!(point.step > 0.0 && point.step <= longest_step))
    refuse(fmt::format("run.step = {} must be above 0 and at most {}", point.step, longest_step));
  refuse_unless_above_zero("run.duration", point.duration);
  refuse_unless_above_zero("run.energy_tolerance", point.energy_tolerance);
  refuse_unless_at_least_zero("run.equilibration", point.equilibration);
  refuse_endless_run(point.equilibration, point.duration, point.step);
  refuse_large_strain(point.strain_rate, point.step);
  refuse_uneven_intervals(point.sample_interval, point.frame_interval, point.step, point.duration);
  validate(static_cast<const FluidSettings&>(point));
  const double energy = std::visit([&](const auto& state) { return state.energy(point.density, point.temperature); },
                                   fluid_of(point).state);
  if (point.cooling == motion::Cooling::isoenergetic && !(energy > 0.0))
    refuse(
        fmt::format("fluid.temperature = {} at system.density = {} makes an internal energy of {:.6g} per particle; it "
                    "must be above 0, since shear.cooling = \"isoenergetic\" takes from each particle the same share "
                    "of it",
                    point.temperature, point.density, energy));
}

std::uint64_t replica_seed(const ShearFlowPoint& point, int replica) {
  const auto number = [](auto choice) { return static_cast<std::uint64_t>(choice); };
  return mixed_seed(point.seed, {number(replica), number(point.particles), bits(point.density), number(point.weight),
                                 bits(point.range), number(point.equation_of_state), bits(point.temperature),
                                 bits(point.viscosity), bits(point.bulk_viscosity), bits(point.conductivity),
                                 number(point.density_mean), bits(point.disorder), bits(point.noise),
                                 number(point.uniform), bits(point.strain_rate), number(point.cooling)});
}

struct ShearFlowRun::Implementation {
  Implementation(const ShearFlowPoint& settings, int replica, int threads)
      : point((validate(settings), settings)),
        steps_per_sample(sample_steps(settings)),
        trajectory(fluid_of(settings), fluid_start(settings, replica_seed(settings, replica)), settings.strain_rate,
                   settings.cooling, watch_of(settings), Team(threads)) {
    record.sample_interval = steps_per_sample * point.step;
  }

  static motion::Watch watch_of(const ShearFlowPoint& point) {
    motion::Watch watch;
    watch.energy_tolerance = point.energy_tolerance;
    return watch;
  }

  ShearFlowPoint point;
  int steps_per_sample;
  std::int64_t done = 0;
  Trajectory trajectory;
  ShearFlowRecord record;
};

ShearFlowRun::ShearFlowRun(const ShearFlowPoint& point, int replica, int threads)
    : self_(std::make_unique<Implementation>(point, replica, threads)) {}
ShearFlowRun::~ShearFlowRun() = default;
ShearFlowRun::ShearFlowRun(ShearFlowRun&&) noexcept = default;
ShearFlowRun& ShearFlowRun::operator=(ShearFlowRun&&) noexcept = default;

void ShearFlowRun::advance_one_interval() {
  Implementation& self = *self_;
  self.trajectory.renew_list(self.point.step);
  ShearFlowSample sample;
  for (int step = 0; step < self.steps_per_sample; ++step) {
    self.trajectory.advance(self.point.step);
    const auto present = averages_of(self.trajectory, self.point.strain_rate);
    for (std::size_t q = 0; q < present.size(); ++q) sample.averages[q] += present[q];
  }
  for (double& value : sample.averages) {
    value /= self.steps_per_sample;
    if (!std::isfinite(value))
      throw RunFailed(fmt::format("at time {:.6g} a sum is not a number", self.trajectory.time()));
  }
  if (self.done >= equilibration_intervals(self.point)) {
    sample.instants = instants_of(self.trajectory);
    self.record.samples.push_back(sample);
  }
  ++self.done;
  const motion::WatchReport& report = self.trajectory.report();
  self.record.worst_energy_error = report.worst_energy_error;
  self.record.energy_drift = self.trajectory.energy_drift();
  self.record.steps = report.steps;
  self.record.subdivided_steps = report.subdivided_steps;
}

std::int64_t ShearFlowRun::intervals_done() const { return self_->done; }

const ShearFlowRecord& ShearFlowRun::record() const { return self_->record; }

const motion::FluidTrajectory<2>& ShearFlowRun::trajectory() const { return self_->trajectory; }

Frame ShearFlowRun::frame() const {
  return frame_of(self_->trajectory, self_->done * self_->steps_per_sample, self_->point.step);
}

bool ShearFlowRun::frame_due() const {
  const Implementation& self = *self_;
  return frame_falls_on(self.done - equilibration_intervals(self.point), self.point.frame_interval,
                        self.steps_per_sample, self.point.step);
}

void ShearFlowRun::save(ArchiveWriter& archive) const {
  const Implementation& self = *self_;
  archive.put(self.done);
  archive.put_sequence(self.record.samples);
  archive.put(self.record.worst_energy_error);
  archive.put(self.record.energy_drift);
  archive.put(self.record.steps);
  archive.put(self.record.subdivided_steps);
  self.trajectory.save(archive);
}

void ShearFlowRun::load(ArchiveReader& archive) {
  Implementation& self = *self_;
  self.done = archive.get<std::int64_t>();
  archive.get_sequence(self.record.samples);
  self.record.worst_energy_error = archive.get<double>();
  self.record.energy_drift = archive.get<double>();
  self.record.steps = archive.get<std::int64_t>();
  self.record.subdivided_steps = archive.get<std::int64_t>();
  self.trajectory.load(archive);
}

}  // namespace lucy::cases
