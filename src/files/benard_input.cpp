// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The keys of a benard input, and where each is stored in a BenardPoint.
#include "lucy/files/benard_input.hpp"

#include "benard_keys.hpp"
#include "fluid_keys.hpp"
#include "shared_keys.hpp"

namespace lucy::files {
namespace {

using P = cases::BenardPoint;

constexpr const char* rayleigh_numbers = "fluid.rayleigh";

std::vector<BoundKey<P>> system_of_particles() {
  auto keys = particles_key<P>(Lists::multiply);
  keys.front().key.meaning =
      "Number of particles N. They start from a square lattice that fills the cell at density 1: its width times its "
      "height, both whole numbers, is N.";
  return keys;
}

std::vector<BoundKey<P>> wall_key() {
  return {
      {{.section = "cell",
        .name = "wall",
        .type = Type::choice,
        .meaning = "What is behind walls: \"mirror-images\" of the particles near them, with the wall's velocity and "
                   "temperature; or rows of \"boundary-particles\" that stand still at the wall's temperature. A "
                   "particle that crosses a wall is reflected.",
        .choices = names_of(space::wall_kind_names)},
       stored_by_name_in(&P::wall, space::wall_kind_names)},
  };
}

/// Lists of names and ranges multiply.
std::vector<BoundKey<P>> weights() {
  auto keys = weight_keys<P>();
  for (auto& bound : keys) bound.key.lists = Lists::multiply;
  return keys;
}

std::vector<BoundKey<P>> output_keys() {
  const std::vector<BoundKey<P>> cells = {
      {{.section = "output",
        .name = "cells",
        .type = Type::integer,
        .meaning = "Cells over the height in which fields are averaged over time; along x they are as near to squares "
                   "as they can be.",
        .range = Range::at_least(4).at_most(1000)},
       stored_in(&P::cells)},
  };
  return joined(
      cells,
      sample_interval_key<P>("Time between samples, a whole number of steps. The kinetic energy and what walls "
                             "give are averages over the steps between them, all else is of their end.",
                             "ten steps"),
      frame_interval_key<P>("Time between recorded configurations of the first replica, a whole number of "
                            "samples; 0 records none."));
}

}  // namespace

std::vector<BoundKey<P>> benard_keys() {
  return joined(system_of_particles(),
                cell_keys<P>("what makes the density 1: (particles/2)^(1/2) with periodic sides, particles^(1/2) with "
                             "walls; particles/width where a width is given"),
                wall_key(), weights(),
                convecting_fluid_keys<P>(Range::at_least(0), " With 0 the Rayleigh number is infinite."),
                bulk_viscosity_key<P>(), density_mean_key<P>(), rolls_key<P>(), disorder_key<P>(),
                step_key<P>("Time step of the Runge-Kutta integration.", 1.0, rayleigh_numbers),
                length_keys<P>("Time run first and left out of all averages, per replica; its samples are kept. More "
                               "is discarded later where the data ask for it.",
                               rayleigh_numbers),
                replica_keys<P>(), tolerance_keys<P>(), output_keys());
}

Schema benard_schema() {
  Schema schema = input_schema<BenardInput>(
      "benard",
      {{"", "The experiment."},
       {"system", "How many particles."},
       {"cell", "Where they are."},
       {"kernel", "The weight function."},
       {"fluid", "What the smooth particles are made of."},
       {"start", "How they start."},
       {"run", "How it is integrated, how long, how often."},
       {"output", "What is recorded."}},
      benard_keys(), "the numbers of particles times the weight functions, the ranges and the Rayleigh numbers",
      "particles or rayleigh");
  schema.lacking = {{"grid", "particles need none"}, {"shear", "the fluid is driven by heat"}};
  return schema;
}

BenardInput read_benard(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return read_input<BenardInput>(file, overrides, benard_schema(), benard_keys(),
                                 [](const P& point) { cases::validate(point); });
}

std::string benard_resolved_toml(const BenardInput& input) {
  return resolved_input("convection by smooth particles", benard_schema(), input, benard_keys());
}

}  // namespace lucy::files
