// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/isomorphism.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "lucy/errors.hpp"
#include "lucy/measure/kinetic.hpp"
#include "lucy/measure/smoothed_velocity.hpp"
#include "lucy/motion/neighbourhood.hpp"
#include "lucy/spam/equation_of_state.hpp"

namespace lucy::cases {

namespace {

using Trajectory = motion::Trajectory<2>;

constexpr double default_sample_interval = 1.0;
constexpr double fewest_samples = 10.0;
constexpr double most_steps_per_sample = 1e9;

spam::Isentropic fluid_of(const IsomorphismPoint& point) {
  return spam::Isentropic(point.pressure, point.reference_density);
}

std::int64_t intervals(const IsomorphismPoint& point, double time) {
  return static_cast<std::int64_t>(std::ceil(time / (sample_steps(point) * point.step) - 1e-6));
}

/// All numbers of one state that are compared: positions, momenta and forces by particle number, then the sums.
class Snapshot {
 public:
  explicit Snapshot(std::int64_t particles)
      : coordinates_(2 * static_cast<std::size_t>(particles)), values_(3 * coordinates_ + compared_sums.size()) {}

  void take(const Trajectory& trajectory) {
    const std::span values(values_);
    // As they lie in memory, not wrapped: both readings make their lists at the same steps, and wrap there.
    trajectory.copy_positions(values.first(coordinates_));
    trajectory.copy_momenta(values.subspan(coordinates_, coordinates_));
    trajectory.copy_forces(values.subspan(2 * coordinates_, coordinates_));
    const auto& virial = trajectory.pair_totals().virial;
    const std::array<double, compared_sums.size()> sums = {trajectory.energy(), trajectory.friction(), virial(0, 0),
                                                           virial(0, 1), virial(1, 1)};
    std::copy(sums.begin(), sums.end(), values.subspan(3 * coordinates_).begin());
  }

  std::size_t size() const { return values_.size(); }

  /// Component of compared_coordinates.
  double of_particle(std::int64_t particle, int component) const {
    const int block = component / 2;
    return values_[block * coordinates_ + 2 * static_cast<std::size_t>(particle) + component % 2];
  }
  /// Of compared_sums.
  double sum(int component) const { return values_[3 * coordinates_ + static_cast<std::size_t>(component)]; }

  bool same_bits(const Snapshot& other) const {
    return std::memcmp(values_.data(), other.values_.data(), values_.size() * sizeof(double)) == 0;
  }

 private:
  std::size_t coordinates_;
  std::vector<double> values_;
};

bool differ(double a, double b) { return std::bit_cast<std::uint64_t>(a) != std::bit_cast<std::uint64_t>(b); }

/// Nothing when all bits are the same. Positions and momenta come first, particle by particle: forces and then sums
/// follow from them.
std::optional<Difference> first_difference(const Snapshot& atoms, const Snapshot& smooth, std::int64_t particles) {
  if (atoms.same_bits(smooth)) return std::nullopt;
  Difference found;
  const auto found_in = [&](int first_component, int last_component) {
    for (found.particle = 0; found.particle < particles; ++found.particle) {
      for (found.component = first_component; found.component <= last_component; ++found.component) {
        found.atoms = atoms.of_particle(found.particle, found.component);
        found.smooth = smooth.of_particle(found.particle, found.component);
        if (differ(found.atoms, found.smooth)) return true;
      }
    }
    return false;
  };
  constexpr int first_force = 4;
  if (found_in(0, first_force - 1) || found_in(first_force, static_cast<int>(compared_coordinates.size()) - 1))
    return found;
  found.particle = -1;
  for (std::size_t c = 0; c < compared_sums.size(); ++c) {
    found.component = static_cast<int>(c);
    found.atoms = atoms.sum(found.component);
    found.smooth = smooth.sum(found.component);
    if (differ(found.atoms, found.smooth)) break;
  }
  return found;
}

/// sum_i u_i u_i over the smoothed velocities, with a list made for this configuration alone.
Eigen::Matrix2d field_momentum_flux(const Trajectory& smooth, const kernel::Lucy<2>& kernel,
                                    std::span<const double> density, const Team& team) {
  const std::vector<double> positions = smooth.positions();
  const std::vector<double> momenta = smooth.momenta();
  const std::size_t particles = density.size();
  motion::Neighbourhood<2> near(smooth.box(), particles, kernel.range());
  space::Columns state(5, near.capacity());  // positions, momenta, density
  space::Columns scratch(5, near.capacity());
  for (std::size_t i = 0; i < particles; ++i) {
    for (int d = 0; d < 2; ++d) {
      state[d][i] = positions[2 * i + static_cast<std::size_t>(d)];
      state[2 + d][i] = momenta[2 * i + static_cast<std::size_t>(d)];
    }
    state[4][i] = density[i];
  }
  near.sort(state, scratch, {});
  motion::Speeds speeds;
  speeds.largest = std::sqrt(smooth.kinetic().largest_square);
  speeds.typical = std::sqrt(smooth.kinetic().kinetic_energy() / static_cast<double>(particles));
  near.make_list(state, speeds, 0.0, team);

  space::Columns smoothed(2, near.capacity());
  measure::smoothed_velocities<2>(kernel, near.list(), near.images(0.0), motion::pointers<2>(state, 0),
                                  motion::pointers<2>(state, 2), state[4], {smoothed[0], smoothed[1]}, team);
  const auto u = motion::pointers<2>(smoothed, 0);
  return measure::kinetic_sums<2>(u, u, near.slots(), team).momentum_flux;
}

}  // namespace

std::string_view Difference::component_name() const {
  const auto place = static_cast<std::size_t>(component);
  return particle >= 0 ? compared_coordinates.at(place) : compared_sums.at(place);
}

CouettePoint sweep_row(const IsomorphismPoint& point) {
  CouettePoint row;
  row.particles = point.particles;
  row.energy_per_particle = point.energy_per_particle;
  row.density = point.density;
  row.dimension = point.dimension;
  row.kernel = point.kernel;
  row.range = point.range;
  row.strain_rate = point.strain_rate;
  row.thermostat = point.strain_rate == 0.0 ? motion::Thermostat::none : point.thermostat;
  row.relaxation_time = point.relaxation_time;
  row.integrator = point.integrator;
  row.step = point.step;
  row.equilibration = point.equilibration;
  row.duration = point.duration;
  row.replicas = point.replicas;
  row.seed = point.seed;
  row.energy_tolerance = point.energy_tolerance;
  row.sample_interval = point.sample_interval;
  return row;
}

int sample_steps(const IsomorphismPoint& point) {
  const double interval = point.sample_interval > 0.0
                              ? point.sample_interval
                              : std::min(default_sample_interval, point.duration / fewest_samples);
  return static_cast<int>(std::clamp(std::round(interval / point.step), 1.0, most_steps_per_sample));
}

std::int64_t interval_count(const IsomorphismPoint& point) {
  return intervals(point, point.equilibration) + intervals(point, point.duration);
}

void validate(const IsomorphismPoint& point) {
  validate(sweep_row(point));
  const auto power_of_two = [](const char* key, double value) {
    try {
      spam::Isentropic(value, 1.0);
    } catch (const BadInput&) {
      throw BadInput(fmt::format(
          "{} = {} must be a power of two (1, 2, 0.5, ...), so that P/rho^2 is the same number at every density", key,
          value));
    }
  };
  power_of_two("isentropic.pressure", point.pressure);
  power_of_two("isentropic.reference_density", point.reference_density);
}

motion::Start<2> isomorphism_start(const IsomorphismPoint& point, int replica) {
  return motion::lattice_start(kernel::Lucy<2>(point.range), point.particles, point.density, point.energy_per_particle,
                               replica_seed(sweep_row(point), replica));
}

struct IsomorphismRun::Implementation {
  Implementation(const IsomorphismPoint& settings, const motion::Start<2>& start_of_atoms,
                 const motion::Start<2>& start_of_smooth, int threads)
      : point((validate(settings), settings)),
        team(threads),
        kernel(settings.range),
        fluid(fluid_of(settings)),
        atoms(make(start_of_atoms, motion::Reading::md)),
        smooth(make(start_of_smooth, motion::Reading::spam)),
        of_atoms(settings.particles),
        of_smooth(settings.particles),
        density(static_cast<std::size_t>(settings.particles)) {
    record.sample_interval = sample_steps(point) * point.step;
    compare();
  }

  Trajectory make(const motion::Start<2>& start, motion::Reading reading) const {
    const CouettePoint row = sweep_row(point);
    motion::Shear shear;
    shear.strain_rate = row.strain_rate;
    shear.thermostat = row.thermostat;
    shear.relaxation_time = row.relaxation_time;
    motion::Watch watch;
    watch.energy_tolerance = row.energy_tolerance;
    return {kernel, start, shear, row.integrator, watch, team, reading, fluid};
  }

  void compare() {
    of_atoms.take(atoms);
    of_smooth.take(smooth);
    record.comparisons += static_cast<std::int64_t>(of_atoms.size());
    record.difference = first_difference(of_atoms, of_smooth, point.particles);
    if (!record.difference) return;
    record.difference->step = record.steps;
    record.difference->time = atoms.time();
  }

  IsomorphismSample observe() {
    const auto n = static_cast<double>(point.particles);
    const double volume = atoms.volume();
    IsomorphismSample sample;
    const auto set = [&](std::size_t quantity, double value) { sample[quantity] = value; };
    // Of a sum of momenta or of a virial.
    const auto shear_stress = [&](const auto& sum) { return sum(0, 1) / volume; };
    const auto pressure = [&](const auto& sum) { return 0.5 * sum.trace() / volume; };
    const auto viscosity = [&](double pxy) {
      return point.strain_rate != 0.0 ? -pxy / point.strain_rate : std::numeric_limits<double>::quiet_NaN();
    };

    const auto& momenta = atoms.kinetic().momentum_flux;
    const auto& virial = atoms.pair_totals().virial;
    set(isomorphism_quantity("atoms_potential_energy"), atoms.pair_totals().potential_energy / n);
    set(isomorphism_quantity("atoms_kinetic_energy"), atoms.kinetic().kinetic_energy() / n);
    set(isomorphism_quantity("atoms_energy"), atoms.energy() / n);
    set(isomorphism_quantity("atoms_pxy_kinetic"), shear_stress(momenta));
    set(isomorphism_quantity("atoms_pxy_potential"), shear_stress(virial));
    set(isomorphism_quantity("atoms_pressure_kinetic"), pressure(momenta));
    set(isomorphism_quantity("atoms_pressure_potential"), pressure(virial));
    set(isomorphism_quantity("atoms_viscosity_kinetic"), viscosity(shear_stress(momenta)));
    set(isomorphism_quantity("atoms_viscosity_potential"), viscosity(shear_stress(virial)));
    set(isomorphism_quantity("atoms_viscosity"), viscosity(shear_stress(momenta) + shear_stress(virial)));

    smooth.copy_densities(density);
    double internal_energy = 0.0;
    double fluid_pressure = 0.0;
    for (const double rho : density) {
      internal_energy += fluid.energy(rho);
      fluid_pressure += fluid.pressure(rho) / rho;
    }
    const double kinetic_energy = smooth.kinetic().kinetic_energy();
    const auto& individual = smooth.kinetic().momentum_flux;
    const auto field = field_momentum_flux(smooth, kernel, density, team);
    const auto& tensor = smooth.pair_totals().virial;
    set(isomorphism_quantity("smooth_internal_energy"), internal_energy / n);
    set(isomorphism_quantity("smooth_kinetic_energy"), kinetic_energy / n);
    set(isomorphism_quantity("smooth_kinetic_energy_of_field"), 0.5 * field.trace() / n);
    set(isomorphism_quantity("smooth_energy"), (internal_energy + kinetic_energy) / n);
    set(isomorphism_quantity("smooth_pxy_reynolds"), shear_stress(individual));
    set(isomorphism_quantity("smooth_pxy_reynolds_of_field"), shear_stress(field));
    set(isomorphism_quantity("smooth_pxy_tensor"), shear_stress(tensor));
    set(isomorphism_quantity("smooth_pressure_reynolds"), pressure(individual));
    set(isomorphism_quantity("smooth_pressure_tensor"), pressure(tensor));
    set(isomorphism_quantity("smooth_pressure_fluid"), fluid_pressure / volume);
    set(isomorphism_quantity("smooth_viscosity_reynolds"), viscosity(shear_stress(individual)));
    set(isomorphism_quantity("smooth_viscosity_reynolds_of_field"), viscosity(shear_stress(field)));
    set(isomorphism_quantity("smooth_viscosity_tensor"), viscosity(shear_stress(tensor)));
    set(isomorphism_quantity("smooth_viscosity"), viscosity(shear_stress(individual) + shear_stress(tensor)));
    return sample;
  }

  IsomorphismPoint point;
  Team team;
  kernel::Lucy<2> kernel;
  spam::Isentropic fluid;
  Trajectory atoms;
  Trajectory smooth;
  Snapshot of_atoms;
  Snapshot of_smooth;
  std::vector<double> density;  // scratch of observe()
  std::int64_t done = 0;
  IsomorphismRecord record;
};

IsomorphismRun::IsomorphismRun(const IsomorphismPoint& point, int replica, int threads) {
  validate(point);
  const motion::Start<2> start = isomorphism_start(point, replica);
  self_ = std::make_unique<Implementation>(point, start, start, threads);
}
IsomorphismRun::IsomorphismRun(const IsomorphismPoint& point, const motion::Start<2>& atoms,
                               const motion::Start<2>& smooth, int threads)
    : self_(std::make_unique<Implementation>(point, atoms, smooth, threads)) {}
IsomorphismRun::~IsomorphismRun() = default;
IsomorphismRun::IsomorphismRun(IsomorphismRun&&) noexcept = default;
IsomorphismRun& IsomorphismRun::operator=(IsomorphismRun&&) noexcept = default;

void IsomorphismRun::advance_one_interval() {
  Implementation& self = *self_;
  ++self.done;
  if (self.record.difference) return;
  self.atoms.renew_list(self.point.step);
  self.smooth.renew_list(self.point.step);
  const int steps = sample_steps(self.point);
  for (int step = 0; step < steps && !self.record.difference; ++step) {
    self.atoms.advance(self.point.step);
    self.smooth.advance(self.point.step);
    ++self.record.steps;
    self.compare();
  }
  if (!std::isfinite(self.atoms.energy()))
    throw RunFailed(fmt::format("at time {:.6g} the energy is not a number", self.atoms.time()));
  self.record.worst_energy_error = self.atoms.report().worst_energy_error;
  self.record.subdivided_steps = self.atoms.report().subdivided_steps;
  const bool equilibrated = self.done > intervals(self.point, self.point.equilibration);
  if (equilibrated && !self.record.difference) self.record.samples.push_back(self.observe());
}

std::int64_t IsomorphismRun::intervals_done() const { return self_->done; }

const IsomorphismRecord& IsomorphismRun::record() const { return self_->record; }

const motion::Trajectory<2>& IsomorphismRun::atoms() const { return self_->atoms; }

const motion::Trajectory<2>& IsomorphismRun::smooth() const { return self_->smooth; }

void IsomorphismRun::save(ArchiveWriter& archive) const {
  const Implementation& self = *self_;
  archive.put(self.done);
  archive.put(self.record.steps);
  archive.put(self.record.comparisons);
  archive.put(self.record.difference.has_value());
  archive.put(self.record.difference.value_or(Difference{}));
  archive.put_sequence(self.record.samples);
  archive.put(self.record.worst_energy_error);
  archive.put(self.record.subdivided_steps);
  self.atoms.save(archive);
  self.smooth.save(archive);
}

void IsomorphismRun::load(ArchiveReader& archive) {
  Implementation& self = *self_;
  self.done = archive.get<std::int64_t>();
  self.record.steps = archive.get<std::int64_t>();
  self.record.comparisons = archive.get<std::int64_t>();
  const bool differs = archive.get<bool>();
  const auto difference = archive.get<Difference>();
  self.record.difference = differs ? std::optional(difference) : std::nullopt;
  archive.get_sequence(self.record.samples);
  self.record.worst_energy_error = archive.get<double>();
  self.record.subdivided_steps = archive.get<std::int64_t>();
  self.atoms.load(archive);
  self.smooth.load(archive);
}

}  // namespace lucy::cases
