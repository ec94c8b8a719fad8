// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/wave_decay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "lucy/statistics/decay_forms.hpp"
#include "lucy/statistics/running_integral.hpp"

namespace lucy::statistics {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr Estimate unknown = {not_a_number, not_a_number, not_a_number, 0};
constexpr std::size_t fewest_samples = 8;
constexpr std::size_t fewest_in_window = 4;
constexpr double significant = 3.0;   // errors
constexpr double late_level = 0.5;    // of a(0): the tail is fitted to what lies below
constexpr double decaying = 2.0;      // errors of its rate
constexpr double swing = 0.05;        // of a(0), to the other side, by which a wave is known to ring
constexpr double swing_errors = 5.0;  // and of the mean curve's errors: one of many points is looked for

std::vector<std::vector<double>> checked(double interval, std::vector<std::vector<double>> amplitudes) {
  if (!(interval > 0.0) || !std::isfinite(interval))
    throw std::invalid_argument("the times of a decaying wave need an interval above zero, not " +
                                std::to_string(interval));
  if (amplitudes.empty()) throw std::invalid_argument("a decaying wave needs at least one replica");
  for (std::size_t r = 0; r < amplitudes.size(); ++r) {
    if (amplitudes[r].size() != amplitudes.front().size() || amplitudes[r].size() < fewest_samples)
      throw std::invalid_argument(
          "replica " + std::to_string(r) + " of a decaying wave has " + std::to_string(amplitudes[r].size()) +
          " amplitudes; every replica has equally many, " + "at least " + std::to_string(fewest_samples));
    for (std::size_t i = 0; i < amplitudes[r].size(); ++i)
      if (!std::isfinite(amplitudes[r][i]))
        throw std::invalid_argument("replica " + std::to_string(r) +
                                    " of a decaying wave has an amplitude that is not " + "finite, sample " +
                                    std::to_string(i));
  }
  return amplitudes;
}

/// Samples `begin` to `end` - 1.
struct Window {
  std::size_t begin, end;
};

/// Where the curve first falls to a level; the number of samples when it does not.
std::size_t first_at(std::span<const double> curve, double level) {
  const auto below = std::find_if(curve.begin(), curve.end(), [&](double value) { return value <= level; });
  return static_cast<std::size_t>(below - curve.begin());
}

/// `noise`: levels below it are not looked for; nothing is told from where the curve has fallen below the last of the
/// others.
std::vector<Window> windows_of(std::span<const double> curve, std::span<const double> levels, double noise) {
  std::vector<Window> windows;
  std::size_t begin = 0;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const double level = levels[k] * curve.front();
    std::size_t end = curve.size();
    if (first_at(curve, level) < curve.size()) {
      if (level < noise) break;
      const double next = k + 1 < levels.size() ? levels[k + 1] * curve.front() : 0.0;
      const auto until = curve.begin() + static_cast<std::ptrdiff_t>(first_at(curve, next));
      end = static_cast<std::size_t>(std::count_if(curve.begin(), until, [&](double value) { return value > level; }));
    }
    if (end < begin + fewest_in_window) continue;
    windows.push_back({begin, end});
    begin = end;
    if (end == curve.size()) break;
  }
  return windows;
}

/// The exponential fitted to a window of a curve, its a0 at the centre of the window.
DecayParameters fit_window(std::span<const double> times, std::span<const double> curve, Window window) {
  const double centre = 0.5 * (times[window.begin] + times[window.end - 1]);
  std::vector<double> from_centre;
  for (std::size_t i = window.begin; i < window.end; ++i) from_centre.push_back(times[i] - centre);
  return fit_decay_form(DecayForm::exponential, from_centre, curve.subspan(window.begin, window.end - window.begin));
}

/// The standard error of the mean curve, pooled over all times; nan for a single replica.
double pooled_error(const DecayingWave& wave) {
  double squares = 0.0;
  for (const double error : wave.errors()) squares += error * error;
  return std::sqrt(squares / static_cast<double>(wave.samples()));
}

/// Whether the curve still swings to the other side in the last half of its time.
bool rings_at_the_end(std::span<const double> curve, double error) {
  const double lowest = *std::min_element(curve.begin() + static_cast<std::ptrdiff_t>(curve.size() / 2), curve.end());
  return lowest < -std::fmax(swing * curve.front(), swing_errors * error);
}

/// The wave's mean curves: each with one replica left out, and last with none. A single replica has only the last.
std::vector<std::vector<double>> mean_curves(const DecayingWave& wave) {
  std::vector<std::vector<double>> curves(wave.replicas() + 1);
  if (wave.replicas() > 1)
    for (std::size_t r = 0; r < wave.replicas(); ++r) curves[r] = wave.mean_without(r);
  curves.back() = wave.mean();
  return curves;
}

}  // namespace

DecayingWave::DecayingWave(double interval, std::vector<std::vector<double>> amplitudes)
    : amplitudes_(checked(interval, std::move(amplitudes))),
      averages_(amplitudes_, std::vector<double>(amplitudes_.size(), 1.0)) {
  for (std::size_t i = 0; i < amplitudes_.front().size(); ++i) times_.push_back(interval * static_cast<double>(i));
}

std::vector<double> DecayingWave::mean_without(std::size_t replica) const {
  return replica == replicas() ? averages_.mean() : averages_.mean_without(replica);
}

std::vector<double> DecayingWave::errors() const { return averages_.errors(); }

ReplicaMeanCurve replica_mean_curve(const DecayingWave& wave) { return {wave.times(), wave.mean(), wave.errors()}; }

std::vector<LocalRate> local_rates(const DecayingWave& wave, std::span<const double> levels) {
  for (std::size_t k = 0; k < levels.size(); ++k)
    if (!(levels[k] > 0.0 && levels[k] < (k == 0 ? 1.0 : levels[k - 1])))
      throw std::invalid_argument("the levels of a decaying wave must fall from below one and stay above zero, but " +
                                  std::to_string(levels[k]) + " is among them");
  const std::vector<std::vector<double>> curves = mean_curves(wave);
  if (!(curves.back().front() > 0.0)) return {};
  const std::vector<double>& times = wave.times();
  std::vector<LocalRate> rates;
  for (const Window window : windows_of(curves.back(), levels, significant * pooled_error(wave))) {
    std::vector<DecayParameters> fits;
    for (const std::vector<double>& curve : curves)
      fits.push_back(curve.empty() ? DecayParameters{} : fit_window(times, curve, window));
    LocalRate result;
    result.begin = times[window.begin];
    result.end = times[window.end - 1];
    result.time = 0.5 * (result.begin + result.end);
    result.amplitude = jackknife(wave.replicas(), [&](std::size_t r) { return fits[r].amplitude; });
    result.rate = jackknife(wave.replicas(), [&](std::size_t r) { return fits[r].rate; });
    if (!(result.amplitude.value < significant * result.amplitude.error)) rates.push_back(result);
  }
  return rates;
}

IntegralRate integral_rate(const DecayingWave& wave, std::optional<double> initial_amplitude) {
  const std::vector<double>& times = wave.times();
  const std::vector<std::vector<double>> curves = mean_curves(wave);
  if (!(curves.back().front() > 0.0) || rings_at_the_end(curves.back(), pooled_error(wave))) return {unknown, unknown};
  // Decided once, by the mean of all: jackknife samples that differ in it would show its steps.
  const Window late{std::min(first_at(curves.back(), late_level * curves.back().front()), wave.samples() / 2),
                    wave.samples()};
  struct Parts {
    double late_rate, rate, tail_share;
  };
  const auto parts_of = [&](const std::vector<double>& curve) -> Parts {
    const DecayParameters fit = fit_window(times, curve, late);
    const double since_centre = 0.5 * (times[late.end - 1] - times[late.begin]);
    const double tail = decay_form(DecayForm::exponential, fit, since_centre) / fit.rate;
    const double integral = running_integral(times, curve).back() + tail;
    return {fit.rate, initial_amplitude.value_or(curve.front()) / integral, tail / integral};
  };
  std::vector<Parts> parts;
  for (const std::vector<double>& curve : curves) parts.push_back(curve.empty() ? Parts{} : parts_of(curve));
  const auto estimate = [&](double Parts::*part) {
    return jackknife(wave.replicas(), [&](std::size_t r) { return parts[r].*part; });
  };
  const Estimate late_rate = estimate(&Parts::late_rate);
  if (!(late_rate.value > 0.0) || late_rate.value < decaying * late_rate.error) return {unknown, unknown};
  return {estimate(&Parts::rate), estimate(&Parts::tail_share)};
}

}  // namespace lucy::statistics
