// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Replicas become one value with one error: blocks of all replicas pooled about the common mean (blocking.hpp), and a
// check whether the replicas scatter as their own errors say.
#pragma once

#include <span>
#include <vector>

#include "lucy/statistics/blocking.hpp"

namespace lucy::statistics {

/// A mean with its uncertainty: value +- error covers the truth 68.27 times in a hundred.
struct Estimate {
  double value = 0.0;
  double error = 0.0;              ///< one standard error; nan when none could be given
  double effective_samples = 0.0;  ///< nan when no error could be given
  int degrees_of_freedom = 0;      ///< that the error rests on
};

/// The number of standard errors within which 68.27 % of Student's distribution lie, below ten degrees of freedom;
/// 1 from there on (it would be 1.053 at ten). nan for no degrees of freedom.
double student_factor(int degrees_of_freedom);

/// The mean over all samples of all replicas (independent series at the same interval, equilibration removed), with
/// Student's factor applied. Too short for an error by the rules of blocking.hpp: error nan. No samples: value nan too.
Estimate pooled_mean(std::span<const std::span<const double>> replicas);
Estimate pooled_mean(std::span<const std::vector<double>> replicas);

/// Whether replicas agree: chi_squared = sum over replicas of (replica mean - grand mean)^2 / (V/n_r), V the mean (by
/// length) of what each replica says alone about its own long-run variance. As V has errors of its own, the p-value
/// (the probability of a larger chi_squared by chance) is that of Fisher's F = chi_squared/degrees_of_freedom with all
/// the replicas' degrees of freedom in the denominator; for many it is the usual one.
struct ReplicaSpread {
  double chi_squared = 0.0;    ///< nan when it cannot be given
  int degrees_of_freedom = 0;  ///< replicas - 1
  double p_value = 0.0;        ///< nan when it cannot be given

  /// Then the error bars are not to be believed.
  bool contradicts_errors() const { return p_value < 1e-3; }
};

/// nan for fewer than two replicas, or when none has an error of its own.
ReplicaSpread replica_spread(std::span<const std::span<const double>> replicas);
ReplicaSpread replica_spread(std::span<const std::vector<double>> replicas);

}  // namespace lucy::statistics
