// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Convection by particles beside that of the continuum and beside print: number by number, in per cent and in combined
// standard errors.
//
// A flow on the grid belongs to one of particles when both are the same problem of a continuum: fluid, sides, both
// temperatures, constant eta and k, and, in units of the height, the same width, gravity, viscosity and conductivity;
// this makes the Rayleigh number the same. The height itself has no part in it: a continuum has no length of its own.
//
// A second grid may have been run with the coefficients that particles effectively have. Those are lengths times
// velocities, so there the height has to be the same as well; and as Rayleigh numbers are not, the fluids of one cell
// belong together in the order of their Rayleigh numbers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lucy/cases/benard_grid_table.hpp"
#include "lucy/cases/benard_table.hpp"
#include "lucy/cases/comparison.hpp"
#include "lucy/statistics/pooling.hpp"

namespace lucy::cases {

/// What is compared. Particles have three kinetic energies (benard.hpp), a continuum has one; print does not say which
/// of the three it has, and is laid beside the total.
inline constexpr std::array<std::string_view, 5> benard_compared = {
    "kinetic_energy_total", "kinetic_energy_smoothed", "kinetic_energy_field", "nusselt_hot", "nusselt_cold"};

/// A kinetic energy per mass as published.
struct PublishedBenard {
  std::int64_t particles = 0;  ///< 0: of a continuum
  Convection convection;
  PublishedCell kinetic_energy;
  std::string source;
};

enum class BenardSource { grid, effective_grid, published };
inline constexpr std::array<std::pair<std::string_view, BenardSource>, 3> benard_source_names = {{
    {"grid", BenardSource::grid},
    {"effective-grid", BenardSource::effective_grid},
    {"published", BenardSource::published},
}};

/// A number that stands beside another one, and how far that other one is from it; errors are nan where one is.
struct BenardBeside {
  BenardSource source = BenardSource::grid;
  double value = 0.0;
  double error = 0.0;       ///< grid: of the extrapolation; published: rounding of print alone
  double last_digit = 0.0;  ///< of print; 0: not printed
  double difference = 0.0;  ///< the other one less this
  double difference_error = 0.0;
  double per_cent = 0.0;  ///< of this
  double per_cent_error = 0.0;
  double z = 0.0;  ///< the difference in combined standard errors
};

struct BenardComparedRow {
  std::string_view quantity;  ///< of benard_compared, or kinetic_energy_continuum: the grid's, beside print
  double value = 0.0;
  double error = 0.0;
  std::vector<BenardBeside> beside;  ///< those that there are, in the order of BenardSource
};

struct BenardComparison {
  BenardRow particles;
  std::optional<BenardGridLimit> grid;
  std::optional<BenardGridLimit> effective;
  std::vector<BenardComparedRow> rows;  ///< of all benard_compared, then of the continuum where it has a print
};

/// Whether two are the same problem of a continuum, as told above; all numbers to one part in 10^9.
bool same_convection(const Convection& one, const Convection& other);

/// One entry for every row of particles, in their order, with what belongs to it; `grid` and `effective` are steady
/// flows on any number of meshes. Throws BadInput when `effective` has flows in a cell of particles, but not as many
/// as these have Rayleigh numbers.
std::vector<BenardComparison> compare_benard(std::span<const BenardRow> particles, std::span<const BenardGridRow> grid,
                                             std::span<const BenardGridRow> effective,
                                             std::span<const PublishedBenard> published);

}  // namespace lucy::cases
