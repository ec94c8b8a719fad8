// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// viscosity.csv, correlation.csv and pairs.csv: what Green-Kubo states gave. Numbers are the shortest text that reads
// back as the same bits; nothing that varies between repetitions stands in them. What is not known is nan.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lucy/cases/green_kubo_table.hpp"

namespace lucy::files {

/// The names of the columns of viscosity.csv, in order.
std::vector<std::string> viscosity_columns();

/// One line per state. Throws RunFailed when the disk refuses; an earlier file is then untouched.
void write_viscosity_csv(const std::filesystem::path& path, std::span<const cases::GreenKuboRow> rows);

/// Reads a viscosity.csv back; columns are found by name, further ones are passed over. Degrees of freedom, warnings
/// and the text of a failure are not in the file. Throws BadInput naming file, line and column.
std::vector<cases::GreenKuboRow> read_viscosity_csv(const std::filesystem::path& path);

/// The stress correlations (times V/kT) of all states in long form: point (the line of viscosity.csv, from 1),
/// energy_per_particle, particles and time lead each line. A state without curves has no lines.
void write_correlation_csv(const std::filesystem::path& path, std::span<const cases::GreenKuboResult> results);

/// The further correlations of all states in long form, one line per state, pair and time. Without any, no file is
/// written.
void write_pairs_csv(const std::filesystem::path& path, std::span<const cases::GreenKuboResult> results);

}  // namespace lucy::files
