// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows of shear_flow.csv for tests of files and texts.
#pragma once

#include <cmath>
#include <limits>

#include "lucy/cases/shear_flow_table.hpp"

namespace lucy::files::testing {

inline constexpr double unknown_value = std::numeric_limits<double>::quiet_NaN();

/// A row of an ideal gas at the rate 0.1 of which everything is known.
inline cases::ShearFlowRow shear_flow_row() {
  cases::ShearFlowRow row;
  row.settings.particles = 1024;
  row.settings.viscosity = 0.5;
  row.settings.conductivity = 0.25;
  row.settings.strain_rate = 0.1;
  row.settings.duration = row.duration = 1500;
  row.settings.replicas = 2;
  for (std::size_t i = 0; i < row.estimates.size(); ++i)
    row.estimates[i] = {0.5 + std::sin(1.0 + static_cast<double>(i)) / 3.0, 1e-3 / (1.0 + static_cast<double>(i)), 128,
                        127};
  row.estimates[cases::shear_flow_quantity("viscosity")] = {0.5765, 0.0012, 128, 127};
  row.estimates[cases::shear_flow_quantity("viscosity_newtonian")] = {0.49217, 0.00004, 128, 127};
  row.estimates[cases::shear_flow_quantity("viscosity_pressure")] = {0.0327, 0.0005, 128, 127};
  row.estimates[cases::shear_flow_quantity("viscosity_carried")] = {0.0516, 0.0015, 128, 127};
  row.estimates[cases::shear_flow_quantity("least_entropy_production")] = {-0.00012, 0.00002, 128, 127};
  row.estimates[cases::shear_flow_quantity("velocity_gradient")] = {0.0985, 0.0001, 128, 127};
  row.effective_samples = 128.5;
  row.equilibration_discarded = 12.25;
  row.worst_energy_error = 3e-9;
  row.energy_drift = -2.5e-6;
  row.subdivided_steps = 7;
  return row;
}

}  // namespace lucy::files::testing
