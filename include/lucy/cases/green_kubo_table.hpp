// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the replicas of one state recorded becomes its shear viscosity,
//
//     eta = (V/kT) int_0^cutoff C(t) dt,     C = 1/2 [<P_xy(0) P_xy(t)> + <D(0) D(t)>],     D = (P_xx - P_yy)/2
//
// (Green, J. Chem. Phys. 22, 398 (1954); Kubo, J. Phys. Soc. Jpn. 12, 570 (1957); Posch, Hoover and Kum, Sec. V), P the
// whole stress. Blocks of the replicas, correlated apart, give every error by the jackknife.
//
// The cut-off is cutoff_in_decay_times times the decay time tau of C (decay.hpp), a rule that looks at C's decay and
// never at its integral: an exponential tail has exp(-6) = 0.25 % left there. The values at half and twice the cut-off
// stand beside it. A second estimate comes from the low-frequency end of the stress spectrum (spectrum_fit.hpp).
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

consteval std::size_t green_kubo_quantity(std::string_view name) {
  for (std::size_t i = 0; i < green_kubo_quantities.size(); ++i)
    if (green_kubo_quantities[i] == name) return i;
  throw "no such quantity";
}

/// One row of viscosity.csv (reduced units). What is not known is nan.
struct GreenKuboRow {
  double energy_per_particle = 0.0;
  std::int64_t particles = 0;
  std::array<statistics::Estimate, green_kubo_quantities.size()> estimates{};
  double spectrum_z = 0.0;   ///< (viscosity - viscosity_spectrum) in standard errors of that difference, by the
                             ///< jackknife: both come from the same data
  double cutoff = 0.0;       ///< time
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

/// Correlation functions in the units of their transport coefficient, with errors.
struct Curve {
  std::vector<double> value;
  std::vector<double> error;
};

/// What stands in correlation.csv for one state; all curves on `time`. Multiplied by V/kT.
struct StressCurves {
  std::vector<double> time;
  Curve xy, difference, mean;          ///< C_xy, C_difference, their mean
  Curve integral;                      ///< running, of the mean
  std::vector<double> noise_envelope;  ///< one standard deviation of the running integral of pure noise
  Curve noise_integral;                ///< running integral of <P_xy(0) D(t)>, which isotropy makes zero
  Curve kinetic, cross, potential;     ///< the mean apart; empty when parts are not known
};

/// One of the further correlations: name "velocity velocity", "heat_flux heat_flux" or as asked for.
struct OtherCurve {
  std::string name;
  std::vector<double> time;
  Curve correlation;  ///< velocity: <v_x(0) v_x(t)>; heat flux: V/(kT^2) <J_x(0) J_x(t)>; others: V <a(0) b(t)>
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

/// The same estimators on such a series: what needs more than stresses is nan. Throws BadInput for an empty series,
/// unequal lengths, or numbers at or below zero where they must be above.
GreenKuboResult summarize_series(const SampledSeries& series);

}  // namespace lucy::cases
