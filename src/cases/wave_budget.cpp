// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/wave_budget.hpp"

#include <variant>

#include "lucy/errors.hpp"

namespace lucy::cases {

namespace {

using motion::FluidTrajectory;

/// What is asked of vectors held as x0 y0 x1 y1 ...
double x_of(const std::vector<double>& vectors, std::size_t i) { return vectors[2 * i]; }
double y_of(const std::vector<double>& vectors, std::size_t i) { return vectors[2 * i + 1]; }

/// value(i) less its mean over the particles.
template <class Value>
auto deviations(std::size_t particles, const Value& value) {
  double mean = 0.0;
  for (std::size_t i = 0; i < particles; ++i) mean += value(i) / static_cast<double>(particles);
  return [value, mean](std::size_t i) { return value(i) - mean; };
}

/// A standing wave of velocity u sin(k y) has this kinetic energy per particle.
double energy_of_wave(double amplitude) { return 0.25 * amplitude * amplitude; }

double carried_momentum(const WaveShape& shape, double wave_vector, const std::vector<double>& velocities) {
  return wave_vector * shape.along_cosine([&](std::size_t i) { return x_of(velocities, i) * y_of(velocities, i); });
}

/// The mean over the volume of the equation of state's pressure, and that of moving particles.
double mean_pressure(const FluidTrajectory<2>& fluid, double particle_noise) {
  const std::vector<double> pressures = fluid.pressures();
  const std::vector<double> densities = fluid.densities();
  double sum = particle_noise * static_cast<double>(fluid.particles());
  for (std::size_t i = 0; i < pressures.size(); ++i) sum += pressures[i] / densities[i];
  return sum / fluid.volume();
}

void fill_shear(const FluidTrajectory<2>& trajectory, const WaveShape& shape, double wave_vector, WaveSample& sample) {
  const std::vector<double> velocities = trajectory.velocities();
  const std::vector<double> accelerations = trajectory.accelerations();
  sample.amplitude = shape.along_sine([&](std::size_t i) { return x_of(velocities, i); });
  const double forces = shape.along_sine([&](std::size_t i) { return x_of(accelerations, i); });
  sample.parts[part_rest] = forces;
  spam::Fluid<2> inviscid = trajectory.fluid().fluid();
  if (!inviscid.transport.none()) {
    inviscid.transport = {};
    const std::vector<double> rates = trajectory.rates_of(inviscid);
    sample.parts[part_rest] = shape.along_sine([&](std::size_t i) { return rates[3 * i]; });
  }
  sample.parts[part_operator] = forces - sample.parts[part_rest];
  sample.parts[part_carried] = carried_momentum(shape, wave_vector, velocities);
  sample.particle_noise = trajectory.kinetic().kinetic_energy() / static_cast<double>(trajectory.particles()) -
                          energy_of_wave(sample.amplitude);
}

void fill_temperature(const FluidTrajectory<2>& trajectory, const WaveShape& shape, double wave_vector,
                      WaveSample& sample) {
  const std::vector<double> velocities = trajectory.velocities();
  const std::vector<double> densities = trajectory.densities();
  const std::vector<double> pressures = trajectory.pressures();
  const std::vector<double> temperatures = trajectory.temperatures();
  const std::vector<double> energy_rates = trajectory.energy_rates();
  const std::vector<double> entropy = entropies(trajectory);
  const spam::Fluid<2>& fluid = trajectory.fluid().fluid();

  // The rate of a particle's own density is twice that of e = rho/2, which the isentropic fluid P = rho^2/2 has.
  const std::vector<double> isentropic = trajectory.rates_of({fluid.weight, spam::Isentropic(), {}, fluid.mean, {}});
  const auto density_rate = [&](std::size_t i) { return 2.0 * isentropic[3 * i + 2]; };
  const double all = shape.along_sine(deviations(entropy.size(), [&](std::size_t i) {
    return (energy_rates[i] - pressures[i] / (densities[i] * densities[i]) * density_rate(i)) / temperatures[i];
  }));
  if (fluid.transport.conductivity > 0.0) {
    spam::Fluid<2> insulator = fluid;
    insulator.transport.conductivity = 0.0;
    const std::vector<double> rates = trajectory.rates_of(insulator);
    sample.parts[part_operator] = shape.along_sine(deviations(
        entropy.size(), [&](std::size_t i) { return (energy_rates[i] - rates[3 * i + 2]) / temperatures[i]; }));
  }
  sample.parts[part_rest] = all - sample.parts[part_operator];
  const auto deviation = deviations(entropy.size(), [&](std::size_t i) { return entropy[i]; });
  sample.amplitude = shape.along_sine(deviation);
  sample.parts[part_carried] =
      wave_vector * shape.along_cosine([&](std::size_t i) { return deviation(i) * y_of(velocities, i); });
  const double sound = shape.along_cosine([&](std::size_t i) { return y_of(velocities, i); });
  sample.particle_noise =
      trajectory.kinetic().kinetic_energy() / static_cast<double>(trajectory.particles()) - energy_of_wave(sound);
}

}  // namespace

std::vector<double> entropies(const FluidTrajectory<2>& trajectory) {
  const std::vector<double> densities = trajectory.densities();
  std::vector<double> values = trajectory.energies();
  std::visit(
      [&]<class State>(const State& state) {
        if constexpr (State::has_entropy) {
          for (std::size_t i = 0; i < values.size(); ++i) values[i] = state.entropy(densities[i], values[i]);
        } else {
          throw BadInput("this equation of state has no entropy");
        }
      },
      trajectory.fluid().fluid().state);
  return values;
}

WaveSample wave_sample(WaveQuantity quantity, const FluidTrajectory<2>& fluid, double wave_vector) {
  const WaveShape shape(fluid.positions(), wave_vector);
  WaveSample sample;
  if (quantity == WaveQuantity::shear) {
    fill_shear(fluid, shape, wave_vector, sample);
  } else {
    fill_temperature(fluid, shape, wave_vector, sample);
  }
  sample.pressure = mean_pressure(fluid, sample.particle_noise);
  return sample;
}

WaveSample wave_sample(WaveQuantity /*quantity*/, const motion::Trajectory<2>& atoms, double wave_vector) {
  const WaveShape shape(atoms.positions(), wave_vector);
  const std::vector<double> momenta = atoms.momenta();
  const std::vector<double> forces = atoms.forces();
  WaveSample sample;
  sample.amplitude = shape.along_sine([&](std::size_t i) { return x_of(momenta, i); });
  sample.parts[part_rest] = shape.along_sine([&](std::size_t i) { return x_of(forces, i); });
  sample.parts[part_carried] = carried_momentum(shape, wave_vector, momenta);
  const auto particles = static_cast<double>(atoms.particles());
  sample.particle_noise = atoms.kinetic().kinetic_energy() / particles - energy_of_wave(sample.amplitude);
  sample.pressure = (particles * sample.particle_noise + 0.5 * atoms.pair_totals().virial.trace()) / atoms.volume();
  return sample;
}

}  // namespace lucy::cases
