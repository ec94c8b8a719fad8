// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Decaying waves: the three parts of da/dt account for all that the amplitude loses, the discrete operators are as
// strong as they are known to be, and an inviscid gas of uniform entropy is the Lucy fluid in other units.
#include "lucy/cases/wave.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/errors.hpp"
#include "lucy/motion/trajectory.hpp"

namespace lucy::cases {
namespace {

WavePoint small(WaveQuantity quantity) {
  WavePoint point;
  point.quantity = quantity;
  point.particles = 144;
  point.viscosity = 0.2;
  point.bulk_viscosity = 0.1;
  point.conductivity = 0.3;
  point.disorder = 0.3;
  point.noise = 0.02;
  point.step = 0.1;
  point.duration = 10.0;
  point.amplitude = 0.1;
  return point;
}

WavePoint small_atoms() {
  WavePoint point;
  point.reading = motion::Reading::md;
  point.energy_per_particle = 1.0;
  point.particles = 144;
  point.step = 0.1;
  point.duration = 10.0;
  point.amplitude = 0.3;
  return point;
}

WaveRun finished(const WavePoint& point, int replica = 0, int threads = 1) {
  WaveRun run(point, replica, threads);
  while (run.intervals_done() < run.intervals_needed()) run.advance_one_interval();
  return run;
}

std::vector<std::uint64_t> bits_of(const WaveRecord& record) {
  std::vector<std::uint64_t> bits = {
      std::bit_cast<std::uint64_t>(record.imposed_amplitude), std::bit_cast<std::uint64_t>(record.worst_energy_error),
      static_cast<std::uint64_t>(record.steps), static_cast<std::uint64_t>(record.subdivided_steps)};
  for (const WaveSample& sample : record.samples)
    for (const double value :
         {sample.amplitude, sample.parts[0], sample.parts[1], sample.parts[2], sample.particle_noise, sample.pressure})
      bits.push_back(std::bit_cast<std::uint64_t>(value));
  return bits;
}

std::string refusal(const WavePoint& point) {
  try {
    validate(point);
  } catch (const BadInput& refused) {
    return refused.what();
  }
  return "accepted";
}

/// By Simpson's rule, whose error falls with the fourth power of the interval.
double integral(const WaveRecord& record, const std::function<double(const WaveSample&)>& of) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 2 < record.samples.size(); i += 2)
    sum += of(record.samples[i]) + 4.0 * of(record.samples[i + 1]) + of(record.samples[i + 2]);
  return sum * record.sample_interval / 3.0;
}

void expect_closed_budget(WavePoint point) {
  point.step = point.sample_interval = 0.025;
  point.duration = 5.0;
  const WaveRecord record = finished(point).record();
  ASSERT_EQ(record.samples.size(), 201u);
  double parts = 0.0;
  for (std::size_t part = 0; part < wave_parts; ++part) {
    const double gained = integral(record, [part](const WaveSample& sample) { return sample.parts[part]; });
    const bool expected = part != part_operator || prescribed_diffusivity(point) > 0.0;
    EXPECT_EQ(std::abs(gained) > 1e-5, expected) << "part " << part << " is " << gained;
    parts += gained;
  }
  const double change = record.samples.back().amplitude - record.samples.front().amplitude;
  EXPECT_GT(std::abs(change), 1e-3);
  EXPECT_NEAR(parts, change, 1e-6 * point.amplitude);
}

TEST(Wave, ThePartsAccountForAllThatAShearWaveLoses) {
  expect_closed_budget(small(WaveQuantity::shear));
  expect_closed_budget(small_atoms());
  WavePoint inviscid = small(WaveQuantity::shear);
  inviscid.viscosity = inviscid.bulk_viscosity = inviscid.conductivity = 0.0;
  expect_closed_budget(inviscid);
}

TEST(Wave, ThePartsAccountForAllThatATemperatureWaveLoses) {
  WavePoint point = small(WaveQuantity::temperature);
  expect_closed_budget(point);
  point.equation_of_state = spam::EquationOfStateName::van_der_waals;
  point.temperature = 1.4;
  point.weight = kernel::WeightName::monaghan;
  expect_closed_budget(point);
}

// The operator of a lattice is weaker than that of a continuum by what its kernel sums do to a wave of this length.
TEST(Wave, TheViscousOperatorOfALatticeIsKnown) {
  WavePoint point;
  point.particles = 4096;
  point.viscosity = 0.7;
  for (const auto& [weight, factor] :
       {std::pair{kernel::WeightName::lucy, 0.98527}, {kernel::WeightName::monaghan, 0.99631}}) {
    point.weight = weight;
    point.duration = 10.0;
    const WaveRun run(point, 0);
    const WaveSample& start = run.record().samples.front();
    const double k = wave_vector(point);
    EXPECT_NEAR(start.amplitude, point.amplitude, 1e-13);
    EXPECT_NEAR(-start.parts[part_operator] / (prescribed_diffusivity(point) * k * k * start.amplitude), factor, 1e-5);
    EXPECT_NEAR(start.parts[part_rest], 0.0, 1e-15);
    EXPECT_NEAR(start.parts[part_carried], 0.0, 1e-15);
    EXPECT_NEAR(start.particle_noise, 0.0, 1e-15);
    EXPECT_NEAR(start.pressure, 1.0, 3e-3);
  }
}

// The gradient of the temperature is found by the same sums as that of the velocity.
TEST(Wave, TheConductionOperatorOfALatticeIsThatOfItsViscosity) {
  WavePoint point;
  point.quantity = WaveQuantity::temperature;
  point.particles = 4096;
  point.conductivity = 0.5;
  point.amplitude = 1e-5;  // e'/T is linear for small ones only
  point.duration = 10.0;
  const WaveRun run(point, 0);
  const WaveSample& start = run.record().samples.front();
  const double k = wave_vector(point);
  EXPECT_NEAR(start.amplitude, point.amplitude, 1e-14);
  EXPECT_NEAR(-start.parts[part_operator] / (point.conductivity * k * k * start.amplitude), 0.98527, 1e-4);
}

// The entropy has no zero: a sound wave moves what all particles have alike, and makes no wave of it.
TEST(Wave, TheEntropyThatAllParticlesHaveAlikeMakesNoWave) {
  WavePoint point = small(WaveQuantity::temperature);
  point.viscosity = point.bulk_viscosity = point.conductivity = 0.0;
  point.disorder = point.noise = 0.0;
  point.amplitude = 0.2;
  const double imposed = 10.0 * (1.0 - std::sqrt(0.96));  // of log(1 + 0.2 sin): (2/A) [1 - (1 - A^2)^(1/2)]
  for (const double temperature : {0.5, 1.0, 3.0}) {
    point.temperature = temperature;
    const WaveRecord record = finished(point).record();
    EXPECT_NEAR(record.samples.front().amplitude, imposed, 1e-6);
    for (const WaveSample& sample : record.samples) EXPECT_NEAR(sample.amplitude, imposed, 0.03) << temperature;
  }
}

TEST(Wave, PrescribesEtaOverRhoAndKappaOverTheHeatCapacityAtConstantPressure) {
  WavePoint point = small(WaveQuantity::shear);
  point.density = 0.8;
  EXPECT_DOUBLE_EQ(prescribed_diffusivity(point), 0.25);
  point.quantity = WaveQuantity::temperature;
  EXPECT_DOUBLE_EQ(prescribed_diffusivity(point), 0.3 / (0.8 * 2.0));
  point.equation_of_state = spam::EquationOfStateName::van_der_waals;
  point.density = 1.0;
  EXPECT_NEAR(prescribed_diffusivity(point), 0.3 / (7.0 / 3.0), 1e-15);
  // c_P by differences: T ds at constant pressure.
  point.temperature = 1.3;
  const spam::VanDerWaals fluid;
  const double pressure = fluid.pressure(1.0, fluid.energy(1.0, 1.3));
  const auto entropy_at = [&](double temperature) {
    double density = 1.0;
    for (int i = 0; i < 100; ++i) {
      const double value = fluid.pressure(density, fluid.energy(density, temperature)) - pressure;
      const double more = fluid.pressure(density + 1e-6, fluid.energy(density + 1e-6, temperature)) - pressure;
      density -= 1e-6 * value / (more - value);
    }
    return fluid.entropy(density, fluid.energy(density, temperature));
  };
  const double heat_capacity = 1.3 * (entropy_at(1.3 + 1e-4) - entropy_at(1.3 - 1e-4)) / 2e-4;
  EXPECT_NEAR(prescribed_diffusivity(point), 0.3 / heat_capacity, 1e-6);
}

// P/rho^2 = e/rho = 1 at all particles and for ever: forces are those of two Lucy potentials, times run faster by the
// square root of two.
TEST(Wave, AnInviscidGasOfUniformEntropyIsTheLucyFluidOfTwiceTheEnergy) {
  FluidSettings settings;
  settings.particles = 144;
  settings.disorder = 0.4;
  settings.noise = 0.3;
  settings.uniform = UniformStart::entropy;
  const motion::FluidStart<2> start = fluid_start(settings, 5);
  motion::FluidTrajectory<2> fluid(fluid_of(settings), start, 0.0, motion::Cooling::none, motion::Watch{}, Team(1));
  motion::Start<2> same{start.lengths, start.position, start.velocity};
  for (auto& momentum : same.momentum)
    for (double& component : momentum) component /= std::numbers::sqrt2;
  motion::Shear at_rest;
  at_rest.thermostat = motion::Thermostat::none;
  motion::Trajectory<2> atoms(kernel::Lucy<2>(3.0), same, at_rest, motion::Integrator::runge_kutta_4, motion::Watch{},
                              Team(1));
  const double step = 0.05;
  for (int i = 0; i < 100; ++i) {
    atoms.advance(step);
    fluid.advance(step / std::numbers::sqrt2);
  }
  const auto expected = atoms.positions();
  const auto positions = fluid.positions();
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(positions[i], expected[i], 1e-6) << i;
  const auto energies = fluid.energies();
  const auto densities = fluid.densities();
  for (std::size_t i = 0; i < energies.size(); ++i) EXPECT_NEAR(energies[i], densities[i], 1e-5) << i;
}

TEST(Wave, IsSuperposedAfterTheEquilibrationWithoutNetMomentum) {
  WavePoint point = small(WaveQuantity::shear);
  point.equilibration = 3.05;
  point.frame_interval = 2.0;
  WaveRun run(point, 0);
  EXPECT_TRUE(run.record().samples.empty());
  EXPECT_FALSE(run.frame_due());
  while (run.record().samples.empty()) run.advance_one_interval();
  EXPECT_EQ(run.record().steps, 31);
  EXPECT_TRUE(run.frame_due());
  EXPECT_NEAR(run.record().imposed_amplitude, 0.1, 0.01);
  const Frame frame = run.frame();
  EXPECT_EQ(frame.step, 31);
  EXPECT_EQ(frame.internal_energy.size(), 144u);
  double momentum = 0.0;
  double amplitude = 0.0;
  for (std::size_t i = 0; i < frame.momentum.size(); i += 2) {
    momentum += frame.momentum[i];
    amplitude += 2.0 / 144.0 * frame.momentum[i] * std::sin(wave_vector(point) * frame.position[i + 1]);
  }
  EXPECT_NEAR(momentum, 0.0, 1e-13);
  EXPECT_NEAR(amplitude, run.record().samples.front().amplitude, 1e-13);
  int frames = 1;
  while (run.intervals_done() < run.intervals_needed()) {
    run.advance_one_interval();
    frames += run.frame_due() ? 1 : 0;
  }
  EXPECT_EQ(frames, 6);
  EXPECT_EQ(run.record().steps, 131);
  EXPECT_EQ(run.record().samples.size(), 101u);
}

TEST(Wave, GoesOnFromEverySavedStateWithTheSameBits) {
  for (WavePoint point : {small(WaveQuantity::shear), small(WaveQuantity::temperature), small_atoms()}) {
    point.equilibration = 2.0;
    point.frame_interval = 2.0;  // intervals of this length
    const auto expected = bits_of(finished(point, 1).record());
    for (std::int64_t interval = 0; interval < wave_schedule(point).intervals(); ++interval) {
      WaveRun run(point, 1);
      while (run.intervals_done() < interval) run.advance_one_interval();
      ArchiveWriter saved;
      run.save(saved);
      WaveRun other(point, 1);
      ArchiveReader archive(saved.bytes());
      other.load(archive);
      EXPECT_TRUE(archive.exhausted());
      while (other.intervals_done() < other.intervals_needed()) other.advance_one_interval();
      EXPECT_EQ(bits_of(other.record()), expected) << interval;
    }
  }
}

TEST(Wave, DoesNotDependOnTheNumberOfThreads) {
  for (const WavePoint& point : {small(WaveQuantity::shear), small(WaveQuantity::temperature), small_atoms()}) {
    const auto expected = bits_of(finished(point).record());
    EXPECT_EQ(bits_of(finished(point, 0, 3).record()), expected);
    EXPECT_NE(bits_of(finished(point, 1).record()), expected) << "another replica";
  }
}

TEST(WavePoints, AreSeededByAllThatIsPhysical) {
  const WavePoint point = small(WaveQuantity::shear);
  WavePoint longer = point;
  longer.duration = 20.0;
  longer.step = 0.05;
  EXPECT_EQ(replica_seed(longer, 2), replica_seed(point, 2));
  WavePoint other = point;
  other.viscosity = 0.21;
  EXPECT_NE(replica_seed(other, 2), replica_seed(point, 2));
  EXPECT_NE(replica_seed(point, 1), replica_seed(point, 2));
}

TEST(WavePoints, AreSampledTwoHundredTimesOrEveryTwoTimeUnits) {
  WavePoint point = small(WaveQuantity::shear);
  EXPECT_DOUBLE_EQ(wave_schedule(point).sample_interval(point), 0.1);  // half a step asked for
  point.duration = 100.0;
  EXPECT_DOUBLE_EQ(wave_schedule(point).sample_interval(point), 0.5);
  EXPECT_EQ(wave_schedule(point).samples, 200);
  point.duration = 1e5;
  EXPECT_DOUBLE_EQ(wave_schedule(point).sample_interval(point), 2.0);
}

TEST(WavePoints, AreRefusedWhenTheyAreUnsound) {
  EXPECT_EQ(refusal(small(WaveQuantity::shear)), "accepted");
  EXPECT_EQ(refusal(small(WaveQuantity::temperature)), "accepted");
  EXPECT_EQ(refusal(small_atoms()), "accepted");
  const auto expect = [](const char* words, WavePoint point, auto change) {
    change(point);
    EXPECT_NE(refusal(point).find(words), std::string::npos) << words << ": " << refusal(point);
  };
  const WavePoint fluid = small(WaveQuantity::shear);
  expect("run.step = 0.6 must be above 0 and at most 0.5", fluid, [](auto& p) { p.step = 0.6; });
  expect("system.energy_per_particle = 1 is for system.reading = \"md\"", fluid,
         [](auto& p) { p.energy_per_particle = 1.0; });
  expect("wave.mode = 3 makes a wavelength of 4, which must be at least twice kernel.range = 3", fluid,
         [](auto& p) { p.mode = 3; });
  expect("wave.mode = 0 must be at least 1", fluid, [](auto& p) { p.mode = 0; });
  expect("wave.amplitude = 0 must be above 0", fluid, [](auto& p) { p.amplitude = 0.0; });
  expect("at least twice kernel.range = 7", fluid, [](auto& p) { p.range = 7.0; });
  expect("fluid.viscosity = -1 must be at least 0", fluid, [](auto& p) { p.viscosity = -1.0; });
  expect("run.duration = nan must be above 0", fluid, [](auto& p) { p.duration = std::nan(""); });
  expect("output.sample_interval = 0.25 must be a whole number of steps", fluid,
         [](auto& p) { p.sample_interval = 0.25; });
  expect("output.sample_interval = 2 must be at most an eighth of run.duration = 10", fluid,
         [](auto& p) { p.sample_interval = 2.0; });
  expect("output.frame_interval = 0.5 must be a multiple of the time between samples, 0.2", fluid,
         [](auto& p) { p.sample_interval = 0.2, p.frame_interval = 0.5; });
  const WavePoint atoms = small_atoms();
  expect("run.step = 0.5 must be above 0 and at most 0.2", atoms, [](auto& p) { p.step = 0.5; });
  expect("system.energy_per_particle = 0.4 must be above 0.41305", atoms, [](auto& p) { p.energy_per_particle = 0.4; });
  expect("system.energy_per_particle is required", atoms, [](auto& p) { p.energy_per_particle.reset(); });
  expect("fluid.viscosity = 0.3 is for smooth particles", atoms, [](auto& p) { p.viscosity = 0.3; });
  expect("start.disorder = 0.3 is for smooth particles", atoms, [](auto& p) { p.disorder = 0.3; });
  expect("kernel.name must be \"lucy\"", atoms, [](auto& p) { p.weight = kernel::WeightName::monaghan; });
  expect("system.reading = \"md\" must be \"spam\"", atoms, [](auto& p) { p.quantity = WaveQuantity::temperature; });
  const WavePoint heat = small(WaveQuantity::temperature);
  expect("fluid.equation_of_state must be \"ideal-gas\" or \"van-der-waals\"", heat,
         [](auto& p) { p.equation_of_state = spam::EquationOfStateName::dense_fluid; });
  expect("wave.amplitude = 1 must be below 1", heat, [](auto& p) { p.amplitude = 1.0; });
  expect("fluid.temperature = 0.2 must be above 0.25 for a van der Waals fluid of density 1", heat, [](auto& p) {
    p.equation_of_state = spam::EquationOfStateName::van_der_waals;
    p.temperature = 0.2;
  });
}

}  // namespace
}  // namespace lucy::cases
