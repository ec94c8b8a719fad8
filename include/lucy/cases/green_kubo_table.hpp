// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the replicas of one state recorded becomes its shear viscosity,
//
//     eta = (V/kT) int_0^cutoff C(t) dt,     C = 1/2 [<P_xy(0) P_xy(t)> + <D(0) D(t)>],     D = (P_xx - P_yy)/2
//
// (Green, J. Chem. Phys. 22, 398 (1954); Kubo, J. Phys. Soc. Jpn. 12, 570 (1957); Posch, Hoover and Kum, Sec. V), P the
// whole stress. Blocks of the replicas, correlated apart, give errors by the jackknife (jackknife.hpp).
//
// The cut-off is cutoff_in_decay_times times the decay time tau of C (decay.hpp), a rule that looks at C's decay and
// never at its integral: an exponential tail has exp(-6) = 0.25 % left there. The rule is applied again where a block
// is left out, so that the error knows that the cut-off is uncertain too. The values at half and twice the cut-off
// stand beside it; half leaves out 5 % of a tail. Without a decay time the integral runs over all lags and the status
// is short.
//
// A second estimate comes from the low-frequency end of the stress spectrum (spectrum_fit.hpp), with the error that the
// curvature of its likelihood gives: steadier than the jackknife, and there with one block already. Only the difference
// of both estimates, which rest on the same data, gets its error from the jackknife.
//
// Measured coverage of the true int C dt by one and two errors on synthetic stresses, Ornstein-Uhlenbeck processes of
// relaxation times 25 (a), 25 and 1 with variances 0.3 and 1 (b), 25 and 8 with equal variances (c), two components
// sampled every 0.2 and correlated to 400; 2000 realisations each (+-0.010), 500 to 800 of the longest. A Gaussian
// would have 0.683 and 0.954. Then mean error over true scatter, mean deviation in true scatters, and scatter relative
// to the truth. The spectrum of one exponential is taken too high, by a third of an error, as its constant cannot be
// less than nothing. Of 200 relaxation times (1 x 5000) one in fifty has no decay time:
//
//        replicas   integral to the cut-off              spectrum
//     a  1 x 5000    0.698 0.888  1.11  -0.02  24.3 %    0.734 0.969  1.04  +0.37  22.8 %
//     a  1 x 20000   0.662 0.929  1.00  +0.01  12.0 %    0.668 0.968  0.96  +0.35  11.1 %
//     a  8 x 2500    0.685 0.912  1.05  -0.02  11.7 %    0.699 0.971  0.92  +0.31  11.5 %
//     a  8 x 5000    0.657 0.926  0.97  +0.02   8.5 %    0.667 0.960  0.91  +0.31   7.9 %
//     a  8 x 20000   0.688 0.956  1.04  -0.06   4.0 %    0.704 0.966  1.07  +0.27   3.2 %
//     b  1 x 5000    0.696 0.890  1.13  -0.06  24.3 %    0.708 0.938  0.98  +0.27  24.2 %
//     b  1 x 20000   0.670 0.932  1.02  +0.03  12.1 %    0.685 0.954  0.95  +0.22  11.9 %
//     b  8 x 2500    0.693 0.924  1.05  -0.00  12.1 %    0.697 0.954  0.90  +0.19  12.4 %
//     b  8 x 5000    0.670 0.916  0.97  +0.01   8.6 %    0.661 0.952  0.89  +0.17   8.8 %
//     b  8 x 20000   0.704 0.940  1.01  -0.03   4.2 %    0.718 0.944  0.98  +0.07   3.8 %
//     c  1 x 5000    0.693 0.885  1.12  -0.05  23.0 %    0.682 0.931  0.94  +0.22  23.2 %
//     c  1 x 20000   0.685 0.929  1.02  -0.02  10.9 %    0.654 0.934  0.88  +0.14  11.9 %
//     c  8 x 2500    0.669 0.910  1.04  -0.05  11.0 %    0.672 0.927  0.85  +0.13  12.3 %
//     c  8 x 5000    0.657 0.922  0.96  -0.03   7.9 %    0.640 0.937  0.85  +0.07   8.5 %
//     c  8 x 20000   0.675 0.936  0.98  -0.13   3.9 %    0.646 0.916  0.91  -0.08   3.9 %
//
// Self-diffusion D = int <v_x(0) v_x(t)> dt and thermal conductivity lambda = V/(kT^2) int <J_x(0) J_x(t)> dt (averaged
// over x and y), each up to its own cut-off by the same rule. In two dimensions all three integrals grow without bound,
// as log t, once hydrodynamic long-time tails (C ~ 1/t) are reached; sound crosses a periodic box before that in small
// systems. They are numbers for this N and this cut-off, not for the thermodynamic limit.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/cases/couette_table.hpp"
#include "lucy/cases/green_kubo.hpp"
#include "lucy/cases/place_of.hpp"
#include "lucy/statistics/pooling.hpp"

namespace lucy::cases {

inline constexpr double cutoff_in_decay_times = 6.0;
/// A recording shorter than this many cut-offs per replica has status short.
inline constexpr double least_duration_in_cutoffs = 10.0;

/// The columns of viscosity.csv that have an error, in the order of the file. shear_modulus is V C(0)/kT.
inline constexpr std::array<std::string_view, 18> green_kubo_quantities = {
    "viscosity",           "viscosity_half_cutoff", "viscosity_twice_cutoff",
    "viscosity_spectrum",  "viscosity_kinetic",     "viscosity_cross",
    "viscosity_potential", "viscosity_xy",          "viscosity_difference",
    "decay_time",          "kinetic_temperature",   "pressure",
    "pressure_kinetic",    "pressure_potential",    "potential_energy",
    "shear_modulus",       "self_diffusion",        "thermal_conductivity"};

consteval std::size_t green_kubo_quantity(std::string_view name) { return place_of(green_kubo_quantities, name); }

/// One row of viscosity.csv (reduced units). What is not known is nan.
struct GreenKuboRow {
  double energy_per_particle = 0.0;
  std::int64_t particles = 0;
  std::array<statistics::Estimate, green_kubo_quantities.size()> estimates{};
  double spectrum_z = 0.0;  ///< (viscosity - viscosity_spectrum) in standard errors of that difference, by the
                            ///< jackknife: both come from the same data
  double cutoff = 0.0;      ///< time
  double self_diffusion_cutoff = 0.0;
  double thermal_conductivity_cutoff = 0.0;
  double decay_begin = 0.0;  ///< window of the decay fit
  double decay_end = 0.0;
  double spectrum_frequency = 0.0;  ///< highest (angular) that was fitted
  double spectrum_p_value = 0.0;
  int blocks = 0;  ///< over all replicas
  double step = 0.0;
  double sample_interval = 0.0;
  double duration = 0.0;  ///< recorded time per replica
  int replicas = 0;
  double energy_drift = 0.0;  ///< per particle, of the replica that drifted most, signed
  double largest_energy_error = 0.0;
  RowStatus status = RowStatus::ok;
  std::vector<std::string> warnings;  ///< one sentence each; not in viscosity.csv
  std::string failure;                ///< why, when status is failed
};

/// Correlation functions in the units of their transport coefficient, with errors (at fixed times; that of kT is not in
/// them).
struct Curve {
  std::vector<double> value;
  std::vector<double> error;
};

/// What stands in correlation.csv for one state; all curves on `time`. Multiplied by V/kT.
struct StressCurves {
  std::vector<double> time;
  Curve xy, difference, mean;          ///< C_xy, C_difference, their mean
  Curve integral;                      ///< running, of the mean
  std::vector<double> noise_envelope;  ///< one standard deviation of the running integral of pure noise: of the mean
                                       ///< of two independent components
  Curve noise_integral;                ///< running integral of <P_xy(0) D(t) + D(0) P_xy(t)>/2, a sample of such noise:
                                       ///< isotropy makes it zero
  Curve kinetic, cross, potential;     ///< the mean apart; empty when parts are not known
};

/// One of the further correlations: name "velocity velocity", "heat_flux heat_flux" or as asked for.
struct OtherCurve {
  std::string name;
  std::vector<double> time;
  Curve correlation;  ///< velocity: <v_x(0) v_x(t)>; heat flux: V/(kT^2) <J_x(0) J_x(t)>; others: V <a(0) b(t)> of the
                      ///< deviations from the means
  Curve integral;
};

struct GreenKuboResult {
  GreenKuboRow row;
  StressCurves curves;
  double decay_amplitude = 0.0;  ///< of the fit to curves.mean
  std::vector<OtherCurve> others;
};

/// Everything known of a state from what its replicas recorded.
GreenKuboResult summarize(const GreenKuboPoint& point, std::span<const GreenKuboRecord> replicas);

/// The row of a state that could not be finished.
GreenKuboRow failed_row(const GreenKuboPoint& point, std::string message);

/// The viscosity as known from the blocks that are complete so far; nan before there are two.
statistics::Estimate current_viscosity(const GreenKuboPoint& point, std::span<const GreenKuboRecord> replicas);

/// A stress series sampled elsewhere, and the state that it belongs to.
struct SampledSeries {
  std::vector<double> pxy;
  std::vector<double> stress_difference;  ///< (P_xx - P_yy)/2
  double sample_interval = 0.0;
  double volume = 0.0;
  double kinetic_temperature = 0.0;
  double length = 0.0;  ///< longest lag in time; 0: a fifth of the series, at most 400
  double cutoff = 0.0;  ///< 0: by the rule
};

/// The same estimators on such a series, in blocks of at least 2.5 times the longest lag, 16 at most: what needs more
/// than stresses is nan. Throws BadInput for an empty series, unequal lengths, or numbers at or below zero where they
/// must be above.
GreenKuboResult summarize_series(const SampledSeries& series);

}  // namespace lucy::cases
