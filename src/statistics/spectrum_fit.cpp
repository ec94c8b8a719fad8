// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/spectrum_fit.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_multimin.h>
#include <gsl/gsl_sf_psi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

namespace lucy::statistics {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr LorentzianFit no_fit = {not_a_number, not_a_number, not_a_number, not_a_number, not_a_number, 0,
                                  not_a_number};

constexpr int parameters = 3;
constexpr int fewest_ordinates = 10;
constexpr int most_rounds = 30;
constexpr double agreement = 1e-3;         // of omega_max and tau, relative
constexpr double least_at_zero = 1e-6;     // of I_1: with less at k = 0 the mean was taken off, and I_0 says nothing
constexpr double widest_logarithm = 25.0;  // of b/a: beyond it one of the two is nothing

/// The ordinates omega_k <= omega_max with what the likelihood asks of them again and again.
struct Ordinates {
  std::size_t segment;
  double interval;
  std::vector<double> power;                     // I_k
  std::vector<std::complex<double>> revolution;  // exp(-i omega_k dt)
  std::vector<double> weight;                    // shape of the Gamma distribution, in units of m

  Ordinates(std::span<const double> all, std::size_t segment_length, double sampling_interval, double highest)
      : segment(segment_length), interval(sampling_interval) {
    const double spacing = 2.0 * std::numbers::pi / static_cast<double>(segment);
    for (std::size_t k = 0; k < all.size() && 2 * k < segment; ++k) {
      const double angle = spacing * static_cast<double>(k);
      if (angle > highest * interval) break;
      if (k == 0 && !(all[0] > least_at_zero * all[1])) continue;
      power.push_back(all[k]);
      revolution.push_back(std::polar(1.0, -angle));
      weight.push_back(k == 0 ? 0.5 : 1.0);
    }
  }
};

/// E I_k of the file comment, for a C of variance one and this relaxation time.
double lorentzian(const Ordinates& ordinates, std::size_t k, double phi, double phi_to_the_segment) {
  const std::complex<double> z = phi * ordinates.revolution[k];
  const std::complex<double> rest = 1.0 / (1.0 - z);
  return ((1.0 + z) * rest).real() -
         2.0 / static_cast<double>(ordinates.segment) * (z * rest * rest).real() * (1.0 - phi_to_the_segment);
}

/// A point of the search: S_k up to a common factor, a L_k(tau) + b, a + b = 1.
struct Shape {
  double relaxation_time;
  double lorentzian_share;  // a
  double constant_share;    // b
  std::vector<double> spectrum;

  Shape(const Ordinates& ordinates, double log_time, double log_ratio) : relaxation_time(std::exp(log_time)) {
    const double ratio = std::exp(std::clamp(log_ratio, -widest_logarithm, widest_logarithm));
    lorentzian_share = 1.0 / (1.0 + ratio);
    constant_share = ratio / (1.0 + ratio);
    const double phi = std::exp(-ordinates.interval / relaxation_time);
    const double to_the_segment =
        std::exp(-ordinates.interval * static_cast<double>(ordinates.segment) / relaxation_time);
    for (std::size_t k = 0; k < ordinates.power.size(); ++k)
      spectrum.push_back(lorentzian_share * lorentzian(ordinates, k, phi, to_the_segment) + constant_share);
  }

  /// S(0)/2 in time of a spectrum of this shape.
  double integral(double interval) const {
    return lorentzian_share * relaxation_time + 0.5 * constant_share * interval;
  }
};

/// -log L/m of a spectrum of this shape times `scale`.
double minus_log_likelihood(const Ordinates& ordinates, const Shape& shape, double scale) {
  double sum = 0.0;
  for (std::size_t k = 0; k < ordinates.power.size(); ++k) {
    const double model = scale * shape.spectrum[k];
    sum += ordinates.weight[k] * (ordinates.power[k] / model + std::log(model));
  }
  return sum;
}

/// The scale that maximises the likelihood of a shape: where the mean of I_k/S_k is one.
double best_scale(const Ordinates& ordinates, const Shape& shape) {
  double sum = 0.0, weights = 0.0;
  for (std::size_t k = 0; k < ordinates.power.size(); ++k) {
    sum += ordinates.weight[k] * ordinates.power[k] / shape.spectrum[k];
    weights += ordinates.weight[k];
  }
  return sum / weights;
}

double objective(const gsl_vector* point, void* data) {
  const auto& ordinates = *static_cast<const Ordinates*>(data);
  const Shape shape(ordinates, gsl_vector_get(point, 0), gsl_vector_get(point, 1));
  const double value = minus_log_likelihood(ordinates, shape, best_scale(ordinates, shape));
  // A simplex has to be able to turn round.
  return std::isfinite(value) ? value : std::numeric_limits<double>::max();
}

struct Minimum {
  double log_time = 0.0, log_ratio = 0.0;
  double value = std::numeric_limits<double>::infinity();
};

Minimum minimise(Ordinates& ordinates, double log_time, double log_ratio) {
  const std::unique_ptr<gsl_multimin_fminimizer, decltype(&gsl_multimin_fminimizer_free)> minimiser(
      gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, 2), &gsl_multimin_fminimizer_free);
  gsl_multimin_function function = {objective, 2, &ordinates};
  std::array<double, 2> start = {log_time, log_ratio}, size = {0.3, 0.7};
  const gsl_vector_view start_view = gsl_vector_view_array(start.data(), 2);
  const gsl_vector_view size_view = gsl_vector_view_array(size.data(), 2);
  gsl_multimin_fminimizer_set(minimiser.get(), &function, &start_view.vector, &size_view.vector);
  for (int step = 0; step < 400 && gsl_multimin_fminimizer_size(minimiser.get()) > 1e-5; ++step)
    if (gsl_multimin_fminimizer_iterate(minimiser.get()) != GSL_SUCCESS) break;
  const gsl_vector* found = gsl_multimin_fminimizer_x(minimiser.get());
  return {gsl_vector_get(found, 0), std::clamp(gsl_vector_get(found, 1), -widest_logarithm, widest_logarithm),
          gsl_multimin_fminimizer_minimum(minimiser.get())};
}

/// Variance of log(integral) from the curvature of the likelihood in (log integral, log tau, log b/a), parameters that
/// the likelihood does not depend on (b or a nothing) being left out; nan where it is no minimum.
double log_integral_variance(const Ordinates& ordinates, const Minimum& minimum, double integral, double spectra) {
  const auto value = [&](const std::array<double, parameters>& shift) {
    const Shape shape(ordinates, minimum.log_time + shift[1], minimum.log_ratio + shift[2]);
    const double scale = integral * std::exp(shift[0]) / shape.integral(ordinates.interval);
    return spectra * minus_log_likelihood(ordinates, shape, scale);
  };
  constexpr double step = 1e-3;
  std::array<double, parameters> at{};
  const double centre = value(at);
  std::array<std::array<double, parameters>, parameters> curvature{};
  for (int i = 0; i < parameters; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = 0.0;
      if (i == j) {
        for (const double sign : {-1.0, 1.0}) {
          at = {};
          at[i] = sign * step;
          sum += value(at) - centre;
        }
        curvature[i][i] = sum / (step * step);
      } else {
        for (const double first : {-1.0, 1.0}) {
          for (const double second : {-1.0, 1.0}) {
            at = {};
            at[i] = first * step;
            at[j] = second * step;
            sum += first * second * value(at);
          }
        }
        curvature[i][j] = curvature[j][i] = sum / (4.0 * step * step);
      }
    }
  }
  std::vector<int> kept = {0};
  for (int i = 1; i < parameters; ++i)
    if (curvature[i][i] > 1e-4 * curvature[0][0]) kept.push_back(i);
  const std::size_t n = kept.size();
  std::vector<double> matrix(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) matrix[i * n + j] = curvature[kept[i]][kept[j]];
  // Gaussian elimination from below; what is left of the first row is the inverse of the variance.
  for (std::size_t pivot = n - 1; pivot > 0; --pivot) {
    if (!(matrix[pivot * n + pivot] > 0.0)) return not_a_number;
    for (std::size_t i = 0; i < pivot; ++i) {
      const double share = matrix[i * n + pivot] / matrix[pivot * n + pivot];
      for (std::size_t j = 0; j < pivot; ++j) matrix[i * n + j] -= share * matrix[pivot * n + j];
    }
  }
  return matrix[0] > 0.0 ? 1.0 / matrix[0] : not_a_number;
}

/// The probability of a larger deviance D = 2 sum m_k (x_k - 1 - log x_k), x_k = I_k/S_k, by chance. For a Gamma
/// distribution of shape m a term has mean 2 m (log m - psi(m)) and variance 4 m^2 (psi'(m) - 1/m): the multiple of a
/// chi squared that has both, less the share that the parameters have taken up.
double deviance_p_value(const Ordinates& ordinates, const Shape& shape, double scale, double spectra) {
  double deviance = 0.0, mean = 0.0, variance = 0.0;
  for (std::size_t k = 0; k < ordinates.power.size(); ++k) {
    const double m = spectra * ordinates.weight[k];
    const double ratio = ordinates.power[k] / (scale * shape.spectrum[k]);
    deviance += 2.0 * m * (ratio - 1.0 - std::log(ratio));
    mean += 2.0 * m * (std::log(m) - gsl_sf_psi(m));
    variance += 4.0 * m * m * (gsl_sf_psi_1(m) - 1.0 / m);
  }
  const double factor = 0.5 * variance / mean;
  const double left = 1.0 - static_cast<double>(parameters) / static_cast<double>(ordinates.power.size());
  return gsl_cdf_chisq_Q(deviance / factor, left * mean / factor);
}

/// The best minimum from these starts of log b/a about a relaxation time, in omega_k <= highest.
LorentzianFit fit_below(std::span<const double> power, std::size_t segment, double spectra, double interval,
                        double highest, double time, std::span<const double> log_ratios) {
  Ordinates ordinates(power, segment, interval, highest);
  const int count = static_cast<int>(ordinates.power.size());
  if (count < fewest_ordinates) return no_fit;
  if (std::any_of(ordinates.power.begin(), ordinates.power.end(),
                  [](double each) { return !(each > 0.0) || !std::isfinite(each); }))
    return no_fit;
  Minimum best;
  for (const double log_ratio : log_ratios) {
    const Minimum found = minimise(ordinates, std::log(time), log_ratio);
    if (found.value < best.value) best = found;
  }
  if (!std::isfinite(best.value)) return no_fit;
  const double length = static_cast<double>(segment) * interval;
  const Shape shape(ordinates, best.log_time, best.log_ratio);
  const double scale = best_scale(ordinates, shape);
  LorentzianFit result;
  result.integral = scale * shape.integral(interval);
  result.background = 0.5 * scale * shape.constant_share * interval;
  result.relaxation_time = shape.relaxation_time;
  result.integral_error = result.integral * std::sqrt(log_integral_variance(ordinates, best, result.integral, spectra));
  result.highest_frequency = highest;
  result.ordinates = count;
  result.p_value = deviance_p_value(ordinates, shape, scale, spectra);
  // The half width has to lie above the lowest ordinate: a spectrum that still rises there has no end to fit.
  const double lowest = 2.0 * std::numbers::pi / length;
  const bool found = std::isfinite(result.integral) && result.relaxation_time * lowest < 1.0;
  return found ? result : no_fit;
}

/// 1/omega where the spectrum, averaged over k/2 ... 3k/2, has fallen to half of its low end; nan when it does not.
double half_width_time(std::span<const double> power, std::size_t segment, double interval) {
  const auto mean = [&](std::size_t from, std::size_t to) {
    double sum = 0.0;
    for (std::size_t k = from; k <= to; ++k) sum += power[k];
    return sum / static_cast<double>(to - from + 1);
  };
  constexpr std::size_t low_end = 4;
  if (power.size() <= low_end) return not_a_number;
  const double half = 0.5 * mean(1, low_end);
  for (std::size_t k = low_end; k + k / 2 + 1 < power.size(); ++k)
    if (mean(k - k / 2, k + k / 2) <= half)
      return static_cast<double>(segment) * interval / (2.0 * std::numbers::pi * static_cast<double>(k));
  return not_a_number;
}

}  // namespace

LorentzianFit fit_lorentzian(std::span<const double> power, std::size_t segment, double spectra, double interval) {
  // Chance must not narrow the range until nothing is left in it.
  const double length = static_cast<double>(segment) * interval;
  const double least_highest = 2.0 * std::numbers::pi * (fewest_ordinates + 0.5) / length;
  double time = half_width_time(power, segment, interval);
  for (int round = 0; round < most_rounds && time > 0.0; ++round) {
    const double highest = std::max(spectrum_reach / time, least_highest);
    // Heights of the constant over that of the Lorentzian at zero, which is 2 tau/dt per unit of a.
    const double height = std::log(2.0 * time / interval);
    const std::array<double, 3> starts = {height - 4.0, height - 1.0, height + 1.0};
    const LorentzianFit result = fit_below(power, segment, spectra, interval, highest, time, starts);
    if (std::abs(result.relaxation_time - time) <= agreement * time || round == most_rounds - 1) return result;
    time = round < 5 ? result.relaxation_time : std::sqrt(time * result.relaxation_time);
  }
  return no_fit;
}

LorentzianFit refit_lorentzian(std::span<const double> power, std::size_t segment, double spectra, double interval,
                               const LorentzianFit& like) {
  const double lorentzian_share = (like.integral - like.background) / like.relaxation_time;
  const double ratio = like.background / (0.5 * interval) / lorentzian_share;
  const double start = std::log(std::clamp(ratio, std::exp(-widest_logarithm), std::exp(widest_logarithm)));
  return fit_below(power, segment, spectra, interval, like.highest_frequency, like.relaxation_time, {&start, 1});
}

}  // namespace lucy::statistics
