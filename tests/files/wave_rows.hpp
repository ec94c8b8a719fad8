// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows of decaying waves for tests of files and texts.
#pragma once

#include <cmath>
#include <limits>

#include "lucy/cases/wave_table.hpp"

namespace lucy::files::testing {

inline constexpr double unknown_value = std::numeric_limits<double>::quiet_NaN();

/// A row of an ideal gas of which everything is known.
inline cases::WaveRow wave_row(cases::WaveQuantity quantity = cases::WaveQuantity::shear) {
  cases::WaveRow row;
  row.settings.quantity = quantity;
  row.settings.particles = 4096;
  row.settings.viscosity = 0.3;
  row.settings.conductivity = quantity == cases::WaveQuantity::temperature ? 0.4 : 0.0;
  row.settings.disorder = 0.3;
  row.settings.step = 0.5;
  row.settings.duration = 500.0;
  row.wave_vector = cases::wave_vector(row.settings);
  row.sample_interval = 2.0;
  row.prescribed = cases::prescribed_diffusivity(row.settings);
  row.imposed_amplitude = 0.05;
  row.parts_until = 362.0;
  for (std::size_t i = 0; i < row.estimates.size(); ++i)
    row.estimates[i] = {0.5 + std::sin(1.0 + static_cast<double>(i)) / 3.0, 1e-3 / (1.0 + static_cast<double>(i)), 8,
                        7};
  row.estimates[cases::wave_quantity("total")] = {0.6521, 0.012, 8, 7};
  row.estimates[cases::wave_quantity("operator_factor")] = {0.98527, 0.00021, 8, 7};
  row.estimates[cases::wave_quantity("yield_stress")] = {0.00096, 0.00019, 8, 7};
  row.estimates[cases::wave_quantity("pressure")] = {2.0, 0.0001, 8, 7};
  row.preferred = statistics::DecayForm::yielding;
  row.by_likelihood = true;
  row.worst_energy_error = 6e-9;
  row.subdivided_steps = 12;
  return row;
}

/// One of atoms.
inline cases::WaveRow atoms_row() {
  cases::WaveRow row = wave_row();
  const double duration = row.settings.duration;
  row.settings = {};
  row.settings.reading = motion::Reading::md;
  row.settings.energy_per_particle = 0.5;
  row.settings.particles = 1024;
  row.settings.mode = 2;
  row.settings.amplitude = 0.1;
  row.settings.duration = duration;
  row.prescribed = row.estimates[cases::wave_quantity("operator_factor")].value =
      row.estimates[cases::wave_quantity("operator_factor")].error = unknown_value;
  row.estimates[cases::wave_quantity("operator")] = {0.0, 0.0, 8, 7};
  row.preferred = statistics::DecayForm::viscoelastic;
  return row;
}

}  // namespace lucy::files::testing
