// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where production begins, decided by the data: the cut that maximises the effective number of samples kept,
//     n_eff(cut) = (n - cut)/g(cut),     g the statistical inefficiency of what is kept
// (Chodera, J. Chem. Theory Comput. 12, 1799 (2016)). With g = V/s^2 (blocking.hpp) one has to say which variance s^2
// of a sample: that of the remainder itself would hide a transient, which inflates V and s^2 alike (an AR(1) series
// started 100 standard deviations away was then never cut). Here s^2 is that of the last half, a constant; so the cut
// minimises V(cut)/(n - cut), the squared error of the mean of what is kept, the bias from a transient included (White,
// Simulation 69, 323 (1997), with blocks of the right length). V(cut) comes from consecutive blocks that begin
// at the cut, as long as blocking.hpp chooses for the last half, at most a sixteenth of the series.
//
// Chance alone makes some cut look best. The logarithm of V from m - k blocks differs from that of all m by
// sqrt(2 k/(m (m - k))) standard, and a cut has to gain three times that. What stays undetected is small against the
// error: AR(1) series (phi = 0.9, relaxation time T, 2000 each) that start 3 to 100 standard deviations off keep a bias
// of at most 0.07 errors after the cut when they last 100 T and more, 0.2 at 30 T (uncut, at 100 T: 0.2 to 7); they are
// cut at 2 to 7 T when 100 T long, 5 to 10 T at 1000 T.
// The price: stationary series of 10, 30, 100, 300 T lose 4, 2.6, 2, 1 % of their length on average, a quarter or more
// in 7, 3, 0.7, 0.1 % of the cases, and one error then covers the truth in 0.614, 0.658, 0.637, 0.652 of them, against
// 0.660, 0.694, 0.653, 0.666 uncut (+-0.01).
#pragma once

#include <cstddef>
#include <span>

namespace lucy::statistics {

/// Samples to drop at the start of `series` (equal intervals, in order of time): 0 to half of them. Candidates lie at
/// (n/2)(j/64)^2, j = 0 to 64. 0 for fewer than 16 samples, and for a series that is constant to rounding.
std::size_t equilibration_cut(std::span<const double> series);

}  // namespace lucy::statistics
