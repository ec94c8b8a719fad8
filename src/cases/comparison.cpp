// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lucy::cases {

namespace {

constexpr std::size_t place(std::string_view name) {
  return static_cast<std::size_t>(std::find(compared_quantities.begin(), compared_quantities.end(), name) -
                                  compared_quantities.begin());
}
constexpr std::size_t pxy_kinetic = place("pxy_kinetic");
constexpr std::size_t pxy_potential = place("pxy_potential");
constexpr std::size_t viscosity = place("viscosity");

/// Place of each compared quantity among the columns of our table.
constexpr std::array<std::size_t, compared_quantities.size()> our_place = [] {
  std::array<std::size_t, compared_quantities.size()> places{};
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = static_cast<std::size_t>(std::find(quantities.begin(), quantities.end(), compared_quantities[i]) -
                                         quantities.begin());
  return places;
}();
static_assert(std::ranges::all_of(our_place, [](std::size_t i) { return i < quantities.size(); }));

bool same_state(const TableRow& ours, const PublishedRow& published) {
  return ours.particles == published.particles &&
         nearly_equal(ours.energy_per_particle, published.energy_per_particle) &&
         nearly_equal(ours.strain_rate, published.strain_rate);
}

ComparedRow compare_row(const TableRow& ours, const PublishedRow& published) {
  ComparedRow row{.particles = ours.particles,
                  .energy_per_particle = ours.energy_per_particle,
                  .strain_rate = ours.strain_rate,
                  .our_time = ours.replicas * (ours.duration - ours.equilibration_discarded),
                  .published_time = published.total_time,
                  .instability_region = published.instability_region,
                  .cells = {}};
  for (std::size_t quantity = 0; quantity < compared_quantities.size(); ++quantity) {
    const PublishedCell& theirs = published.cells[quantity];
    if (std::isnan(theirs.value)) continue;
    const statistics::Estimate& estimate = ours.estimates[our_place[quantity]];
    ComparedCell cell{.quantity = quantity,
                      .ours = estimate.value,
                      .our_error = estimate.error,
                      .published = theirs.value,
                      .published_error = error_of_print(theirs, estimate.error, row.our_time / row.published_time),
                      .last_digit = theirs.last_digit,
                      .difference = 0.0,
                      .standing = Standing::judged,
                      .why = {}};
    const double combined = std::hypot(cell.our_error, cell.published_error);
    cell.difference = (cell.ours - cell.published) / combined;
    if (!std::isfinite(cell.difference)) {
      cell.difference = std::numeric_limits<double>::quiet_NaN();
      cell.standing = Standing::no_error;
    } else if (published.instability_region) {
      cell.standing = Standing::instability_region;
    }
    if (!theirs.misprint) {
      row.cells.push_back(std::move(cell));
      continue;
    }
    ComparedCell read = cell;
    cell.standing = Standing::misprint;
    cell.why = theirs.why;
    row.cells.push_back(std::move(cell));
    if (!theirs.reading) continue;
    read.published = *theirs.reading;
    if (read.standing != Standing::no_error) read.difference = (read.ours - read.published) / combined;
    if (read.standing == Standing::judged) read.standing = Standing::read_differently;
    row.cells.push_back(std::move(read));
  }
  return row;
}

void judge(Comparison& comparison) {
  for (const ComparedRow& row : comparison.rows)
    for (const ComparedCell& cell : row.cells) {
      if (cell.standing != Standing::judged && cell.standing != Standing::read_differently) continue;
      const double size = std::abs(cell.difference);
      ++comparison.judged;
      if (cell.quantity != viscosity) {
        ++comparison.independent;
        comparison.chi_squared += size * size;
      }
      for (std::size_t i = 0; i < comparison.beyond.size(); ++i)
        if (size > 2.0 + static_cast<double>(i)) ++comparison.beyond[i];
      if (size >= comparison.largest) {
        comparison.largest = size;
        comparison.largest_where = fmt::format("{} at N = {}, E/N = {}, rate {}", compared_quantities[cell.quantity],
                                               row.particles, row.energy_per_particle, row.strain_rate);
      }
    }
  if (comparison.judged > 0) comparison.verdict = comparison.beyond[2] > 0 ? Verdict::disagree : Verdict::agree;
}

}  // namespace

bool nearly_equal(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); }

double error_of_print(const PublishedCell& cell, double our_error, double time_ratio) {
  if (cell.standard_error) return *cell.standard_error;
  return std::hypot(cell.last_digit / std::sqrt(12.0), our_error * std::sqrt(time_ratio));
}

void derive_viscosity(PublishedRow& row) {
  const PublishedCell& kinetic = row.cells[pxy_kinetic];
  const PublishedCell& potential = row.cells[pxy_potential];
  PublishedCell& cell = row.cells[viscosity];
  cell = {};
  if (row.strain_rate == 0.0) return;
  cell.value = -(kinetic.value + potential.value) / row.strain_rate;
  cell.last_digit = std::hypot(kinetic.last_digit, potential.last_digit) / std::abs(row.strain_rate);
  cell.misprint = kinetic.misprint || potential.misprint;
  const auto as_read = [](const PublishedCell& part) { return part.misprint ? part.reading : part.value; };
  if (cell.misprint && as_read(kinetic) && as_read(potential))
    cell.reading = -(*as_read(kinetic) + *as_read(potential)) / row.strain_rate;
  if (cell.misprint) cell.why = "follows from a misprinted part of P_xy";
}

Comparison compare(std::span<const TableRow> ours, const PublishedTable& published) {
  Comparison comparison;
  comparison.name = published.name;
  comparison.source = published.source;
  comparison.in_print = published.in_print;
  for (const TableRow& row : ours) {
    const auto partner =
        std::ranges::find_if(published.rows, [&](const auto& other) { return same_state(row, other); });
    if (partner == published.rows.end())
      comparison.only_ours.push_back(row);
    else
      comparison.rows.push_back(compare_row(row, *partner));
  }
  for (const PublishedRow& row : published.rows)
    if (std::ranges::none_of(ours, [&](const auto& other) { return same_state(other, row); }))
      comparison.only_published.push_back(row);
  judge(comparison);
  return comparison;
}

}  // namespace lucy::cases
