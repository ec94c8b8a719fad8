// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/decay.hpp"

#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

namespace lucy::statistics {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr int fewest_points = 4;
constexpr int most_rounds = 40;
constexpr double agreement = 1e-4;  // of window and tau, relative

constexpr ExponentialDecay no_decay = {not_a_number, not_a_number, not_a_number, not_a_number, 0};

/// A exp(-k t) - C(t) at the points of the window, in units of C(0) and of the time that the search began with.
struct Window {
  std::vector<double> times, values, weights;
};

int residuals(const gsl_vector* parameters, void* data, gsl_vector* result) {
  const auto& window = *static_cast<const Window*>(data);
  const double amplitude = gsl_vector_get(parameters, 0), rate = gsl_vector_get(parameters, 1);
  for (std::size_t i = 0; i < window.times.size(); ++i)
    gsl_vector_set(result, i, amplitude * std::exp(-rate * window.times[i]) - window.values[i]);
  return GSL_SUCCESS;
}

int derivatives(const gsl_vector* parameters, void* data, gsl_matrix* result) {
  const auto& window = *static_cast<const Window*>(data);
  const double amplitude = gsl_vector_get(parameters, 0), rate = gsl_vector_get(parameters, 1);
  for (std::size_t i = 0; i < window.times.size(); ++i) {
    const double shape = std::exp(-rate * window.times[i]);
    gsl_matrix_set(result, i, 0, shape);
    gsl_matrix_set(result, i, 1, -amplitude * window.times[i] * shape);
  }
  return GSL_SUCCESS;
}

/// Where C first falls to C(0)/e, linear in between; nan when it does not.
double first_decay(std::span<const double> times, std::span<const double> values) {
  const double level = values.front() * std::exp(-1.0);
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] <= level)
      return times[i - 1] + (times[i] - times[i - 1]) * (values[i - 1] - level) / (values[i - 1] - values[i]);
  return not_a_number;
}

/// The fit in begin <= t <= end, started with the decay time `start`.
ExponentialDecay fit(std::span<const double> times, std::span<const double> values, double begin, double end,
                     double start) {
  const auto first = static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), begin) - times.begin());
  const auto last = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), end) - times.begin());
  if (last < first + fewest_points) return no_decay;
  Window window;
  for (std::size_t i = first; i < last; ++i) {
    window.times.push_back(times[i] / start);
    window.values.push_back(values[i] / values.front());
    const double before = i == first ? times[i] : times[i - 1];
    const double after = i + 1 == last ? times[i] : times[i + 1];
    window.weights.push_back(0.5 * (after - before) / start);
  }

  gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
  const std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)> workspace(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, window.times.size(), 2),
      &gsl_multifit_nlinear_free);
  gsl_multifit_nlinear_fdf problem{};
  problem.f = residuals;
  problem.df = derivatives;
  problem.n = window.times.size();
  problem.p = 2;
  problem.params = &window;
  double guess[2] = {window.values.front() * std::exp(window.times.front()), 1.0};
  const gsl_vector_view guess_view = gsl_vector_view_array(guess, 2);
  const gsl_vector_view weights_view = gsl_vector_view_array(window.weights.data(), window.weights.size());
  gsl_multifit_nlinear_winit(&guess_view.vector, &weights_view.vector, &problem, workspace.get());
  int reason = 0;
  gsl_multifit_nlinear_driver(100, 1e-10, 1e-10, 0.0, nullptr, nullptr, &reason, workspace.get());
  const gsl_vector* found = gsl_multifit_nlinear_position(workspace.get());
  const double amplitude = gsl_vector_get(found, 0) * values.front(), rate = gsl_vector_get(found, 1) / start;
  if (!std::isfinite(amplitude) || !(amplitude > 0.0) || !(rate > 0.0) || !std::isfinite(1.0 / rate)) return no_decay;
  return {amplitude, 1.0 / rate, begin, end, static_cast<int>(last - first)};
}

bool usable(std::span<const double> times, std::span<const double> values) {
  return values.size() >= fewest_points && times.size() == values.size() && values.front() > 0.0 &&
         std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

ExponentialDecay fit_decay(std::span<const double> times, std::span<const double> values) {
  if (!usable(times, values)) return no_decay;
  double tau = first_decay(times, values);
  for (int round = 0; round < most_rounds && tau > 0.0; ++round) {
    if (decay_window_end * tau > times.back()) return no_decay;
    const ExponentialDecay result = fit(times, values, decay_window_begin * tau, decay_window_end * tau, tau);
    if (std::abs(result.time - tau) <= agreement * tau || round == most_rounds - 1) return result;
    // From the tenth round on half a step: a point more or less in the window can make the two chase each other.
    tau = round < 10 ? result.time : std::sqrt(tau * result.time);
  }
  return no_decay;
}

ExponentialDecay fit_decay_in_window(std::span<const double> times, std::span<const double> values, double begin,
                                     double end) {
  if (!usable(times, values) || !(end > begin)) return no_decay;
  return fit(times, values, begin, end, end / decay_window_end);
}

}  // namespace lucy::statistics
