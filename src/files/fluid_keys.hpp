// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keys that the inputs of all smooth-particle fluids share. `Row` derives from cases::FluidSettings.
#pragma once

#include <vector>

#include "lucy/cases/fluid_settings.hpp"
#include "shared_keys.hpp"

namespace lucy::files {

template <class Row>
std::vector<BoundKey<Row>> weight_keys() {
  const std::vector<BoundKey<Row>> name = {
      {{.section = "kernel",
        .name = "name",
        .type = Type::choice,
        .meaning = "Weight function: \"lucy\", (5/(pi h^2)) (1 + 3r/h)(1 - r/h)^3, or \"monaghan\", the cubic "
                   "B-spline.",
        .choices = names_of(kernel::weight_names)},
       stored_by_name_in(member_of<Row>(&Row::weight), kernel::weight_names)}};
  return joined(name, range_key<Row>());
}

template <class Row>
std::vector<BoundKey<Row>> bulk_viscosity_key() {
  return {
      {{.section = "fluid",
        .name = "bulk_viscosity",
        .unit = "(m epsilon)^(1/2)/sigma",
        .meaning = "Bulk viscosity of the constitutive law.",
        .range = Range::at_least(0)},
       stored_in(member_of<Row>(&Row::bulk_viscosity))},
  };
}

template <class Row>
std::vector<BoundKey<Row>> density_mean_key() {
  return {
      {{.section = "fluid",
        .name = "density_mean",
        .type = Type::choice,
        .meaning = "The mean density of two particles in the gradients of velocity and temperature.",
        .choices = names_of(spam::density_mean_names)},
       stored_by_name_in(member_of<Row>(&Row::density_mean), spam::density_mean_names)},
  };
}

template <class Row>
std::vector<BoundKey<Row>> fluid_keys() {
  const std::vector<BoundKey<Row>> state_and_viscosity = {
      {{.section = "fluid",
        .name = "equation_of_state",
        .type = Type::choice,
        .meaning = "P = rho^2/2 (isentropic); P = rho e, e = kT (ideal gas); van der Waals with a = b = 1/2; the dense "
                   "fluid fitted to molecular dynamics near density 1 and kT = 1.",
        .choices = names_of(spam::equation_of_state_names)},
       stored_by_name_in(member_of<Row>(&Row::equation_of_state), spam::equation_of_state_names)},
      {{.section = "fluid",
        .name = "temperature",
        .unit = "epsilon/k",
        .meaning = "Temperature of the fluid at the start. The isentropic fluid has none.",
        .range = Range::above(0)},
       stored_in(member_of<Row>(&Row::temperature))},
      {{.section = "fluid",
        .name = "viscosity",
        .unit = "(m epsilon)^(1/2)/sigma",
        .meaning = "Shear viscosity eta of the constitutive law.",
        .range = Range::at_least(0)},
       stored_in(member_of<Row>(&Row::viscosity))},
  };
  const std::vector<BoundKey<Row>> conductivity = {
      {{.section = "fluid",
        .name = "conductivity",
        .unit = "k (epsilon/m)^(1/2)",
        .meaning = "Thermal conductivity of Fourier's law. The isentropic fluid has no temperature to conduct.",
        .range = Range::at_least(0)},
       stored_in(member_of<Row>(&Row::conductivity))},
  };
  return joined(state_and_viscosity, bulk_viscosity_key<Row>(), conductivity, density_mean_key<Row>());
}

template <class Row>
std::vector<BoundKey<Row>> disorder_key() {
  return {
      {{.section = "start",
        .name = "disorder",
        .unit = "lattice spacings",
        .meaning = "Particles start from a nearly square lattice, displaced at random, uniformly within this much "
                   "either way along each axis. 0: the perfect lattice.",
        .range = Range::at_least(0).at_most(0.5)},
       stored_in(member_of<Row>(&Row::disorder))},
  };
}

template <class Row>
std::vector<BoundKey<Row>> start_keys() {
  const std::vector<BoundKey<Row>> noise_and_uniform = {
      {{.section = "start",
        .name = "noise",
        .unit = "epsilon",
        .meaning = "Kinetic energy per particle of random velocities at the start.",
        .range = Range::at_least(0)},
       stored_in(member_of<Row>(&Row::noise))},
      {{.section = "start",
        .name = "uniform",
        .type = Type::choice,
        .meaning = "What is the same at all particles at the start: the temperature, or (ideal gas only) the entropy, "
                   "with e = kT rho/n.",
        .choices = names_of(cases::uniform_start_names)},
       stored_by_name_in(member_of<Row>(&Row::uniform), cases::uniform_start_names)},
  };
  return joined(disorder_key<Row>(), noise_and_uniform);
}

}  // namespace lucy::files
