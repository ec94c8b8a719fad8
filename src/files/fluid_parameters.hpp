// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the H5MD files of all smooth-particle fluids say of them in /parameters.
#pragma once

#include "choice_names.hpp"
#include "hdf5_file.hpp"
#include "lucy/cases/fluid_settings.hpp"

namespace lucy::files {

inline void add_fluid(hid_t group, const cases::FluidSettings& settings) {
  using hdf5::add_attribute;
  add_attribute(group, "particles", settings.particles);
  add_attribute(group, "density", settings.density);
  add_attribute(group, "dimension", settings.dimension);
  add_attribute(group, "kernel", name_of(kernel::weight_names, settings.weight));
  add_attribute(group, "range", settings.range);
  add_attribute(group, "equation_of_state", name_of(spam::equation_of_state_names, settings.equation_of_state));
  add_attribute(group, "temperature", settings.temperature);
  add_attribute(group, "viscosity", settings.viscosity);
  add_attribute(group, "bulk_viscosity", settings.bulk_viscosity);
  add_attribute(group, "conductivity", settings.conductivity);
  add_attribute(group, "density_mean", name_of(spam::density_mean_names, settings.density_mean));
  add_attribute(group, "disorder", settings.disorder);
  add_attribute(group, "noise", settings.noise);
  add_attribute(group, "uniform", name_of(cases::uniform_start_names, settings.uniform));
  add_attribute(group, "step", settings.step);
  add_attribute(group, "equilibration", settings.equilibration);
  add_attribute(group, "duration", settings.duration);
  add_attribute(group, "seed", static_cast<std::int64_t>(settings.seed));
}

}  // namespace lucy::files
