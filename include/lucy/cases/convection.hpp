// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rayleigh-Benard convection, whatever solves it: a fluid of mean density 1 in a cell between a hot floor and a cold
// ceiling, in which rolls start.
//
//     Ra = g alpha L^3 (T_hot - T_cold)/(nu kappa)     nu = eta/rho, kappa = k/(rho C_V), rho = 1
//
// (O. Kum, W. G. Hoover and H. A. Posch, Phys. Rev. E 52, 4899 (1995), Sec. IV.) With the gravity that keeps the fluid
// at rest uniform, g L = f (T_hot - T_cold), this makes eta k = c L^2 (T_hot - T_cold)^2/Ra:
//
//                        f      c           alpha C_V = c/f
//     ideal gas          1      1           1
//     van der Waals      2      4/3         2/3
//     dense fluid        3.75   1.26        0.336
//
// In a gas so defined heat is carried at constant pressure while kappa has C_V, and the fluid at rest is stabilised by
// its compressibility: both factors cancel, so that rolls set in at the Ra of an incompressible fluid, 1707.8, when the
// difference of temperatures is small. Times are compared with the diffusion time tau = L^2/nu.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "lucy/grid/flow.hpp"
#include "lucy/spam/equation_of_state.hpp"

namespace lucy::cases {

/// Those with a temperature.
inline constexpr std::array<std::pair<std::string_view, spam::EquationOfStateName>, 3> benard_fluid_names = {{
    {"ideal-gas", spam::EquationOfStateName::ideal_gas},
    {"van-der-waals", spam::EquationOfStateName::van_der_waals},
    {"dense-fluid", spam::EquationOfStateName::dense_fluid},
}};

/// Names as in the input files.
struct Convection {
  // [cell]
  double height = 50.0;
  std::optional<double> width;  ///< unset: twice the height between periodic sides, the height between walls
  grid::Sides sides = grid::Sides::periodic;
  double hot = 1.5;
  double cold = 0.5;
  std::optional<double> gravity;  ///< unset: what keeps the fluid at rest uniform
  // [fluid]
  spam::EquationOfStateName equation_of_state = spam::EquationOfStateName::ideal_gas;
  std::optional<double> rayleigh;   ///< with eta = k; or else:
  std::optional<double> viscosity;  ///< eta (or eta/rho) at density 1
  std::optional<double> conductivity;
  // [start]
  std::optional<double> roll_velocity;
};

/// The largest velocity of the rolls at the start, unless another is asked for, over T_hot - T_cold.
inline constexpr double usual_roll_velocity = 0.085;

double width_of(const Convection& convection);

/// Sets what may be unset, but for the velocity of the rolls. Without viscosity the Rayleigh number is infinite.
void set_unset(Convection& convection);

/// tau, infinite without viscosity.
double diffusion_time(const Convection& convection);

/// Heat per time that the fluid at rest would carry to the ceiling, k (T_hot - T_cold) width/height.
double heat_at_rest(const Convection& convection);

/// Refuses (BadInput, one sentence naming the key `section.key`, the value and what is accepted) a floor that is not
/// the hotter one, and both a Rayleigh number and coefficients, or neither. `viscous`: a viscosity of zero is refused.
void validate(const Convection& convection, bool viscous);

}  // namespace lucy::cases
