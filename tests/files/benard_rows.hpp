// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows of benard.csv for tests of files and texts.
#pragma once

#include <cmath>
#include <limits>

#include "lucy/cases/benard_table.hpp"

namespace lucy::files::testing {

/// A row of 5000 particles of an ideal gas at Ra = 10000 of which everything is known.
inline cases::BenardRow benard_row() {
  cases::BenardPoint point;
  point.particles = 5000;
  point.rayleigh = 10000.0;
  point.equilibration = 3000.0;
  point.duration = 3000.0;
  point.replicas = 2;
  cases::BenardRow row;
  row.settings = cases::resolved(point);
  row.duration = 3000.0;
  for (std::size_t i = 0; i < row.estimates.size(); ++i)
    row.estimates[i] = {0.5 + std::sin(1.0 + static_cast<double>(i)) / 3.0, 1e-3 / (1.0 + static_cast<double>(i)), 128,
                        127};
  row.estimates[cases::benard_quantity("kinetic_energy_total")] = {0.00451, 0.00002, 128, 127};
  row.estimates[cases::benard_quantity("kinetic_energy_smoothed")] = {0.00389, 0.00002, 128, 127};
  row.estimates[cases::benard_quantity("kinetic_energy_field")] = {0.00402, 0.00001, 128, 127};
  row.estimates[cases::benard_quantity("nusselt_hot")] = {1.532, 0.012, 128, 127};
  row.estimates[cases::benard_quantity("conduction_cold")] = {-0.912, 0.011, 128, 127};
  row.effective_samples = 128.5;
  row.equilibration_discarded = 12.25;
  row.worst_energy_error = 3e-9;
  row.energy_drift = -2.5e-6;
  row.subdivided_steps = 7;
  row.reflections = 321;
  return row;
}

/// The same fluid without viscosity, and whatever else is not the usual.
inline cases::BenardRow unusual_benard_row() {
  cases::BenardPoint point;
  point.particles = 2500;
  point.equation_of_state = spam::EquationOfStateName::van_der_waals;
  point.weight = kernel::WeightName::monaghan;
  point.range = 3.5;
  point.sides = grid::Sides::walls;
  point.wall = space::WallKind::boundary_particles;
  point.density_mean = spam::DensityMean::arithmetic;
  point.hot = 10.0;
  point.viscosity = 0.0;
  point.conductivity = 0.1 + 0.2;
  point.bulk_viscosity = 1.0 / 3.0;
  point.disorder = 0.1;
  point.duration = 100.0;
  cases::BenardRow row = benard_row();
  row.settings = cases::resolved(point);
  row.duration = point.duration;
  row.estimates[0].error = std::numeric_limits<double>::quiet_NaN();
  row.status = cases::RowStatus::too_short;
  return row;
}

}  // namespace lucy::files::testing
