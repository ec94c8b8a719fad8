// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows of benard_grid.csv, and what several meshes and several Rayleigh numbers say together.
//
// On n cells a quantity of a second-order grid is q(n) = q + a/n^2 + b/n^4 + ... The value is where the straight line
// in 1/n^2 through the finest two meshes ends, its error how far from there the parabola through the finest three ends.
//
// The critical Rayleigh number, where rolls neither grow nor decay, in two ways:
//     growth rates     the zero of rate L^2/nu as a function of Ra on each mesh (the parabola through the three nearest
//                      points), extrapolated as above
//     straight line    steady kinetic energies, extrapolated, lie near a straight line in Ra^(-1/2), which ends at K =
//     0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/benard_grid.hpp"
#include "lucy/cases/couette_table.hpp"

namespace lucy::cases {

struct BenardGridRow {
  BenardGridPoint settings;  ///< resolved
  double time = 0.0;         ///< reached
  double kinetic_energy = 0.0;
  double nusselt_hot = 0.0;
  double nusselt_cold = 0.0;
  double nusselt_sides = 0.0;
  double largest_speed = 0.0;
  double energy_imbalance = 0.0;     ///< heat in less heat out, over that of the floor
  double mass_error = 0.0;           ///< relative
  double change = 0.0;               ///< of the kinetic energy in the last interval, relative, per diffusion time
  double growth_rate = 0.0;          ///< of the rolls, per time; nan where a steady state was asked for
  double growth_rate_error = 0.0;    ///< how much it changes over the times that were fitted
  RowStatus status = RowStatus::ok;  ///< too_short: not steady, or too few samples for a rate
  std::string failure;
};

BenardGridRow summarize(const BenardGridPoint& point, const BenardGridRecord& record);

/// All numbers nan.
BenardGridRow failed_row(const BenardGridPoint& point, const std::string& reason);

struct Extrapolated {
  double value = 0.0;  ///< nan: fewer than two meshes
  double error = 0.0;  ///< nan: fewer than three
};

/// `cells` and `values` of one quantity on several meshes, in any order.
Extrapolated extrapolate(std::span<const int> cells, std::span<const double> values);

/// What rows that differ in their meshes alone say together.
struct BenardGridLimit {
  BenardGridPoint settings;  ///< of the finest mesh
  int meshes = 0;
  Extrapolated kinetic_energy;
  Extrapolated nusselt_hot;
  Extrapolated nusselt_cold;
};

/// Of steady rows; rows that failed or are not steady take no part.
std::vector<BenardGridLimit> limits_of(std::span<const BenardGridRow> rows);

struct CriticalRayleigh {
  enum class Route { growth_rates, straight_line };
  BenardGridPoint settings;  ///< of any of the rows
  Route route = Route::growth_rates;
  int cells = 0;   ///< of the mesh; 0: extrapolated over meshes
  int points = 0;  ///< Rayleigh numbers used
  Extrapolated rayleigh;
};
inline constexpr std::array<std::pair<std::string_view, CriticalRayleigh::Route>, 2> critical_route_names = {
    {{"growth-rates", CriticalRayleigh::Route::growth_rates},
     {"straight-line", CriticalRayleigh::Route::straight_line}}};

/// Of every fluid and cell of which rates were found at two Rayleigh numbers or more on either side of the critical
/// one, mesh by mesh and then extrapolated; and of every one with three or more steady flows.
std::vector<CriticalRayleigh> critical_rayleighs(std::span<const BenardGridRow> rows);

}  // namespace lucy::cases
