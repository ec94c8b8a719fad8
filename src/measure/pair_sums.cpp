// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/pair_sums.hpp"

namespace lucy::measure {

void PairSums::pool(const PairSums& other, const Reference& there, const Reference& here) {
  const std::size_t components = here.a.size();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto count = static_cast<double>(other.pairs[k]);
    pairs[k] += other.pairs[k];
    product[k] += other.product[k];
    for (std::size_t c = 0; c < components; ++c) {
      const std::size_t at = k * components + c;
      const double moved_a = there.a[c] - here.a[c];
      const double moved_b = there.b[c] - here.b[c];
      product[k] += moved_a * other.b[at] + moved_b * other.a[at] + count * moved_a * moved_b;
      a[at] += other.a[at] + count * moved_a;
      b[at] += other.b[at] + count * moved_b;
    }
  }
}

Correlation PairSums::correlation(std::span<const double> lag, const Reference& reference, Means means) const {
  const std::size_t components = reference.a.size();
  Correlation result;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (pairs[k] == 0) continue;
    const auto count = static_cast<double>(pairs[k]);
    double of_means = 0.0;  // what the references or the means add to the product
    for (std::size_t c = 0; c < components; ++c) {
      const double mean_a = a[k * components + c] / count;
      const double mean_b = b[k * components + c] / count;
      of_means += means == Means::subtracted ? -mean_a * mean_b
                                             : reference.a[c] * (reference.b[c] + mean_b) + mean_a * reference.b[c];
    }
    result.lag.push_back(lag[k]);
    result.value.push_back(product[k] / count + of_means);
    result.pairs.push_back(pairs[k]);
    if (components == 1) {
      result.mean_a.push_back(reference.a[0] + a[k] / count);
      result.mean_b.push_back(reference.b[0] + b[k] / count);
    }
  }
  return result;
}

void PairSums::save(ArchiveWriter& archive) const {
  archive.put_sequence(pairs);
  archive.put_sequence(product);
  archive.put_sequence(a);
  archive.put_sequence(b);
}

void PairSums::load(ArchiveReader& archive) {
  load_values(archive, pairs);
  load_values(archive, product);
  load_values(archive, a);
  load_values(archive, b);
}

}  // namespace lucy::measure
