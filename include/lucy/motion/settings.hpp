// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The choices a person makes about the motion, by the names used in input files.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace lucy::motion {

enum class Thermostat { isoenergetic, isokinetic, nose_hoover, none };
inline constexpr std::array<std::pair<std::string_view, Thermostat>, 4> thermostat_names = {{
    {"isoenergetic", Thermostat::isoenergetic},
    {"isokinetic", Thermostat::isokinetic},
    {"nose-hoover", Thermostat::nose_hoover},
    {"none", Thermostat::none},
}};

enum class Integrator { runge_kutta_4, velocity_verlet };
inline constexpr std::array<std::pair<std::string_view, Integrator>, 2> integrator_names = {{
    {"rk4", Integrator::runge_kutta_4},
    {"velocity-verlet", Integrator::velocity_verlet},
}};

/// How the pair sum is read (pairs/pair_force.hpp): as atoms, or as smooth particles of the fluid P = rho^2/2.
enum class Reading { md, spam };
inline constexpr std::array<std::pair<std::string_view, Reading>, 2> reading_names = {{
    {"md", Reading::md},
    {"spam", Reading::spam},
}};

}  // namespace lucy::motion
