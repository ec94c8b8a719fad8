// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Our table beside a published one, cell by cell, in combined standard errors.
//
//     z = (ours - published) / s        s^2 = our error^2 + u^2 / 12 + our error^2 (our total time / theirs)
//
// u is one unit of the last printed digit; the last term estimates the statistical error of a table printed without
// error bars: ours, scaled by the lengths of the two runs. Our total time is replicas (duration - discarded), theirs
// the printed run length over the strain rate. A table that states its own errors has those instead of the last two
// terms.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/cases/couette_table.hpp"

namespace lucy::cases {

/// What is compared. The viscosity is not printed in the tables but follows from the two parts of P_xy; it counts for
/// the verdict, not for chi squared.
inline constexpr std::array<std::string_view, 8> compared_quantities = {
    "potential_energy", "pxy_kinetic", "pxy_potential", "pxx_kinetic",
    "pxx_potential",    "pyy_kinetic", "pyy_potential", "viscosity"};

struct PublishedCell {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< as printed; nan: not published
  double last_digit = 0.0;                                  ///< one unit of the last printed digit
  std::optional<double> standard_error = {};                ///< when the source gives one
  bool misprint = false;               ///< known to be wrong in print: `value` takes no part in the verdict
  std::optional<double> reading = {};  ///< what the print should have said, when that is known: takes part instead
  std::string why = {};                ///< of a misprint
};

struct PublishedRow {
  std::int64_t particles = 0;
  double energy_per_particle = 0.0;
  double strain_rate = 0.0;
  double total_time = 0.0;          ///< of the published average
  bool instability_region = false;  ///< averages there depend on the run length: no part in the verdict
  std::array<PublishedCell, compared_quantities.size()> cells{};
};

struct PublishedTable {
  std::string name;
  std::string source;
  std::vector<PublishedRow> rows;
  bool in_print = true;  ///< false: another table.csv, with errors of its own
};

/// Fills the viscosity of a row from its printed P_xy, misprints included.
void derive_viscosity(PublishedRow& row);

/// Why a cell counts or does not.
enum class Standing { judged, read_differently, misprint, instability_region, no_error };

struct ComparedCell {
  std::size_t quantity = 0;  ///< place in compared_quantities
  double ours = 0.0;
  double our_error = 0.0;
  double published = 0.0;
  double published_error = 0.0;
  double last_digit = 0.0;  ///< of the published value; 0: not printed
  double difference = 0.0;  ///< in combined standard errors; nan when that cannot be given
  Standing standing = Standing::judged;
  std::string why = {};  ///< of a misprint
};

struct ComparedRow {
  std::int64_t particles = 0;
  double energy_per_particle = 0.0;
  double strain_rate = 0.0;
  double our_time = 0.0;
  double published_time = 0.0;
  bool instability_region = false;
  std::vector<ComparedCell> cells;  ///< a misprinted cell with a reading stands twice: as printed, then as read
};

enum class Verdict { agree, disagree, nothing_to_judge };

struct Comparison {
  std::string name;
  std::string source;
  bool in_print = true;
  std::vector<ComparedRow> rows;
  std::vector<TableRow> only_ours;           ///< no published row of this N, E/N and rate
  std::vector<PublishedRow> only_published;  ///< not among our rows
  int judged = 0;                            ///< cells that count, viscosities included
  int independent = 0;                       ///< those that were printed
  double chi_squared = 0.0;  ///< sum of squared differences over the `independent` cells (not strictly independent:
                             ///< in each row the energy couples Phi and the two kinetic pressures)
  double largest = 0.0;      ///< |difference| over all judged cells
  std::string largest_where;
  std::array<int, 3> beyond{};                  ///< judged cells beyond 2, 3 and 4 combined standard errors
  Verdict verdict = Verdict::nothing_to_judge;  ///< disagree: a judged cell is beyond 4
};

/// Equal to one part in 10^9.
bool nearly_equal(double a, double b);

/// The standard error of a published value: its own, or else rounding of print and, scaled by (our total
/// time)/(theirs), the statistical error of ours.
double error_of_print(const PublishedCell& cell, double our_error, double time_ratio);

/// Rows are matched by particle number, energy and strain rate (the latter two to one part in 10^9).
Comparison compare(std::span<const TableRow> ours, const PublishedTable& published);

}  // namespace lucy::cases
