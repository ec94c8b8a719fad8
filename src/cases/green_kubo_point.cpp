// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cases/green_kubo_schedule.hpp"
#include "lucy/cases/green_kubo.hpp"
#include "lucy/errors.hpp"
#include "lucy/kernel/lucy.hpp"
#include "lucy/motion/start.hpp"

namespace lucy::cases {

namespace {

constexpr double longest_sample_interval = 0.2;  // at E = N/2 part of the stress is forgotten by t = 2
constexpr double longest_length = 400.0;
constexpr double length_of_duration = 0.2;
constexpr double least_block_in_lengths = 2.5;
constexpr std::int64_t most_blocks = 16;
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

}  // namespace

std::int64_t steps_per_sample(const GreenKuboPoint& point) {
  const double interval = point.sample_interval > 0.0 ? point.sample_interval
                                                      : std::min(longest_sample_interval, 0.5 * stress_memory(point));
  // What was asked for is a whole number of steps but for rounding; what was not is the most that fits.
  const double steps = interval / point.step;
  return std::max<std::int64_t>(
      1, point.sample_interval > 0.0 ? std::llround(steps) : static_cast<std::int64_t>(steps * (1.0 + 1e-9)));
}

std::int64_t recorded_intervals(const GreenKuboPoint& point) {
  const double interval = sample_interval(point) * static_cast<double>(samples_per_interval(point));
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(point.duration / interval - 1e-6)));
}

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

bool names_in_pairs(const GreenKuboPoint& point, std::string_view name) {
  return std::any_of(point.pairs.begin(), point.pairs.end(), [&](const std::string& pair) {
    const auto [a, b] = parse_pair(pair);
    return sampled_quantities[a] == name || sampled_quantities[b] == name;
  });
}

bool needs_heat_flux(const GreenKuboPoint& point) {
  return point.thermal_conductivity || names_in_pairs(point, "heat_flux_x") || names_in_pairs(point, "heat_flux_y");
}

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

}  // namespace lucy::cases
