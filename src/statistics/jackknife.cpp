// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/statistics/jackknife.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace lucy::statistics {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

BlockAverages::BlockAverages(std::vector<std::vector<double>> blocks, std::vector<double> weights)
    : blocks_(std::move(blocks)), weights_(std::move(weights)), sum_(numbers(), 0.0) {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    total_ += weights_[b];
    for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += weights_[b] * blocks_[b][i];
  }
}

std::size_t BlockAverages::numbers() const { return blocks_.empty() ? 0 : blocks_.front().size(); }

std::vector<double> BlockAverages::mean() const {
  std::vector<double> result = sum_;
  for (double& value : result) value /= total_;
  return result;
}

std::vector<double> BlockAverages::mean_without(std::size_t block) const {
  std::vector<double> result = sum_;
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = (result[i] - weights_[block] * blocks_[block][i]) / (total_ - weights_[block]);
  return result;
}

std::vector<double> BlockAverages::errors() const {
  std::vector<double> result(numbers(), not_a_number);
  const std::size_t count = blocks();
  if (count < 2) return result;
  // The jackknife in two passes, so that not all the means without one block need be kept.
  std::vector<double> mean_of_means(numbers(), 0.0), squares(numbers(), 0.0);
  for (std::size_t b = 0; b < count; ++b) {
    const std::vector<double> without = mean_without(b);
    for (std::size_t i = 0; i < without.size(); ++i) mean_of_means[i] += without[i] / static_cast<double>(count);
  }
  for (std::size_t b = 0; b < count; ++b) {
    const std::vector<double> without = mean_without(b);
    for (std::size_t i = 0; i < without.size(); ++i)
      squares[i] += (without[i] - mean_of_means[i]) * (without[i] - mean_of_means[i]);
  }
  const auto blocks = static_cast<double>(count);
  const double factor = student_factor(static_cast<int>(count) - 1);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = factor * std::sqrt((blocks - 1.0) / blocks * squares[i]);
  return result;
}

Estimate jackknife(double of_all, std::span<const double> leaving_out_one) {
  const std::size_t count = leaving_out_one.size();
  Estimate result{of_all, not_a_number, not_a_number, 0};
  if (count < 2) return result;
  const auto blocks = static_cast<double>(count);
  double mean = 0.0, squares = 0.0;
  for (const double value : leaving_out_one) mean += value / blocks;
  for (const double value : leaving_out_one) squares += (value - mean) * (value - mean);
  if (!std::isfinite(of_all) || !std::isfinite(squares)) return result;
  const int degrees_of_freedom = static_cast<int>(count) - 1;
  result.error = student_factor(degrees_of_freedom) * std::sqrt((blocks - 1.0) / blocks * squares);
  result.effective_samples = blocks;
  result.degrees_of_freedom = degrees_of_freedom;
  return result;
}

Estimate jackknife(std::size_t blocks, const std::function<double(std::size_t)>& leaving_out) {
  std::vector<double> leaving_out_one;
  if (blocks >= 2)
    for (std::size_t b = 0; b < blocks; ++b) leaving_out_one.push_back(leaving_out(b));
  return jackknife(leaving_out(blocks), leaving_out_one);
}

}  // namespace lucy::statistics
