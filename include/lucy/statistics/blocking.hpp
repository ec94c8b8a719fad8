// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The error of the mean of correlated samples, from the variance of block means (Flyvbjerg and Petersen, J. Chem. Phys.
// 91, 461 (1989)), with overlapping blocks, the leading bias removed, and the block length chosen from the data.
//
// With V(b) = b <(block mean - grand mean)^2> over all windows of b consecutive samples within a replica, divided by
// 1 - b/n (the grand mean is itself estimated; n counts the samples of all replicas), and V the limit that fixes the
// error of the mean, sqrt(V/n): V(b) = V (1 - tau/b) when correlations last for tau. Hence the "lugsail" combination
//     V ~ 2 V(b) - V(b/2)
// (Vats and Flegal, Biometrika 109, 735 (2022); as a lag window it is flat up to b/2 and falls to zero at b), whose
// bias is exponentially small, but never less than V(b). It rests on 0.75 (n_r/b - 1) degrees of freedom from a replica
// of n_r samples (measured on white noise: 6.5 for n_r/b = 10, 13.5 for 20), against 1.5 (n_r/b - 1) for V(b) alone.
// The statistical inefficiency is g = V/variance of one sample, and n/g the effective samples.
//
// Block length: the shortest b from which on every longer one obeys
//     b^3 > n g(b)^2 / 2,        b at most half of the shortest replica.
// The power law is that of Lee et al. (Phys. Rev. E 83, 066706 (2011): b^3 > 2 n g^2, which balances bias against
// noise); the prefactor is a quarter of theirs because the bias is gone. Asking it of all longer blocks too finds a
// slow component under fast noise. A block length must leave three effective samples: a series with fewer has hardly
// forgotten where it began. Where no b obeys all this, replicas get the error of the spread of their means (replicas -
// 1 degrees of freedom), V not less than V(b) of half the shortest replica, lest means that agree by chance pass for a
// small error: four replicas of any length, or two and three of at least 16 samples each. Others get none.
//
// Measured coverage of the true mean by one and two standard errors (Student's factor below ten degrees of freedom
// applied), stationary AR(1) series, relaxation time T = -1/ln phi, 4000 realisations each (2000 at 1000 T), so +-0.007
// and +-0.003; a Gaussian would have 0.683 and 0.954. Last column: mean error over true error.
//
//     length  replicas     phi = 0.5       phi = 0.9       phi = 0.98
//       10 T     1       0.733  0.929    0.660  0.875    0.651  0.876    1.07 - 1.26
//       10 T     4       0.734  0.946    0.709  0.937    0.715  0.939    1.14 - 1.15
//       30 T     1       0.701  0.933    0.694  0.923    0.695  0.921    1.12 - 1.19
//       30 T     4       0.687  0.945    0.693  0.943    0.699  0.938    1.04 - 1.05
//      100 T     1       0.690  0.939    0.653  0.932    0.671  0.930    1.01 - 1.02
//      100 T     4       0.685  0.946    0.681  0.944    0.684  0.950    1.00
//      300 T     1       0.681  0.949    0.666  0.954    0.671  0.949    1.00
//      300 T     4       0.673  0.959    0.691  0.956    0.672  0.956    1.00
//     1000 T     1       0.675  0.950    0.674  0.950    0.689  0.958    1.00
//     1000 T     4       0.692  0.948    0.688  0.948    0.692  0.956    1.00
//
// White noise of 200 to 2000 samples: 0.670-0.687 and 0.950-0.956. Errors below half of the true one: one in seven at
// 10 T with one replica (where one in fourteen is refused), one in a hundred with four; one in fifty at 30 T; none from
// 100 T on. Shorter than about 5 T a single replica cannot know how little it has seen: of 3 T one in four is refused
// and the others cover 0.46; four replicas cover 0.68-0.70 however short they are.
//
// Two and three replicas, phi = 0.98, 4000 realisations, Student's factor applied:
//
//     length  replicas     coverage
//      0.5 T     2        0.68  0.84
//      0.5 T     3        0.70  0.88
//        2 T     2        0.71  0.88
//        5 T     3        0.71  0.92
//       10 T     2        0.72  0.92
//       10 T     3        0.72  0.94
//
// For comparison V(b) alone at Lee's block length, phi = 0.9, one replica: 0.556 at 10 T (one in five refused), 0.656
// at 30 T, 0.660 at 100 T, errors 5 % too small at 100 T and 2 % at 1000 T.
#pragma once

#include <cstddef>
#include <span>

namespace lucy::statistics {

/// The mean of correlated samples with what its error rests on. When no error can be given: block_length 0; `error`,
/// `inefficiency` and `effective_samples` nan; no degrees of freedom. Without samples the mean is nan too.
struct Blocking {
  std::size_t block_length = 0;    ///< samples
  double inefficiency = 0.0;       ///< g: variance of the mean over that of as many independent samples
  double effective_samples = 0.0;  ///< samples/g, at most the samples
  double mean = 0.0;               ///< over all samples of all replicas
  double error = 0.0;              ///< one standard error, Student's factor not applied
  int degrees_of_freedom = 0;
};

/// One series, in the order of time at equal intervals. Needs at least 4 samples for an error. A series constant to
/// rounding (2 samples at least) has error 0 and g = 1.
Blocking automatic_blocking(std::span<const double> series);

/// Independent series of the same quantity at the same interval: one block length for all, deviations from the common
/// mean (so a replica that went elsewhere widens the error). Replicas may differ in length; empty ones do not count.
Blocking automatic_blocking(std::span<const std::span<const double>> replicas);

}  // namespace lucy::statistics
