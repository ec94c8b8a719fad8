// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The exponential tail of a correlation function, C(t) = A exp(-t/tau), fitted by least squares (GSL) over a window
// that is stated in units of the result,
//
//     window_begin tau <= t <= window_end tau,
//
// found by repeating the fit until window and tau agree. The window starts after the fast part of C and ends while C
// still stands above its noise. What is made least is the integral of (C - A exp(-t/tau))^2 over the window, so that
// the spacing of the lags does not matter; errors of C hardly depend on t there, and are not asked for. Points of C at
// different lags move together: the fit's own covariance is of no use, and errors of A and tau come from repeating it
// on jackknife samples.
#pragma once

#include <span>

namespace lucy::statistics {

inline constexpr double decay_window_begin = 0.5;
inline constexpr double decay_window_end = 3.0;

struct ExponentialDecay {
  double amplitude = 0.0;  ///< A; nan when no fit was found
  double time = 0.0;       ///< tau, in the unit of `times`; nan when no fit was found
  double begin = 0.0;      ///< window
  double end = 0.0;
  int points = 0;  ///< in the window
};

/// `times` increasing from 0, `values` C there. nan results when C(0) is not positive, when C does not decay within
/// `times`, or when fewer than 4 points lie in the window.
ExponentialDecay fit_decay(std::span<const double> times, std::span<const double> values);

/// The same with the window held fixed.
ExponentialDecay fit_decay_in_window(std::span<const double> times, std::span<const double> values, double begin,
                                     double end);

}  // namespace lucy::statistics
