// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/green_kubo.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <variant>

#include "lucy/errors.hpp"
#include "lucy/motion/trajectory.hpp"

namespace lucy::cases {

namespace {

constexpr double longest_sample_interval = 0.2;  // at E = N/2 part of the stress is forgotten by t = 2
constexpr double longest_length = 400.0;
constexpr double length_of_duration = 0.2;
constexpr double least_block_in_lengths = 2.5;
constexpr std::int64_t most_blocks = 16;
constexpr std::int64_t most_segment = 32768;  // samples in one spectrum
constexpr double usual_interval = 2.0;
constexpr double most_samples = 1e14;
constexpr double longest_correlation = 1e8;  // samples
constexpr std::int64_t fewest_intervals = 10;

/// The same state as a Couette point at rest: what they share is checked and seeded in one place.
CouettePoint at_rest(const GreenKuboPoint& point) {
  CouettePoint rest;
  rest.particles = point.particles;
  rest.energy_per_particle = point.energy_per_particle;
  rest.density = point.density;
  rest.dimension = point.dimension;
  rest.reading = point.reading;
  rest.kernel = point.kernel;
  rest.range = point.range;
  rest.thermostat = motion::Thermostat::none;
  rest.integrator = point.integrator;
  rest.step = point.step;
  rest.equilibration = point.equilibration;
  rest.duration = point.duration;
  rest.replicas = point.replicas;
  rest.seed = point.seed;
  rest.energy_tolerance = point.energy_tolerance;
  rest.sample_interval = point.sample_interval;
  rest.frame_interval = point.frame_interval;
  return rest;
}

/// The time in which a thermal particle crosses a quarter of the range: stresses are forgotten no faster.
double stress_memory(const GreenKuboPoint& point) {
  const kernel::Lucy<2> kernel(point.range);
  const double temperature = point.energy_per_particle - motion::lattice_energy(kernel, point.density);
  return 0.25 * point.range / std::sqrt(2.0 * temperature);
}

std::int64_t steps_per_sample(const GreenKuboPoint& point) {
  const double interval = point.sample_interval > 0.0 ? point.sample_interval
                                                      : std::min(longest_sample_interval, 0.5 * stress_memory(point));
  // What was asked for is a whole number of steps but for rounding; what was not is the most that fits.
  const double steps = interval / point.step;
  return std::max<std::int64_t>(
      1, point.sample_interval > 0.0 ? std::llround(steps) : static_cast<std::int64_t>(steps * (1.0 + 1e-9)));
}

std::int64_t samples_per_interval(const GreenKuboPoint& point) {
  const double sample = static_cast<double>(steps_per_sample(point)) * point.step;
  const auto most = static_cast<std::int64_t>(point.duration / sample) / fewest_intervals;
  auto samples = std::clamp<std::int64_t>(std::llround(usual_interval / sample), 1, std::max<std::int64_t>(1, most));
  if (point.frame_interval > 0.0) {
    // Frames fall on the ends of intervals.
    const auto between = std::max<std::int64_t>(1, std::llround(point.frame_interval / sample));
    samples = std::min(samples, between);
    while (between % samples != 0) --samples;
  }
  return samples;
}

std::int64_t recorded_intervals(const GreenKuboPoint& point) {
  const double interval = sample_interval(point) * static_cast<double>(samples_per_interval(point));
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(point.duration / interval - 1e-6)));
}

/// The sheared time that is nearest to `preparation`: through a whole number of box lengths, so that the images stand
/// straight again.
double preparation_time(const GreenKuboPoint& point) {
  const auto sites = motion::near_square(point.particles);
  const double turn = static_cast<double>((*sites)[0]) / (preparation_rate * static_cast<double>((*sites)[1]));
  return turn * std::round(point.preparation / turn);
}

std::int64_t preparation_steps(const GreenKuboPoint& point) {
  return static_cast<std::int64_t>(std::ceil(preparation_time(point) / point.step * (1.0 - 1e-9)));
}

std::int64_t preparation_intervals(const GreenKuboPoint& point) {
  const std::int64_t steps = interval_steps(point);
  return (preparation_steps(point) + steps - 1) / steps;
}

std::int64_t equilibration_intervals(const GreenKuboPoint& point) {
  const double interval = static_cast<double>(interval_steps(point)) * point.step;
  return static_cast<std::int64_t>(std::ceil(point.equilibration / interval - 1e-6));
}

std::int64_t recorded_samples(const GreenKuboPoint& point) {
  return recorded_intervals(point) * samples_per_interval(point);
}

consteval std::size_t sampled(std::string_view name) {
  for (std::size_t i = 0; i < sampled_quantities.size(); ++i)
    if (sampled_quantities[i] == name) return i;
  throw "no such quantity";
}

bool names_in_pairs(const GreenKuboPoint& point, std::string_view name) {
  return std::any_of(point.pairs.begin(), point.pairs.end(), [&](const std::string& pair) {
    const auto [a, b] = parse_pair(pair);
    return sampled_quantities[a] == name || sampled_quantities[b] == name;
  });
}

bool needs_heat_flux(const GreenKuboPoint& point) {
  return point.thermal_conductivity || names_in_pairs(point, "heat_flux_x") || names_in_pairs(point, "heat_flux_y");
}

/// Without the lags beyond `longest`, which the last level of a multiple-tau correlator reaches.
measure::Correlation cut_at(measure::Correlation correlation, double longest) {
  const auto end = std::upper_bound(correlation.lag.begin(), correlation.lag.end(), longest);
  const auto kept = static_cast<std::size_t>(end - correlation.lag.begin());
  for (auto* values : {&correlation.lag, &correlation.value, &correlation.mean_a, &correlation.mean_b})
    values->resize(std::min(values->size(), kept));
  correlation.pairs.resize(kept);
  return correlation;
}

/// Either correlator, for a pair of numbers.
class PairCorrelator {
 public:
  PairCorrelator(CorrelationMethod method, std::size_t lags) : longest_lag_(static_cast<double>(lags - 1)) {
    if (method == CorrelationMethod::fft) {
      correlator_.emplace<measure::FftCorrelator>(lags);
    } else {
      measure::MultipleTauCorrelator::Settings settings;
      settings.longest_lag = longest_lag_;
      correlator_.emplace<measure::MultipleTauCorrelator>(settings);
    }
  }

  void add(double a, double b) {
    std::visit([&](auto& correlator) { correlator.add(a, b); }, correlator_);
  }
  void add(double a) { add(a, a); }
  measure::Correlation result() const {
    return std::visit([&](const auto& correlator) { return cut_at(correlator.result(), longest_lag_); }, correlator_);
  }
  /// Of quantities whose mean is zero: nobody asks for it.
  measure::Correlation result_without_means() const {
    measure::Correlation correlation = result();
    correlation.mean_a.clear();
    correlation.mean_b.clear();
    return correlation;
  }
  void save(ArchiveWriter& archive) const {
    std::visit([&](const auto& correlator) { correlator.save(archive); }, correlator_);
  }
  void load(ArchiveReader& archive) {
    std::visit([&](auto& correlator) { correlator.load(archive); }, correlator_);
  }

 private:
  double longest_lag_;
  std::variant<measure::FftCorrelator, measure::MultipleTauCorrelator> correlator_{measure::FftCorrelator(1)};
};

/// Everything that one block is made of, while samples come in.
class BlockCorrelators {
 public:
  explicit BlockCorrelators(const GreenKuboPoint& point)
      : particles_(static_cast<double>(point.particles)),
        longest_lag_(static_cast<double>(lag_count(point) - 1)),
        reverse_noise_(point.method, lag_count(point)),
        spectrum_xy_(segment_samples(point)),
        spectrum_difference_(segment_samples(point)) {
    const std::size_t lags = lag_count(point);
    for (std::size_t i = 0; i < stress_correlations; ++i) stress_.emplace_back(point.method, lags);
    if (point.diffusion) {
      measure::MultipleTauCorrelator::Settings settings;
      settings.components = 2 * static_cast<std::size_t>(point.particles);
      settings.longest_lag = static_cast<double>(lags - 1);
      velocity_.emplace(settings);
    }
    if (point.thermal_conductivity)
      for (std::size_t d = 0; d < 2; ++d) heat_.emplace_back(point.method, lags);
    for (const std::string& pair : point.pairs) {
      pairs_.push_back(parse_pair(pair));
      others_.emplace_back(point.method, lags);
    }
  }

  using Sample = std::array<double, sampled_quantities.size()>;

  /// `velocities` is looked at only for diffusion.
  void add(const Sample& sample, std::span<const double> velocities) {
    const double difference_kinetic = 0.5 * (sample[sampled("pxx_kinetic")] - sample[sampled("pyy_kinetic")]);
    const double difference_potential = 0.5 * (sample[sampled("pxx_potential")] - sample[sampled("pyy_potential")]);
    const double pxy = sample[sampled("pxy")];
    const double stress_difference = sample[sampled("stress_difference")];
    stress_[StressCorrelation::xy].add(pxy);
    stress_[StressCorrelation::xy_kinetic].add(sample[sampled("pxy_kinetic")]);
    stress_[StressCorrelation::xy_potential].add(sample[sampled("pxy_potential")]);
    stress_[StressCorrelation::difference].add(stress_difference);
    stress_[StressCorrelation::difference_kinetic].add(difference_kinetic);
    stress_[StressCorrelation::difference_potential].add(difference_potential);
    stress_[StressCorrelation::pure_noise].add(pxy, stress_difference);
    reverse_noise_.add(stress_difference, pxy);
    spectrum_xy_.add(pxy);
    spectrum_difference_.add(stress_difference);
    if (velocity_) velocity_->add(velocities);
    for (std::size_t d = 0; d < heat_.size(); ++d) heat_[d].add(sample[sampled("heat_flux_x") + d]);
    for (std::size_t i = 0; i < pairs_.size(); ++i) others_[i].add(sample[pairs_[i][0]], sample[pairs_[i][1]]);
    ++samples_;
  }

  std::int64_t samples() const { return samples_; }

  CorrelationBlock result() const {
    CorrelationBlock block;
    block.samples = samples_;
    for (std::size_t i = 0; i < stress_correlations; ++i) block.stress[i] = stress_[i].result_without_means();
    block.stress[StressCorrelation::pure_noise] =
        mean_correlation(block.stress[StressCorrelation::pure_noise], reverse_noise_.result());
    block.spectrum = mean_spectrum(spectrum_xy_.result(), spectrum_difference_.result());
    if (velocity_) {
      block.others.push_back(cut_at(velocity_->result(), longest_lag_));
      for (double& value : block.others.back().value) value *= 0.5 / particles_;
    }
    if (!heat_.empty()) {
      block.others.push_back(mean_correlation(heat_[0].result_without_means(), heat_[1].result()));
    }
    for (const auto& correlator : others_) block.others.push_back(correlator.result());
    return block;
  }

  void save(ArchiveWriter& archive) const {
    archive.put(samples_);
    for_all([&](const auto& accumulator) { accumulator.save(archive); }, *this);
  }

  void load(ArchiveReader& archive) {
    samples_ = archive.get<std::int64_t>();
    for_all([&](auto& accumulator) { accumulator.load(archive); }, *this);
  }

  static measure::Correlation mean_correlation(measure::Correlation a, const measure::Correlation& b) {
    for (std::size_t k = 0; k < a.value.size(); ++k) a.value[k] = 0.5 * (a.value[k] + b.value[k]);
    return a;
  }

  static measure::Spectrum mean_spectrum(measure::Spectrum a, const measure::Spectrum& b) {
    for (std::size_t k = 0; k < a.power.size(); ++k) a.power[k] = 0.5 * (a.power[k] + b.power[k]);
    return a;
  }

  static std::size_t segment_samples(std::int64_t block_samples) {
    const std::int64_t segments = (block_samples + most_segment - 1) / most_segment;
    return static_cast<std::size_t>(std::max<std::int64_t>(2, block_samples / std::max<std::int64_t>(1, segments)));
  }

 private:
  static std::size_t segment_samples(const GreenKuboPoint& point) { return segment_samples(block_samples(point)); }

  template <class Action, class Self>
  static void for_all(Action action, Self& self) {
    for (auto& accumulator : self.stress_) action(accumulator);
    action(self.reverse_noise_);
    action(self.spectrum_xy_);
    action(self.spectrum_difference_);
    if (self.velocity_) action(*self.velocity_);
    for (auto& accumulator : self.heat_) action(accumulator);
    for (auto& accumulator : self.others_) action(accumulator);
  }

  double particles_;
  double longest_lag_;
  std::int64_t samples_ = 0;
  std::vector<PairCorrelator> stress_;
  PairCorrelator reverse_noise_;
  measure::Periodogram spectrum_xy_;
  measure::Periodogram spectrum_difference_;
  std::optional<measure::MultipleTauCorrelator> velocity_;
  std::vector<PairCorrelator> heat_;
  std::vector<std::array<std::size_t, 2>> pairs_;
  std::vector<PairCorrelator> others_;
};

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

std::array<std::size_t, 2> parse_pair(std::string_view pair) {
  std::array<std::size_t, 2> places{};
  const auto refuse = [&](std::string_view why) {
    throw BadInput(fmt::format("correlation.pairs: \"{}\" {}; expected two names with a space between, of {}", pair,
                               why, fmt::join(sampled_quantities, ", ")));
  };
  const std::size_t space = pair.find(' ');
  if (space == std::string_view::npos) refuse("is not a pair");
  const std::array names = {pair.substr(0, space), pair.substr(space + 1)};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto found = std::find(sampled_quantities.begin(), sampled_quantities.end(), names[i]);
    if (found == sampled_quantities.end()) refuse(fmt::format("names '{}', which is not sampled", names[i]));
    places[i] = static_cast<std::size_t>(found - sampled_quantities.begin());
  }
  return places;
}

bool mean_is_zero(std::size_t quantity) {
  const std::string_view name = sampled_quantities[quantity];
  return name.starts_with("pxy") || name == "stress_difference" || name.starts_with("heat_flux");
}

double sample_interval(const GreenKuboPoint& point) {
  return static_cast<double>(steps_per_sample(point)) * point.step;
}

std::size_t lag_count(const GreenKuboPoint& point) {
  const double length =
      point.length > 0.0 ? point.length : std::min(longest_length, length_of_duration * point.duration);
  const auto lags = static_cast<std::int64_t>(length / sample_interval(point) * (1.0 + 1e-9)) + 1;
  return static_cast<std::size_t>(std::clamp<std::int64_t>(lags, 1, recorded_samples(point)));
}

std::int64_t block_count(const GreenKuboPoint& point) {
  const double least = least_block_in_lengths * static_cast<double>(lag_count(point));
  const double blocks = static_cast<double>(recorded_samples(point)) / least;
  return std::clamp<std::int64_t>(static_cast<std::int64_t>(blocks), 1, most_blocks);
}

std::int64_t block_samples(const GreenKuboPoint& point) { return recorded_samples(point) / block_count(point); }

std::int64_t interval_steps(const GreenKuboPoint& point) {
  return steps_per_sample(point) * samples_per_interval(point);
}

std::int64_t interval_count(const GreenKuboPoint& point) {
  return preparation_intervals(point) + equilibration_intervals(point) + recorded_intervals(point);
}

std::uint64_t replica_seed(const GreenKuboPoint& point, int replica) { return replica_seed(at_rest(point), replica); }

void validate(const GreenKuboPoint& point) {
  CouettePoint rest = at_rest(point);
  // Steps of the preparation count too.
  if (point.preparation > 0.0 && std::isfinite(point.preparation)) rest.equilibration += point.preparation;
  validate(rest);
  const auto refuse = [](const std::string& message) { throw BadInput(message); };
  const auto at_least_zero = [&](const char* key, double value) {
    if (!(value >= 0.0) || !std::isfinite(value)) refuse(fmt::format("{} = {} must be 0 or above", key, value));
  };
  at_least_zero("run.preparation", point.preparation);
  at_least_zero("correlation.length", point.length);
  at_least_zero("correlation.cutoff", point.cutoff);
  if (!(point.energy_band > 0.0) || !std::isfinite(point.energy_band))
    refuse(fmt::format("run.energy_band = {} must be above 0", point.energy_band));
  if (point.replicas < 1) refuse(fmt::format("run.replicas = {} must be at least 1", point.replicas));
  const double interval = sample_interval(point);
  if (point.frame_interval > 0.0) {
    rest.sample_interval = interval;
    rest.equilibration = 0.0;
    validate(rest);
  }
  if (static_cast<double>(recorded_samples(point)) > most_samples)
    refuse(fmt::format("run.duration = {} makes more than {} samples", point.duration, most_samples));
  const double memory = stress_memory(point);
  if (interval > memory * (1.0 + 1e-9)) {
    const char* key = point.sample_interval > 0.0 ? "output.sample_interval" : "run.step";
    refuse(fmt::format(
        "{} = {} must be at most {:.4f}, the time in which a thermal particle crosses a quarter of the range: "
        "the stress would be forgotten between two samples",
        key, point.sample_interval > 0.0 ? point.sample_interval : point.step, std::floor(1e4 * memory) / 1e4));
  }
  if (point.length > 0.0) {
    if (point.length > point.duration)
      refuse(fmt::format("correlation.length = {} must be at most run.duration = {}", point.length, point.duration));
    if (point.length < interval)
      refuse(
          fmt::format("correlation.length = {} must be at least the time between samples, {}", point.length, interval));
  }
  if (static_cast<double>(lag_count(point)) > longest_correlation)
    refuse(fmt::format("correlation.length = {} is more than {} samples", point.length, longest_correlation));
  const double longest = static_cast<double>(lag_count(point) - 1) * interval;
  if (point.cutoff > longest * (1.0 + 1e-9)) {
    refuse(
        fmt::format("correlation.cutoff = {} must be at most the longest time that is correlated, {} "
                    "(correlation.length)",
                    point.cutoff, longest));
  }
  for (const std::string& pair : point.pairs) parse_pair(pair);
}

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
        wanted_of_samples(names_in_pairs(settings, "potential_energy") ? md::Wanted::everything : md::Wanted::stress),
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
    trajectory.emplace(kernel, start, shear, motion::Integrator::runge_kutta_4, watch, team);
  }

  void make_resting() {
    motion::Shear shear;
    shear.thermostat = motion::Thermostat::none;
    motion::Watch watch;
    watch.energy_tolerance = point.energy_tolerance;
    watch.rescale = false;
    watch.energy_band = std::numeric_limits<double>::infinity();  // watch_energy() knows better
    trajectory.emplace(kernel, start, shear, point.integrator, watch, team);
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
      const auto wanted = step == steps_per_interval ? md::Wanted::everything
                          : sampled_now              ? wanted_of_samples
                                                     : md::Wanted::shear_stress;
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
  md::Wanted wanted_of_samples;
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

CouetteFrame GreenKuboRun::frame() const {
  const Implementation& self = *self_;
  const auto box = self.trajectory->box();
  CouetteFrame frame;
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

std::vector<CorrelationBlock> correlate_series(std::span<const double> pxy, std::span<const double> stress_difference,
                                               std::size_t lags, std::int64_t blocks) {
  std::vector<CorrelationBlock> results;
  const auto samples = static_cast<std::int64_t>(pxy.size());
  const std::int64_t usual = samples / blocks;
  for (std::int64_t number = 0; number < blocks; ++number) {
    const std::int64_t begin = number * usual;
    const std::int64_t end = number + 1 == blocks ? samples : begin + usual;
    measure::FftCorrelator correlate_xy(lags);
    measure::FftCorrelator correlate_difference(lags);
    measure::FftCorrelator correlate_noise(lags);
    measure::FftCorrelator correlate_reverse_noise(lags);
    measure::Periodogram spectrum_xy(BlockCorrelators::segment_samples(usual));
    measure::Periodogram spectrum_difference(BlockCorrelators::segment_samples(usual));
    for (std::int64_t i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      correlate_xy.add(pxy[at]);
      correlate_difference.add(stress_difference[at]);
      correlate_noise.add(pxy[at], stress_difference[at]);
      correlate_reverse_noise.add(stress_difference[at], pxy[at]);
      spectrum_xy.add(pxy[at]);
      spectrum_difference.add(stress_difference[at]);
    }
    CorrelationBlock block;
    block.samples = end - begin;
    block.stress[StressCorrelation::xy] = correlate_xy.result();
    block.stress[StressCorrelation::difference] = correlate_difference.result();
    block.stress[StressCorrelation::pure_noise] =
        BlockCorrelators::mean_correlation(correlate_noise.result(), correlate_reverse_noise.result());
    block.spectrum = BlockCorrelators::mean_spectrum(spectrum_xy.result(), spectrum_difference.result());
    results.push_back(std::move(block));
  }
  return results;
}

}  // namespace lucy::cases
