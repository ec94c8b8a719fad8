// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/pooling.hpp"

#include <gsl/gsl_cdf.h>

#include <cmath>
#include <limits>

namespace lucy::statistics {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::vector<std::span<const double>> views(std::span<const std::vector<double>> replicas) {
  return {replicas.begin(), replicas.end()};
}

}  // namespace

double student_factor(int degrees_of_freedom) {
  if (degrees_of_freedom < 1) return not_a_number;
  if (degrees_of_freedom >= 10) return 1.0;
  return gsl_cdf_tdist_Pinv(gsl_cdf_ugaussian_P(1.0), degrees_of_freedom);
}

Estimate pooled_mean(std::span<const std::span<const double>> replicas) {
  const Blocking blocking = automatic_blocking(replicas);
  return {blocking.mean, blocking.error * student_factor(blocking.degrees_of_freedom), blocking.effective_samples,
          blocking.degrees_of_freedom};
}

Estimate pooled_mean(std::span<const std::vector<double>> replicas) { return pooled_mean(views(replicas)); }

ReplicaSpread replica_spread(std::span<const std::span<const double>> replicas) {
  struct Mean {
    double value, samples;
  };
  std::vector<Mean> means;
  double total = 0.0, samples = 0.0;
  double variance = 0.0, variance_samples = 0.0;
  int within = 0;  // degrees of freedom of `variance`
  for (const std::span<const double> series : replicas) {
    if (series.empty()) continue;
    const Blocking alone = automatic_blocking(series);
    const auto length = static_cast<double>(series.size());
    means.push_back({alone.mean, length});
    total += length * alone.mean;
    samples += length;
    if (alone.degrees_of_freedom == 0) continue;
    variance += length * (length * alone.error * alone.error);
    variance_samples += length;
    within += alone.degrees_of_freedom;
  }
  const int between = static_cast<int>(means.size()) - 1;
  if (between < 1 || within < 1) return {not_a_number, std::max(0, between), not_a_number};
  variance /= variance_samples;
  double squares = 0.0;
  for (const Mean& mean : means)
    squares += mean.samples * (mean.value - total / samples) * (mean.value - total / samples);
  if (variance == 0.0 && squares == 0.0) return {0.0, between, 1.0};
  if (variance == 0.0) return {std::numeric_limits<double>::infinity(), between, 0.0};
  const double chi_squared = squares / variance;
  return {chi_squared, between, gsl_cdf_fdist_Q(chi_squared / between, between, within)};
}

ReplicaSpread replica_spread(std::span<const std::vector<double>> replicas) { return replica_spread(views(replicas)); }

}  // namespace lucy::statistics
