// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The integral of a correlation function from the low-frequency end of the power spectrum: S(0) = 2 int_0^inf C dt.
// Model: a Lorentzian on a constant,
//
//     S(omega) = b + a (Lorentzian of relaxation time tau),     a, b >= 0,
//
// an exponential tail of C above faster parts, which are flat at low frequencies. Of a finite series of S samples at
// interval dt the mean periodogram of an exponential C is known in closed form, discreteness and leakage included: with
// phi = exp(-dt/tau), z = phi exp(-i omega_k dt), omega_k a Fourier frequency,
//
//     E I_k = Re[(1 + z)/(1 - z)] - (2/S) Re[z (1 - phi^S)/(1 - z)^2]        for C(k) = phi^|k|
//
// so no bias comes from short segments. Ordinates averaged over m spectra follow a Gamma distribution of shape m_k = m
// (m/2 at omega = 0, a real number squared) about that mean: the parameters maximise its likelihood (Whittle, Ark. Mat.
// 2, 423 (1953)),
//
//     -log L = sum_k m_k [ I_k/S_k + log S_k ],        0 <= omega_k <= omega_max,
//
// omega_max = spectrum_reach/tau, found by repeating the fit until both agree, but at least ten ordinates. The mean of
// the series is known to be zero; if it was taken off (I_0 = 0), omega = 0 is left out. a or b may come out as nothing.
// A half width below the lowest frequency, omega_1 tau > 1, is called no fit.
//
// Coverage of the error that the curvature gives, and the bias, are in cases/green_kubo_table.hpp. The reach is a
// compromise: a constant has to stand for all that is faster than the tail. With two relaxation times of 25 and 8 in
// equal parts, 16 blocks, one error covers the truth in 0.65 of the cases with reach 2, 0.59 with 2.5, 0.52 with 3;
// with one relaxation time the scatter is 0.075, 0.066, 0.063 of the value.
#pragma once

#include <cstddef>
#include <span>

namespace lucy::statistics {

inline constexpr double spectrum_reach = 2.0;  ///< omega_max tau

struct LorentzianFit {
  double integral = 0.0;           ///< int_0^inf C dt = S(0)/2, in (unit of x)^2 times time; nan when no fit was found
  double integral_error = 0.0;     ///< from the curvature of the likelihood
  double relaxation_time = 0.0;    ///< tau
  double background = 0.0;         ///< the part of `integral` that comes from b
  double highest_frequency = 0.0;  ///< omega_max, per time
  int ordinates = 0;
  double p_value = 0.0;  ///< of the deviance against the model: small when the spectrum has another shape
};

/// `power`: I_k, k = 0 ... (measure::Spectrum); `spectra`: m; `interval`: dt; `segment`: S.
LorentzianFit fit_lorentzian(std::span<const double> power, std::size_t segment, double spectra, double interval);

/// The same with omega_max held fixed and started from another fit, for jackknife samples; none when that
/// was none.
LorentzianFit refit_lorentzian(std::span<const double> power, std::size_t segment, double spectra, double interval,
                               const LorentzianFit& like);

}  // namespace lucy::statistics
