// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The keys of a benard-grid input, and where each is stored in a BenardGridPoint.
#include "lucy/files/benard_grid_input.hpp"

#include "benard_keys.hpp"
#include "shared_keys.hpp"

namespace lucy::files {
namespace {

using P = cases::BenardGridPoint;

std::vector<BoundKey<P>> grid_keys() {
  return {
      {{.section = "grid",
        .name = "cells",
        .type = Type::integer,
        .meaning = "Cells over the height; along x they are as near to squares as cell.width makes them, which has to "
                   "be a whole number of them. Three meshes make an extrapolation with an error.",
        .range = Range::at_least(4).at_most(1000),
        .required = true,
        .lists = Lists::multiply,
        .replaces_rows = true},
       stored_in(&P::cells)},
  };
}

std::vector<BoundKey<P>> transport_key() {
  return {
      {{.section = "fluid",
        .name = "transport",
        .type = Type::choice,
        .meaning = "What is constant: \"dynamic\", eta and k; \"kinematic\", eta/rho and k/rho.",
        .choices = names_of(grid::transport_names)},
       stored_by_name_in(&P::transport, grid::transport_names)},
  };
}

std::vector<BoundKey<P>> run_keys() {
  return {
      {{.section = "run",
        .name = "find",
        .type = Type::choice,
        .meaning = "\"steady-state\": kinetic energy and Nusselt numbers of the steady flow; \"growth-rate\": how fast "
                   "small rolls grow or decay.",
        .choices = names_of(cases::benard_goal_names)},
       stored_by_name_in(&P::find, cases::benard_goal_names)},
      {{.section = "run",
        .name = "step",
        .unit = "time",
        .meaning = "Time step of the Runge-Kutta integration. What is unstable on the mesh is refused.",
        .range = Range::above(0),
        .default_text = "seven tenths of the longest stable step"},
       stored_in(&P::step)},
      {{.section = "run",
        .name = "duration",
        .unit = "time",
        .meaning = "How long the flow runs: at most, when a steady state is looked for.",
        .range = Range::above(0),
        .default_text = "40 diffusion times height^2/nu; 3 for growth rates, fitted over the last"},
       stored_in(&P::duration)},
      {{.section = "run",
        .name = "tolerance",
        .meaning = "A flow is steady when kinetic energy and both Nusselt numbers change by less than this share of "
                   "themselves in a diffusion time.",
        .range = Range::above(0).below(1)},
       stored_in(&P::tolerance)},
  };
}

}  // namespace

std::vector<BoundKey<P>> benard_grid_keys() {
  return joined(cell_keys<P>(), convecting_fluid_keys<P>(Range::above(0), " There is no bulk viscosity."),
                transport_key(), rolls_key<P>("; a hundred-thousandth of that for growth rates"), grid_keys(),
                run_keys());
}

Schema benard_grid_schema() {
  Schema schema = input_schema<BenardGridInput>("benard-grid",
                                                {{"", "The experiment."},
                                                 {"cell", "Where the fluid is."},
                                                 {"fluid", "What it is."},
                                                 {"start", "How it starts."},
                                                 {"grid", "The meshes."},
                                                 {"run", "What is looked for, and how it is integrated."}},
                                                benard_grid_keys(), "the Rayleigh numbers times the numbers of cells",
                                                "rayleigh or cells");
  schema.lacking = {{"system", "a continuum has no particles"}, {"shear", "the fluid is driven by heat"}};
  return schema;
}

BenardGridInput read_benard_grid(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return read_input<BenardGridInput>(file, overrides, benard_grid_schema(), benard_grid_keys(),
                                     [](const P& point) { cases::validate(point); });
}

std::string benard_grid_resolved_toml(const BenardGridInput& input) {
  return resolved_input("convection on grids", benard_grid_schema(), input, benard_grid_keys());
}

}  // namespace lucy::files
