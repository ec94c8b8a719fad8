// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/shear_flow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>

#include "lucy/cases/shear_flow_table.hpp"
#include "lucy/errors.hpp"

namespace lucy::cases {
namespace {

ShearFlowPoint point(std::int64_t particles, double rate, double duration) {
  ShearFlowPoint p;
  p.particles = particles;
  p.viscosity = 0.5;
  p.conductivity = 0.5;
  p.strain_rate = rate;
  p.duration = duration;
  return p;
}

ShearFlowRun finished(const ShearFlowPoint& point, int replica = 0, int threads = 1) {
  ShearFlowRun run(point, replica, threads);
  while (run.intervals_done() < interval_count(point)) run.advance_one_interval();
  return run;
}

double average(const ShearFlowSample& sample, std::string_view name) {
  return sample
      .averages[static_cast<std::size_t>(std::ranges::find(shear_flow_averages, name) - shear_flow_averages.begin())];
}

double instant(const ShearFlowSample& sample, std::string_view name) {
  return sample
      .instants[static_cast<std::size_t>(std::ranges::find(shear_flow_instants, name) - shear_flow_instants.begin())];
}

/// (U, sum of kinetic and internal energy)/N
double energy(const ShearFlowSample& sample, double particles) {
  return average(sample, "internal_energy") + average(sample, "kinetic_temperature") * (particles - 1.0) / particles;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void expect_same_bits(const ShearFlowRun& one, const ShearFlowRun& other) {
  const auto& first = one.record().samples;
  const auto& second = other.record().samples;
  ASSERT_EQ(first.size(), second.size());
  EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(ShearFlowSample)), 0);
  EXPECT_TRUE(same_bits(one.trajectory().positions(), other.trajectory().positions()));
  EXPECT_TRUE(same_bits(one.trajectory().velocities(), other.trajectory().velocities()));
  EXPECT_TRUE(same_bits(one.trajectory().energies(), other.trajectory().energies()));
  EXPECT_EQ(one.record().steps, other.record().steps);
  EXPECT_EQ(one.record().energy_drift, other.record().energy_drift);
}

// A gentle flow, long enough to be steady.
TEST(ShearFlow, InASteadyStateAsMuchHeatAndEntropyAreMadeAsAreRemoved) {
  ShearFlowPoint p = point(144, 0.05, 600.0);
  p.step = 0.2;
  p.equilibration = 200.0;
  p.replicas = 2;
  const std::vector<ShearFlowRecord> records = {finished(p, 0).record(), finished(p, 1).record()};
  for (const ShearFlowRecord& record : records) {
    for (const ShearFlowSample& sample : record.samples) {
      // What the flow puts in is taken out again at every instant: the total energy does not change.
      EXPECT_NEAR(average(sample, "work"), average(sample, "heat_removed"), 1e-15);
      EXPECT_NEAR(energy(sample, 144.0), energy(record.samples.front(), 144.0), 1e-6);
      EXPECT_GT(instant(sample, "entropy_viscosity"), 0.0);
      EXPECT_GT(instant(sample, "entropy_conduction"), 0.0);
      EXPECT_LT(instant(sample, "least_entropy_production"), instant(sample, "entropy_viscosity"));
    }
    EXPECT_LT(std::abs(record.energy_drift), 1e-5);
    EXPECT_LT(record.worst_energy_error, 1e-7);
  }
  const ShearFlowRow row = summarize(p, records);
  EXPECT_EQ(row.status, RowStatus::ok);
  const auto& heating = row[shear_flow_quantity("heating")];
  const auto& removed = row[shear_flow_quantity("heat_removed")];
  EXPECT_NEAR(heating.value, removed.value, 4.0 * std::hypot(heating.error, removed.error));
  EXPECT_LT(removed.error, 0.02 * removed.value);
  // The ideal gas has e = kT: as much entropy leaves as chi says.
  const auto& surplus = row[shear_flow_quantity("entropy_surplus")];
  EXPECT_NEAR(surplus.value, 0.0, 4.0 * surplus.error);
  EXPECT_LT(surplus.error, 0.02 * row[shear_flow_quantity("entropy_removed")].value);
  // More than was prescribed: the particles resist, and carry momentum.
  EXPECT_GT(row[shear_flow_quantity("viscosity_excess")].value,
            4.0 * row[shear_flow_quantity("viscosity_excess")].error);
  EXPECT_NEAR(row[shear_flow_quantity("viscosity_newtonian")].value, 0.5, 0.01);
}

TEST(ShearFlow, WithoutCoolingTheEnergyRisesByTheWorkOfTheFlow) {
  ShearFlowPoint p = point(64, 0.1, 100.0);
  p.cooling = motion::Cooling::none;
  p.sample_interval = 0.1;
  const ShearFlowRun run = finished(p);
  const auto& samples = run.record().samples;
  double work = 0.0;  // by the trapezoidal rule from the first sample to the last
  for (std::size_t i = 1; i < samples.size(); ++i)
    work += 0.5 * p.step * (average(samples[i - 1], "work") + average(samples[i], "work"));
  EXPECT_NEAR(energy(samples.back(), 64.0) - energy(samples.front(), 64.0), work, 1e-6);
  EXPECT_GT(work, 0.4);
  for (const auto& sample : samples) EXPECT_EQ(average(sample, "heat_removed"), 0.0);
  const ShearFlowRow row = summarize(p, std::span(&run.record(), 1));
  EXPECT_EQ(row.status, RowStatus::too_short);
  EXPECT_TRUE(std::isnan(row[shear_flow_quantity("viscosity")].error));
}

TEST(ShearFlow, ThePartsOfTheStressAreThoseOfTheState) {
  ShearFlowPoint p = point(100, 0.3, 20.0);
  p.equilibration = 10.0;
  p.sample_interval = p.step;  // each sample is one state
  p.noise = 0.05;
  p.viscosity = 0.3;
  const ShearFlowRun run = finished(p);
  const ShearFlowSample& last = run.record().samples.back();
  const auto& trajectory = run.trajectory();
  const std::vector<double> velocities = trajectory.velocities();
  const std::vector<double> densities = trajectory.densities();
  const std::vector<double> gradients = trajectory.gradients();
  double carried = 0.0;
  double newtonian = 0.0;
  double gradient = 0.0;
  for (std::size_t i = 0; i < 100; ++i) {
    carried += velocities[2 * i] * velocities[2 * i + 1];
    newtonian -= 0.3 * (gradients[6 * i + 1] + gradients[6 * i + 2]) / densities[i];
    gradient += gradients[6 * i + 1] / 100.0;
  }
  EXPECT_NEAR(average(last, "pxy_carried"), carried / 100.0, 1e-13);
  EXPECT_NEAR(average(last, "pxy_newtonian"), newtonian / 100.0, 1e-13);
  EXPECT_NEAR(instant(last, "velocity_gradient"), gradient, 1e-13);
  EXPECT_GT(std::abs(carried), 0.1);
  const double all = average(last, "pxy_carried") + average(last, "pxy_pressure") + average(last, "pxy_newtonian");
  EXPECT_NEAR(-0.3 * all, average(last, "work"), 1e-14);  // V = N

  const ShearFlowRow row = summarize(p, std::span(&run.record(), 1));
  const auto value = [&](std::size_t quantity) { return row[quantity].value; };
  EXPECT_NEAR(value(shear_flow_quantity("viscosity")),
              value(shear_flow_quantity("viscosity_carried")) + value(shear_flow_quantity("viscosity_pressure")) +
                  value(shear_flow_quantity("viscosity_newtonian")),
              1e-12);
  EXPECT_NEAR(value(shear_flow_quantity("viscosity_excess")), value(shear_flow_quantity("viscosity")) - 0.3, 1e-12);
}

// On the square lattice Lucy's weight with h = 3 finds rho = 1.00293 at the particles and 0.99790 of a linear field's
// gradient (gradients_test): g = 0.99790 rho. The stress over rho is then g/rho^2 of what it should be, and its virial
// (g/rho)^2/rho. All that within a moment: strained, the lattice resists, as a solid would.
TEST(ShearFlow, OnThePerfectLatticeTheViscosityIsThatOfTheDiscreteOperator) {
  ShearFlowPoint p = point(144, 0.001, 2e-4);
  p.disorder = 0.0;
  p.step = p.sample_interval = 1e-4;
  const ShearFlowRun run = finished(p);
  const ShearFlowRow row = summarize(p, std::span(&run.record(), 1));
  EXPECT_NEAR(row[shear_flow_quantity("viscosity_newtonian")].value / 0.5, 0.99498, 1e-5);
  EXPECT_NEAR(row[shear_flow_quantity("velocity_gradient")].value / 0.001, 0.99790, 1e-5);
  EXPECT_NEAR(row[shear_flow_quantity("viscosity")].value / 0.5, 0.99790 * 0.99790 / 1.00293, 3e-5);
  EXPECT_NEAR(row[shear_flow_quantity("viscosity_carried")].value, 0.0, 1e-12);
  EXPECT_NEAR(row[shear_flow_quantity("density_wave")].value, 0.0, 1e-12);
  EXPECT_NEAR(row[shear_flow_quantity("kinetic_temperature")].value, 0.0, 1e-20);
  EXPECT_NEAR(row[shear_flow_quantity("temperature")].value, 1.0, 1e-6);
}

TEST(ShearFlow, ASavedRunGoesOnWithTheSameBits) {
  ShearFlowPoint p = point(100, 0.2, 20.0);
  p.equilibration = 3.0;
  p.sample_interval = 0.5;
  p.noise = 0.1;
  const ShearFlowRun whole = finished(p, 1);
  for (const int stop : {1, 5, 17, 44}) {
    ShearFlowRun first(p, 1);
    for (int i = 0; i < stop; ++i) first.advance_one_interval();
    ArchiveWriter archive;
    first.save(archive);
    ShearFlowRun second(p, 1);
    ArchiveReader reader(archive.bytes());
    second.load(reader);
    while (second.intervals_done() < interval_count(p)) second.advance_one_interval();
    expect_same_bits(second, whole);
  }
}

TEST(ShearFlow, ThreadsDoNotChangeABit) {
  ShearFlowPoint p = point(400, -0.2, 2.0);
  p.sample_interval = 0.5;
  p.noise = 0.1;
  const ShearFlowRun one = finished(p, 0, 1);
  for (const int threads : {2, 3}) expect_same_bits(finished(p, 0, threads), one);
}

TEST(ShearFlow, ReplicasAndStatesStartDifferently) {
  const ShearFlowPoint p = point(64, 0.1, 10.0);
  EXPECT_EQ(replica_seed(p, 0), replica_seed(p, 0));
  EXPECT_NE(replica_seed(p, 0), replica_seed(p, 1));
  ShearFlowPoint other = p;
  other.conductivity = 0.25;
  EXPECT_NE(replica_seed(p, 0), replica_seed(other, 0));
  other = p;
  other.cooling = motion::Cooling::none;
  EXPECT_NE(replica_seed(p, 0), replica_seed(other, 0));
  other = p;
  other.duration = 20.0;  // a longer run of the same state is the same run
  EXPECT_EQ(replica_seed(p, 0), replica_seed(other, 0));
}

TEST(ShearFlow, AFluidWithoutTemperatureHasNoEntropy) {
  ShearFlowPoint p = point(64, 0.1, 10.0);
  p.equation_of_state = spam::EquationOfStateName::isentropic;
  p.conductivity = 0.0;
  const ShearFlowRun run = finished(p);
  const ShearFlowSample& sample = run.record().samples.back();
  for (const auto* name : {"temperature", "entropy_viscosity", "entropy_removed", "least_entropy_production"})
    EXPECT_TRUE(std::isnan(instant(sample, name))) << name;
  EXPECT_NEAR(instant(sample, "pressure"), 0.5, 0.01);  // rho^2/2
  EXPECT_GT(instant(sample, "velocity_gradient"), 0.09);
}

TEST(ShearFlow, FramesComeAfterTheEquilibrationWithInternalEnergies) {
  ShearFlowPoint p = point(64, 0.5, 12.0);
  p.equilibration = 2.0;
  p.frame_interval = 3.0;
  ShearFlowRun run(p, 0);
  std::vector<double> times;
  for (;;) {
    if (run.frame_due()) times.push_back(run.frame().time);
    if (run.intervals_done() == interval_count(p)) break;
    run.advance_one_interval();
  }
  EXPECT_EQ(times, (std::vector<double>{2.0, 5.0, 8.0, 11.0, 14.0}));
  const Frame frame = run.frame();
  ASSERT_EQ(frame.position.size(), 128U);
  ASSERT_EQ(frame.internal_energy.size(), 64U);
  EXPECT_NEAR(std::remainder(frame.offset - 0.5 * 14.0 * 8.0, 8.0), 0.0, 1e-9);
  EXPECT_EQ(frame.internal_energy, run.trajectory().energies());
}

TEST(ShearFlow, SamplesFollowTheShorterOfOneAndATenthOfTheDuration) {
  ShearFlowPoint p = point(64, 0.1, 100.0);
  EXPECT_EQ(sample_steps(p), 10);
  p.duration = 4.0;
  EXPECT_EQ(sample_steps(p), 4);
  p.sample_interval = 2.0;
  EXPECT_EQ(sample_steps(p), 20);
  p.sample_interval = 0.0;
  p.duration = 100.0;
  p.frame_interval = 2.5;  // a whole number of samples between frames
  EXPECT_EQ(sample_steps(p), 5);
}

TEST(ShearFlow, RefusesWhatCannotBeRun) {
  const ShearFlowPoint sound = point(64, 0.1, 100.0);
  EXPECT_NO_THROW(validate(sound));
  const auto refusal = [&](const std::function<void(ShearFlowPoint&)>& change) -> std::string {
    ShearFlowPoint p = sound;
    change(p);
    try {
      validate(p);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal([](auto& p) { p.strain_rate = 0.0; }), "shear.strain_rate = 0 must be finite and not 0");
  EXPECT_EQ(refusal([](auto& p) { p.strain_rate = NAN; }), "shear.strain_rate = nan must be finite and not 0");
  EXPECT_EQ(refusal([](auto& p) { p.step = 0.3; }), "run.step = 0.3 must be above 0 and at most 0.2");
  EXPECT_EQ(refusal([](auto& p) { p.strain_rate = 6.0; }),
            "run.step = 0.1 at shear.strain_rate = 6 strains the box by more than 0.5 in one step");
  EXPECT_EQ(refusal([](auto& p) { p.duration = -1.0; }), "run.duration = -1 must be above 0");
  EXPECT_EQ(refusal([](auto& p) { p.temperature = 0.0; }), "fluid.temperature = 0 must be above 0");
  EXPECT_EQ(refusal([](auto& p) { p.viscosity = -1.0; }), "fluid.viscosity = -1 must be at least 0");
  EXPECT_EQ(refusal([](auto& p) { p.dimension = 3; }), "system.dimension = 3 must be 2");
  EXPECT_EQ(refusal([](auto& p) { p.sample_interval = 0.25; }),
            "output.sample_interval = 0.25 must be a whole number of steps of run.step = 0.1");
  EXPECT_EQ(refusal([](auto& p) {
              p.sample_interval = 0.2;
              p.frame_interval = 0.5;
            }),
            "output.frame_interval = 0.5 must be a multiple of output.sample_interval = 0.2");
  EXPECT_EQ(
      refusal([](auto& p) { p.particles = 25; }),
      "system.particles = 25 at density 1 makes a box of height 5, which must be at least twice kernel.range = 3");
  EXPECT_EQ(refusal([](auto& p) {
              p.equation_of_state = spam::EquationOfStateName::van_der_waals;
              p.temperature = 0.4;
            }),
            "fluid.temperature = 0.4 at system.density = 1 makes an internal energy of -0.1 per particle; it must be "
            "above 0, since shear.cooling = \"isoenergetic\" takes from each particle the same share of it");
  EXPECT_NE(refusal([](auto& p) {
              p.equation_of_state = spam::EquationOfStateName::isentropic;
            }).find("fluid.conductivity = 0.5 needs an equation of state with a temperature"),
            std::string::npos);
  ShearFlowPoint p = sound;
  p.step = 0.3;
  EXPECT_THROW(ShearFlowRun(p, 0), BadInput);
}

// Without viscosity nothing turns the motion of the particles into heat, which the thermostat keeps taking out.
TEST(ShearFlow, AFluidThatIsCooledAwayFailsWithAReason) {
  ShearFlowPoint p = point(64, 0.5, 2000.0);
  p.viscosity = p.conductivity = 0.0;
  p.noise = 0.5;
  try {
    finished(p);
    FAIL() << "it went on";
  } catch (const RunFailed& failure) {
    EXPECT_NE(std::string(failure.what()).find("the temperature of particle"), std::string::npos) << failure.what();
  }
}

}  // namespace
}  // namespace lucy::cases
