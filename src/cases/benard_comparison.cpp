// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/benard_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lucy/errors.hpp"

namespace lucy::cases {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Equal in all but the coefficients of the fluid.
bool same_cell(const Convection& one, const Convection& other) {
  Convection a = one;
  Convection b = other;
  set_unset(a);
  set_unset(b);
  return a.equation_of_state == b.equation_of_state && a.sides == b.sides && nearly_equal(a.hot, b.hot) &&
         nearly_equal(a.cold, b.cold) && nearly_equal(*a.width / a.height, *b.width / b.height) &&
         nearly_equal(*a.gravity * a.height, *b.gravity * b.height);
}

bool same_cell_of_same_height(const Convection& one, const Convection& other) {
  return same_cell(one, other) && nearly_equal(one.height, other.height);
}

BenardBeside beside(BenardSource source, const statistics::Estimate& ours, double value, double error,
                    double last_digit = 0.0) {
  BenardBeside other{.source = source, .value = value, .error = error, .last_digit = last_digit};
  other.difference = ours.value - value;
  other.difference_error = std::hypot(ours.error, error);
  other.per_cent = 100.0 * other.difference / value;
  other.per_cent_error = 100.0 * std::hypot(ours.error / value, ours.value * error / (value * value));
  other.z = other.difference / other.difference_error;
  if (!std::isfinite(other.z)) other.z = not_a_number;
  return other;
}

BenardBeside beside_print(const statistics::Estimate& ours, const PublishedCell& cell) {
  return beside(BenardSource::published, ours, cell.value, error_of_print(cell, 0.0, 0.0), cell.last_digit);
}

const Extrapolated& quantity_of(const BenardGridLimit& limit, std::string_view quantity) {
  if (quantity == "nusselt_hot") return limit.nusselt_hot;
  if (quantity == "nusselt_cold") return limit.nusselt_cold;
  return limit.kinetic_energy;
}

std::optional<BenardGridLimit> partner_of(const Convection& particles, std::span<const BenardGridLimit> limits) {
  for (const BenardGridLimit& limit : limits)
    if (limit.settings.transport == grid::Transport::dynamic && same_convection(particles, limit.settings))
      return limit;
  return std::nullopt;
}

const PublishedBenard* print_of(const Convection& convection, std::int64_t particles,
                                std::span<const PublishedBenard> published) {
  for (const PublishedBenard& print : published)
    if (print.particles == particles && same_convection(convection, print.convection)) return &print;
  return nullptr;
}

/// The different Rayleigh numbers of those of `all` whose convection(one) is in the cell of `cell`, from the lowest.
template <class All, class ConvectionOf>
std::vector<double> rayleigh_numbers(const All& all, const Convection& cell, const ConvectionOf& convection_of) {
  std::vector<double> numbers;
  for (const auto& one : all) {
    const Convection& convection = convection_of(one);
    if (same_cell_of_same_height(convection, cell)) numbers.push_back(*convection.rayleigh);
  }
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end(), nearly_equal), numbers.end());
  return numbers;
}

/// The flow with effective coefficients of a row: the one at the same place in the order of Rayleigh numbers.
std::optional<BenardGridLimit> effective_of(const Convection& mine, std::span<const BenardRow> particles,
                                            std::span<const BenardGridLimit> effective) {
  const auto theirs = rayleigh_numbers(
      effective, mine, [](const BenardGridLimit& limit) -> const Convection& { return limit.settings; });
  if (theirs.empty()) return std::nullopt;
  const auto ours =
      rayleigh_numbers(particles, mine, [](const BenardRow& row) -> const Convection& { return row.settings; });
  if (ours.size() != theirs.size())
    throw BadInput(
        fmt::format("with effective coefficients there are flows at {} Rayleigh number{} in the cell of {} x {}, where "
                    "particles have {}: they are matched in order, so there must be one for each",
                    theirs.size(), theirs.size() == 1 ? "" : "s", mine.height, width_of(mine), ours.size()));
  const auto place = std::ranges::find_if(ours, [&](double ra) { return nearly_equal(ra, *mine.rayleigh); });
  if (place == ours.end()) return std::nullopt;
  const double rayleigh = theirs[static_cast<std::size_t>(place - ours.begin())];
  for (const BenardGridLimit& limit : effective)
    if (same_cell_of_same_height(limit.settings, mine) && nearly_equal(*limit.settings.rayleigh, rayleigh))
      return limit;
  return std::nullopt;
}

std::size_t place_of(std::string_view quantity) {
  return static_cast<std::size_t>(std::ranges::find(benard_quantities, quantity) - benard_quantities.begin());
}

}  // namespace

bool same_convection(const Convection& one, const Convection& other) {
  Convection a = one;
  Convection b = other;
  set_unset(a);
  set_unset(b);
  return same_cell(a, b) && nearly_equal(*a.viscosity / a.height, *b.viscosity / b.height) &&
         nearly_equal(*a.conductivity / a.height, *b.conductivity / b.height);
}

std::vector<BenardComparison> compare_benard(std::span<const BenardRow> particles, std::span<const BenardGridRow> grid,
                                             std::span<const BenardGridRow> effective,
                                             std::span<const PublishedBenard> published) {
  const auto limits = limits_of(grid);
  const auto effective_limits = limits_of(effective);
  std::vector<BenardComparison> comparisons;
  for (const BenardRow& row : particles) {
    BenardComparison comparison{.particles = row,
                                .grid = partner_of(row.settings, limits),
                                .effective = effective_of(row.settings, particles, effective_limits),
                                .rows = {}};
    for (const std::string_view quantity : benard_compared) {
      const statistics::Estimate& ours = row[place_of(quantity)];
      BenardComparedRow compared{.quantity = quantity, .value = ours.value, .error = ours.error, .beside = {}};
      for (const auto& [source, limit] :
           {std::pair(BenardSource::grid, &comparison.grid), {BenardSource::effective_grid, &comparison.effective}})
        if (*limit) {
          const Extrapolated& theirs = quantity_of(**limit, quantity);
          compared.beside.push_back(beside(source, ours, theirs.value, theirs.error));
        }
      if (quantity == "kinetic_energy_total")
        if (const auto* print = print_of(row.settings, row.settings.particles, published))
          compared.beside.push_back(beside_print(ours, print->kinetic_energy));
      comparison.rows.push_back(std::move(compared));
    }
    if (const auto* print = print_of(row.settings, 0, published); print != nullptr && comparison.grid) {
      const statistics::Estimate continuum{comparison.grid->kinetic_energy.value, comparison.grid->kinetic_energy.error,
                                           not_a_number, 0};
      comparison.rows.push_back({.quantity = "kinetic_energy_continuum",
                                 .value = continuum.value,
                                 .error = continuum.error,
                                 .beside = {beside_print(continuum, print->kinetic_energy)}});
    }
    comparisons.push_back(std::move(comparison));
  }
  return comparisons;
}

}  // namespace lucy::cases
