// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What decaying waves gave: shear_wave.csv or temperature_wave.csv, and beside it local.csv, forms.csv and
// amplitude.csv. Numbers are the shortest text that reads back as the same bits; nothing that varies between
// repetitions stands in them. What is not known, or has no meaning for atoms, is nan, or none.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/wave_table.hpp"

namespace lucy::files {

/// "shear_wave.csv" or "temperature_wave.csv".
std::string wave_file_name(cases::WaveQuantity quantity);

/// The names of its columns, in order: the settings by the names of their keys (the kernel's as `kernel`), then what
/// follows from them, then every quantity with its error.
std::vector<std::string> wave_columns(cases::WaveQuantity quantity);

/// One line per point, all of that quantity. Throws RunFailed when the disk refuses; an earlier file is then untouched.
void write_wave_csv(const std::filesystem::path& path, cases::WaveQuantity quantity,
                    std::span<const cases::WaveRow> rows);

/// Reads it back; columns are found by name, further ones are passed over. What no column holds (seed, tolerances,
/// degrees of freedom, warnings, the text of a failure) is as in a new WaveRow. Throws BadInput naming file, line and
/// column.
std::vector<cases::WaveRow> read_wave_csv(const std::filesystem::path& path, cases::WaveQuantity quantity);

/// Whether a row that was read back may be that of a point: by the settings that stand in the file.
bool same_settings(const cases::WavePoint& one, const cases::WavePoint& other);

/// The windows of local diffusivity of all points in long form; `point` is the line of the results, from 1.
void write_local_csv(const std::filesystem::path& path, std::span<const cases::WaveResult> results);

/// Every form fitted to every point. `behind`: see cases::WaveForm.
void write_forms_csv(const std::filesystem::path& path, std::span<const cases::WaveResult> results);

/// Amplitudes against time with their errors, the preferred fit, the noise of the particles, and the parts of da/dt at
/// that instant. All results are of that quantity.
void write_amplitude_csv(const std::filesystem::path& path, cases::WaveQuantity quantity,
                         std::span<const cases::WaveResult> results);

}  // namespace lucy::files
