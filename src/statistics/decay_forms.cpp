// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/decay_forms.hpp"

#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

namespace lucy::statistics {

namespace {

constexpr double steepest = 200.0;         // exponents beyond it are cut, so that no trial of the search overflows
constexpr double widest_logarithm = 20.0;  // of tau over the time that is fitted
constexpr double better = 1.0 - 1e-9;      // of the squares: a richer form has to earn its parameter
constexpr std::size_t most_searches = 4;   // from the best of the starts

double bounded_exponential(double exponent) { return std::exp(std::min(exponent, steepest)); }

double exponential(const DecayParameters& p, double time) { return p.amplitude * bounded_exponential(-p.rate * time); }

double yielding(const DecayParameters& p, double time) {
  const double x = p.rate * time;
  // (1 - exp(-x))/G, which is t for a purely plastic solid.
  const double stopping = std::abs(x) < 1e-12 ? time : -std::expm1(std::min(-x, steepest)) / p.rate;
  const double left = std::abs(p.amplitude) * bounded_exponential(-x) - p.deceleration * stopping;
  return std::copysign(std::max(0.0, left), p.amplitude);
}

double viscoelastic(const DecayParameters& p, double time) {
  if (!(p.memory_time > 0.0)) return exponential(p, time);
  const double q_squared = 1.0 - 4.0 * p.rate * p.memory_time;
  const double half = 0.5 * time / p.memory_time;
  const double y = q_squared * half * half;
  const double q = std::sqrt(std::abs(q_squared));
  if (std::abs(y) < 1e-4) {
    const double c = 1.0 + y / 2.0 * (1.0 + y / 12.0), s = 1.0 + y / 6.0 * (1.0 + y / 20.0);
    return p.amplitude * std::exp(-half) * (c + half * s);
  }
  if (y < 0.0) return p.amplitude * std::exp(-half) * (std::cos(q * half) + std::sin(q * half) / q);
  // The slow exponent by way of (1 - q)(1 + q) = 4 G tau, or it would be a difference of large numbers for small tau.
  return 0.5 * p.amplitude *
         ((1.0 + 1.0 / q) * bounded_exponential(-2.0 * p.rate * time / (1.0 + q)) +
          (1.0 - 1.0 / q) * std::exp(-half * (1.0 + q)));
}

/// What the search moves, a0 first: G; c and G; c on the bound G = 0; log tau and G; or log tau and G/tau, by which a
/// wave that rings is fitted best, since G/tau is the square of its frequency.
enum class Search { exponential, yielding, plastic, relaxing, ringing };

using Coordinates = std::array<double, 3>;

std::size_t parameter_count(Search search) {
  return search == Search::exponential || search == Search::plastic ? 2 : 3;
}

DecayForm form_of(Search search) {
  if (search == Search::exponential) return DecayForm::exponential;
  return search == Search::yielding || search == Search::plastic ? DecayForm::yielding : DecayForm::viscoelastic;
}

DecayParameters parameters_at(Search search, const Coordinates& at) {
  const auto memory_time = [&] { return std::exp(std::clamp(at[1], -widest_logarithm, widest_logarithm)); };
  switch (search) {
    case Search::yielding:
      return {at[0], at[2], at[1], 0.0};
    case Search::plastic:
      return {at[0], 0.0, at[1], 0.0};
    case Search::relaxing:
      return {at[0], at[2], 0.0, memory_time()};
    case Search::ringing:
      return {at[0], at[2] * memory_time(), 0.0, memory_time()};
    default:
      return {at[0], at[1], 0.0, 0.0};
  }
}

Coordinates coordinates_of(Search search, const DecayParameters& p) {
  switch (search) {
    case Search::yielding:
    case Search::plastic:
      return {p.amplitude, p.deceleration, p.rate};
    case Search::relaxing:
      return {p.amplitude, std::log(p.memory_time), p.rate};
    case Search::ringing:
      return {p.amplitude, std::log(p.memory_time), p.rate / p.memory_time};
    default:
      return {p.amplitude, p.rate, 0.0};
  }
}

/// A curve in units of its largest value and of its longest time.
struct Curve {
  std::vector<double> times, values;
};

struct Fit {
  DecayParameters parameters;
  double squares = std::numeric_limits<double>::infinity();
};

double squares(const Curve& curve, DecayForm form, const DecayParameters& parameters) {
  double sum = 0.0;
  for (std::size_t i = 0; i < curve.times.size(); ++i) {
    const double residual = decay_form(form, parameters, curve.times[i]) - curve.values[i];
    sum += residual * residual;
  }
  return sum;
}

struct Problem {
  const Curve& curve;
  Search search;
};

int residuals(const gsl_vector* position, void* data, gsl_vector* result) {
  const auto& [curve, search] = *static_cast<const Problem*>(data);
  Coordinates at{};
  for (std::size_t k = 0; k < position->size; ++k) at[k] = gsl_vector_get(position, k);
  const DecayParameters parameters = parameters_at(search, at);
  for (std::size_t i = 0; i < curve.times.size(); ++i)
    gsl_vector_set(result, i, decay_form(form_of(search), parameters, curve.times[i]) - curve.values[i]);
  return GSL_SUCCESS;
}

Fit minimise(const Curve& curve, Search search, const DecayParameters& start) {
  const std::size_t count = parameter_count(search);
  gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
  settings.fdtype = GSL_MULTIFIT_NLINEAR_CTRDIFF;
  const std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)> workspace(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, curve.times.size(), count),
      &gsl_multifit_nlinear_free);
  Problem problem{curve, search};
  gsl_multifit_nlinear_fdf functions{};
  functions.f = residuals;
  functions.n = curve.times.size();
  functions.p = count;
  functions.params = &problem;
  Coordinates from = coordinates_of(search, start);
  const gsl_vector_view from_view = gsl_vector_view_array(from.data(), count);
  gsl_multifit_nlinear_init(&from_view.vector, &functions, workspace.get());
  int reason = 0;
  gsl_multifit_nlinear_driver(100, 1e-9, 1e-12, 0.0, nullptr, nullptr, &reason, workspace.get());
  const gsl_vector* position = gsl_multifit_nlinear_position(workspace.get());
  Coordinates at{};
  for (std::size_t k = 0; k < count; ++k) at[k] = gsl_vector_get(position, k);
  const DecayParameters found = parameters_at(search, at);
  const double sum = squares(curve, form_of(search), found);
  const bool allowed =
      search == Search::exponential || (found.deceleration >= 0.0 && (search != Search::yielding || found.rate >= 0.0));
  return allowed && std::isfinite(sum) ? Fit{found, sum} : Fit{};
}

/// For a given G the best a0 is a quotient of two sums: the best of many G is where the search starts.
DecayParameters exponential_start(const Curve& curve) {
  Fit best;
  std::vector<double> rates = {-3.0, -1.0, -0.3, 0.0};
  for (double rate = 0.1; rate < 2.0 * static_cast<double>(curve.times.size()); rate *= 1.5) rates.push_back(rate);
  for (const double rate : rates) {
    double product = 0.0, shape_squares = 0.0;
    for (std::size_t i = 0; i < curve.times.size(); ++i) {
      const double shape = std::exp(-rate * curve.times[i]);
      product += shape * curve.values[i];
      shape_squares += shape * shape;
    }
    const DecayParameters start{product / shape_squares, rate, 0.0, 0.0};
    const double sum = squares(curve, DecayForm::exponential, start);
    if (sum < best.squares) best = {start, sum};
  }
  return best.parameters;
}

/// Rising c at falling G, the initial slope being that of the exponential.
std::vector<DecayParameters> yielding_starts(const DecayParameters& fit) {
  std::vector<DecayParameters> starts;
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0})
    starts.push_back({fit.amplitude, (1.0 - share) * fit.rate, share * std::abs(fit.amplitude) * fit.rate, 0.0});
  return starts;
}

/// From strongly over- to underdamped, each falling to half of a0 about when the curve does: that takes log 2/G without
/// memory, (pi/3) (tau/G)^(1/2) where the wave rings, and about the sum of both in between.
std::vector<DecayParameters> viscoelastic_starts(const Curve& curve) {
  const double a0 = curve.values.front();
  std::size_t half = 1;
  while (half + 1 < curve.values.size() && curve.values[half] > 0.5 * a0) ++half;
  std::vector<DecayParameters> starts;
  for (double product = 0.02; product < 2e3; product *= 2.5) {
    const double rate = (0.69 + 1.05 * std::sqrt(product)) / curve.times[half];
    starts.push_back({a0, rate, 0.0, product / rate});
  }
  return starts;
}

/// The best of the searches from the best of the starts, and `bound`, the fit with one parameter less.
Fit best_fit(const Curve& curve, DecayForm form, const std::vector<DecayParameters>& starts, const Fit& bound) {
  std::vector<Fit> ranked;
  for (const DecayParameters& start : starts) ranked.push_back({start, squares(curve, form, start)});
  std::stable_sort(ranked.begin(), ranked.end(), [](const Fit& a, const Fit& b) { return a.squares < b.squares; });
  ranked.resize(std::min(ranked.size(), most_searches));
  Fit best = bound;
  const auto search = [&](Search way, const DecayParameters& start) {
    const Fit found = minimise(curve, way, start);
    if (found.squares < better * best.squares) best = found;
  };
  for (const auto& [start, sum] : ranked) {
    if (form == DecayForm::yielding) {
      search(Search::yielding, start);
      search(Search::plastic, {start.amplitude, 0.0, start.deceleration + std::abs(start.amplitude) * start.rate, 0.0});
    } else {
      search(4.0 * start.rate * start.memory_time > 1.0 ? Search::ringing : Search::relaxing, start);
    }
  }
  return best;
}

DecayParameters in_units(const DecayParameters& p, double amplitude, double time) {
  return {p.amplitude / amplitude, p.rate * time, p.deceleration / amplitude * time, p.memory_time / time};
}

DecayParameters fit(DecayForm form, std::span<const double> times, std::span<const double> values,
                    const DecayParameters* like) {
  const auto magnitude = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const double unit = std::abs(*std::max_element(values.begin(), values.end(), magnitude));
  const double duration = std::abs(*std::max_element(times.begin(), times.end(), magnitude));
  if (!(unit > 0.0)) return {};
  Curve curve{{times.begin(), times.end()}, {values.begin(), values.end()}};
  for (double& time : curve.times) time /= duration;
  for (double& value : curve.values) value /= unit;
  std::vector<DecayParameters> starts;
  if (like != nullptr) starts.push_back(in_units(*like, unit, duration));

  // The same way whatever `like` is: a richer form on its bound is the exponential to the last bit.
  Fit best = minimise(curve, Search::exponential, exponential_start(curve));
  if (form == DecayForm::yielding) {
    if (starts.empty()) starts = yielding_starts(best.parameters);
    best = best_fit(curve, form, starts, best);
  } else if (form == DecayForm::viscoelastic) {
    if (starts.empty())
      starts = viscoelastic_starts(curve);
    else if (!(starts.front().memory_time > 0.0))
      starts.front().memory_time = 0.1 / std::max(1.0, starts.front().rate);
    best = best_fit(curve, form, starts, best);
  }
  return in_units(best.parameters, 1.0 / unit, 1.0 / duration);
}

}  // namespace

std::string_view name(DecayForm form) {
  constexpr std::array<std::string_view, decay_forms.size()> names = {"exponential", "yielding", "viscoelastic"};
  return names[static_cast<std::size_t>(form)];
}

double DecayParameters::yield_amplitude() const { return deceleration > 0.0 ? deceleration / rate : 0.0; }

double DecayParameters::natural_frequency() const {
  return memory_time > 0.0 ? std::sqrt(std::max(0.0, rate / memory_time)) : std::numeric_limits<double>::infinity();
}

double decay_form(DecayForm form, const DecayParameters& parameters, double time) {
  switch (form) {
    case DecayForm::yielding:
      return yielding(parameters, time);
    case DecayForm::viscoelastic:
      return viscoelastic(parameters, time);
    default:
      return exponential(parameters, time);
  }
}

DecayParameters fit_decay_form(DecayForm form, std::span<const double> times, std::span<const double> values) {
  return fit(form, times, values, nullptr);
}

DecayParameters refit_decay_form(DecayForm form, std::span<const double> times, std::span<const double> values,
                                 const DecayParameters& like) {
  return fit(form, times, values, &like);
}

}  // namespace lucy::statistics
