// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows of viscosity.csv for tests of files and texts.
#pragma once

#include <cmath>
#include <limits>
#include <string_view>

#include "lucy/cases/green_kubo_table.hpp"

namespace lucy::files::testing {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A row of which everything is known but diffusion and conductivity; numbers of about the published size.
inline cases::GreenKuboRow green_kubo_row() {
  cases::GreenKuboRow row;
  row.energy_per_particle = 0.5;
  row.particles = 1024;
  for (std::size_t i = 0; i < row.estimates.size(); ++i)
    row.estimates[i] = {0.5 + std::sin(1.0 + static_cast<double>(i)) / 3.0, 1e-2 / (1.0 + static_cast<double>(i)), 128,
                        127};
  row.estimates[cases::green_kubo_quantity("viscosity")] = {0.5923, 0.0123, 128, 127};
  row.estimates[cases::green_kubo_quantity("self_diffusion")] = {unknown, unknown, unknown, 0};
  row.estimates[cases::green_kubo_quantity("thermal_conductivity")] = {unknown, unknown, unknown, 0};
  row.spectrum_z = -0.75;
  row.cutoff = 60.25;
  row.decay_begin = 5.0;
  row.decay_end = 30.125;
  row.spectrum_frequency = 0.3;
  row.spectrum_p_value = 0.4375;
  row.blocks = 128;
  row.step = 0.05;
  row.sample_interval = 0.2;
  row.duration = 20000;
  row.replicas = 8;
  row.energy_drift = -3e-9;
  row.largest_energy_error = 1.5e-6;
  return row;
}

}  // namespace lucy::files::testing
