// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Errors of what is computed from averages over independent blocks, by leaving out one block at a time (Quenouille and
// Tukey; Efron, The Jackknife, the Bootstrap and Other Resampling Plans, SIAM (1982)):
//
//     theta_(b): the result without block b       error^2 = (B - 1)/B sum_b (theta_(b) - mean of theta_(b))^2
//
// with B - 1 degrees of freedom, Student's factor below ten (pooling.hpp). For a plain mean of equal blocks this is the
// usual error of the mean.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "lucy/statistics/pooling.hpp"

namespace lucy::statistics {

/// Means over blocks of weights w_b (their lengths): of all of them, or of all but one.
class BlockAverages {
 public:
  /// `blocks[b]` are the numbers of block b, all equally many; weights above zero.
  BlockAverages(std::vector<std::vector<double>> blocks, std::vector<double> weights);

  std::size_t blocks() const { return blocks_.size(); }
  std::size_t numbers() const;
  std::vector<double> mean() const;
  std::vector<double> mean_without(std::size_t block) const;
  /// Standard error of every mean (Student's factor applied); nan with fewer than 2 blocks.
  std::vector<double> errors() const;

 private:
  std::vector<std::vector<double>> blocks_;
  std::vector<double> weights_;
  std::vector<double> sum_;
  double total_ = 0.0;
};

/// `of_all` with the jackknife error of the values that leave out one block (nan among them, or fewer than two: no
/// error). effective_samples is the number of blocks.
Estimate jackknife(double of_all, std::span<const double> leaving_out_one);

/// The same from a function of the index left out; blocks() itself stands for none left out.
Estimate jackknife(std::size_t blocks, const std::function<double(std::size_t)>& leaving_out);

}  // namespace lucy::statistics
