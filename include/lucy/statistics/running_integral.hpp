// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Integrals of correlation functions up to a time, and the noise that they collect on the way.
#pragma once

#include <span>
#include <vector>

namespace lucy::statistics {

/// I(t_j) = integral_0^{t_j} C dt by the trapezoidal rule, at every one of the increasing `times`; I(t_0) = 0.
std::vector<double> running_integral(std::span<const double> times, std::span<const double> values);

/// The value of a function given at increasing `times`, linear in between; nan beyond the last.
double value_at(std::span<const double> times, std::span<const double> values, double time);

/// One standard deviation of the running integral of pure noise: of the correlation function of two independent
/// Gaussian series of mean zero and length T (`total_time`), both with the autocorrelation function C,
///
///     Var I(t) = 1/T int_0^t du int_0^t dv R(u - v),     R(s) = int_{-inf}^{inf} C(x) C(x + s) dx.
///
/// It starts as t, and grows as 2 (int_0^inf C) sqrt(t/T) once t is beyond the decay of C. C is taken as zero beyond
/// its last time. `times` at equal intervals from 0.
std::vector<double> noise_envelope(std::span<const double> times, std::span<const double> values, double total_time);

}  // namespace lucy::statistics
