// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/equilibration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lucy/statistics/blocking.hpp"

namespace lucy::statistics {

namespace {

constexpr std::size_t fewest_samples = 16;
constexpr std::size_t fewest_blocks = 16;
constexpr std::size_t candidates = 64;
constexpr double required_deviations = 3.0;

/// Sum of squared deviations of the sums of `count` consecutive blocks from their mean.
double block_squares(std::span<const double> running_sum, std::size_t start, std::size_t block, std::size_t count) {
  const double mean = (running_sum[start + count * block] - running_sum[start]) / static_cast<double>(count);
  double squares = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double deviation = running_sum[start + (i + 1) * block] - running_sum[start + i * block] - mean;
    squares += deviation * deviation;
  }
  return squares;
}

}  // namespace

std::size_t equilibration_cut(std::span<const double> series) {
  const std::size_t n = series.size();
  if (n < fewest_samples) return 0;
  const Blocking last_half = automatic_blocking(series.subspan(n / 2));
  if (last_half.error == 0.0 && automatic_blocking(series).error == 0.0) return 0;
  if (!std::isfinite(last_half.mean)) return 0;

  // A last half that allows no error is still relaxing or all correlated: the longest block is the best there is.
  const std::size_t longest = n / fewest_blocks;
  const std::size_t block = last_half.block_length == 0 ? longest : std::min(last_half.block_length, longest);
  std::vector<double> running_sum(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) running_sum[i + 1] = running_sum[i] + (series[i] - last_half.mean);

  const double all_blocks = static_cast<double>(n) / static_cast<double>(block);
  std::size_t best = 0;
  double best_score = -std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j <= candidates; ++j) {
    const std::size_t cut = n * j * j / (2 * candidates * candidates);
    const std::size_t count = (n - cut) / block;
    const double variance = block_squares(running_sum, cut, block, count) / static_cast<double>(count - 1);
    const double dropped = std::max(1.0, static_cast<double>(cut) / static_cast<double>(block));
    const double by_chance = cut == 0 ? 0.0 : std::sqrt(2.0 * dropped / (all_blocks * (all_blocks - dropped)));
    const double score = std::log(static_cast<double>(n - cut) / variance) - required_deviations * by_chance;
    if (score > best_score) {
      best_score = score;
      best = cut;
    }
  }
  return best;
}

}  // namespace lucy::statistics
