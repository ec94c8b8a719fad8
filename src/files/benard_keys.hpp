// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keys of a cell between a hot floor and a cold ceiling, and of the fluid in it, whatever solves its equations. `Row`
// derives from cases::Convection.
#pragma once

#include <string>
#include <vector>

#include "lucy/cases/convection.hpp"
#include "shared_keys.hpp"

namespace lucy::files {

/// `usual_height`: what it is where none is set (0 in a new `Row`), in words.
template <class Row>
std::vector<BoundKey<Row>> cell_keys(const std::string& usual_height = {}) {
  return {
      {{.section = "cell",
        .name = "height",
        .unit = "sigma",
        .meaning = "Height L, from the floor to the ceiling.",
        .range = Range::above(0),
        .default_text = usual_height},
       stored_unless_zero_in(member_of<Row>(&Row::height))},
      {{.section = "cell",
        .name = "width",
        .unit = "sigma",
        .meaning = "Width of the cell.",
        .range = Range::above(0),
        .default_text = "2 cell.height with periodic sides, cell.height with walls"},
       stored_in(member_of<Row>(&Row::width))},
      {{.section = "cell",
        .name = "side",
        .type = Type::choice,
        .meaning =
            "Left and right: \"periodic\", where two rolls start; or \"walls\" at rest, with temperatures on the "
            "straight line between floor and ceiling, where one roll starts.",
        .choices = names_of(grid::sides_names)},
       stored_by_name_in(member_of<Row>(&Row::sides), grid::sides_names)},
      {{.section = "cell",
        .name = "hot",
        .unit = "epsilon/k",
        .meaning = "Temperature of the floor, above that of the ceiling.",
        .range = Range::above(0)},
       stored_in(member_of<Row>(&Row::hot))},
      {{.section = "cell",
        .name = "cold",
        .unit = "epsilon/k",
        .meaning = "Temperature of the ceiling.",
        .range = Range::above(0)},
       stored_in(member_of<Row>(&Row::cold))},
      {{.section = "cell",
        .name = "gravity",
        .unit = "epsilon/(m sigma)",
        .meaning = "Gravity g, towards the floor.",
        .range = Range::above(0),
        .default_text = "what keeps the fluid at rest uniform: g height/(hot - cold) = 1 (ideal gas), 2 (van der "
                        "Waals), 3.75 (dense fluid)"},
       stored_in(member_of<Row>(&Row::gravity))},
  };
}

/// `viscosities`: those that are accepted; `viscosity`: the end of what that key means.
template <class Row>
std::vector<BoundKey<Row>> convecting_fluid_keys(const Range& viscosities, const std::string& viscosity) {
  return {
      {{.section = "fluid",
        .name = "equation_of_state",
        .type = Type::choice,
        .meaning = "P = rho e, e = kT (ideal gas); van der Waals with a = b = 1/2; the dense fluid fitted to molecular "
                   "dynamics near density 1 and kT = 1. The mean density is 1.",
        .choices = names_of(cases::benard_fluid_names)},
       stored_by_name_in(member_of<Row>(&Row::equation_of_state), cases::benard_fluid_names)},
      {{.section = "fluid",
        .name = "rayleigh",
        .meaning = "Rayleigh number g alpha L^3 (hot - cold)/(nu kappa), kappa = k/(rho C_V), which sets viscosity and "
                   "conductivity, one like the other.",
        .range = Range::above(0),
        .default_text = "from fluid.viscosity and fluid.conductivity, which are given instead",
        .lists = Lists::multiply,
        .replaces_rows = true},
       stored_in(member_of<Row>(&Row::rayleigh))},
      {{.section = "fluid",
        .name = "viscosity",
        .unit = "(m epsilon)^(1/2)/sigma",
        .meaning = "Shear viscosity eta at density 1, instead of fluid.rayleigh." + viscosity,
        .range = viscosities,
        .default_text = "from fluid.rayleigh"},
       stored_in(member_of<Row>(&Row::viscosity))},
      {{.section = "fluid",
        .name = "conductivity",
        .unit = "k (epsilon/m)^(1/2)",
        .meaning = "Thermal conductivity k at density 1, instead of fluid.rayleigh.",
        .range = Range::above(0),
        .default_text = "from fluid.rayleigh"},
       stored_in(member_of<Row>(&Row::conductivity))},
  };
}

/// `unless_set`: the end of what the velocity is where none is set, in words.
template <class Row>
std::vector<BoundKey<Row>> rolls_key(const std::string& unless_set = {}) {
  return {
      {{.section = "start",
        .name = "roll_velocity",
        .unit = "(epsilon/m)^(1/2)",
        .meaning = "Largest velocity of the rolls at the start, in a fluid whose temperature is that of rest.",
        .range = Range::above(0),
        .default_text = "0.085 (hot - cold)" + unless_set},
       stored_in(member_of<Row>(&Row::roll_velocity))},
  };
}

}  // namespace lucy::files
