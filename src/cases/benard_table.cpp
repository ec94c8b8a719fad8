// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/benard_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cases/recorded_series.hpp"
#include "lucy/statistics/jackknife.hpp"

namespace lucy::cases {

namespace {

using measure::Moments;
using statistics::Estimate;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr Estimate unknown = {not_a_number, not_a_number, not_a_number, 0};
// A flow whose field has less kinetic energy than this share of the particles' own stands still.
constexpr double frozen_share = 1e-3;

double average(const BenardSample& sample, std::size_t place) { return sample.averages[place]; }

double kinetic_energy(const BenardSample& sample) { return average(sample, benard_average("kinetic_energy_total")); }

double value_of(const BenardSample& sample, std::size_t quantity) {
  const double hot = average(sample, benard_average("conduction_hot")) + average(sample, benard_average("work_hot"));
  const double cold = average(sample, benard_average("conduction_cold")) + average(sample, benard_average("work_cold"));
  const double sides =
      average(sample, benard_average("conduction_sides")) + average(sample, benard_average("work_sides"));
  switch (quantity) {
    case benard_quantity("nusselt_hot"):
      return hot;
    case benard_quantity("nusselt_cold"):
      return -cold;
    case benard_quantity("nusselt_sides"):
      return sides;
    case benard_quantity("energy_imbalance"):
      return hot + cold + sides - average(sample, benard_average("stored"));
    default:
      break;
  }
  const std::size_t place = quantity - benard_derived;
  return place < benard_averages.size() ? sample.averages[place] : sample.instants[place - benard_averages.size()];
}

/// Without an error of these a row is too short. Of the others, extremes over particles among them, some may drift.
bool decides_status(std::size_t quantity) {
  switch (quantity) {
    case benard_quantity("kinetic_energy_total"):
    case benard_quantity("kinetic_energy_smoothed"):
    case benard_quantity("kinetic_energy_field"):
    case benard_quantity("nusselt_hot"):
    case benard_quantity("nusselt_cold"):
      return true;
    default:
      return false;
  }
}

/// What was recorded after the equilibration that was asked for.
std::vector<BenardRecord> after_equilibration(const BenardPoint& point, std::span<const BenardRecord> replicas) {
  const auto skip = static_cast<std::size_t>(equilibration_intervals(point));
  std::vector<BenardRecord> kept;
  for (const BenardRecord& record : replicas) {
    BenardRecord rest;
    rest.sample_interval = record.sample_interval;
    if (record.samples.size() > skip)
      rest.samples.assign(record.samples.begin() + static_cast<std::ptrdiff_t>(skip), record.samples.end());
    kept.push_back(std::move(rest));
  }
  return kept;
}

bool any_sample(std::span<const BenardRecord> records) {
  return std::ranges::any_of(records, [](const BenardRecord& record) { return !record.samples.empty(); });
}

struct Block {
  const Moments<2>* moments;
  double samples;
};

std::vector<Block> blocks_of(std::span<const BenardRecord> replicas) {
  std::vector<Block> blocks;
  for (const BenardRecord& record : replicas)
    for (std::size_t b = 0; b < record.blocks.size(); ++b)
      if (record.block_samples[b] > 0.0) blocks.push_back({&record.blocks[b], record.block_samples[b]});
  return blocks;
}

/// The mean over all samples of all blocks but one; `blocks.size()`: of all.
Moments<2> mean_without(std::span<const Block> blocks, std::size_t left_out) {
  Moments<2> sum(blocks.front().moments->places());
  double samples = 0.0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (b == left_out) continue;
    sum.add(*blocks[b].moments);
    samples += blocks[b].samples;
  }
  sum.divide_by(samples);
  return sum;
}

Estimate field_energy(std::span<const BenardRecord> replicas) {
  const std::vector<Block> blocks = blocks_of(replicas);
  if (blocks.empty()) return unknown;
  return statistics::jackknife(
      blocks.size(), [&](std::size_t left_out) { return kinetic_energy_of_mean_flow(mean_without(blocks, left_out)); });
}

std::span<const BenardRecord> that_count(const BenardPoint& point, std::span<const BenardRecord> replicas) {
  return replicas.size() > 1 && all_replicas_alike(point) ? replicas.first(1) : replicas;
}

BenardRow row_head(const BenardPoint& point, double duration) {
  BenardRow row;
  row.settings = resolved(point);
  row.duration = duration;
  row.estimates.fill(unknown);
  row.effective_samples = not_a_number;
  return row;
}

std::vector<std::string> warnings_of(const BenardPoint& point, const BenardRow& row,
                                     const statistics::ReplicaSpread& spread, std::size_t replicas) {
  std::vector<std::string> warnings;
  if (replicas > 1 && all_replicas_alike(point))
    warnings.emplace_back("all replicas are the same, since start.disorder is 0: the first alone counts");
  if (spread.contradicts_errors()) warnings.push_back(spread_warning(spread));
  const double stored = row[benard_quantity("stored")].value;
  const double given = row[benard_quantity("nusselt_hot")].value;
  if (row.failure.empty() && std::abs(stored) > 0.05 * std::abs(given))
    warnings.push_back(
        fmt::format("the fluid stores {:.2g} of the heat that the floor gives: the flow is not steady yet; lengthen "
                    "run.equilibration",
                    stored / given));
  const double total = row[benard_quantity("kinetic_energy_total")].value;
  const double field = row[benard_quantity("kinetic_energy_field")].value;
  if (row.failure.empty() && field < frozen_share * total)
    warnings.push_back(
        fmt::format("nothing flows: the particles' own motion apart, the kinetic energy is {:.1g} per mass", field));
  return warnings;
}

}  // namespace

double kinetic_energy_of_mean_flow(const Moments<2>& moments) {
  using M = Moments<2>;
  double energy = 0.0;
  double mass = 0.0;
  for (std::size_t k = 0; k < moments.places(); ++k) {
    const double rho = moments.column[M::density][k];
    mass += rho;
    if (!(rho > 0.0)) continue;
    for (std::size_t d = 0; d < 2; ++d) {
      const double momentum = moments.column[M::momentum + d][k];
      energy += 0.5 * momentum * momentum / rho;
    }
  }
  return energy / mass;
}

Moments<2> averaged_moments(const BenardPoint& point, std::span<const BenardRecord> replicas) {
  const std::vector<Block> blocks = blocks_of(that_count(point, replicas));
  if (blocks.empty()) return Moments<2>(0);
  return mean_without(blocks, blocks.size());
}

BenardRow summarize(const BenardPoint& point, std::span<const BenardRecord> all_replicas) {
  const auto replicas = that_count(point, all_replicas);
  const std::vector<BenardRecord> averaged = after_equilibration(point, replicas);
  BenardRow row = row_head(point, recorded_time(point.duration, std::span(averaged)));
  for (const BenardRecord& record : replicas) {
    row.worst_energy_error = std::max(row.worst_energy_error, record.worst_energy_error);
    if (std::abs(record.energy_drift) > std::abs(row.energy_drift)) row.energy_drift = record.energy_drift;
    row.subdivided_steps += record.subdivided_steps;
    row.reflections += record.reflections;
    if (!record.failure.empty() && row.failure.empty()) row.failure = record.failure;
  }
  statistics::ReplicaSpread spread = {not_a_number, 0, not_a_number};
  bool known = false;
  if (any_sample(averaged)) {
    const std::vector<std::size_t> cuts = equilibration_cuts(std::span(averaged), kinetic_energy);
    row.equilibration_discarded = discarded_time(std::span(averaged), std::span(cuts));
    const auto series = [&](std::size_t quantity) {
      return series_of(std::span(averaged), std::span(cuts),
                       [quantity](const BenardSample& sample) { return value_of(sample, quantity); });
    };
    known = true;
    for (std::size_t q = 0; q < row.estimates.size(); ++q) {
      row.estimates[q] =
          q == benard_quantity("kinetic_energy_field") ? field_energy(replicas) : statistics::pooled_mean(series(q));
      if (decides_status(q)) known = known && !std::isnan(row.estimates[q].error);
    }
    row.effective_samples = row[benard_quantity("kinetic_energy_total")].effective_samples;
    spread = statistics::replica_spread(series(benard_quantity("kinetic_energy_total")));
  }
  row.status = !row.failure.empty() ? RowStatus::failed : known ? RowStatus::ok : RowStatus::too_short;
  row.warnings = warnings_of(point, row, spread, all_replicas.size());
  return row;
}

BenardRow failed_row(const BenardPoint& point, std::string message) {
  BenardRow row = row_head(point, point.duration);
  row.equilibration_discarded = not_a_number;
  row.worst_energy_error = not_a_number;
  row.energy_drift = not_a_number;
  row.status = RowStatus::failed;
  row.failure = std::move(message);
  return row;
}

Estimate current_kinetic_energy(const BenardPoint& point, std::span<const BenardRecord> all_replicas) {
  const std::vector<BenardRecord> averaged = after_equilibration(point, that_count(point, all_replicas));
  if (!any_sample(averaged)) return unknown;
  const std::vector<std::size_t> cuts = equilibration_cuts(std::span(averaged), kinetic_energy);
  return statistics::pooled_mean(series_of(std::span(averaged), std::span(cuts), kinetic_energy));
}

}  // namespace lucy::cases
