// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Published tables as the project ships them in reference/: NAME.csv with the digits of print, index.csv with what each
// table is about, NAME_errata.csv or the like with the cells whose print is known to be wrong. Data stay as printed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lucy/cases/comparison.hpp"
#include "lucy/cases/viscosities.hpp"

namespace lucy::files {

/// A table by its name in `reference_directory`/index.csv, or by the path of a CSV file: one with the columns of the
/// shipped tables and, unless its stem is in the index, a column energy_per_particle; or a table.csv of Lucy, or
/// the directory that holds it.
/// Throws BadInput naming file and line, or, for an unknown name, the names there are.
cases::PublishedTable read_published_table(const std::string& name_or_path,
                                           const std::filesystem::path& reference_directory);

/// The names in index.csv. Throws BadInput when it cannot be read.
std::vector<std::string> published_table_names(const std::filesystem::path& reference_directory);

/// Published Green-Kubo values: a CSV file with columns particles, energy_per_particle, viscosity, total_time,
/// pressure, pressure_kinetic and source, the digits as printed (an empty pressure was not printed); a column
/// viscosity_error may give errors of print. Throws BadInput naming file and line.
std::vector<cases::PublishedGreenKubo> read_published_green_kubo(const std::filesystem::path& path);

}  // namespace lucy::files
