// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From what the replicas of a point recorded to series that statistics/ understands. `Record` has `samples` and
// `sample_interval`; a quantity is a function of one sample.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "lucy/statistics/equilibration.hpp"
#include "lucy/statistics/pooling.hpp"

namespace lucy::cases {

/// One series per replica.
using Series = std::vector<std::vector<double>>;

/// What `of` makes of each sample after the cuts.
template <class Record, class Quantity>
Series series_of(std::span<const Record> replicas, std::span<const std::size_t> cuts, const Quantity& of) {
  Series series(replicas.size());
  for (std::size_t r = 0; r < replicas.size(); ++r) {
    const auto kept = std::span(replicas[r].samples).subspan(cuts[r]);
    series[r].reserve(kept.size());
    for (const auto& sample : kept) series[r].push_back(of(sample));
  }
  return series;
}

inline std::vector<double> average(const Series& series) {
  std::vector<double> mean(series.front().size(), 0.0);
  for (const std::vector<double>& replica : series)
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += replica[i] / static_cast<double>(series.size());
  return mean;
}

/// Samples to drop from each replica: equilibration is sought in every one of `quantities`, in each replica alone and
/// in the average over replicas, where a transient common to all stands out of the noise (only when all replicas are
/// equally long). A replica loses the most that any of these asks for, at most half.
template <class Record, class... Quantities>
std::vector<std::size_t> equilibration_cuts(std::span<const Record> replicas, const Quantities&... quantities) {
  std::vector<std::size_t> cuts(replicas.size(), 0);
  const bool equally_long = std::all_of(replicas.begin(), replicas.end(), [&](const Record& record) {
    return record.samples.size() == replicas.front().samples.size();
  });
  const std::vector<std::size_t> all_samples(replicas.size(), 0);
  const auto look_at = [&](const auto& quantity) {
    const Series series = series_of(replicas, all_samples, quantity);
    const std::size_t common = replicas.size() > 1 && equally_long ? statistics::equilibration_cut(average(series)) : 0;
    for (std::size_t r = 0; r < replicas.size(); ++r)
      cuts[r] = std::max({cuts[r], common, statistics::equilibration_cut(series[r])});
  };
  (look_at(quantities), ...);
  return cuts;
}

/// What a reader has to know of replicas that contradict their own error bars.
inline std::string spread_warning(const statistics::ReplicaSpread& spread) {
  return fmt::format(
      "the replicas differ by more than their error bars allow (chi squared {:.3g} for {} degree{} of freedom, p = "
      "{:.1g}): do not believe the error bar, run longer",
      spread.chi_squared, spread.degrees_of_freedom, spread.degrees_of_freedom == 1 ? "" : "s", spread.p_value);
}

/// The time that was cut, mean over replicas.
template <class Record>
double discarded_time(std::span<const Record> replicas, std::span<const std::size_t> cuts) {
  double discarded = 0.0;
  for (std::size_t r = 0; r < replicas.size(); ++r)
    discarded += static_cast<double>(cuts[r]) * replicas[r].sample_interval;
  return replicas.empty() ? 0.0 : discarded / static_cast<double>(replicas.size());
}

/// The time that was recorded: the duration asked for, unless that is no whole number of samples.
template <class Record>
double recorded_time(double duration, std::span<const Record> replicas) {
  if (replicas.empty() || replicas[0].samples.empty()) return duration;
  const double recorded = replicas[0].sample_interval * static_cast<double>(replicas[0].samples.size());
  return std::abs(recorded - duration) > 1e-6 * duration ? recorded : duration;
}

}  // namespace lucy::cases
