// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the pairs (a_i, b_{i+k}) of one lag add up to: everything that a correlation function is made of, from one
// series or from several that were pooled. Values are taken from a reference r near their mean, component by component:
//
//     sum (a_i - r_a) . (b_{i+k} - r_b),     sum (a_i - r_a),     sum (b_{i+k} - r_b)
//
// so that neither the covariance loses its digits to a large mean, nor sums to a long series.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/measure/correlator.hpp"

namespace lucy::measure {

/// A point near all values of a series.
struct Reference {
  std::vector<double> a;  ///< one number per component
  std::vector<double> b;
};

struct PairSums {
  std::vector<std::int64_t> pairs;  ///< per lag
  std::vector<double> product;      ///< per lag
  std::vector<double> a;            ///< per lag and component
  std::vector<double> b;

  PairSums() = default;
  PairSums(std::size_t lags, std::size_t components)
      : pairs(lags), product(lags), a(lags * components), b(lags * components) {}

  /// Adds the sums of another series, taken from `there`, to those taken from `here`.
  void pool(const PairSums& other, const Reference& there, const Reference& here);

  /// Means over the pairs; lags without pairs are left out. `lag`: one per entry of `pairs`.
  Correlation correlation(std::span<const double> lag, const Reference& reference, Means means) const;

  void save(ArchiveWriter& archive) const;
  /// Throws RunFailed unless what was saved has the same lags and components.
  void load(ArchiveReader& archive);
};

/// The next sequence of the archive, into `values`, which keeps its length. Throws RunFailed when it has another.
template <class Container>
void load_values(ArchiveReader& archive, Container& values) {
  const std::size_t count = values.size();
  archive.get_sequence(values);
  if (values.size() != count) throw RunFailed("a saved accumulator does not fit its own settings");
}

}  // namespace lucy::measure
