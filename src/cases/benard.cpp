// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/benard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "cases/pacing.hpp"
#include "cases/refusals.hpp"
#include "cases/seeds.hpp"
#include "lucy/errors.hpp"

namespace lucy::cases {

namespace {

using Trajectory = motion::FluidTrajectory<2>;

constexpr int usual_sample_steps = 10;
constexpr double longest_step = 1.0;
constexpr std::size_t most_blocks = 16;
constexpr int floor_wall = space::wall_number(1, false);
constexpr int ceiling_wall = space::wall_number(1, true);

std::int64_t intervals(const BenardPoint& point, double time) {
  return intervals_in(time, sample_steps(point), point.step);
}

/// That asked for, or what makes the density 1.
double height_of(const BenardPoint& point) {
  if (point.height != 0.0) return point.height;
  const auto area = static_cast<double>(point.particles);
  return point.width ? area / *point.width : std::sqrt(area / (point.sides == grid::Sides::periodic ? 2.0 : 1.0));
}

spam::Fluid<2> fluid_of(const BenardPoint& all) {
  return {kernel::make_weight<2>(all.weight, all.range),
          spam::make_equation_of_state(all.equation_of_state),
          {*all.viscosity, all.bulk_viscosity, *all.conductivity},
          all.density_mean,
          {0.0, -*all.gravity}};
}

space::Walls<2> walls_of(const BenardPoint& all) {
  space::Walls<2> walls;
  walls.kind = all.wall;
  walls.across[1] = {space::Wall<2>{{}, all.hot, {}}, space::Wall<2>{{}, all.cold, {}}};
  if (all.sides == grid::Sides::walls) {
    const space::Wall<2> side{{}, all.hot, {0.0, (all.cold - all.hot) / all.height}};
    walls.across[0] = {side, side};
  }
  return walls;
}

motion::FluidStart<2> start_of(const BenardPoint& all, int replica) {
  const spam::EquationOfState state = spam::make_equation_of_state(all.equation_of_state);
  std::mt19937_64 generator(replica_seed(all, replica));
  std::uniform_real_distribution<double> offset(-all.disorder, all.disorder);
  motion::FluidStart<2> start;
  start.lengths = {*all.width, all.height};
  start.walls = walls_of(all);
  const auto columns = std::lround(*all.width);
  const auto rows = std::lround(all.height);
  for (long row = 0; row < rows; ++row) {
    for (long column = 0; column < columns; ++column) {
      space::Vector<2> position = {(static_cast<double>(column) + 0.5) * *all.width / static_cast<double>(columns),
                                   (static_cast<double>(row) + 0.5) * all.height / static_cast<double>(rows)};
      if (all.disorder > 0.0)
        for (double& coordinate : position) coordinate += offset(generator);
      const auto rolls = grid::roll_pattern(all.sides, position[0] / *all.width - 0.5, position[1] / all.height - 0.5);
      start.position.push_back(position);
      start.velocity.push_back({*all.roll_velocity * rolls[0], *all.roll_velocity * rolls[1]});
      const double temperature = all.hot + (all.cold - all.hot) * position[1] / all.height;
      start.energy.push_back(grid::energy_at(state, 1.0, temperature));
    }
  }
  return start;
}

motion::Watch watch_of(const BenardPoint& all) {
  motion::Watch watch;
  watch.energy_tolerance = all.energy_tolerance;
  return watch;
}

}  // namespace

BenardPoint resolved(const BenardPoint& point) {
  BenardPoint all = point;
  all.height = height_of(point);
  set_unset(all);
  all.roll_velocity = all.roll_velocity.value_or(usual_roll_velocity * (all.hot - all.cold));
  if (all.sample_interval == 0.0) all.sample_interval = sample_steps(all) * all.step;
  return all;
}

int sample_steps(const BenardPoint& point) {
  const double interval = point.sample_interval > 0.0 ? point.sample_interval : usual_sample_steps * point.step;
  return interval_steps(std::min(interval, point.duration), point.frame_interval, point.step);
}

std::int64_t equilibration_intervals(const BenardPoint& point) { return intervals(point, point.equilibration); }

std::int64_t interval_count(const BenardPoint& point) {
  return equilibration_intervals(point) + std::max<std::int64_t>(1, intervals(point, point.duration));
}

std::uint64_t replica_seed(const BenardPoint& point, int replica) {
  const auto number = [](auto choice) { return static_cast<std::uint64_t>(choice); };
  return mixed_seed(point.seed, {number(replica), number(point.particles), bits(point.disorder)});
}

void validate(const BenardPoint& point) {
  refuse_unless_above_zero("system.particles", static_cast<double>(point.particles));
  refuse_unless_above_zero("kernel.range", point.range);
  BenardPoint sized = point;
  sized.height = height_of(point);
  validate(static_cast<const Convection&>(sized), false);
  const double width = width_of(sized);
  const double columns = std::round(width);
  const double rows = std::round(sized.height);
  const auto particles = static_cast<double>(point.particles);
  if (std::abs(width * sized.height - particles) > 1e-6 * particles || columns * rows != particles ||
      std::abs(width - columns) > 1e-6 * columns)
    refuse(fmt::format(
        "system.particles = {} in a cell of width {:.8g} and height {:.8g} make no square lattice of density "
        "1: width times height must be the number of particles, both whole numbers",
        point.particles, width, sized.height));
  for (const auto& [name, length, walled] :
       {std::tuple{"width", width, point.sides == grid::Sides::walls}, std::tuple{"height", sized.height, true}}) {
    const double least = walled ? motion::WallParticles<2>::shortest_in_ranges : 2.0;
    if (!(length > least * point.range))
      refuse(fmt::format("cell.{} = {} must be above {} times kernel.range = {}", name, length, least, point.range));
  }
  refuse_unless_at_least_zero("fluid.bulk_viscosity", point.bulk_viscosity);
  if (const double least = spam::VanDerWaals::spinodal_temperature(1.0);
      point.equation_of_state == spam::EquationOfStateName::van_der_waals && point.cold <= least)
    refuse(
        fmt::format("cell.cold = {} must be above {}, below which a van der Waals fluid of density 1 falls apart into "
                    "drops",
                    point.cold, least));
  refuse_unless_at_least_zero("start.disorder", point.disorder);
  if (!(point.step > 0.0 && point.step <= longest_step))
    refuse(fmt::format("run.step = {} must be above 0 and at most {}", point.step, longest_step));
  refuse_unless_above_zero("run.duration", point.duration);
  refuse_unless_at_least_zero("run.equilibration", point.equilibration);
  refuse_unless_above_zero("run.energy_tolerance", point.energy_tolerance);
  refuse_endless_run(point.equilibration, point.duration, point.step);
  refuse_uneven_intervals(point.sample_interval, point.frame_interval, point.step, point.duration);
  if (point.cells < 4) refuse(fmt::format("output.cells = {} must be at least 4", point.cells));
}

std::vector<double> FieldCells::points() const {
  std::vector<double> result;
  result.reserve(2 * size());
  for (int row = 0; row < cells[1]; ++row)
    for (int column = 0; column < cells[0]; ++column) result.insert(result.end(), {centre(0, column), centre(1, row)});
  return result;
}

FieldCells field_cells(const BenardPoint& point) {
  const BenardPoint all = resolved(point);
  const auto along_x = static_cast<int>(std::lround(all.cells * *all.width / all.height));
  return {{std::max(4, along_x), all.cells}, {*all.width, all.height}};
}

struct BenardRun::Implementation {
  Implementation(const BenardPoint& settings, int replica, int threads)
      : point((validate(settings), resolved(settings))),
        steps_per_sample(sample_steps(point)),
        team(threads),
        places(field_cells(point).points()),
        unit(heat_at_rest(point)),
        trajectory(fluid_of(point), start_of(point, replica), 0.0, motion::Cooling::none, watch_of(point), team) {
    record.sample_interval = steps_per_sample * point.step;
    for (std::size_t k = 0; k < places.size(); ++k) places[k] += trajectory.cell().corner()[k % 2];
    const auto averaged = static_cast<std::size_t>(interval_count(point) - equilibration_intervals(point));
    record.blocks.assign(std::min(most_blocks, averaged), measure::Moments<2>(places.size() / 2));
    record.block_samples.assign(record.blocks.size(), 0.0);
  }

  /// Of the fluid, that in gravity's field among it.
  double total_energy() const {
    const std::vector<double> positions = trajectory.positions();
    double heights = 0.0;
    for (std::size_t y = 1; y < positions.size(); y += 2) heights += positions[y];
    return trajectory.energy() + *point.gravity * heights;
  }

  /// One interval of steps.
  BenardSample averages() {
    const auto given_before = trajectory.given_by_walls();
    const double energy_before = total_energy();
    double kinetic = 0.0;
    for (int step = 0; step < steps_per_sample; ++step) {
      trajectory.advance(point.step);
      kinetic += trajectory.kinetic().kinetic_energy();
    }
    BenardSample sample;
    const double in_units = 1.0 / (record.sample_interval * unit);
    const auto add = [&](std::size_t conduction, std::size_t work, int wall) {
      const auto number = static_cast<std::size_t>(wall);
      const spam::WallExchange& given = trajectory.given_by_walls()[number];
      sample.averages[conduction] += (given.conduction - given_before[number].conduction) * in_units;
      sample.averages[work] += (given.work - given_before[number].work) * in_units;
    };
    add(benard_average("conduction_hot"), benard_average("work_hot"), floor_wall);
    add(benard_average("conduction_cold"), benard_average("work_cold"), ceiling_wall);
    for (const bool high : {false, true})
      add(benard_average("conduction_sides"), benard_average("work_sides"), space::wall_number(0, high));
    sample.averages[benard_average("stored")] = (total_energy() - energy_before) * in_units;
    sample.averages[benard_average("kinetic_energy_total")] =
        kinetic / (steps_per_sample * static_cast<double>(point.particles));
    for (const double value : sample.averages)
      if (!std::isfinite(value))
        throw RunFailed(fmt::format("at time {:.6g} a sum over the particles is not a number", trajectory.time()));
    return sample;
  }

  void take_instants(BenardSample& sample) {
    const auto n = static_cast<double>(point.particles);
    last = {trajectory.time(),      trajectory.positions(),   trajectory.velocities(), {},
            trajectory.densities(), trajectory.temperatures()};
    const motion::FieldPlaces<2> source = trajectory.field_places();
    const auto moments = measure::moments<2>(
        trajectory.fluid().fluid().weight, {source.box, source.position, source.velocity, source.energy}, places, team);
    last.velocity_smoothed.resize(last.velocity.size());
    double smoothed = 0.0;
    double projection = 0.0;
    double pattern_square = 0.0;
    for (std::size_t i = 0; i < last.density.size(); ++i) {
      for (std::size_t d = 0; d < 2; ++d) {
        const double u = moments.particles.column[measure::Moments<2>::momentum + d][i] /
                         moments.particles.column[measure::Moments<2>::density][i];
        last.velocity_smoothed[2 * i + d] = u;
        smoothed += 0.5 * u * u;
      }
      const double pattern = grid::roll_pattern(point.sides, last.position[2 * i] / *point.width - 0.5,
                                                last.position[2 * i + 1] / point.height - 0.5)[1];
      projection += pattern * last.velocity[2 * i + 1];
      pattern_square += pattern * pattern;
    }
    const auto [least_density, largest_density] = std::ranges::minmax(last.density);
    const auto [least_temperature, largest_temperature] = std::ranges::minmax(last.temperature);
    sample.instants[benard_instant("kinetic_energy_smoothed")] = smoothed / n;
    sample.instants[benard_instant("internal_energy")] = trajectory.internal_energy() / n;
    sample.instants[benard_instant("total_energy")] = total_energy() / n;
    sample.instants[benard_instant("roll_amplitude")] = projection / pattern_square;
    sample.instants[benard_instant("density_least")] = least_density;
    sample.instants[benard_instant("density_largest")] = largest_density;
    sample.instants[benard_instant("temperature_least")] = least_temperature;
    sample.instants[benard_instant("temperature_largest")] = largest_temperature;
    if (const std::int64_t averaged = done - equilibration_intervals(point); averaged >= 0) {
      const std::int64_t all = interval_count(point) - equilibration_intervals(point);
      const auto blocks = static_cast<std::int64_t>(record.blocks.size());
      const auto block = static_cast<std::size_t>(std::min(averaged * blocks / all, blocks - 1));
      record.blocks[block].add(moments.points);
      record.block_samples[block] += 1.0;
    }
  }

  BenardPoint point;
  int steps_per_sample;
  Team team;
  std::vector<double> places;  // of the fields, in the box around the cell
  double unit;                 // of heat per time
  std::int64_t done = 0;
  Trajectory trajectory;
  BenardRecord record;
  BenardParticles last;
};

BenardRun::BenardRun(const BenardPoint& point, int replica, int threads)
    : self_(std::make_unique<Implementation>(point, replica, threads)) {}
BenardRun::~BenardRun() = default;
BenardRun::BenardRun(BenardRun&&) noexcept = default;
BenardRun& BenardRun::operator=(BenardRun&&) noexcept = default;

void BenardRun::advance_one_interval() {
  Implementation& self = *self_;
  if (!self.record.failure.empty()) {
    ++self.done;
    return;
  }
  try {
    self.trajectory.renew_list(self.point.step);
    BenardSample sample = self.averages();
    self.take_instants(sample);
    self.record.samples.push_back(sample);
  } catch (const RunFailed& failure) {
    self.record.failure = failure.what();
  }
  ++self.done;
  const motion::WatchReport& report = self.trajectory.report();
  self.record.worst_energy_error = report.worst_energy_error;
  self.record.energy_drift = self.trajectory.energy_drift();
  self.record.steps = report.steps;
  self.record.subdivided_steps = report.subdivided_steps;
  self.record.reflections = self.trajectory.reflections();
}

std::int64_t BenardRun::intervals_done() const { return self_->done; }
const BenardRecord& BenardRun::record() const { return self_->record; }
const BenardParticles& BenardRun::last() const { return self_->last; }
const motion::FluidTrajectory<2>& BenardRun::trajectory() const { return self_->trajectory; }

Frame BenardRun::frame() const {
  return frame_of(self_->trajectory, self_->done * self_->steps_per_sample, self_->point.step);
}

bool BenardRun::frame_due() const {
  const Implementation& self = *self_;
  return self.record.failure.empty() &&
         frame_falls_on(self.done, self.point.frame_interval, self.steps_per_sample, self.point.step);
}

void BenardRun::save(ArchiveWriter& archive) const {
  const Implementation& self = *self_;
  archive.put(self.done);
  archive.put_sequence(self.record.samples);
  for (const measure::Moments<2>& block : self.record.blocks)
    for (const std::vector<double>& column : block.column) archive.put_sequence(column);
  archive.put_sequence(self.record.block_samples);
  archive.put(self.record.worst_energy_error);
  archive.put(self.record.energy_drift);
  archive.put(self.record.steps);
  archive.put(self.record.subdivided_steps);
  archive.put(self.record.reflections);
  archive.put_sequence(self.record.failure);
  archive.put(self.last.time);
  for (const std::vector<double>* values : {&self.last.position, &self.last.velocity, &self.last.velocity_smoothed,
                                            &self.last.density, &self.last.temperature})
    archive.put_sequence(*values);
  self.trajectory.save(archive);
}

void BenardRun::load(ArchiveReader& archive) {
  Implementation& self = *self_;
  self.done = archive.get<std::int64_t>();
  archive.get_sequence(self.record.samples);
  for (measure::Moments<2>& block : self.record.blocks)
    for (std::vector<double>& column : block.column) {
      archive.get_sequence(column);
      if (column.size() != self.places.size() / 2) throw RunFailed("a saved state has fields of another grid");
    }
  const std::size_t blocks = self.record.blocks.size();
  archive.get_sequence(self.record.block_samples);
  if (self.record.block_samples.size() != blocks) throw RunFailed("a saved state has another number of blocks");
  self.record.worst_energy_error = archive.get<double>();
  self.record.energy_drift = archive.get<double>();
  self.record.steps = archive.get<std::int64_t>();
  self.record.subdivided_steps = archive.get<std::int64_t>();
  self.record.reflections = archive.get<std::int64_t>();
  archive.get_sequence(self.record.failure);
  self.last.time = archive.get<double>();
  for (std::vector<double>* values : {&self.last.position, &self.last.velocity, &self.last.velocity_smoothed,
                                      &self.last.density, &self.last.temperature})
    archive.get_sequence(*values);
  self.trajectory.load(archive);
}

}  // namespace lucy::cases
