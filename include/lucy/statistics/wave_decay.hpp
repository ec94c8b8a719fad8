// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What independent replicas of a decaying wave say without a form assumed for it: the mean curve, the local rate of
// decay, and the rate by the integral. Noise within a replica is correlated in time, replicas are independent: every
// error is the scatter over replicas, by leaving out one at a time (jackknife.hpp), Student's factor included. A single
// replica gives values without errors (nan). No logarithm of an amplitude is ever taken.
//
// Local rate -a'(t)/a(t): windows reach from where the mean curve falls below one level, a fraction of a(0), to where
// it falls below the next. Noise crosses a level many times; a window ends after as many samples as lie above its level
// before the curve first reaches the next one, which favours neither the first crossing nor the last, and leaves out
// the later swings of a curve that rings. In every window A exp(-G (t - t_centre)) is fitted by least squares: A is the
// amplitude at the centre, G the rate. Levels below three errors of the mean curve (rms over all times) are not
// looked for: windows that noise ends had rates too small by a third to all of G. One error covers the truth in 0.60 to
// 0.73 of the cases, window by window; noise at a level still makes the last window's rate 1 to 6 % too small, a fifth
// of its error (exp(-t/20), 200 samples at interval 0.5, AR(1) noise of standard deviation 0.05 and relaxation times
// 0.5, 5 and 20; 4, 8 and 16 replicas; 400 realisations of each).
//
// By the integral: G = a(0)/integral_0^inf a dt, the rate of the exponential of equal area; of a Maxwell fluid that
// is G itself, whatever its memory (decay_forms.hpp). The integral goes to the last time T by the trapezoidal rule
// (which makes the rate of an exponential too small by (G interval)^2/12 of itself); the tail beyond it is A/G of the
// exponential fitted to all that follows after the curve has first fallen to half of a(0), or to the last half of the
// record if that is longer, A being its amplitude at T. Where the curve has long reached its noise this tail is
// nothing, without a decision that would bias the integral. Coverage in the cases above: 0.62 to 0.72; with records of
// T = 0.3/G to 30/G (8 replicas, standard deviation 0.05): 0.66 to 0.73, the error of the rate being 16 % and the
// tail's share 0.74 at 0.3/G, 5 % and 0.37 at 1/G, 3 % and 0.05 at 3/G.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "lucy/statistics/jackknife.hpp"
#include "lucy/statistics/pooling.hpp"

namespace lucy::statistics {

/// Amplitudes of one wave in independent replicas at the same times 0, interval, 2 interval ...
class DecayingWave {
 public:
  /// amplitudes[r][i]: replica r at time i interval, all of the same length, at least 8. Throws std::invalid_argument
  /// for anything else, and for amplitudes that are not finite.
  DecayingWave(double interval, std::vector<std::vector<double>> amplitudes);

  std::size_t replicas() const { return amplitudes_.size(); }
  std::size_t samples() const { return times_.size(); }
  const std::vector<double>& times() const { return times_; }
  const std::vector<double>& amplitude(std::size_t replica) const { return amplitudes_[replica]; }
  /// The mean over all replicas but one; replicas() itself stands for none left out.
  std::vector<double> mean_without(std::size_t replica) const;
  std::vector<double> mean() const { return mean_without(replicas()); }
  /// Standard error of the mean at every time.
  std::vector<double> errors() const;

 private:
  std::vector<double> times_;
  std::vector<std::vector<double>> amplitudes_;
  BlockAverages averages_;
};

/// The mean over replicas at every time, with its standard error.
struct ReplicaMeanCurve {
  std::vector<double> times, mean, error;
};

ReplicaMeanCurve replica_mean_curve(const DecayingWave& wave);

/// Fractions of a(0) at which windows end; the first window begins at t = 0.
inline constexpr std::array window_levels = {0.8, 0.6, 0.4, 0.2, 0.1, 0.05};

struct LocalRate {
  double begin = 0.0;  ///< times of the first and the last sample of the window
  double end = 0.0;
  double time = 0.0;   ///< its centre
  Estimate amplitude;  ///< there
  Estimate rate;       ///< -a'/a there, per time
};

/// `levels` fall from below 1 and stay above 0, or else std::invalid_argument. A curve that does not reach the next
/// level has a last window that ends with the record. Windows of fewer than 4 samples are joined with the next; windows
/// whose amplitude is below three of its errors are left out. None for a curve that does not begin above zero.
std::vector<LocalRate> local_rates(const DecayingWave& wave, std::span<const double> levels = window_levels);

struct IntegralRate {
  Estimate rate;        ///< a(0)/integral_0^inf a dt, per time
  Estimate tail_share;  ///< of the integral that comes from beyond the last time
};

/// nan for a curve that does not begin above zero, whose late part does not decay (a rate below two of its errors), or
/// that still rings at the end: goes below -0.05 a(0) and -5 errors in the last half of its time.
/// `initial_amplitude`: a(0) where it is known exactly, as when it was imposed; else the mean curve's first value.
IntegralRate integral_rate(const DecayingWave& wave, std::optional<double> initial_amplitude = {});

}  // namespace lucy::statistics
