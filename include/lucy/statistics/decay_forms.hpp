// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rival forms of a decaying amplitude a(t), and their fits by least squares to the amplitude itself: its logarithm
// would give weight to the noise of the tail, and has no place for curves that cross zero.
//
// A transverse wave v_x = a(t) sin(k y) in a fluid at rest obeys rho a' = -k sigma(t), sigma the amplitude of the shear
// stress against a strain rate of amplitude k a. Three laws for the stress make three forms; a0 is free in all of them.
//
//   exponential    Newton, sigma = eta k a, with G = eta k^2/rho:
//
//                      a' = -G a                         a = a0 exp(-G t)
//
//   yielding       Bingham's solid, which besides the viscous stress opposes any flow by a constant one. With c = G s
//                  the deceleration that the constant stress alone would give,
//
//                      a' = -G (a + s) = -G a - c        a = (a0 + s) exp(-G t) - s          G, c >= 0
//
//                  as long as a > 0; where that expression reaches zero, at t = log(1 + a0/s)/G, the flow stops and a
//                  stays zero. It decays the faster for its amplitude the smaller the amplitude is. G = 0 (s infinite)
//                  is the purely plastic straight line a0 - c t. (For a0 < 0 the same with all signs turned.)
//
//   viscoelastic   Maxwell's fluid, whose stress takes the time tau to follow: tau sigma' + sigma = eta k a. With
//                  a'(0) = 0, since no stress has built up yet,
//
//                      a'' + a'/tau + (G/tau) a = 0      a = a0 exp(-t/2 tau) [C + (t/2 tau) S]
//                      C = cosh(q t/2 tau), S = sinh(q t/2 tau)/(q t/2 tau), q^2 = 1 - 4 G tau
//
//                  C and S are power series in q^2, hence smooth through critical damping, 4 G tau = 1, beyond which
//                  the wave rings. tau -> 0 is the exponential. It stands for atoms whose mean free path is not small
//                  against the wave, and for lattices, whose shear modulus is G rho/(tau k^2).
//
// Their integrals over all times follow from integrating the equations: a0/G for the exponential and the viscoelastic
// form, whatever tau is, and a0/G - s log(1 + a0/s)/G for the yielding one.
//
// Both richer forms hold the exponential, as c = 0 and tau = 0: where the least squares lie there, or beyond, the fit
// is the exponential. Squares are minimised by Levenberg and Marquardt's method (GSL) from several starts.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace lucy::statistics {

/// From the simplest on.
enum class DecayForm { exponential, yielding, viscoelastic };

inline constexpr std::array decay_forms = {DecayForm::exponential, DecayForm::yielding, DecayForm::viscoelastic};

/// The word for it in tables: "exponential", "yielding", "viscoelastic".
std::string_view name(DecayForm form);

/// Parameters of any form; what a form does not have is zero.
struct DecayParameters {
  double amplitude = 0.0;     ///< a0, in the unit of a
  double rate = 0.0;          ///< G, per time; negative when a grows
  double deceleration = 0.0;  ///< c, in the unit of a per time: yielding
  double memory_time = 0.0;   ///< tau: viscoelastic

  /// s = c/G, the amplitude at which yield and viscosity oppose the flow alike; infinite for G = 0.
  double yield_amplitude() const;
  /// (G/tau)^(1/2), at which a wave of little damping rings; infinite without memory.
  double natural_frequency() const;
};

/// a(t) of the file comment, t >= 0 (for the exponential any t).
double decay_form(DecayForm form, const DecayParameters& parameters, double time);

/// The parameters of least squares. `times` and finite `values` there, at least 4 of them; times increase from 0 (for
/// the exponential from anywhere).
DecayParameters fit_decay_form(DecayForm form, std::span<const double> times, std::span<const double> values);

/// The same, started from the parameters of a curve that is much like this one: for jackknife samples.
DecayParameters refit_decay_form(DecayForm form, std::span<const double> times, std::span<const double> values,
                                 const DecayParameters& like);

}  // namespace lucy::statistics
