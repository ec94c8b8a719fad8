// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/green_kubo_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "cases/green_kubo_estimates.hpp"
#include "lucy/errors.hpp"

namespace lucy::cases {

namespace {

using statistics::Estimate;
using Numbers = std::vector<double>;

constexpr double largest_mean = 4.0;             // of a stress that should have none, in its errors
constexpr double longest_series_length = 400.0;  // of a series sampled elsewhere
constexpr double length_of_series = 0.2;
constexpr double series_block_in_lengths = 2.5;
constexpr std::int64_t most_series_blocks = 16;

GreenKuboRow empty_row() {
  GreenKuboRow row;
  row.energy_per_particle = not_a_number;
  row.estimates.fill(unknown);
  for (double* const each : {&row.spectrum_z, &row.cutoff, &row.self_diffusion_cutoff, &row.thermal_conductivity_cutoff,
                             &row.decay_begin, &row.decay_end, &row.spectrum_frequency, &row.spectrum_p_value,
                             &row.step, &row.energy_drift, &row.largest_energy_error})
    *each = not_a_number;
  return row;
}

GreenKuboRow row_head(const GreenKuboPoint& point, double duration, int replicas) {
  GreenKuboRow row = empty_row();
  row.energy_per_particle = point.energy_per_particle;
  row.particles = point.particles;
  row.step = point.step;
  row.sample_interval = sample_interval(point);
  row.duration = duration;
  row.replicas = replicas;
  return row;
}

/// Whether the viscosity is to be believed, once all estimates are there.
void conclude(const State& state, GreenKuboRow& row) {
  const bool long_enough = row.duration >= least_duration_in_cutoffs * row.cutoff;
  const bool chosen = state.cutoff > 0.0 || !std::isnan(row.estimates[green_kubo_quantity("decay_time")].value);
  const bool with_error = !std::isnan(row.estimates[green_kubo_quantity("viscosity")].error);
  row.status = long_enough && chosen && with_error ? RowStatus::ok : RowStatus::too_short;
  if (row.duration < least_duration_in_cutoffs * row.cutoff) {
    row.warnings.push_back(fmt::format("A recording of {:.6g} holds less than {:.0f} cut-offs of {:.4g}: lengthen {}.",
                                       row.duration, least_duration_in_cutoffs, row.cutoff, state.duration_key));
  }
}

Blocks blocks_of(std::span<const GreenKuboRecord> replicas) {
  Blocks blocks;
  for (const GreenKuboRecord& record : replicas)
    for (const CorrelationBlock& block : record.blocks) blocks.push_back(&block);
  return blocks;
}

/// Mean of what `of` makes of the equilibrium samples.
template <class Quantity>
Estimate equilibrium_mean(std::span<const GreenKuboRecord> replicas, Quantity of) {
  std::vector<Numbers> series;
  for (const GreenKuboRecord& record : replicas) {
    Numbers& values = series.emplace_back();
    for (const EquilibriumSample& sample : record.samples) values.push_back(of(sample));
  }
  return statistics::pooled_mean(series);
}

/// The recorded time of the shortest replica; what was asked for, where they agree but for rounding.
double recorded_time(const GreenKuboPoint& point, std::span<const GreenKuboRecord> replicas) {
  if (replicas.empty()) return point.duration;
  double shortest = std::numeric_limits<double>::infinity();
  for (const GreenKuboRecord& record : replicas)
    shortest = std::min(shortest, record.interval * static_cast<double>(record.samples.size()));
  return std::abs(shortest - point.duration) > 1e-6 * point.duration ? shortest : point.duration;
}

State state_of(const GreenKuboPoint& point, std::span<const GreenKuboRecord> replicas) {
  State state;
  state.volume = static_cast<double>(point.particles) / point.density;
  state.temperature = equilibrium_mean(replicas, [](const EquilibriumSample& sample) { return sample[0]; });
  state.sample_interval = sample_interval(point);
  state.cutoff = point.cutoff;
  state.duration = recorded_time(point, replicas);
  return state;
}

}  // namespace

GreenKuboResult summarize(const GreenKuboPoint& point, std::span<const GreenKuboRecord> replicas) {
  const State state = state_of(point, replicas);
  GreenKuboResult result;
  GreenKuboRow& row = result.row;
  row = row_head(point, state.duration, static_cast<int>(replicas.size()));
  const Blocks blocks = blocks_of(replicas);
  row.blocks = static_cast<int>(blocks.size());
  if (!replicas.empty()) row.energy_drift = row.largest_energy_error = 0.0;
  for (const GreenKuboRecord& record : replicas) {
    if (std::abs(record.energy_drift) > std::abs(row.energy_drift)) row.energy_drift = record.energy_drift;
    row.largest_energy_error = std::max(row.largest_energy_error, record.largest_energy_error);
  }
  for (std::size_t i = 0; i < equilibrium_observables.size(); ++i) {
    const auto place =
        std::find(green_kubo_quantities.begin(), green_kubo_quantities.end(), equilibrium_observables[i]);
    row.estimates[static_cast<std::size_t>(place - green_kubo_quantities.begin())] =
        equilibrium_mean(replicas, [i](const EquilibriumSample& sample) { return sample[i]; });
  }
  row.estimates[green_kubo_quantity("pressure")] =
      equilibrium_mean(replicas, [](const EquilibriumSample& sample) { return sample[1] + sample[2]; });
  if (blocks.empty()) {
    row.warnings.push_back(fmt::format("No block of correlations is complete after {:.6g}: lengthen {} or shorten {}.",
                                       state.duration, state.duration_key, state.length_key));
  } else {
    estimate_from_stress(blocks, state, result);
    estimate_others(point, blocks, state, result);
  }
  conclude(state, row);
  return result;
}

GreenKuboRow failed_row(const GreenKuboPoint& point, std::string message) {
  GreenKuboRow row = row_head(point, point.duration, point.replicas);
  row.status = RowStatus::failed;
  row.failure = std::move(message);
  return row;
}

Estimate current_viscosity(const GreenKuboPoint& point, std::span<const GreenKuboRecord> replicas) {
  const Blocks blocks = blocks_of(replicas);
  if (blocks.size() < 2) return unknown;
  return estimate_viscosity(blocks, state_of(point, replicas));
}

GreenKuboResult summarize_series(const SampledSeries& series) {
  const std::size_t samples = series.pxy.size();
  if (samples == 0) throw BadInput("the stress series is empty");
  if (series.stress_difference.size() != samples) {
    throw BadInput(
        fmt::format("the series of P_xy has {} values and that of (P_xx - P_yy)/2 has {}: they must be as many",
                    samples, series.stress_difference.size()));
  }
  const auto above_zero = [](std::string_view name, double value) {
    if (!(value > 0.0) || !std::isfinite(value))
      throw BadInput(fmt::format("the {} of the stress series is {}, and must be {}", name, value,
                                 value > 0.0 ? "finite" : "above 0"));
  };
  for (const auto& [name, values] :
       {std::pair("P_xy", &series.pxy), std::pair("(P_xx - P_yy)/2", &series.stress_difference)})
    if (samples > 1 && values->front() != 0.0 && std::ranges::count(*values, values->front()) == std::ssize(*values))
      throw BadInput(
          fmt::format("{} of the stress series is {} in every sample: it does not fluctuate", name, values->front()));
  above_zero("sample interval", series.sample_interval);
  above_zero("volume", series.volume);
  above_zero("kinetic temperature", series.kinetic_temperature);
  State state;
  state.duration = static_cast<double>(samples) * series.sample_interval;
  const auto within = [&](std::string_view name, double value, double longest) {
    if (!(value >= 0.0) || value > longest)
      throw BadInput(fmt::format("the {} of the correlation of the stress series is {}, and must lie from 0 to {}",
                                 name, value, longest));
  };
  within("length", series.length, state.duration);
  const double length =
      series.length > 0.0 ? series.length : std::min(longest_series_length, length_of_series * state.duration);
  within("cut-off", series.cutoff, length);
  if (series.length > 0.0 && length < series.sample_interval)
    throw BadInput(
        fmt::format("the length of the correlation of the stress series is {}, less than the interval between "
                    "samples, {}",
                    length, series.sample_interval));
  const auto lags = static_cast<std::size_t>(length / series.sample_interval * (1.0 + 1e-9)) + 1;
  const auto blocks = std::clamp<std::int64_t>(
      static_cast<std::int64_t>(state.duration / (series_block_in_lengths * length)), 1, most_series_blocks);
  const std::vector<CorrelationBlock> correlated =
      correlate_series(series.pxy, series.stress_difference, std::min(lags, samples), blocks);

  state.volume = series.volume;
  state.temperature = {series.kinetic_temperature, 0.0, not_a_number, 0};
  state.sample_interval = series.sample_interval;
  state.cutoff = series.cutoff;
  state.length_key = "--length";
  state.interval_key = "the interval between samples";
  state.duration_key = "the series";
  GreenKuboResult result;
  result.row = empty_row();
  result.row.sample_interval = series.sample_interval;
  result.row.duration = state.duration;
  result.row.replicas = 1;
  result.row.blocks = static_cast<int>(correlated.size());
  result.row.estimates[green_kubo_quantity("kinetic_temperature")] = state.temperature;
  const auto look_at_mean = [&](std::string_view name, const Numbers& values) {
    const Estimate mean = statistics::pooled_mean(std::span(&values, 1));
    if (!(std::abs(mean.value) > largest_mean * mean.error)) return;
    result.row.warnings.push_back(fmt::format(
        "The mean of {} is {:.4g}, {:.1f} of its standard errors from zero: at equilibrium it has none, and "
        "here its square is integrated too.",
        name, mean.value, std::abs(mean.value) / mean.error));
  };
  look_at_mean("P_xy", series.pxy);
  look_at_mean("(P_xx - P_yy)/2", series.stress_difference);
  Blocks pointers;
  for (const CorrelationBlock& block : correlated) pointers.push_back(&block);
  estimate_from_stress(pointers, state, result);
  conclude(state, result.row);
  return result;
}

}  // namespace lucy::cases
