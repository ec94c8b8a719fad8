// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Atoms and smooth particles side by side: every bit is the same where it has to be, the smallest difference is found
// and named, and the continuum's sums are what they are said to be.
#include "lucy/cases/isomorphism.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/isomorphism_table.hpp"
#include "lucy/errors.hpp"
#include "pairs/crowd.hpp"

namespace lucy::cases {
namespace {

using ::testing::HasSubstr;

IsomorphismPoint small(double rate, double duration = 20.0) {
  IsomorphismPoint point;
  point.particles = 100;
  point.energy_per_particle = 1.0;
  point.strain_rate = rate;
  point.equilibration = 2.0;
  point.duration = duration;
  point.seed = 3;
  return point;
}

void finish(IsomorphismRun& run, const IsomorphismPoint& point) {
  while (run.intervals_done() < interval_count(point)) run.advance_one_interval();
}

IsomorphismRecord record_of(const IsomorphismPoint& point, int threads = 1) {
  IsomorphismRun run(point, 0, threads);
  finish(run, point);
  return run.record();
}

std::vector<std::uint64_t> bits_of(std::span<const double> values) {
  std::vector<std::uint64_t> bits;
  for (const double value : values) bits.push_back(std::bit_cast<std::uint64_t>(value));
  return bits;
}

void expect_same_samples(const IsomorphismRecord& one, const IsomorphismRecord& other) {
  EXPECT_EQ(one.steps, other.steps);
  EXPECT_EQ(one.comparisons, other.comparisons);
  ASSERT_EQ(one.samples.size(), other.samples.size());
  for (std::size_t i = 0; i < one.samples.size(); ++i)
    EXPECT_EQ(bits_of(one.samples[i]), bits_of(other.samples[i])) << i;
}

void expect_identical(const IsomorphismPoint& point) {
  const IsomorphismRecord record = record_of(point);
  EXPECT_FALSE(record.difference.has_value());
  const std::int64_t steps = std::llround((point.equilibration + point.duration) / point.step);
  EXPECT_EQ(record.steps, steps);
  EXPECT_EQ(record.comparisons, (steps + 1) * (6 * point.particles + 5));
  EXPECT_EQ(record.samples.size(), static_cast<std::size_t>(std::llround(point.duration)));
  for (const int threads : {2, 3}) expect_same_samples(record_of(point, threads), record);
}

TEST(Isomorphism, EveryBitIsTheSameAtRestOnAnyNumberOfThreads) { expect_identical(small(0.0)); }

TEST(Isomorphism, EveryBitIsTheSameUnderShearOnAnyNumberOfThreads) { expect_identical(small(0.5)); }

TEST(Isomorphism, EveryBitIsTheSameWithEveryThermostat) {
  for (const auto& [name, thermostat] : motion::thermostat_names) {
    IsomorphismPoint point = small(-0.3);
    point.thermostat = thermostat;
    EXPECT_FALSE(record_of(point).difference.has_value()) << name;
  }
  IsomorphismPoint by_verlet = small(0.0);
  by_verlet.integrator = motion::Integrator::velocity_verlet;
  EXPECT_FALSE(record_of(by_verlet).difference.has_value());
}

/// Where the readings of a start differ whose copy for the smooth particles was changed.
Difference difference_after(const std::function<void(motion::Start<2>&)>& change) {
  const IsomorphismPoint point = small(0.5);
  const motion::Start<2> start = isomorphism_start(point, 0);
  motion::Start<2> changed = start;
  change(changed);
  const IsomorphismRun run(point, start, changed);
  return run.record().difference.value();
}

double next_double(double value) { return std::nextafter(value, std::numeric_limits<double>::infinity()); }

TEST(Isomorphism, OneUnitInTheLastPlaceOfOneCoordinateIsFoundAndNamed) {
  double before = 0.0;
  const Difference of_position = difference_after([&](motion::Start<2>& start) {
    before = start.position[17][1];
    start.position[17][1] = next_double(before);
  });
  EXPECT_EQ(of_position.step, 0);
  EXPECT_EQ(of_position.time, 0.0);
  EXPECT_EQ(of_position.particle, 17);
  EXPECT_EQ(of_position.component_name(), "y");
  EXPECT_EQ(of_position.atoms, before);
  EXPECT_EQ(of_position.smooth, next_double(before));
  const Difference of_momentum = difference_after([&](motion::Start<2>& start) {
    before = start.momentum[99][0];
    start.momentum[99][0] = next_double(before);
  });
  EXPECT_EQ(of_momentum.step, 0);
  EXPECT_EQ(of_momentum.particle, 99);
  EXPECT_EQ(of_momentum.component_name(), "p_x");
  EXPECT_EQ(of_momentum.atoms, before);
  EXPECT_EQ(of_momentum.smooth, next_double(before));
}

TEST(Isomorphism, ASignOfZeroIsADifference) {
  const IsomorphismPoint point = small(0.5);
  motion::Start<2> start = isomorphism_start(point, 0);
  start.momentum[5] = {0.0, 0.25};
  motion::Start<2> changed = start;
  changed.momentum[5][0] = -0.0;
  const IsomorphismRun run(point, start, changed);
  ASSERT_TRUE(run.record().difference.has_value());
  EXPECT_EQ(run.record().difference->particle, 5);
  EXPECT_EQ(run.record().difference->component_name(), "p_x");
}

TEST(Isomorphism, NothingMovesAfterADifference) {
  const IsomorphismPoint point = small(0.5);
  const motion::Start<2> start = isomorphism_start(point, 0);
  motion::Start<2> changed = start;
  changed.momentum[50][1] = next_double(changed.momentum[50][1]);
  IsomorphismRun run(point, start, changed);
  finish(run, point);
  EXPECT_EQ(run.intervals_done(), interval_count(point));
  EXPECT_EQ(run.record().steps, 0);
  EXPECT_EQ(run.record().comparisons, 605);
  EXPECT_EQ(run.record().samples.size(), 0u);
  EXPECT_EQ(run.atoms().time(), 0.0);
}

/// The place in an archive of the last double with these bits.
std::size_t last_place_of(double value, std::span<const std::byte> bytes) {
  std::size_t place = bytes.size();
  for (std::size_t at = 0; at + sizeof value <= bytes.size(); ++at)
    if (std::memcmp(bytes.data() + at, &value, sizeof value) == 0) place = at;
  return place;
}

TEST(Isomorphism, ADifferenceOnTheWayIsFoundAtTheNextStep) {
  const IsomorphismPoint point = small(0.5);
  IsomorphismRun run(point, 0);
  for (int i = 0; i < 5; ++i) run.advance_one_interval();
  ArchiveWriter archive;
  run.save(archive);
  // The smooth particles are saved last: a momentum of particle 0 is changed there, by one part in some thousands.
  std::vector<std::byte> bytes = archive.bytes();
  const std::size_t place = last_place_of(run.smooth().momenta()[0], bytes);
  ASSERT_LT(place, bytes.size());
  bytes[place + 5] ^= std::byte{1};
  IsomorphismRun changed(point, 0);
  ArchiveReader reader(bytes);
  changed.load(reader);
  finish(changed, point);
  ASSERT_TRUE(changed.record().difference.has_value());
  const Difference difference = *changed.record().difference;
  EXPECT_EQ(difference.step, 101);
  EXPECT_NEAR(difference.time, 5.05, 1e-12);
  EXPECT_EQ(difference.particle, 0);
  EXPECT_EQ(difference.component_name(), "x");
  EXPECT_NE(difference.atoms, difference.smooth);
  EXPECT_EQ(changed.record().steps, 101);
  EXPECT_EQ(changed.record().samples.size(), 3u);  // those of before
}

TEST(Isomorphism, AnotherFluidMovesOtherwiseFromTheStart) {
  IsomorphismPoint point = small(0.5);
  point.pressure = 2.0;
  const IsomorphismRecord record = record_of(point);
  ASSERT_TRUE(record.difference.has_value());
  EXPECT_EQ(record.difference->step, 0);
  EXPECT_EQ(record.difference->particle, 0);
  EXPECT_EQ(record.difference->component_name(), "F_x");
  EXPECT_EQ(record.difference->smooth, 2.0 * record.difference->atoms);
}

TEST(Isomorphism, AFluidWithTheSameCoefficientMovesTheSame) {
  IsomorphismPoint point = small(0.5);
  const IsomorphismRecord unit = record_of(point);
  point.pressure = 4.0;
  point.reference_density = 2.0;
  const IsomorphismRecord other = record_of(point);
  EXPECT_FALSE(other.difference.has_value());
  expect_same_samples(other, unit);
}

TEST(Isomorphism, ASavedRunGoesOnWithTheSameBits) {
  const IsomorphismPoint point = small(0.5);
  const IsomorphismRecord whole = record_of(point);
  for (const int stop : {1, 2, 9}) {
    IsomorphismRun first(point, 0);
    for (int i = 0; i < stop; ++i) first.advance_one_interval();
    ArchiveWriter archive;
    first.save(archive);
    IsomorphismRun second(point, 0, 2);
    ArchiveReader reader(archive.bytes());
    second.load(reader);
    EXPECT_TRUE(reader.exhausted());
    EXPECT_EQ(second.intervals_done(), stop);
    finish(second, point);
    EXPECT_FALSE(second.record().difference.has_value());
    expect_same_samples(second.record(), whole);
  }
}

TEST(Isomorphism, ASavedDifferenceIsStillThere) {
  IsomorphismPoint point = small(0.5);
  point.pressure = 2.0;
  IsomorphismRun first(point, 0);
  ArchiveWriter archive;
  first.save(archive);
  point.pressure = 1.0;  // whose start has no difference
  IsomorphismRun second(point, 0);
  ArchiveReader reader(archive.bytes());
  second.load(reader);
  ASSERT_TRUE(second.record().difference.has_value());
  EXPECT_EQ(second.record().difference->smooth, first.record().difference->smooth);
  EXPECT_EQ(second.record().difference->component_name(), "F_x");
}

TEST(Isomorphism, ItsAtomsAreThoseOfASweep) {
  for (const double rate : {0.0, 0.5}) {
    IsomorphismPoint point = small(rate);
    point.sample_interval = point.step;
    CouetteRun sweep(sweep_row(point), 1);
    IsomorphismRun run(point, 1);
    for (int step = 0; step < 100; ++step) {
      sweep.advance_one_sample();
      run.advance_one_interval();
    }
    const Sample& of_sweep = sweep.record().samples.back();
    const IsomorphismSample& ours = run.record().samples.back();
    EXPECT_EQ(of_sweep[0], ours[isomorphism_quantity("atoms_potential_energy")]);
    EXPECT_EQ(of_sweep[2], ours[isomorphism_quantity("atoms_pxy_kinetic")]);
    EXPECT_EQ(of_sweep[3], ours[isomorphism_quantity("atoms_pxy_potential")]);
  }
}

// Every sum of the continuum again, by a double loop over particles and images.
TEST(Isomorphism, TheContinuumsSumsAreThoseOverAllPartners) {
  const IsomorphismPoint point = small(0.5);
  const kernel::Lucy<2> kernel(point.range);
  IsomorphismRun run(point, 0);
  finish(run, point);
  const std::size_t n = 100;
  const std::vector<double> positions = run.smooth().positions();
  const std::vector<double> momenta = run.smooth().momenta();
  std::vector<space::Vector<2>> position(n);
  std::vector<double> density(n, kernel.weight_at_zero());
  std::vector<space::Vector<2>> moment(n);
  for (std::size_t i = 0; i < n; ++i) {
    position[i] = {positions[2 * i], positions[2 * i + 1]};
    for (std::size_t d = 0; d < 2; ++d) moment[i][d] = kernel.weight_at_zero() * momenta[2 * i + d];
  }
  double virial_xy = 0.0;
  double virial_trace = 0.0;
  pairs::testing::for_all_pairs<2>(run.smooth().box(), position, 0.0, point.range,
                                   [&](std::size_t i, std::size_t j, const auto& apart, const auto&) {
                                     const double distance = std::hypot(apart[0], apart[1]);
                                     const double weight = kernel.weight(distance);
                                     density[i] += weight;
                                     density[j] += weight;
                                     for (std::size_t d = 0; d < 2; ++d) {
                                       moment[i][d] += weight * momenta[2 * j + d];
                                       moment[j][d] += weight * momenta[2 * i + d];
                                     }
                                     virial_xy += kernel.slope(distance) * apart[0] * apart[1];
                                     virial_trace += kernel.slope(distance) * distance * distance;
                                   });
  double reynolds = 0.0;
  double of_field = 0.0;
  double field_energy = 0.0;
  double internal_energy = 0.0;
  double fluid_pressure = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double u_x = moment[i][0] / density[i];
    const double u_y = moment[i][1] / density[i];
    of_field += u_x * u_y;
    field_energy += 0.5 * (u_x * u_x + u_y * u_y);
    reynolds += momenta[2 * i] * momenta[2 * i + 1];
    internal_energy += 0.5 * density[i];                             // e = rho/2
    fluid_pressure += (0.5 * density[i] * density[i]) / density[i];  // P = rho^2/2
  }
  const double volume = 100.0;
  const IsomorphismSample& sample = run.record().samples.back();
  const auto expect = [&](std::size_t quantity, double value) {
    EXPECT_NEAR(sample[quantity], value, 1e-12) << isomorphism_quantities[quantity];
  };
  expect(isomorphism_quantity("smooth_pxy_reynolds"), reynolds / volume);
  expect(isomorphism_quantity("smooth_pxy_reynolds_of_field"), of_field / volume);
  expect(isomorphism_quantity("smooth_viscosity_reynolds_of_field"), -of_field / volume / 0.5);
  expect(isomorphism_quantity("smooth_kinetic_energy_of_field"), field_energy / 100.0);
  expect(isomorphism_quantity("smooth_pxy_tensor"), virial_xy / volume);
  expect(isomorphism_quantity("smooth_pressure_tensor"), 0.5 * virial_trace / volume);
  expect(isomorphism_quantity("smooth_internal_energy"), internal_energy / 100.0);
  expect(isomorphism_quantity("smooth_pressure_fluid"), fluid_pressure / volume);
}

TEST(Isomorphism, EnergiesDifferByTheSelfTermAndStressesByNothing) {
  for (const double rate : {0.0, 0.5}) {
    const IsomorphismPoint point = small(rate);
    const double self_term = 0.5 * kernel::Lucy<2>(point.range).weight_at_zero();
    const IsomorphismRecord record = record_of(point);
    ASSERT_EQ(record.samples.size(), 20u);
    for (const IsomorphismSample& sample : record.samples) {
      const auto value = [&](std::size_t quantity) { return sample[quantity]; };
      EXPECT_NEAR(value(isomorphism_quantity("smooth_internal_energy")),
                  value(isomorphism_quantity("atoms_potential_energy")) + self_term, 1e-13);
      EXPECT_NEAR(value(isomorphism_quantity("smooth_energy")), value(isomorphism_quantity("atoms_energy")) + self_term,
                  1e-13);
      EXPECT_EQ(value(isomorphism_quantity("smooth_kinetic_energy")),
                value(isomorphism_quantity("atoms_kinetic_energy")));
      EXPECT_EQ(value(isomorphism_quantity("smooth_pxy_tensor")), value(isomorphism_quantity("atoms_pxy_potential")));
      EXPECT_EQ(value(isomorphism_quantity("smooth_pxy_reynolds")), value(isomorphism_quantity("atoms_pxy_kinetic")));
      EXPECT_LT(value(isomorphism_quantity("smooth_kinetic_energy_of_field")),
                value(isomorphism_quantity("smooth_kinetic_energy")));
      EXPECT_EQ(std::isnan(value(isomorphism_quantity("atoms_viscosity"))), rate == 0.0);
    }
  }
}

std::string refusal(const IsomorphismPoint& point) {
  try {
    validate(point);
  } catch (const BadInput& refused) {
    return refused.what();
  }
  return "accepted";
}

TEST(Isomorphism, RefusesWhatCannotBeRun) {
  EXPECT_EQ(refusal(small(0.5)), "accepted");
  IsomorphismPoint point = small(0.5);
  point.pressure = 3.0;
  EXPECT_THAT(refusal(point), HasSubstr("isentropic.pressure = 3 must be a power of two"));
  EXPECT_THROW(IsomorphismRun(point, 0), BadInput);
  point = small(0.5);
  point.reference_density = -1.0;
  EXPECT_THAT(refusal(point), HasSubstr("isentropic.reference_density = -1 must be a power of two"));
  point = small(0.5);
  point.particles = 25;
  EXPECT_THAT(refusal(point), HasSubstr("below twice kernel.range"));
  point = small(0.5);
  point.integrator = motion::Integrator::velocity_verlet;
  EXPECT_THAT(refusal(point), HasSubstr("run.integrator"));
  point = small(0.5);
  point.sample_interval = 0.07;
  EXPECT_THAT(refusal(point), HasSubstr("output.sample_interval"));
}

TEST(Isomorphism, SamplesAreTakenEveryTimeUnitOrTenTimesAtLeast) {
  EXPECT_EQ(sample_steps(small(0.0, 1000.0)), 20);
  EXPECT_EQ(sample_steps(small(0.0, 5.0)), 10);
  EXPECT_EQ(sample_steps(small(0.0, 0.05)), 1);
  IsomorphismPoint point = small(0.0, 100.0);
  point.sample_interval = 0.25;
  EXPECT_EQ(sample_steps(point), 5);
  EXPECT_EQ(interval_count(point), 408);
}

TEST(IsomorphismRow, HoldsMeansWithErrorsOfBothReadings) {
  const IsomorphismPoint point = small(0.5, 400.0);
  const IsomorphismRecord record = record_of(point);
  const IsomorphismRow row = summarize(point, std::span(&record, 1));
  EXPECT_EQ(row.status, RowStatus::ok);
  EXPECT_EQ(row.identical(), "yes");
  EXPECT_EQ(row.thermostat, "isoenergetic");
  EXPECT_EQ(row.steps, record.steps);
  EXPECT_EQ(row.comparisons, record.comparisons);
  const auto& atoms = row.estimates[isomorphism_quantity("atoms_viscosity")];
  const auto& smooth = row.estimates[isomorphism_quantity("smooth_viscosity")];
  EXPECT_EQ(atoms.value, smooth.value);
  EXPECT_EQ(atoms.error, smooth.error);
  EXPECT_GT(atoms.error, 0.0);
  const auto value = [&](std::size_t quantity) { return row.estimates[quantity].value; };
  EXPECT_NEAR(
      atoms.value,
      -(value(isomorphism_quantity("atoms_pxy_kinetic")) + value(isomorphism_quantity("atoms_pxy_potential"))) / 0.5,
      1e-12);
  // Posch, Hoover and Kum (1995), Table II, N = 1024; that a hundred particles are fewer is less than the error here.
  EXPECT_NEAR(atoms.value, (0.2124 - 0.0012) / 0.5, 4.0 * atoms.error);
  EXPECT_LT(atoms.error, 0.03);
}

TEST(IsomorphismRow, HasNoViscosityAtRestAndNoThermostat) {
  const IsomorphismPoint point = small(0.0, 100.0);
  const IsomorphismRecord record = record_of(point);
  const IsomorphismRow row = summarize(point, std::span(&record, 1));
  EXPECT_EQ(row.status, RowStatus::ok);
  EXPECT_EQ(row.thermostat, "none");
  EXPECT_TRUE(std::isnan(row.estimates[isomorphism_quantity("atoms_viscosity")].value));
  EXPECT_FALSE(std::isnan(row.estimates[isomorphism_quantity("atoms_pxy_kinetic")].error));
}

// The integrator lets the energy drift: that makes no run short.
TEST(IsomorphismRow, NeedsNoErrorOfTheConservedEnergy) {
  const IsomorphismPoint point = small(0.0, 200.0);
  IsomorphismRecord record = record_of(point);
  double drift = 0.0;
  for (auto& sample : record.samples) sample[isomorphism_quantity("atoms_energy")] += (drift += 1e-7);
  const IsomorphismRow row = summarize(point, std::span(&record, 1));
  EXPECT_TRUE(std::isnan(row.estimates[isomorphism_quantity("atoms_energy")].error));
  EXPECT_NEAR(row.estimates[isomorphism_quantity("atoms_energy")].value, 1.0, 1e-4);
  EXPECT_EQ(row.status, RowStatus::ok);
}

TEST(IsomorphismRow, PoolsReplicasAndNamesTheOneThatDiffers) {
  IsomorphismPoint point = small(0.5, 30.0);
  point.replicas = 2;
  std::vector<IsomorphismRecord> records;
  for (int replica = 0; replica < 2; ++replica) {
    IsomorphismRun run(point, replica);
    finish(run, point);
    records.push_back(run.record());
  }
  EXPECT_NE(bits_of(records[0].samples.front()), bits_of(records[1].samples.front()));
  const IsomorphismRow row = summarize(point, records);
  EXPECT_EQ(row.steps, 2 * records[0].steps);
  EXPECT_EQ(row.identical(), "yes");
  records[1].difference = Difference{};
  const IsomorphismRow differing = summarize(point, records);
  EXPECT_EQ(differing.identical(), "no");
  EXPECT_EQ(differing.differing_replica, 1);
  EXPECT_EQ(differing.status, RowStatus::too_short);
  for (const auto& estimate : differing.estimates) EXPECT_TRUE(std::isnan(estimate.value));
}

TEST(IsomorphismRow, GivesNoErrorsToAFlowThatHeatsUp) {
  IsomorphismPoint point = small(0.5, 50.0);
  point.thermostat = motion::Thermostat::none;
  const IsomorphismRecord record = record_of(point);
  const IsomorphismRow row = summarize(point, std::span(&record, 1));
  EXPECT_EQ(row.identical(), "yes");
  EXPECT_EQ(row.status, RowStatus::too_short);
  EXPECT_TRUE(std::isnan(row.estimates[isomorphism_quantity("atoms_viscosity")].error));
}

TEST(IsomorphismRow, OfAFailedCaseClaimsNothing) {
  const IsomorphismRow row = failed_row(small(0.5), "no steady flow");
  EXPECT_EQ(row.status, RowStatus::failed);
  EXPECT_EQ(row.identical(), "unknown");
  EXPECT_EQ(row.failure, "no steady flow");
  EXPECT_EQ(row.comparisons, 0);
}

}  // namespace
}  // namespace lucy::cases
