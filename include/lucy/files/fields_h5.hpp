// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// fields.h5 and spectra.csv: what `lucy fields` found, in reduced units.
//
//     /provenance                 attributes: source, replica, frame, frames, first_time, time, command, version,
//     commit /parameters                 attributes: particles, strain_rate, kernel, range, medium ("atoms", or the
//     name of the
//                                 equation of state)
//     /grid/x [n_x], y [n_y]      coordinates of the nodes; attributes edges (L_x, L_y), offset (of the image above)
//     /fields/NAME [n_y][n_x]     as in measure/fields.hpp; vectors [n_y][n_x][2]; nan where there is no fluid
//     /spectra/NAME/wave_number, modes, power       rings of |k| (measure/field_spectrum.hpp); attribute variance, the
//                                 sum of modes times power; attribute whole_up_to of /spectra: beyond it rings have
//                                 only what the grid's corners hold
//     /particles/position, velocity_individual, velocity_smoothed, density, internal_energy    of a single frame
//     /kinetic_energies           attributes: individual, smoothed, field, per particle
//
// Every dataset has the attributes `meaning` and `unit`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lucy/cases/saved_fields.hpp"

namespace lucy::files {

/// Where the fields come from.
struct FieldsProvenance {
  std::string source;  ///< the file that was read
  int replica = 1;
  std::vector<std::size_t> frames;  ///< from 1
  std::vector<std::string> command_line;
  std::string version;
  std::string commit;
};

/// Throws RunFailed when the disk refuses.
void write_fields_h5(const std::filesystem::path& path, const cases::FieldSettings& settings,
                     const cases::SavedFields& fields, const FieldsProvenance& provenance);

/// spectra.csv: field, wave_number, modes, power; one row per field and ring. Throws RunFailed when the disk refuses.
void write_spectra_csv(const std::filesystem::path& path, const std::vector<cases::NamedSpectrum>& spectra);

/// The name of a medium: "atoms", "ideal-gas", ...
std::string_view medium_name(const measure::Medium& medium);

/// For the terminal: a row per field with mean, root-mean-square variation and extremes over the nodes; then the number
/// of particles on the grid and the kinetic energies. Ends with a line feed.
std::string format_fields(const cases::FieldSettings& settings, const cases::SavedFields& fields);

}  // namespace lucy::files
