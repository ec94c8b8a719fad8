// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shear viscosity of one state by every route that is at hand, side by side: the sweep extrapolated to zero rate,
// Green-Kubo, print, and the weak-scattering estimate 35 (m kT)^(1/2) kT/(epsilon sigma) (Posch, Hoover and Kum, Phys.
// Rev. E 52, 1711 (1995), Secs. IV-V), which holds for their model: Lucy's potential of range 3 at unit density.
//
// Extrapolation: eta is even in the rate, so
//
//     eta(rate) = eta_0 + eta_2 rate^2
//
// is fitted by weighted least squares to the lowest rates. Rows take part by rule: not failed, a rate other than zero,
// a viscosity with an error, no instability (the largest particle holds no more than largest_stable_share of the
// kinetic energy on average); of these the longest run of lowest |rate|s, three at least, that lies on such a parabola:
//
//   - its fit has a p-value of at least least_p_value;
//   - the next term, too small to be seen by the p-value but always pulling the same way, does no harm: a second model
//     of a shear-thinning fluid, fitted to the same rows,
//
//         eta(rate) = eta_0 / sqrt(1 + (rate/rate_0)^2),
//
//     has an eta_0 that differs by no more than largest_pull of the fit's error. (Its rate^4 term is 1.5 eta_2^2/eta_0;
//     the BGK equation of a sheared two-dimensional gas at constant temperature has 1.75.) Where no run obeys this, the
//     shortest with a sufficient p-value is taken.
//
// The error of eta_0 is the fit's, widened by sqrt(chi^2/degrees of freedom) where that is above one, and in quadrature
// the difference between both models' eta_0.
//
// Measured coverage of eta_0 by one and two of these errors, over 36 imagined sweeps of 400 realisations each (fluids
// that thin as BGK, as 1/(1 + x^2) and as 1/sqrt(1 + x^2); the rates and errors of both published tables and two
// others, errors times 0.3, 1 and 3): 0.69 and 0.95 on average, 0.61 and 0.92 at worst. With the p-value alone, and no
// second model: 0.43 and 0.75 on average, 0.20 and 0.47 at worst.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/cases/comparison.hpp"
#include "lucy/cases/couette_table.hpp"
#include "lucy/cases/green_kubo_table.hpp"
#include "lucy/statistics/pooling.hpp"

namespace lucy::cases {

inline constexpr double largest_stable_share = 0.2;
inline constexpr double least_p_value = 0.05;
inline constexpr double largest_pull = 0.5;
inline constexpr std::size_t fewest_rates = 3;
/// A fit that bends by more than this part of eta_0 over its rates reaches far.
inline constexpr double largest_bend = 0.5;

/// Why a row of the sweep takes part in the fit or not. `no_error` stands for failed rows and zero rates too.
enum class FitPart { fitted, beyond, unstable, no_error };

/// As it stands in files: fitted, beyond, unstable, no-error.
std::string_view fit_part_name(FitPart part);

struct ZeroRateFit {
  statistics::Estimate viscosity;  ///< eta_0 with the error described above; nan when there is none
  double fit_error = 0.0;          ///< of eta_0, of the fit alone (widened)
  double other_model = 0.0;        ///< eta_0 of the second model
  double curvature = 0.0;          ///< eta_2
  double curvature_error = 0.0;    ///< of the fit alone (widened)
  double covariance = 0.0;         ///< of eta_0 and eta_2, widened likewise
  double highest_rate = 0.0;       ///< of the fitted rows
  double chi_squared = 0.0;
  int degrees_of_freedom = 0;
  double p_value = 0.0;        ///< without a viscosity: of the fit to the lowest rates that was refused, or nan
  std::vector<FitPart> parts;  ///< one for each row given
  std::string note;            ///< why there is no viscosity, or what to beware of; may be empty
};

/// Rows of one particle number and one energy, in any order; a negative rate counts by its size.
ZeroRateFit extrapolate_to_zero_rate(std::span<const TableRow> rows);

/// A published Green-Kubo value. Without an error in print, ours is scaled by the lengths of the runs (comparison.hpp).
struct PublishedGreenKubo {
  std::int64_t particles = 0;
  double energy_per_particle = 0.0;
  double total_time = 0.0;
  PublishedCell viscosity;
  PublishedCell pressure;          ///< value nan: not printed
  PublishedCell pressure_kinetic;  ///< value nan: not printed
  std::string source;
};

/// One route's value; z is its difference from Green-Kubo in combined standard errors (nan where either has none).
struct Route {
  std::string name;  ///< nemd, green-kubo, green-kubo-spectrum, published-green-kubo or weak-scattering
  double value = 0.0;
  double error = 0.0;
  double z = 0.0;
  std::string note = {};
};

struct SideBySide {
  std::int64_t particles = 0;
  double energy_per_particle = 0.0;
  ZeroRateFit fit;
  std::vector<TableRow> sweep;  ///< rows of this state
  std::vector<Route> routes;    ///< in the order of Route::name; one for each published value that there is
};

/// Particle number and energy (to one part in 10^9) of any row of any table.
template <class One, class Other>
bool same_equilibrium_state(const One& one, const Other& other) {
  return one.particles == other.particles && nearly_equal(one.energy_per_particle, other.energy_per_particle);
}

/// One entry for each state that both have, in the order of the Green-Kubo rows. Published values and the
/// weak-scattering estimate belong to the model of the paper; of another one they are left out.
std::vector<SideBySide> side_by_side(std::span<const TableRow> sweep, std::span<const GreenKuboRow> green_kubo,
                                     std::span<const PublishedGreenKubo> published, bool model_of_the_paper = true);

/// 35 sqrt(kT) kT with the error that kT hands on.
statistics::Estimate weak_scattering_viscosity(const statistics::Estimate& kinetic_temperature);

}  // namespace lucy::cases
