// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/blocking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace lucy::statistics {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double fewest_effective_samples = 3.0;
// Replicas whose means alone give an error: so many, or two at least of so many samples each. Less is called too short.
constexpr std::size_t fewest_replicas = 4;
constexpr std::size_t fewest_samples_of_two = 16;

/// Running sums of the deviations from the grand mean, one list per replica: a block sum is one difference.
using RunningSums = std::vector<std::vector<double>>;

/// V(b) of the file comment. Windows start every b/8 samples: closer ones carry no further information.
double blocked_variance(const RunningSums& sums, std::size_t block, double samples) {
  const std::size_t stride = std::max<std::size_t>(1, block / 8);
  double squares = 0.0;
  std::size_t windows = 0;
  for (const std::vector<double>& sum : sums) {
    for (std::size_t start = 0; start + block < sum.size(); start += stride) {
      const double deviation = sum[start + block] - sum[start];
      squares += deviation * deviation;
      ++windows;
    }
  }
  const auto length = static_cast<double>(block);
  return squares / (static_cast<double>(windows) * length * (1.0 - length / samples));
}

Blocking without_error(double mean) { return {0, not_a_number, not_a_number, mean, not_a_number, 0}; }

// A long-run variance of zero would need a series that alternates exactly; that is no proof of a zero error, and the
// callers refuse it.
Blocking with_error(std::size_t block, double long_run_variance, double variance, double samples, double mean,
                    int degrees_of_freedom) {
  const double inefficiency = long_run_variance / variance;
  const double effective_samples = std::min(samples, samples / inefficiency);
  return {block, inefficiency, effective_samples, mean, std::sqrt(long_run_variance / samples), degrees_of_freedom};
}

/// The error of the grand mean from the means of replicas, each one block; means that agree by chance do not take it
/// below what half a replica says.
Blocking from_replica_means(const RunningSums& sums, double mean, double samples, double variance) {
  double squares = 0.0;
  std::size_t shortest = std::numeric_limits<std::size_t>::max();
  for (const std::vector<double>& sum : sums) {
    squares += sum.back() * sum.back();
    shortest = std::min(shortest, sum.size() - 1);
  }
  const auto replicas = static_cast<double>(sums.size());
  const double of_means = squares * replicas / ((replicas - 1.0) * samples);
  const double of_halves = blocked_variance(sums, std::max<std::size_t>(1, shortest / 2), samples);
  const double long_run_variance = std::max(of_means, of_halves);
  if (!(long_run_variance > 0.0)) return without_error(mean);
  return with_error(shortest, long_run_variance, variance, samples, mean, static_cast<int>(sums.size()) - 1);
}

}  // namespace

Blocking automatic_blocking(std::span<const double> series) {
  return automatic_blocking(std::span<const std::span<const double>>(&series, 1));
}

Blocking automatic_blocking(std::span<const std::span<const double>> replicas) {
  std::size_t count = 0, shortest = std::numeric_limits<std::size_t>::max(), replica_count = 0;
  double total = 0.0;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const std::span<const double> series : replicas) {
    if (series.empty()) continue;
    ++replica_count;
    count += series.size();
    shortest = std::min(shortest, series.size());
    for (const double value : series) {
      total += value;
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
  }
  if (count == 0) return without_error(not_a_number);
  const auto samples = static_cast<double>(count);
  const double mean = total / samples;
  if (!std::isfinite(mean)) return without_error(not_a_number);
  if (count < 2) return without_error(mean);
  constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
  if (highest - lowest <= rounding * std::max(std::abs(lowest), std::abs(highest)))
    return {1, 1.0, samples, lowest == highest ? lowest : mean, 0.0, static_cast<int>(count) - 1};

  RunningSums sums;
  sums.reserve(replica_count);
  double variance = 0.0;
  for (const std::span<const double> series : replicas) {
    if (series.empty()) continue;
    std::vector<double>& sum = sums.emplace_back();
    sum.reserve(series.size() + 1);
    double running = 0.0;
    sum.push_back(running);
    for (const double value : series) {
      variance += (value - mean) * (value - mean);
      running += value - mean;
      sum.push_back(running);
    }
  }
  variance /= samples - 1.0;

  // From the longest block down, as long as the criterion holds.
  std::vector<std::size_t> half_lengths;
  for (std::size_t half = 1; 4 * half <= shortest; half = std::max(half + 1, half * 6 / 5))
    half_lengths.push_back(half);
  std::size_t block = 0;
  double long_run_variance = 0.0;
  std::reverse(half_lengths.begin(), half_lengths.end());
  for (const std::size_t half : half_lengths) {
    const double whole_blocks = blocked_variance(sums, 2 * half, samples);
    const double half_blocks = blocked_variance(sums, half, samples);
    const double corrected = std::max(2.0 * whole_blocks - half_blocks, whole_blocks);
    const auto length = static_cast<double>(2 * half);
    const double inefficiency = corrected / variance;
    if (length * length * length <= 0.5 * samples * inefficiency * inefficiency) break;
    block = 2 * half;
    long_run_variance = corrected;
  }
  if (block > 0 && long_run_variance > 0.0) {
    const double blocks = samples / static_cast<double>(block) - static_cast<double>(sums.size());
    const int degrees_of_freedom = std::max(1, static_cast<int>(0.75 * blocks));
    const Blocking result = with_error(block, long_run_variance, variance, samples, mean, degrees_of_freedom);
    if (result.effective_samples >= fewest_effective_samples) return result;
  }
  // By count alone: if the means were judged by their own spread, those that agree by chance would pass.
  const bool by_means = sums.size() >= fewest_replicas || (sums.size() >= 2 && shortest >= fewest_samples_of_two);
  return by_means ? from_replica_means(sums, mean, samples, variance) : without_error(mean);
}

}  // namespace lucy::statistics
