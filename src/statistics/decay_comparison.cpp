// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/decay_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "lucy/statistics/blocking.hpp"
#include "lucy/statistics/jackknife.hpp"

namespace lucy::statistics {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr Estimate unknown = {not_a_number, not_a_number, not_a_number, 0};
constexpr std::size_t fewest_replicas = 4;
constexpr double least_noise = 1e-9;        // of a(0)
constexpr double errors_of_worse = 2.0;     // of the difference of log-likelihoods
constexpr double residuals_of_worse = 2.0;  // rms residual over the least one
constexpr double least_residual = 1e-6;     // of a(0): below it a form is as good as exact

double squares_about(DecayForm form, const DecayParameters& parameters, std::span<const double> times,
                     std::span<const double> values) {
  double sum = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double residual = values[i] - decay_form(form, parameters, times[i]);
    sum += residual * residual;
  }
  return sum;
}

/// One form's parameters: with each replica left out, and last with none.
std::vector<DecayParameters> fits_of(DecayForm form, const DecayingWave& wave) {
  std::vector<DecayParameters> fits(wave.replicas() + 1);
  fits.back() = fit_decay_form(form, wave.times(), wave.mean());
  if (wave.replicas() > 1)
    for (std::size_t r = 0; r < wave.replicas(); ++r)
      fits[r] = refit_decay_form(form, wave.times(), wave.mean_without(r), fits.back());
  return fits;
}

FormFit with_errors(DecayForm form, const DecayingWave& wave, const std::vector<DecayParameters>& fits, double noise) {
  const auto estimate = [&](const auto& value) {
    return jackknife(wave.replicas(), [&](std::size_t r) { return value(fits[r]); });
  };
  FormFit result;
  result.form = form;
  result.parameters = fits.back();
  result.amplitude = estimate([](const DecayParameters& p) { return p.amplitude; });
  result.rate = estimate([](const DecayParameters& p) { return p.rate; });
  result.deceleration = result.yield_amplitude = result.memory_time = result.natural_frequency = unknown;
  if (form == DecayForm::yielding) {
    result.deceleration = estimate([](const DecayParameters& p) { return p.deceleration; });
    result.yield_amplitude = estimate([](const DecayParameters& p) { return p.yield_amplitude(); });
  } else if (form == DecayForm::viscoelastic) {
    result.memory_time = estimate([](const DecayParameters& p) { return p.memory_time; });
    result.natural_frequency = estimate([](const DecayParameters& p) { return p.natural_frequency(); });
  }
  const auto samples = static_cast<double>(wave.samples()), replicas = static_cast<double>(wave.replicas());
  const double residual = std::sqrt(squares_about(form, fits.back(), wave.times(), wave.mean()) / samples);
  result.relative_residual = residual > 0.0 ? residual / std::abs(fits.back().amplitude) : 0.0;
  result.residual_over_error = residual > 0.0 ? residual / (noise / std::sqrt(replicas)) : 0.0;
  return result;
}

/// Each replica's deviations from the mean of all.
std::vector<std::vector<double>> deviations_of(const DecayingWave& wave) {
  const std::vector<double> mean = wave.mean();
  std::vector<std::vector<double>> deviations;
  for (std::size_t r = 0; r < wave.replicas(); ++r) {
    std::vector<double>& deviation = deviations.emplace_back(wave.amplitude(r));
    for (std::size_t i = 0; i < deviation.size(); ++i) deviation[i] -= mean[i];
  }
  return deviations;
}

double noise_of(const std::vector<std::vector<double>>& deviations) {
  if (deviations.size() < 2) return not_a_number;
  double squares = 0.0;
  for (const std::vector<double>& deviation : deviations)
    for (const double each : deviation) squares += each * each;
  return std::sqrt(squares / static_cast<double>((deviations.size() - 1) * deviations.front().size()));
}

/// log L_r of the file comment.
std::vector<double> scores_of(DecayForm form, const DecayingWave& wave, const std::vector<DecayParameters>& fits,
                              double variance) {
  std::vector<double> scores;
  for (std::size_t r = 0; r < wave.replicas(); ++r)
    scores.push_back(-0.5 * squares_about(form, fits[r], wave.times(), wave.amplitude(r)) / variance);
  return scores;
}

/// The sum of the differences of two forms' scores.
Estimate sum_of_differences(const std::vector<double>& first, const std::vector<double>& second) {
  const auto count = static_cast<double>(first.size());
  double sum = 0.0;
  for (std::size_t r = 0; r < first.size(); ++r) sum += first[r] - second[r];
  return jackknife(first.size(), [&](std::size_t r) {
    return r == first.size() ? sum : count / (count - 1.0) * (sum - (first[r] - second[r]));
  });
}

DecayForm preferred_by_likelihood(const std::array<FormDifference, 3>& differences) {
  const auto& [yielding, viscoelastic, richer] = differences;
  const FormDifference& best = richer.log_likelihood.value > 0.0 ? yielding : viscoelastic;
  const bool worse = -best.log_likelihood.value > errors_of_worse * best.log_likelihood.error;
  return worse ? best.second : DecayForm::exponential;
}

DecayForm preferred_by_residuals(const std::array<FormFit, decay_forms.size()>& fits) {
  const auto& [exponential, yielding, viscoelastic] = fits;
  const FormFit& best = yielding.relative_residual < viscoelastic.relative_residual ? yielding : viscoelastic;
  const double bound = std::max(residuals_of_worse * best.relative_residual, least_residual);
  return exponential.relative_residual > bound ? best.form : DecayForm::exponential;
}

}  // namespace

FormFit fit_form(const DecayingWave& wave, DecayForm form) {
  return with_errors(form, wave, fits_of(form, wave), noise_of(deviations_of(wave)));
}

DecayComparison compare_decay_forms(const DecayingWave& wave) {
  const std::vector<std::vector<double>> deviations = deviations_of(wave);
  DecayComparison result;
  result.noise = noise_of(deviations);
  std::array<std::vector<DecayParameters>, decay_forms.size()> fits;
  for (std::size_t f = 0; f < decay_forms.size(); ++f) {
    fits[f] = fits_of(decay_forms[f], wave);
    result.fits[f] = with_errors(decay_forms[f], wave, fits[f], result.noise);
  }

  const std::vector<std::span<const double>> views(deviations.begin(), deviations.end());
  result.inefficiency = not_a_number;
  if (wave.replicas() >= fewest_replicas && result.noise > least_noise * std::abs(result.fits.front().amplitude.value))
    result.inefficiency = std::fmax(1.0, automatic_blocking(views).inefficiency);
  result.by_likelihood = std::isfinite(result.inefficiency);
  const auto replicas = static_cast<double>(wave.replicas());
  const double variance = result.inefficiency * result.noise * result.noise * (1.0 + 1.0 / (replicas - 1.0));
  std::size_t pair = 0;
  for (std::size_t first = 0; first < decay_forms.size(); ++first) {
    for (std::size_t second = first + 1; second < decay_forms.size(); ++second) {
      result.differences[pair++] = {
          decay_forms[first], decay_forms[second],
          result.by_likelihood ? sum_of_differences(scores_of(decay_forms[first], wave, fits[first], variance),
                                                    scores_of(decay_forms[second], wave, fits[second], variance))
                               : unknown};
    }
  }
  result.preferred =
      result.by_likelihood ? preferred_by_likelihood(result.differences) : preferred_by_residuals(result.fits);
  return result;
}

}  // namespace lucy::statistics
