// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/running_integral.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lucy::statistics {

std::vector<double> running_integral(std::span<const double> times, std::span<const double> values) {
  std::vector<double> integral(values.size(), 0.0);
  for (std::size_t j = 1; j < values.size(); ++j)
    integral[j] = integral[j - 1] + 0.5 * (values[j - 1] + values[j]) * (times[j] - times[j - 1]);
  return integral;
}

double value_at(std::span<const double> times, std::span<const double> values, double time) {
  if (values.empty() || !(time >= times.front() && time <= times.back()))
    return std::numeric_limits<double>::quiet_NaN();
  const auto after = static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), time) - times.begin());
  if (times[after] == time) return values[after];
  const double share = (time - times[after - 1]) / (times[after] - times[after - 1]);
  return (1.0 - share) * values[after - 1] + share * values[after];
}

std::vector<double> noise_envelope(std::span<const double> times, std::span<const double> values, double total_time) {
  const std::size_t points = values.size();
  if (points < 2) return std::vector<double>(points, 0.0);
  const double interval = times[1] - times[0];

  // C on both sides of zero, so that R is one sum of products.
  std::vector<double> even(2 * points - 1);
  for (std::size_t j = 0; j < points; ++j) even[points - 1 + j] = even[points - 1 - j] = values[j];
  std::vector<double> correlation(points, 0.0);
  for (std::size_t s = 0; s < points; ++s) {
    double sum = 0.0;
    for (std::size_t x = 0; x + s < even.size(); ++x) sum += even[x] * even[x + s];
    correlation[s] = sum * interval;
  }

  // The double integral over u and v is 2 int_0^t (t - s) R(s) ds: R integrated twice.
  const std::vector<double> once = running_integral(times, correlation);
  std::vector<double> envelope = running_integral(times, once);
  for (double& value : envelope) value = std::sqrt(std::max(0.0, 2.0 * value / total_time));
  return envelope;
}

}  // namespace lucy::statistics
