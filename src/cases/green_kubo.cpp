// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/green_kubo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "cases/block_correlators.hpp"
#include "cases/green_kubo_schedule.hpp"
#include "lucy/errors.hpp"
#include "lucy/motion/trajectory.hpp"

namespace lucy::cases {

namespace {

void save_correlation(ArchiveWriter& archive, const measure::Correlation& correlation) {
  archive.put_sequence(correlation.lag);
  archive.put_sequence(correlation.value);
  archive.put_sequence(correlation.pairs);
  archive.put_sequence(correlation.mean_a);
  archive.put_sequence(correlation.mean_b);
}

measure::Correlation load_correlation(ArchiveReader& archive) {
  measure::Correlation correlation;
  archive.get_sequence(correlation.lag);
  archive.get_sequence(correlation.value);
  archive.get_sequence(correlation.pairs);
  archive.get_sequence(correlation.mean_a);
  archive.get_sequence(correlation.mean_b);
  return correlation;
}

void save_block(ArchiveWriter& archive, const CorrelationBlock& block) {
  archive.put(block.samples);
  for (const auto& correlation : block.stress) save_correlation(archive, correlation);
  archive.put(block.spectrum.segment);
  archive.put(block.spectrum.segments);
  archive.put_sequence(block.spectrum.power);
  archive.put(block.others.size());
  for (const auto& correlation : block.others) save_correlation(archive, correlation);
}

CorrelationBlock load_block(ArchiveReader& archive) {
  CorrelationBlock block;
  block.samples = archive.get<std::int64_t>();
  for (auto& correlation : block.stress) correlation = load_correlation(archive);
  block.spectrum.segment = archive.get<std::size_t>();
  block.spectrum.segments = archive.get<std::int64_t>();
  archive.get_sequence(block.spectrum.power);
  const auto others = archive.get<std::size_t>();
  for (std::size_t i = 0; i < others; ++i) block.others.push_back(load_correlation(archive));
  return block;
}

}  // namespace

struct GreenKuboRun::Implementation {
  using Trajectory = motion::Trajectory<2>;

  Implementation(const GreenKuboPoint& settings, int replica, int threads)
      : point((validate(settings), settings)),
        team(threads),
        kernel(settings.range),
        start(motion::lattice_start(kernel, settings.particles, settings.density, settings.energy_per_particle,
                                    replica_seed(settings, replica))),
        steps_per_sample(cases::steps_per_sample(settings)),
        steps_per_interval(interval_steps(settings)),
        blocks(block_count(settings)),
        samples_of_block(block_samples(settings)),
        samples_of_last_block(recorded_samples(settings) - (blocks - 1) * samples_of_block),
        heat_flux(needs_heat_flux(settings)),
        wanted_of_samples(names_in_pairs(settings, "potential_energy") ? pairs::Wanted::everything
                                                                       : pairs::Wanted::stress),
        correlators(settings) {
    const double preparation = preparation_time(point);
    preparation_steps = cases::preparation_steps(point);
    preparation_step = preparation_steps > 0 ? preparation / static_cast<double>(preparation_steps) : 0.0;
    preparation_intervals = cases::preparation_intervals(point);
    rest_intervals = equilibration_intervals(point);
    record.sample_interval = static_cast<double>(steps_per_sample) * point.step;
    record.interval = static_cast<double>(steps_per_interval) * point.step;
    if (point.diffusion) velocities.resize(2 * static_cast<std::size_t>(point.particles));
    if (preparation_intervals > 0) {
      make_sheared();
    } else {
      make_resting();
    }
  }

  void make_sheared() {
    motion::Shear shear;
    shear.strain_rate = preparation_rate;
    shear.thermostat = motion::Thermostat::isoenergetic;
    motion::Watch watch;
    watch.energy_tolerance = point.energy_tolerance;
    trajectory.emplace(kernel, start, shear, motion::Integrator::runge_kutta_4, watch, team, point.reading);
  }

  void make_resting() {
    motion::Shear shear;
    shear.thermostat = motion::Thermostat::none;
    motion::Watch watch;
    watch.energy_tolerance = point.energy_tolerance;
    watch.rescale = false;
    watch.energy_band = std::numeric_limits<double>::infinity();  // watch_energy() knows better
    trajectory.emplace(kernel, start, shear, point.integrator, watch, team, point.reading);
  }

  /// From shear to rest: the same positions and momenta in a box whose images stand straight.
  void come_to_rest() {
    const std::vector<double> positions = trajectory->positions();
    const std::vector<double> momenta = trajectory->momenta();
    for (std::size_t i = 0; i < start.position.size(); ++i) {
      for (std::size_t d = 0; d < 2; ++d) {
        start.position[i][d] = positions[2 * i + d];
        start.momentum[i][d] = momenta[2 * i + d];
      }
    }
    subdivided_before = trajectory->report().subdivided_steps;
    make_resting();
  }

  bool recording() const { return done >= preparation_intervals + rest_intervals; }

  void prepare() {
    const std::int64_t first = done * steps_per_interval;
    const std::int64_t last = std::min(first + steps_per_interval, preparation_steps);
    try {
      trajectory->renew_list(preparation_step);
      for (std::int64_t step = first; step < last; ++step) trajectory->advance(preparation_step);
    } catch (const RunFailed& failure) {
      throw RunFailed(
          fmt::format("while it was sheared in preparation, {} (run.preparation = 0 leaves that out)", failure.what()));
    }
    if (last == preparation_steps) come_to_rest();
  }

  BlockCorrelators::Sample sample() {
    const double volume = trajectory->volume();
    const auto& kinetic = trajectory->kinetic();
    const auto& pair = trajectory->pair_totals();
    BlockCorrelators::Sample values{};
    values[sampled("pxy_kinetic")] = kinetic.momentum_flux(0, 1) / volume;
    values[sampled("pxy_potential")] = pair.virial(0, 1) / volume;
    values[sampled("pxx_kinetic")] = kinetic.momentum_flux(0, 0) / volume;
    values[sampled("pxx_potential")] = pair.virial(0, 0) / volume;
    values[sampled("pyy_kinetic")] = kinetic.momentum_flux(1, 1) / volume;
    values[sampled("pyy_potential")] = pair.virial(1, 1) / volume;
    values[sampled("pxy")] = values[sampled("pxy_kinetic")] + values[sampled("pxy_potential")];
    const double pxx = values[sampled("pxx_kinetic")] + values[sampled("pxx_potential")];
    const double pyy = values[sampled("pyy_kinetic")] + values[sampled("pyy_potential")];
    values[sampled("stress_difference")] = 0.5 * (pxx - pyy);
    values[sampled("pressure")] = 0.5 * (pxx + pyy);
    const auto n = static_cast<double>(point.particles);
    values[sampled("kinetic_temperature")] = kinetic.kinetic_energy() / (n - 1.0);
    values[sampled("potential_energy")] = pair.potential_energy / n;
    if (heat_flux) {
      const md::HeatFlux<2> flux = trajectory->heat_flux();
      for (int d = 0; d < 2; ++d) values[sampled("heat_flux_x") + static_cast<std::size_t>(d)] = flux.total(d) / volume;
    }
    return values;
  }

  EquilibriumSample observe() const {
    const auto n = static_cast<double>(point.particles);
    const auto& kinetic = trajectory->kinetic();
    const auto& pair = trajectory->pair_totals();
    return {kinetic.kinetic_energy() / (n - 1.0), 0.5 * kinetic.momentum_flux.trace() / trajectory->volume(),
            0.5 * pair.virial.trace() / trajectory->volume(), pair.potential_energy / n};
  }

  /// Against the energy that was asked for, from the end of the preparation on.
  void watch_energy() {
    const double energy = trajectory->energy() / static_cast<double>(point.particles);
    const double error = energy - point.energy_per_particle;
    if (!(std::abs(error) <= point.energy_band)) {
      throw RunFailed(fmt::format(
          "at time {:.6g} the energy per particle is {:.6g}, outside the band of run.energy_band = {} about "
          "system.energy_per_particle = {}; use a smaller run.step than {}",
          trajectory->time(), energy, point.energy_band, point.energy_per_particle, point.step));
    }
    if (!recording()) return;
    if (record.samples.empty()) energy_at_start = energy;
    record.energy_drift = energy - energy_at_start;
    record.largest_energy_error = std::max(record.largest_energy_error, std::abs(error));
  }

  void run_at_rest() {
    trajectory->renew_list(point.step);
    for (std::int64_t step = 1; step <= steps_per_interval; ++step) {
      const bool sampled_now = recording() && step % steps_per_sample == 0;
      // The energy is looked at once an interval: a whole state is what a checkpoint holds, and what recording begins
      // with.
      const auto wanted = step == steps_per_interval ? pairs::Wanted::everything
                          : sampled_now              ? wanted_of_samples
                                                     : pairs::Wanted::shear_stress;
      trajectory->advance(point.step, wanted);
      if (sampled_now) take_sample();
    }
    watch_energy();
    if (!recording()) return;
    record.samples.push_back(observe());
  }

  void take_sample() {
    const BlockCorrelators::Sample values = sample();
    if (point.diffusion) trajectory->copy_momenta(velocities);
    correlators.add(values, velocities);
    if (point.series) {
      StressSample& kept = series.emplace_back();
      std::copy_n(values.begin(), kept.size(), kept.begin());
    }
    const bool last = static_cast<std::int64_t>(record.blocks.size()) + 1 == blocks;
    if (correlators.samples() == (last ? samples_of_last_block : samples_of_block)) {
      record.blocks.push_back(correlators.result());
      correlators = BlockCorrelators(point);
    }
  }

  GreenKuboPoint point;
  Team team;
  kernel::Lucy<2> kernel;
  motion::Start<2> start;
  std::int64_t steps_per_sample;
  std::int64_t steps_per_interval;
  std::int64_t blocks;
  std::int64_t samples_of_block;
  std::int64_t samples_of_last_block;
  std::int64_t preparation_steps = 0;
  double preparation_step = 0.0;
  std::int64_t preparation_intervals = 0;
  std::int64_t rest_intervals = 0;
  std::int64_t done = 0;
  std::int64_t subdivided_before = 0;
  double energy_at_start = 0.0;
  bool heat_flux;
  pairs::Wanted wanted_of_samples;
  std::optional<Trajectory> trajectory;
  std::vector<double> velocities;
  BlockCorrelators correlators;
  GreenKuboRecord record;
  std::vector<StressSample> series;
};

GreenKuboRun::GreenKuboRun(const GreenKuboPoint& point, int replica, int threads)
    : self_(std::make_unique<Implementation>(point, replica, threads)) {}
GreenKuboRun::~GreenKuboRun() = default;
GreenKuboRun::GreenKuboRun(GreenKuboRun&&) noexcept = default;
GreenKuboRun& GreenKuboRun::operator=(GreenKuboRun&&) noexcept = default;

void GreenKuboRun::advance_one_interval() {
  Implementation& self = *self_;
  if (self.done < self.preparation_intervals) {
    self.prepare();
  } else {
    self.run_at_rest();
  }
  ++self.done;
  self.record.steps = std::min(self.done * self.steps_per_interval, self.preparation_steps) +
                      std::max<std::int64_t>(0, self.done - self.preparation_intervals) * self.steps_per_interval;
  self.record.subdivided_steps = self.subdivided_before + self.trajectory->report().subdivided_steps;
}

std::int64_t GreenKuboRun::intervals_done() const { return self_->done; }

std::int64_t GreenKuboRun::intervals_needed() const { return interval_count(self_->point); }

const GreenKuboRecord& GreenKuboRun::record() const { return self_->record; }

const std::vector<StressSample>& GreenKuboRun::series() const { return self_->series; }

std::int64_t GreenKuboRun::first_recorded_step() const { return self_->rest_intervals * self_->steps_per_interval; }

Frame GreenKuboRun::frame() const {
  const Implementation& self = *self_;
  const auto box = self.trajectory->box();
  Frame frame;
  frame.step = (self.done - self.preparation_intervals) * self.steps_per_interval;
  frame.time = static_cast<double>(frame.step) * self.point.step;
  frame.offset = box.offset();
  frame.box = box.lengths();
  frame.position = self.trajectory->positions();
  frame.momentum = self.trajectory->momenta();
  return frame;
}

bool GreenKuboRun::frame_due() const {
  const Implementation& self = *self_;
  if (self.point.frame_interval <= 0.0 || !self.recording()) return false;
  const auto between = std::llround(self.point.frame_interval / self.record.interval);
  return (self.done - self.preparation_intervals - self.rest_intervals) % between == 0;
}

void GreenKuboRun::save(ArchiveWriter& archive) const {
  const Implementation& self = *self_;
  archive.put(self.done);
  archive.put(self.subdivided_before);
  archive.put(self.energy_at_start);
  archive.put_sequence(self.record.samples);
  archive.put(self.record.blocks.size());
  for (const auto& block : self.record.blocks) save_block(archive, block);
  archive.put_sequence(self.series);
  archive.put(self.record.energy_drift);
  archive.put(self.record.largest_energy_error);
  archive.put(self.record.steps);
  archive.put(self.record.subdivided_steps);
  self.correlators.save(archive);
  self.trajectory->save(archive);
}

void GreenKuboRun::load(ArchiveReader& archive) {
  Implementation& self = *self_;
  self.done = archive.get<std::int64_t>();
  self.subdivided_before = archive.get<std::int64_t>();
  self.energy_at_start = archive.get<double>();
  archive.get_sequence(self.record.samples);
  const auto blocks = archive.get<std::size_t>();
  self.record.blocks.clear();
  for (std::size_t i = 0; i < blocks; ++i) self.record.blocks.push_back(load_block(archive));
  archive.get_sequence(self.series);
  self.record.energy_drift = archive.get<double>();
  self.record.largest_energy_error = archive.get<double>();
  self.record.steps = archive.get<std::int64_t>();
  self.record.subdivided_steps = archive.get<std::int64_t>();
  self.correlators.load(archive);
  if (self.done < self.preparation_intervals) {
    self.make_sheared();
  } else {
    self.make_resting();
  }
  self.trajectory->load(archive);
}

}  // namespace lucy::cases
