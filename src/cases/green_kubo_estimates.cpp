// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/green_kubo_estimates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "lucy/statistics/decay.hpp"
#include "lucy/statistics/jackknife.hpp"
#include "lucy/statistics/running_integral.hpp"
#include "lucy/statistics/spectrum_fit.hpp"

namespace lucy::cases {

namespace {

using statistics::Estimate;
using Numbers = std::vector<double>;

constexpr int fewest_degrees = 5;                   // of freedom, for an error by the jackknife alone
constexpr double least_first_lag = 0.5;             // of C(0), below which samples are too far apart
constexpr double least_spectrum_p_value = 0.001;    // below which the spectrum is called of another shape
constexpr std::size_t most_envelope_points = 4096;  // the envelope costs their square
constexpr double components = 2.0;                  // P_xy and (P_xx - P_yy)/2

/// The lags, in time, that all of these correlations begin with.
Numbers common_times(const std::vector<const measure::Correlation*>& correlations, double sample_interval) {
  if (correlations.empty()) return {};
  const Numbers& first = correlations.front()->lag;
  std::size_t common = first.size();
  for (const measure::Correlation* other : correlations) {
    const auto end = std::mismatch(first.begin(), first.end(), other->lag.begin(), other->lag.end()).first;
    common = std::min(common, static_cast<std::size_t>(end - first.begin()));
  }
  Numbers times(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(common));
  for (double& time : times) time *= sample_interval;
  return times;
}

/// Correlation functions of all blocks, each with its running integral: both are linear in the blocks, so that their
/// means and errors are one computation.
class BlockCurves {
 public:
  /// `blocks[b]` holds the correlation functions of block b one after another, each at all of `times`.
  BlockCurves(Numbers times, std::vector<Numbers> blocks, Numbers weights)
      : times_(std::move(times)), averages_(with_integrals(times_, std::move(blocks)), std::move(weights)) {}

  const Numbers& times() const { return times_; }
  std::size_t blocks() const { return averages_.blocks(); }

  /// The means over all blocks but one; over all of them for `blocks()`.
  Numbers without(std::size_t block) const {
    return block == blocks() ? averages_.mean() : averages_.mean_without(block);
  }
  Numbers errors() const { return averages_.errors(); }

  std::span<const double> correlation(const Numbers& numbers, std::size_t curve) const {
    return std::span(numbers).subspan(2 * curve * times_.size(), times_.size());
  }
  std::span<const double> integral(const Numbers& numbers, std::size_t curve) const {
    return std::span(numbers).subspan((2 * curve + 1) * times_.size(), times_.size());
  }
  double integral_to(const Numbers& numbers, std::size_t curve, double time) const {
    return statistics::value_at(times_, integral(numbers, curve), time);
  }

 private:
  static std::vector<Numbers> with_integrals(const Numbers& times, std::vector<Numbers> blocks) {
    for (Numbers& block : blocks) {
      Numbers both;
      both.reserve(2 * block.size());
      for (std::size_t begin = 0; begin < block.size(); begin += times.size()) {
        const std::span<const double> values = std::span(block).subspan(begin, times.size());
        const Numbers integral = statistics::running_integral(times, values);
        both.insert(both.end(), values.begin(), values.end());
        both.insert(both.end(), integral.begin(), integral.end());
      }
      block = std::move(both);
    }
    return blocks;
  }

  Numbers times_;
  statistics::BlockAverages averages_;
};

/// Where the integrals end, by the rule or as asked for.
struct Ending {
  statistics::ExponentialDecay decay;
  double cutoff = 0.0;
};

Ending ending_of(const BlockCurves& curves, const Numbers& numbers, std::size_t curve, double fixed_cutoff) {
  const auto decay = statistics::fit_decay(curves.times(), curves.correlation(numbers, curve));
  const double longest = curves.times().back();
  if (fixed_cutoff > 0.0) return {decay, std::min(fixed_cutoff, longest)};
  // Without a decay time there is no rule to follow: as far as is known, and that is told.
  return {decay, std::isnan(decay.time) ? longest : std::min(cutoff_in_decay_times * decay.time, longest)};
}

/// The same where one block is left out: chance there must not leave the whole without an error.
Ending ending_without(const BlockCurves& curves, const Numbers& numbers, std::size_t curve, double fixed_cutoff,
                      const Ending& of_all) {
  const Ending own = ending_of(curves, numbers, curve, fixed_cutoff);
  return std::isnan(own.decay.time) ? of_all : own;
}

/// The jackknife of several quantities at once: `values_of` makes them from the means over blocks and the ending.
template <class ValuesOf>
auto jackknife_of(const BlockCurves& curves, std::size_t curve, double fixed_cutoff, const Ending& of_all,
                  ValuesOf values_of) {
  const auto values = values_of(curves.without(curves.blocks()), of_all);
  std::array<Numbers, std::tuple_size_v<decltype(values)>> leaving_out{};
  if (curves.blocks() >= 2) {
    for (std::size_t b = 0; b < curves.blocks(); ++b) {
      const Numbers numbers = curves.without(b);
      const auto each = values_of(numbers, ending_without(curves, numbers, curve, fixed_cutoff, of_all));
      for (std::size_t q = 0; q < each.size(); ++q) leaving_out[q].push_back(each[q]);
    }
  }
  std::array<Estimate, std::tuple_size_v<decltype(values)>> estimates;
  for (std::size_t q = 0; q < estimates.size(); ++q) estimates[q] = statistics::jackknife(values[q], leaving_out[q]);
  return std::pair(estimates, leaving_out);
}

/// An estimate in other units; the unit has an error of its own.
Estimate scaled(Estimate estimate, double factor, double relative_error = 0.0) {
  estimate.value *= factor;
  estimate.error = std::hypot(estimate.error * factor, estimate.value * relative_error);
  return estimate;
}

Curve scaled_curve(std::span<const double> values, std::span<const double> errors, double factor) {
  Curve curve;
  if (values.empty() || std::isnan(values.back())) return curve;
  for (const double value : values) curve.value.push_back(factor * value);
  for (const double error : errors) curve.error.push_back(factor * error);
  return curve;
}

/// One standard deviation of the running integral of pure noise of correlation function C (statistics::noise_envelope),
/// where lags may be unequally spaced.
Numbers envelope(const Numbers& times, std::span<const double> values, double total_time) {
  if (times.size() < 2) return Numbers(times.size(), 0.0);
  const double longest = times.back() - times.front();
  const auto most = static_cast<double>(most_envelope_points - 1);
  const auto intervals = static_cast<std::size_t>(std::round(std::min(most, longest / (times[1] - times[0]))));
  Numbers grid(intervals + 1), on_grid(intervals + 1);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    grid[i] = std::min(times.back(), longest * static_cast<double>(i) / static_cast<double>(intervals));
    on_grid[i] = statistics::value_at(times, values, grid[i]);
  }
  const Numbers of_grid = statistics::noise_envelope(grid, on_grid, total_time);
  Numbers result;
  for (const double time : times) result.push_back(statistics::value_at(grid, of_grid, std::min(time, grid.back())));
  return result;
}

// --------------------------------------------------------------------------------------------------------- the stress

enum StressCurve : std::size_t { of_xy, of_difference, of_mean, of_kinetic, of_cross, of_potential, of_noise };
constexpr std::size_t stress_curves = 7;

/// The mean of two correlations at the first `points` lags; nan where either is not known.
Numbers mean_of(const measure::Correlation& a, const measure::Correlation& b, std::size_t points) {
  Numbers mean(points, not_a_number);
  for (std::size_t i = 0; i < std::min({points, a.value.size(), b.value.size()}); ++i)
    mean[i] = 0.5 * (a.value[i] + b.value[i]);
  return mean;
}

std::optional<BlockCurves> stress_of(const Blocks& blocks, double sample_interval) {
  std::vector<const measure::Correlation*> known;
  for (const CorrelationBlock* block : blocks)
    for (const measure::Correlation& correlation : block->stress)
      if (!correlation.value.empty()) known.push_back(&correlation);
  Numbers times = common_times(known, sample_interval);
  const std::size_t points = times.size();
  if (points < 2) return std::nullopt;

  std::vector<Numbers> numbers;
  Numbers weights;
  for (const CorrelationBlock* block : blocks) {
    const auto& stress = block->stress;
    std::array<Numbers, stress_curves> curves;
    curves[of_xy] = mean_of(stress[xy], stress[xy], points);
    curves[of_difference] = mean_of(stress[difference], stress[difference], points);
    curves[of_mean] = mean_of(stress[xy], stress[difference], points);
    curves[of_kinetic] = mean_of(stress[xy_kinetic], stress[difference_kinetic], points);
    curves[of_potential] = mean_of(stress[xy_potential], stress[difference_potential], points);
    curves[of_cross] = curves[of_mean];
    for (std::size_t i = 0; i < points; ++i) curves[of_cross][i] -= curves[of_kinetic][i] + curves[of_potential][i];
    curves[of_noise] = mean_of(stress[pure_noise], stress[pure_noise], points);
    Numbers& together = numbers.emplace_back();
    for (const Numbers& curve : curves) together.insert(together.end(), curve.begin(), curve.end());
    weights.push_back(static_cast<double>(block->samples));
  }
  return BlockCurves(std::move(times), std::move(numbers), std::move(weights));
}

/// The spectra of the blocks that have one of the same segment length, weighted by their segments.
struct BlockSpectra {
  std::size_t segment = 0;
  double segments = 0.0;
  std::vector<const measure::Spectrum*> of_block;  // null: none
  Numbers power;

  explicit BlockSpectra(const Blocks& blocks) {
    for (const CorrelationBlock* block : blocks) {
      const measure::Spectrum& spectrum = block->spectrum;
      if (segment == 0 && spectrum.segments > 0) segment = spectrum.segment;
      const bool taken = spectrum.segments > 0 && spectrum.segment == segment;
      of_block.push_back(taken ? &spectrum : nullptr);
      if (!taken) continue;
      power.resize(spectrum.power.size(), 0.0);
      segments += static_cast<double>(spectrum.segments);
      for (std::size_t k = 0; k < power.size(); ++k)
        power[k] += static_cast<double>(spectrum.segments) * spectrum.power[k];
    }
    for (double& each : power) each /= segments;
  }

  /// What is left without one block.
  double segments_without(std::size_t block) const {
    return of_block[block] == nullptr ? segments : segments - static_cast<double>(of_block[block]->segments);
  }
  Numbers power_without(std::size_t block) const {
    const double left = segments_without(block);
    if (of_block[block] == nullptr) return power;
    if (left <= 0.0) return {};
    Numbers result = power;
    for (std::size_t k = 0; k < power.size(); ++k)
      result[k] = (segments * power[k] - (segments - left) * of_block[block]->power[k]) / left;
    return result;
  }
};

/// The second estimate of int C dt, and how far it lies from the first.
void estimate_from_spectrum(const Blocks& blocks, const State& state, double integral,
                            const Numbers& integral_leaving_out, double factor, double relative_error,
                            GreenKuboRow& row) {
  const BlockSpectra spectra(blocks);
  if (spectra.segments == 0.0) return;
  const auto fit =
      statistics::fit_lorentzian(spectra.power, spectra.segment, components * spectra.segments, state.sample_interval);
  row.spectrum_frequency = fit.highest_frequency;
  row.spectrum_p_value = fit.p_value;
  if (std::isnan(fit.integral)) return;
  // The curvature of the likelihood gives a steadier error than the jackknife, which would refit a handful of blocks.
  const Estimate estimate = {fit.integral, fit.integral_error, components * spectra.segments, fit.ordinates};
  row.estimates[green_kubo_quantity("viscosity_spectrum")] = scaled(estimate, factor, relative_error);
  Numbers leaving_out;
  for (std::size_t b = 0; b < blocks.size() && blocks.size() >= 2; ++b)
    leaving_out.push_back(statistics::refit_lorentzian(spectra.power_without(b), spectra.segment,
                                                       components * spectra.segments_without(b), state.sample_interval,
                                                       fit)
                              .integral);
  for (std::size_t b = 0; b < leaving_out.size(); ++b) leaving_out[b] = integral_leaving_out[b] - leaving_out[b];
  const Estimate between = statistics::jackknife(integral - fit.integral, leaving_out);
  row.spectrum_z = between.value / between.error;
}

void warn_of_cutoff(const Ending& ending, const std::string& what, double longest, const State& state,
                    std::vector<std::string>& warnings) {
  if (std::isnan(ending.decay.time) && state.cutoff == 0.0) {
    warnings.push_back(fmt::format(
        "No decay time of the {} was found within the {:.4g} that is correlated, and its integral runs over all of "
        "them: lengthen {} or {}.",
        what, longest, state.duration_key, state.length_key));
  } else if (state.cutoff > 0.0 && state.cutoff < cutoff_in_decay_times * ending.decay.time) {
    warnings.push_back(fmt::format(
        "The {} is integrated to the cut-off {:.4g} that was asked for, which is less than {:.4g} decay times "
        "of {:.4g}: part of the integral is missing.",
        what, state.cutoff, cutoff_in_decay_times, ending.decay.time));
  } else if (state.cutoff == 0.0 && cutoff_in_decay_times * ending.decay.time > longest) {
    warnings.push_back(
        fmt::format("The {} is integrated to its longest time {:.4g} only, which is less than {:.4g} decay times of "
                    "{:.4g}: lengthen {}.",
                    what, longest, cutoff_in_decay_times, ending.decay.time, state.length_key));
  }
}

/// Few blocks may agree by chance: with fewer than fewest_degrees degrees of freedom the errors of the integral are not
/// less than what pure noise would give it.
void keep_above_noise(const StressCurves& curves, int degrees_of_freedom, GreenKuboRow& row) {
  if (degrees_of_freedom < 1 || degrees_of_freedom >= fewest_degrees) return;
  const auto keep = [&](std::size_t place, double cutoff) {
    double& error = row.estimates[place].error;
    const double noise = statistics::value_at(curves.time, curves.noise_envelope, cutoff);
    if (error < noise) error = noise;
  };
  keep(green_kubo_quantity("viscosity"), row.cutoff);
  keep(green_kubo_quantity("viscosity_half_cutoff"), 0.5 * row.cutoff);
  keep(green_kubo_quantity("viscosity_twice_cutoff"), 2.0 * row.cutoff);
  row.warnings.push_back(
      fmt::format("There are {} blocks only, and errors rest on {} degrees of freedom; those of the integral are not "
                  "less than what pure noise would give it. More replicas or a longer recording make more blocks.",
                  degrees_of_freedom + 1, degrees_of_freedom));
}

// ----------------------------------------------------------------------------------------------------- what is further

/// Takes the means off the products of a pair: zero where symmetry says so, else the mean over all blocks. A mean of
/// each block's own would take the slow part of the correlation with it.
void take_means_off(std::span<const measure::Correlation* const> known, std::span<const double> weights,
                    const std::array<std::size_t, 2>& pair, std::vector<Numbers>& numbers) {
  double mean_a = 0.0;
  double mean_b = 0.0;
  double total = 0.0;
  for (std::size_t b = 0; b < known.size(); ++b) {
    mean_a += weights[b] * known[b]->mean_a.front();
    mean_b += weights[b] * known[b]->mean_b.front();
    total += weights[b];
  }
  mean_a = mean_is_zero(pair[0]) ? 0.0 : mean_a / total;
  mean_b = mean_is_zero(pair[1]) ? 0.0 : mean_b / total;
  for (std::size_t b = 0; b < known.size(); ++b)
    for (std::size_t k = 0; k < numbers[b].size(); ++k)
      numbers[b][k] += mean_a * mean_b - mean_a * known[b]->mean_b[k] - mean_b * known[b]->mean_a[k];
}

/// Where a transport coefficient and its cut-off go.
struct Coefficient {
  Estimate* estimate;
  double* cutoff;
};

/// One of `others` of every block: its curve, and the estimate of its integral if that is a transport coefficient.
/// `pair`: the factors whose means are to be taken off.
OtherCurve other_of(const Blocks& blocks, std::size_t place, std::string name, double factor, double relative_error,
                    const State& state, Coefficient* coefficient, const std::optional<std::array<std::size_t, 2>>& pair,
                    std::vector<std::string>& warnings) {
  OtherCurve result;
  result.name = std::move(name);
  std::vector<const measure::Correlation*> known;
  for (const CorrelationBlock* block : blocks)
    known.push_back(place < block->others.size() ? &block->others[place] : nullptr);
  if (known.empty() || std::count(known.begin(), known.end(), nullptr) > 0) return result;
  result.time = common_times(known, state.sample_interval);
  const auto points = static_cast<std::ptrdiff_t>(result.time.size());
  if (points < 2) return result;
  std::vector<Numbers> numbers;
  Numbers weights;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    numbers.emplace_back(known[b]->value.begin(), known[b]->value.begin() + points);
    weights.push_back(static_cast<double>(blocks[b]->samples));
  }
  if (pair) take_means_off(known, weights, *pair, numbers);
  const BlockCurves curves(result.time, std::move(numbers), std::move(weights));
  const Numbers all = curves.without(curves.blocks()), errors = curves.errors();
  result.correlation = scaled_curve(curves.correlation(all, 0), curves.correlation(errors, 0), factor);
  result.integral = scaled_curve(curves.integral(all, 0), curves.integral(errors, 0), factor);
  if (coefficient == nullptr) return result;

  // Its own cut-off always: a cut-off that was asked for is that of the viscosity.
  const Ending ending = ending_of(curves, all, 0, 0.0);
  const auto [estimates, leaving_out] =
      jackknife_of(curves, 0, 0.0, ending, [&](const Numbers& means, const Ending& end) {
        return std::array<double, 1>{curves.integral_to(means, 0, end.cutoff)};
      });
  *coefficient->estimate = scaled(estimates[0], factor, relative_error);
  *coefficient->cutoff = ending.cutoff;
  State own = state;
  own.cutoff = 0.0;
  warn_of_cutoff(ending, result.name + " correlation", result.time.back(), own, warnings);
  return result;
}

}  // namespace

void estimate_from_stress(const Blocks& blocks, const State& state, GreenKuboResult& result) {
  GreenKuboRow& row = result.row;
  const std::optional<BlockCurves> stress = stress_of(blocks, state.sample_interval);
  if (!stress) return;
  const Numbers& times = stress->times();
  const double longest = times.back();
  const double factor = state.volume / state.temperature.value;
  const double relative_error = state.temperature.error / state.temperature.value;
  const Numbers all = stress->without(stress->blocks());
  const Ending ending = ending_of(*stress, all, of_mean, state.cutoff);

  // Twice the cut-off is asked of the correlation as a whole; where a block is left out the cut-off may lie later.
  const double twice = 2.0 * ending.cutoff;
  constexpr std::array places = {green_kubo_quantity("viscosity"),
                                 green_kubo_quantity("viscosity_half_cutoff"),
                                 green_kubo_quantity("viscosity_twice_cutoff"),
                                 green_kubo_quantity("viscosity_kinetic"),
                                 green_kubo_quantity("viscosity_cross"),
                                 green_kubo_quantity("viscosity_potential"),
                                 green_kubo_quantity("viscosity_xy"),
                                 green_kubo_quantity("viscosity_difference"),
                                 green_kubo_quantity("shear_modulus")};
  const auto values_of = [&](const Numbers& numbers, const Ending& end) {
    const auto to = [&](StressCurve curve, double time) { return stress->integral_to(numbers, curve, time); };
    return std::array<double, places.size() + 1>{
        to(of_mean, end.cutoff),
        to(of_mean, 0.5 * end.cutoff),
        twice > longest ? not_a_number : to(of_mean, std::min(2.0 * end.cutoff, longest)),
        to(of_kinetic, end.cutoff),
        to(of_cross, end.cutoff),
        to(of_potential, end.cutoff),
        to(of_xy, end.cutoff),
        to(of_difference, end.cutoff),
        stress->correlation(numbers, of_mean).front(),
        end.decay.time};
  };
  const auto [estimates, leaving_out] = jackknife_of(*stress, of_mean, state.cutoff, ending, values_of);
  for (std::size_t i = 0; i < places.size(); ++i)
    row.estimates[places[i]] = scaled(estimates[i], factor, relative_error);
  row.estimates[green_kubo_quantity("decay_time")] = estimates.back();
  row.cutoff = ending.cutoff;
  row.decay_begin = ending.decay.begin;
  row.decay_end = ending.decay.end;
  result.decay_amplitude = factor * ending.decay.amplitude;

  const Numbers errors = stress->errors();
  const auto correlation = [&](StressCurve curve) {
    return scaled_curve(stress->correlation(all, curve), stress->correlation(errors, curve), factor);
  };
  const auto integral = [&](StressCurve curve) {
    return scaled_curve(stress->integral(all, curve), stress->integral(errors, curve), factor);
  };
  double total_time = 0.0;
  for (const CorrelationBlock* block : blocks)
    total_time += static_cast<double>(block->samples) * state.sample_interval;
  StressCurves& curves = result.curves;
  curves.time = times;
  curves.xy = correlation(of_xy);
  curves.difference = correlation(of_difference);
  curves.mean = correlation(of_mean);
  curves.integral = integral(of_mean);
  curves.noise_envelope = envelope(times, curves.mean.value, components * total_time);
  curves.noise_integral = integral(of_noise);
  curves.kinetic = correlation(of_kinetic);
  curves.cross = correlation(of_cross);
  curves.potential = correlation(of_potential);

  keep_above_noise(curves, static_cast<int>(stress->blocks()) - 1, row);

  const std::span<const double> mean = stress->correlation(all, of_mean);
  if (mean[1] < least_first_lag * mean[0]) {
    row.warnings.push_back(
        fmt::format("The stress is sampled too coarsely: its correlation falls to {:.2g} of its start from one sample "
                    "to the next, and the integral misses what lies between; lower {} from {:.4g}.",
                    mean[1] / mean[0], state.interval_key, state.sample_interval));
  }
  warn_of_cutoff(ending, "stress correlation", longest, state, row.warnings);
  if (twice > longest) {
    row.warnings.push_back(
        fmt::format("Twice the cut-off, {:.4g}, lies beyond the longest time that is correlated, {:.4g}, and has no "
                    "value: lengthen {}.",
                    twice, longest, state.length_key));
  }
  if (stress->blocks() == 1) {
    row.warnings.push_back(
        fmt::format("There is one block of {:.4g} only, and no error without a second: lengthen {} or shorten {}.",
                    total_time, state.duration_key, state.length_key));
  }

  estimate_from_spectrum(blocks, state, estimates[0].value, leaving_out[0], factor, relative_error, row);
  if (std::isnan(row.estimates[green_kubo_quantity("viscosity_spectrum")].value)) {
    row.warnings.push_back(
        fmt::format("No Lorentzian was found at the low end of the stress spectrum: lengthen {}.", state.duration_key));
  } else if (row.spectrum_p_value < least_spectrum_p_value) {
    row.warnings.push_back(fmt::format(
        "The stress spectrum below {:.3g} is no Lorentzian on a constant (p-value {:.2g}), and its viscosity "
        "may be off by more than its error.",
        row.spectrum_frequency, row.spectrum_p_value));
  }
}

void estimate_others(const GreenKuboPoint& point, const Blocks& blocks, const State& state, GreenKuboResult& result) {
  const double temperature = state.temperature.value;
  const double relative_error = state.temperature.error / temperature;
  std::size_t place = 0;
  const auto add = [&](std::string name, double factor, double factor_error, Coefficient* coefficient,
                       const std::optional<std::array<std::size_t, 2>>& pair = std::nullopt) {
    result.others.push_back(other_of(blocks, place++, std::move(name), factor, factor_error, state, coefficient, pair,
                                     result.row.warnings));
  };
  GreenKuboRow& row = result.row;
  Coefficient diffusion = {&row.estimates[green_kubo_quantity("self_diffusion")], &row.self_diffusion_cutoff};
  Coefficient conductivity = {&row.estimates[green_kubo_quantity("thermal_conductivity")],
                              &row.thermal_conductivity_cutoff};
  if (point.diffusion) add("velocity velocity", 1.0, 0.0, &diffusion);
  if (point.thermal_conductivity)
    add("heat_flux heat_flux", state.volume / (temperature * temperature), 2.0 * relative_error, &conductivity);
  for (const std::string& pair : point.pairs) add(pair, state.volume, 0.0, nullptr, parse_pair(pair));
}

Estimate estimate_viscosity(const Blocks& blocks, const State& state) {
  const std::optional<BlockCurves> stress = stress_of(blocks, state.sample_interval);
  if (!stress) return unknown;
  const Ending ending = ending_of(*stress, stress->without(stress->blocks()), of_mean, state.cutoff);
  const auto [estimates, leaving_out] =
      jackknife_of(*stress, of_mean, state.cutoff, ending, [&](const Numbers& numbers, const Ending& end) {
        return std::array<double, 1>{stress->integral_to(numbers, of_mean, end.cutoff)};
      });
  return scaled(estimates[0], state.volume / state.temperature.value,
                state.temperature.error / state.temperature.value);
}

}  // namespace lucy::cases
