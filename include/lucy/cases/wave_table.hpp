// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the replicas of a decaying wave recorded becomes one row of shear_wave.csv or temperature_wave.csv. Values are
// diffusivities: kinematic viscosities nu, or thermal diffusivities D_T. Errors are the scatter over replicas
// (jackknife, Student's factor included).
//
// By parts, from the start to the time T at which the mean amplitude falls below 5 % of its start (or two of its
// errors):
//
//     total      (a(0) - a(T))/(k^2 int a dt)
//     operator   -int (its part of da/dt) dt/(k^2 int a dt)
//     carried    likewise
//     rest       total - operator - carried: of pressure forces (shear), of heating and compression (temperature)
//
// The rest is what is left, not the integral of its own part: that one swings with every vibration of the particles,
// faster than it is sampled. By the integral over all times: a(0)/(k^2 int_0^inf a dt), a(0) what was imposed
// (statistics/wave_decay.hpp). Locally: the rate of decay in windows of the amplitude. By rival forms fitted to the
// amplitude (statistics/decay_forms.hpp), of whose parameters
//
//     G                  the diffusivity G/k^2
//     c = G s            a yield stress sigma_y = pi rho c/(4 k): Bingham's stress eta du/dy + sigma_y sign(du/dy) in
//                        rho dv/dt = d sigma/dy, projected on sin(k y), gives rho a' = -eta k^2 a - (4/pi) k sigma_y
//     tau, (G/tau)^1/2   Maxwell's relaxation time, and his modulus eta/tau = rho G/(k^2 tau)
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/cases/couette_table.hpp"
#include "lucy/cases/place_of.hpp"
#include "lucy/cases/wave.hpp"
#include "lucy/statistics/decay_forms.hpp"
#include "lucy/statistics/pooling.hpp"

namespace lucy::cases {

inline constexpr double parts_end_at = 0.05;        ///< of the amplitude at the start,
inline constexpr double parts_end_at_errors = 2.0;  ///< or so many errors of the mean

/// The columns that have an error, in the order of the file. `rest` is written as rest_name(). `operator_factor`: the
/// operator's rate at the start over that of the constitutive law (eta/rho; kappa/(rho c_V), as the density is uniform
/// still). `tail_share`: of the integral from beyond the record.
/// `fitted`: G/k^2 of the preferred form. `yield_stress` of the yielding form, `modulus` and `relaxation_time` of the
/// viscoelastic one, preferred or not; those of momentum only. `particle_noise` and `pressure` are means up to T.
inline constexpr std::array<std::string_view, 13> wave_quantities = {
    "operator_factor", "operator",     "rest",    "carried",         "total",          "integral", "tail_share",
    "fitted",          "yield_stress", "modulus", "relaxation_time", "particle_noise", "pressure"};

consteval std::size_t wave_quantity(std::string_view name) { return place_of(wave_quantities, name); }

/// "pressure_forces", or "heating" of temperature waves.
std::string_view rest_name(WaveQuantity quantity);

/// One row of the results (reduced units). What is not known is nan.
struct WaveRow {
  WavePoint settings;
  double wave_vector = 0.0;
  double sample_interval = 0.0;
  double prescribed = 0.0;         ///< by the constitutive law; nan for atoms
  double imposed_amplitude = 0.0;  ///< mean over replicas
  double parts_until = 0.0;        ///< T
  std::array<statistics::Estimate, wave_quantities.size()> estimates{};
  statistics::DecayForm preferred = statistics::DecayForm::exponential;
  bool by_likelihood = false;       ///< preferred by likelihood, or else by residuals
  double worst_energy_error = 0.0;  ///< largest |dE|/N of one step
  std::int64_t subdivided_steps = 0;
  RowStatus status = RowStatus::ok;   ///< short: no error bar, or the amplitude did not fall to 80 % of its start
  std::vector<std::string> warnings;  ///< one sentence each; not in the file
  std::string failure;                ///< why, when status is failed
};

/// The decay while the amplitude falls from one level to the next.
struct LocalDiffusivity {
  double begin = 0.0;  ///< times
  double end = 0.0;
  statistics::Estimate amplitude;  ///< at the middle of the window
  statistics::Estimate gradient;   ///< k a: of the strain rate, or of the entropy's gradient
  statistics::Estimate value;      ///< nu or D_T
  statistics::Estimate particle_noise;
};

/// One form fitted to the amplitude; what it does not have is nan.
struct WaveForm {
  statistics::DecayForm form = statistics::DecayForm::exponential;
  statistics::Estimate amplitude;     ///< a0
  statistics::Estimate diffusivity;   ///< G/k^2
  statistics::Estimate yield_stress;  ///< of momentum only
  statistics::Estimate yield_amplitude;
  statistics::Estimate relaxation_time;
  statistics::Estimate modulus;  ///< of momentum only
  double relative_residual = 0.0;
  double residual_over_error = 0.0;
  statistics::Estimate behind;  ///< log-likelihood of the likeliest form less that of this one; nan without likelihoods
  bool preferred = false;
};

/// What is drawn: all of the same length.
struct WaveCurve {
  std::vector<double> time, mean, error;
  std::vector<double> fit;  ///< of the preferred form
  std::vector<double> particle_noise;
  std::array<std::vector<double>, wave_parts> parts;  ///< of da/dt, means over replicas
};

struct WaveResult {
  WaveRow row;
  std::vector<LocalDiffusivity> local;
  std::vector<WaveForm> forms;  ///< in the order of statistics::decay_forms; none where nothing could be fitted
  WaveCurve curve;
};

/// Everything known of a point from what its replicas recorded.
WaveResult summarize(const WavePoint& point, std::span<const WaveRecord> replicas);

/// The row of a point that could not be finished.
WaveRow failed_row(const WavePoint& point, std::string message);

}  // namespace lucy::cases
