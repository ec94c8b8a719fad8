// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rival forms of decay_forms.hpp fitted to the mean of replicas, their parameters with jackknife errors over
// replicas, and which of them the replicas speak for.
//
// By likelihood, each form predicting what it has not seen: it is fitted to the mean of the other R - 1 replicas, and
// replica r is scored by a Gaussian about that curve f_(r),
//
//     log L_r = - 1/(2 g v) sum_i [a_r(t_i) - f_(r)(t_i)]^2,     v = sigma^2 (1 + 1/(R - 1)),
//
// less a constant. sigma^2 is the variance of the replicas about their mean, pooled over all times; the second term of
// v stands for the uncertainty of the mean that f_(r) was fitted to. g is the statistical inefficiency of the
// deviations from the mean (blocking.hpp), at least 1: where noise outlasts the sampling interval, n samples tell the
// difference of two smooth curves as n/g independent ones would. The difference of two forms is the sum over replicas,
// sum_r (log L_r of one - log L_r of the other), its error R^(1/2) times the standard deviation of the summands.
//
// Rule: the simplest form that is not worse than the best one by more than two errors of the difference is preferred;
// of the two forms of three parameters, the better. v and g scale a difference and its error alike, so the choice does
// not hang on them. The rule asks for much: a third parameter that stands z of its errors from nothing gains about
// z^2/2, with an error of about z, and wins from z = 4 on. So an exponential that is preferred is not thereby
// right: look at its residual_over_error and at the richer forms' parameters with their errors. Measured on waves with
// a0 = 1, G = 0.05, 200 samples at interval 0.5, AR(1) noise, 200 realisations each:
//
//     exponential; noise of standard deviation 0.05 and 0.2, relaxation time 0.5, 5, 20; 4, 8, 16 replicas
//         a richer form is preferred in 0 to 4 %; one error of G covers the truth in 0.61 to 0.78
//     yielding, s = 0.02, 0.05, 0.1, 0.3; noise 0.05, relaxation time 5, 8 replicas
//         yielding is preferred in 6, 22, 42, 82 %; its G is covered in 0.66 to 0.72, c in 0.65 to 0.70;
//         the exponential's G is covered in 0.14 of the cases for s = 0.02, never from s = 0.05 on
//     viscoelastic, G tau = 0.05, 0.1, 0.25, 1; the same noise
//         viscoelastic is preferred in 4, 18, 96, 100 %; its G is covered in 0.62 to 0.70, tau in 0.60 to 0.70
//
// No likelihood comes from fewer than 4 replicas, nor from replicas that agree to 1e-9 of a(0), as those of a run
// without noise do: then the simplest form is preferred whose rms residual is at most twice that of the best, or below
// 1e-6 of a(0).
#pragma once

#include <array>

#include "lucy/statistics/decay_forms.hpp"
#include "lucy/statistics/pooling.hpp"
#include "lucy/statistics/wave_decay.hpp"

namespace lucy::statistics {

/// Parameters as in DecayParameters; those that the form does not have are nan. On its bound (c = 0, tau = 0) a
/// parameter's jackknife error tells how often leaving out a replica takes it off, and is not to be trusted.
struct FormFit {
  DecayForm form = DecayForm::exponential;
  DecayParameters parameters;  ///< of the mean of all replicas, for drawing the curve
  Estimate amplitude;          ///< a0
  Estimate rate;               ///< G, per time
  Estimate deceleration;       ///< c = G s, in the unit of a per time
  Estimate yield_amplitude;    ///< s, in the unit of a
  Estimate memory_time;        ///< tau
  /// (G/tau)^(1/2), radians per time; infinite without memory, no error where that is so with a replica left out.
  Estimate natural_frequency;
  double relative_residual = 0.0;  ///< rms of mean curve - fit, in units of the fitted a0
  /// The same in units of sigma/R^(1/2): well above 1 where the form is wrong; nan for a single replica.
  double residual_over_error = 0.0;
};

FormFit fit_form(const DecayingWave& wave, DecayForm form);

/// The log-likelihood of `first` less that of `second`, of all replicas together.
struct FormDifference {
  DecayForm first = DecayForm::exponential;
  DecayForm second = DecayForm::exponential;
  Estimate log_likelihood;  ///< nan without a comparison by likelihood
};

struct DecayComparison {
  std::array<FormFit, decay_forms.size()> fits;  ///< in the order of decay_forms
  /// Exponential - yielding, exponential - viscoelastic, yielding - viscoelastic.
  std::array<FormDifference, 3> differences;
  DecayForm preferred = DecayForm::exponential;
  bool by_likelihood = false;  ///< or else by residuals
  double noise = 0.0;          ///< sigma, in the unit of a; nan for a single replica
  double inefficiency = 0.0;   ///< g; nan without a comparison by likelihood
};

DecayComparison compare_decay_forms(const DecayingWave& wave);

}  // namespace lucy::statistics
