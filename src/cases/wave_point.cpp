// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a point means: its schedule, its seeds, and what is refused.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cases/refusals.hpp"
#include "cases/seeds.hpp"
#include "lucy/cases/couette.hpp"
#include "lucy/cases/wave.hpp"
#include "lucy/motion/start.hpp"

namespace lucy::cases {

namespace {

constexpr double longest_sample_interval = 2.0;
constexpr double usual_samples = 200.0;
constexpr std::int64_t fewest_samples = 8;  // of a decay (statistics/wave_decay.hpp)
constexpr double usual_interval = 20.0;     // between renewals of the list at least
constexpr double longest_step_of_fluids = 0.5;

bool of_atoms(const WavePoint& point) { return point.reading == motion::Reading::md; }

std::int64_t whole(double ratio) { return static_cast<std::int64_t>(std::ceil(ratio - 1e-6)); }

std::int64_t steps_per_sample(const WavePoint& point) {
  if (point.sample_interval > 0.0) return std::max<std::int64_t>(1, std::llround(point.sample_interval / point.step));
  const double interval = std::min(longest_sample_interval, point.duration / usual_samples);
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(interval / point.step * (1.0 + 1e-9)));
}

/// The same state as a Couette point at rest, by which atoms are checked.
CouettePoint at_rest(const WavePoint& point) {
  CouettePoint rest;
  rest.particles = point.particles;
  rest.energy_per_particle = point.energy_per_particle.value_or(0.0);
  rest.density = point.density;
  rest.dimension = point.dimension;
  rest.range = point.range;
  rest.thermostat = motion::Thermostat::none;
  rest.step = point.step;
  rest.equilibration = point.equilibration;
  rest.duration = point.duration;
  rest.replicas = point.replicas;
  rest.energy_tolerance = point.energy_tolerance;
  return rest;
}

void validate_atoms(const WavePoint& point) {
  if (point.quantity == WaveQuantity::temperature)
    refuse("system.reading = \"md\" must be \"spam\": a temperature wave is one of smooth particles");
  if (!point.energy_per_particle) refuse("system.energy_per_particle is required with system.reading = \"md\"");
  const FluidSettings untouched;
  const auto not_of_atoms = [](const char* key, double value, double usual) {
    if (value != usual)
      refuse(fmt::format("{} = {} is for smooth particles; with system.reading = \"md\" it must be {}", key, value,
                         usual));
  };
  not_of_atoms("fluid.viscosity", point.viscosity, 0.0);
  not_of_atoms("fluid.bulk_viscosity", point.bulk_viscosity, 0.0);
  not_of_atoms("fluid.conductivity", point.conductivity, 0.0);
  not_of_atoms("fluid.temperature", point.temperature, untouched.temperature);
  not_of_atoms("start.disorder", point.disorder, 0.0);
  not_of_atoms("start.noise", point.noise, 0.0);
  if (point.equation_of_state != untouched.equation_of_state)
    refuse("fluid.equation_of_state is for smooth particles; with system.reading = \"md\" leave it out");
  if (point.density_mean != untouched.density_mean)
    refuse("fluid.density_mean is for smooth particles; with system.reading = \"md\" leave it out");
  if (point.uniform != untouched.uniform)
    refuse("start.uniform is for smooth particles; with system.reading = \"md\" leave it out");
  if (point.weight != kernel::WeightName::lucy)
    refuse("kernel.name must be \"lucy\" with system.reading = \"md\": the atoms' potential is Lucy's weight function");
  validate(at_rest(point));
}

void validate_fluid(const WavePoint& point) {
  if (point.energy_per_particle)
    refuse(
        fmt::format("system.energy_per_particle = {} is for system.reading = \"md\"; the energy of smooth particles "
                    "follows from fluid.temperature",
                    *point.energy_per_particle));
  if (!(point.step > 0.0 && point.step <= longest_step_of_fluids))
    refuse(fmt::format("run.step = {} must be above 0 and at most {}", point.step, longest_step_of_fluids));
  refuse_unless_above_zero("fluid.temperature", point.temperature);
  refuse_unless_at_least_zero("start.disorder", point.disorder);
  refuse_unless_at_least_zero("start.noise", point.noise);
  validate(static_cast<const FluidSettings&>(point));
  if (point.quantity == WaveQuantity::shear) return;
  if (!std::visit([](const auto& state) { return state.has_entropy; }, fluid_of(point).state))
    refuse(
        "fluid.equation_of_state must be \"ideal-gas\" or \"van-der-waals\" for a temperature wave: it is followed by "
        "the entropy, which the isentropic and the dense fluid do not have");
  if (point.amplitude >= 1.0)
    refuse(fmt::format("wave.amplitude = {} must be below 1, or temperatures would not be positive", point.amplitude));
}

void validate_intervals(const WavePoint& point) {
  refuse_unless_at_least_zero("output.sample_interval", point.sample_interval);
  refuse_unless_at_least_zero("output.frame_interval", point.frame_interval);
  if (point.sample_interval > 0.0)
    refuse_unless_whole_steps("output.sample_interval", point.sample_interval, point.step);
  const WaveSchedule schedule = wave_schedule(point);
  if (schedule.samples < fewest_samples) {
    const bool asked = point.sample_interval > 0.0;
    refuse(fmt::format("{} = {} must be at most an eighth of run.duration = {}",
                       asked ? "output.sample_interval" : "run.step", asked ? point.sample_interval : point.step,
                       point.duration));
  }
  if (point.frame_interval > 0.0) {
    refuse_unless_whole_steps("output.frame_interval", point.frame_interval, point.step);
    if (std::llround(point.frame_interval / point.step) % schedule.steps_per_sample != 0)
      refuse(fmt::format("output.frame_interval = {} must be a multiple of the time between samples, {}",
                         point.frame_interval, schedule.sample_interval(point)));
  }
}

}  // namespace

std::int64_t WaveSchedule::equilibration_intervals() const {
  return (equilibration_steps + steps_per_interval() - 1) / steps_per_interval();
}

std::int64_t WaveSchedule::intervals() const {
  return equilibration_intervals() + (samples + samples_per_interval - 1) / samples_per_interval;
}

WaveSchedule wave_schedule(const WavePoint& point) {
  WaveSchedule schedule;
  schedule.steps_per_sample = steps_per_sample(point);
  const double interval = schedule.sample_interval(point);
  schedule.samples = whole(point.duration / interval);
  schedule.equilibration_steps = whole(point.equilibration / point.step);
  schedule.samples_per_interval =
      std::clamp<std::int64_t>(std::llround(usual_interval / interval), 1, std::max<std::int64_t>(1, schedule.samples));
  if (point.frame_interval > 0.0) {
    // Frames fall on the ends of intervals.
    const auto between = std::max<std::int64_t>(1, std::llround(point.frame_interval / interval));
    schedule.samples_per_interval = std::min(schedule.samples_per_interval, between);
    while (between % schedule.samples_per_interval != 0) --schedule.samples_per_interval;
  }
  return schedule;
}

double wave_vector(const WavePoint& point) {
  const auto sites = motion::near_square(point.particles);
  const double height = static_cast<double>((*sites)[1]) / std::sqrt(point.density);
  return 2.0 * std::numbers::pi * point.mode / height;
}

double prescribed_diffusivity(const WavePoint& point) {
  if (of_atoms(point)) return std::numeric_limits<double>::quiet_NaN();
  if (point.quantity == WaveQuantity::shear) return point.viscosity / point.density;
  // c_P = c_V + T (dP/dT)^2/(rho^2 dP/drho), with c_V = 1 for both fluids that have an entropy.
  double heat_capacity = 2.0;
  if (point.equation_of_state == spam::EquationOfStateName::van_der_waals) {
    const double spinodal = spam::VanDerWaals::spinodal_temperature(point.density);
    heat_capacity = 1.0 + point.temperature / (point.temperature - spinodal);
  }
  return point.conductivity / (point.density * heat_capacity);
}

std::uint64_t replica_seed(const WavePoint& point, int replica) {
  const auto choice = [](auto value) { return static_cast<std::uint64_t>(value); };
  return mixed_seed(point.seed, {choice(replica),
                                 choice(point.particles),
                                 choice(point.quantity),
                                 choice(point.reading),
                                 bits(point.energy_per_particle.value_or(0.0)),
                                 bits(point.density),
                                 choice(point.weight),
                                 bits(point.range),
                                 choice(point.equation_of_state),
                                 bits(point.temperature),
                                 bits(point.viscosity),
                                 bits(point.bulk_viscosity),
                                 bits(point.conductivity),
                                 choice(point.density_mean),
                                 bits(point.disorder),
                                 bits(point.noise),
                                 choice(point.uniform),
                                 bits(point.equilibration),
                                 bits(point.amplitude),
                                 choice(point.mode)});
}

void validate(const WavePoint& point) {
  if (point.dimension != 2) refuse(fmt::format("system.dimension = {} must be 2", point.dimension));
  refuse_unless_above_zero("system.density", point.density);
  refuse_unless_above_zero("kernel.range", point.range);
  refuse_unless_above_zero("run.duration", point.duration);
  refuse_unless_above_zero("run.energy_tolerance", point.energy_tolerance);
  refuse_unless_at_least_zero("run.equilibration", point.equilibration);
  refuse_unless_above_zero("wave.amplitude", point.amplitude);
  if (point.replicas < 1) refuse(fmt::format("run.replicas = {} must be at least 1", point.replicas));
  if (of_atoms(point)) {
    validate_atoms(point);
  } else {
    validate_fluid(point);
  }
  refuse_endless_run(point.equilibration, point.duration, point.step);
  if (point.mode < 1) refuse(fmt::format("wave.mode = {} must be at least 1", point.mode));
  const double wavelength = 2.0 * std::numbers::pi / wave_vector(point);
  if (!(wavelength >= 2.0 * point.range))
    refuse(fmt::format("wave.mode = {} makes a wavelength of {:.6g}, which must be at least twice kernel.range = {}",
                       point.mode, wavelength, point.range));
  validate_intervals(point);
}

}  // namespace lucy::cases
