// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One transform of length M takes in a segment of S origins and L - 1 samples after it, M >= S + L - 1:
//
//     sum_{i < S} a_i b_{i+k} = 1/M sum_q conj(A_q) B_q exp(2 pi i q k/M),     0 <= k < L
//
// A of the origins followed by zeros, B of the whole. No pair is met twice and none is wrapped around, so the sum over
// segments has every pair of the series. It is kept as a spectrum: only result() transforms back.
#include <algorithm>
#include <bit>
#include <complex>
#include <stdexcept>
#include <string>

#include "lucy/measure/correlator.hpp"
#include "measure/pair_sums.hpp"
#include "measure/real_transform.hpp"

namespace lucy::measure {

namespace {

// Transforms of four times the lags cost little more per sample than longer ones, and of 256 hardly more than shorter.
constexpr std::size_t least_transform = 256;

std::size_t transform_length(std::size_t lags, std::size_t segment) {
  if (lags == 0) throw std::invalid_argument("a correlation function needs at least one lag");
  return segment == 0 ? std::bit_ceil(std::max(4 * lags, least_transform)) : std::bit_ceil(segment + lags - 1);
}

}  // namespace

struct FftCorrelator::Implementation {
  std::size_t lags;
  std::shared_ptr<const RealTransform> transform;
  std::size_t segment;

  // Of the series that is being taken in, from the reference.
  Reference reference{{0.0}, {0.0}};
  std::int64_t samples = 0;
  double total_a = 0.0;
  double total_b = 0.0;
  std::vector<double> first_b;  // up to lags - 1
  std::vector<double> a;        // samples that are still origins to come, lags - 1 at least once there are so many
  std::vector<double> b;
  RealTransform::Spectrum products;  // conj(A) B, summed over the segments that are done

  // Of the series that were merged; no lags before there are any.
  std::int64_t merged_samples = 0;
  PairSums merged;

  Implementation(std::size_t lag_count, std::size_t segment_wanted)
      : lags(lag_count),
        transform(RealTransform::of(transform_length(lag_count, segment_wanted))),
        segment(transform->length() - lag_count + 1),
        products(transform->frequencies()) {
    first_b.reserve(lags - 1);
    a.reserve(transform->length());
    b.reserve(transform->length());
  }

  void add(double of_a, double of_b) {
    if (samples + merged_samples == 0) reference = {{of_a}, {of_b}};
    const double from_a = of_a - reference.a[0];
    const double from_b = of_b - reference.b[0];
    total_a += from_a;
    total_b += from_b;
    if (first_b.size() + 1 < lags) first_b.push_back(from_b);
    a.push_back(from_a);
    b.push_back(from_b);
    ++samples;
    if (a.size() == transform->length()) {
      add_products(0, products);
      a.erase(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(segment));
      b.erase(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(segment));
    }
  }

  /// Adds the products of the origins from `begin` on, one segment of them at most, with all their partners.
  void add_products(std::size_t begin, RealTransform::Spectrum& to) const {
    RealTransform::Sequence padded(transform->length());
    RealTransform::Spectrum of_a(transform->frequencies());
    RealTransform::Spectrum of_b(transform->frequencies());
    const auto start = static_cast<std::ptrdiff_t>(begin);
    std::copy_n(a.begin() + start, std::min(segment, a.size() - begin), padded.begin());
    transform->forward(padded, of_a);
    std::copy_n(b.begin() + start, std::min(transform->length(), b.size() - begin), padded.begin());
    transform->forward(padded, of_b);
    for (std::size_t q = 0; q < to.size(); ++q) {
      const double real = of_a[q].real() * of_b[q].real() + of_a[q].imag() * of_b[q].imag();
      const double imaginary = of_a[q].real() * of_b[q].imag() - of_a[q].imag() * of_b[q].real();
      to[q] += std::complex(real, imaginary);
    }
  }

  /// Of all series.
  PairSums sums() const {
    PairSums result(lags, 1);
    if (samples > 0) {
      RealTransform::Spectrum all = products;
      for (std::size_t begin = 0; begin < a.size(); begin += segment) add_products(begin, all);
      RealTransform::Sequence summed(transform->length());
      transform->backward(all, summed);
      double left_a = total_a;  // of the first n - k
      double left_b = total_b;  // of the last n - k
      for (std::size_t k = 0; k < lags && static_cast<std::int64_t>(k) < samples; ++k) {
        if (k > 0) {
          left_a -= a[a.size() - k];
          left_b -= first_b[k - 1];
        }
        result.pairs[k] = samples - static_cast<std::int64_t>(k);
        result.product[k] = summed[k] / static_cast<double>(transform->length());
        result.a[k] = left_a;
        result.b[k] = left_b;
      }
    }
    if (merged_samples > 0) result.pool(merged, reference, reference);
    return result;
  }
};

FftCorrelator::FftCorrelator(std::size_t lags, std::size_t segment)
    : self_(std::make_unique<Implementation>(lags, segment)) {}
FftCorrelator::~FftCorrelator() = default;
FftCorrelator::FftCorrelator(FftCorrelator&&) noexcept = default;
FftCorrelator& FftCorrelator::operator=(FftCorrelator&&) noexcept = default;

void FftCorrelator::add(double a, double b) { self_->add(a, b); }

Correlation FftCorrelator::result(Means means) const {
  std::vector<double> lag(self_->lags);
  for (std::size_t k = 0; k < lag.size(); ++k) lag[k] = static_cast<double>(k);
  return self_->sums().correlation(lag, self_->reference, means);
}

std::int64_t FftCorrelator::samples() const { return self_->samples + self_->merged_samples; }

void FftCorrelator::save(ArchiveWriter& archive) const {
  const Implementation& self = *self_;
  archive.put(self.lags);
  archive.put(self.transform->length());
  archive.put(self.reference.a[0]);
  archive.put(self.reference.b[0]);
  archive.put(self.samples);
  archive.put(self.total_a);
  archive.put(self.total_b);
  archive.put_sequence(self.first_b);
  archive.put_sequence(self.a);
  archive.put_sequence(self.b);
  archive.put_sequence(self.products);
  archive.put(self.merged_samples);
  if (self.merged_samples > 0) self.merged.save(archive);
}

void FftCorrelator::load(ArchiveReader& archive) {
  const auto lags = archive.get<std::size_t>();
  const auto length = archive.get<std::size_t>();
  if (lags != self_->lags || length != self_->transform->length()) {
    throw RunFailed("a saved correlation function has " + std::to_string(lags) + " lags in transforms of " +
                    std::to_string(length) + ", where " + std::to_string(self_->lags) + " in " +
                    std::to_string(self_->transform->length()) + " are asked for");
  }
  auto loaded = std::make_unique<Implementation>(lags, self_->segment);
  loaded->reference.a[0] = archive.get<double>();
  loaded->reference.b[0] = archive.get<double>();
  loaded->samples = archive.get<std::int64_t>();
  loaded->total_a = archive.get<double>();
  loaded->total_b = archive.get<double>();
  archive.get_sequence(loaded->first_b);
  archive.get_sequence(loaded->a);
  archive.get_sequence(loaded->b);
  const auto taken = static_cast<std::size_t>(loaded->samples);
  const std::size_t done = taken < length ? 0 : ((taken - length) / loaded->segment + 1) * loaded->segment;
  if (loaded->first_b.size() != std::min(lags - 1, taken) || loaded->a.size() != taken - done ||
      loaded->b.size() != taken - done) {
    throw RunFailed("a saved correlation function does not hold the samples that it counts");
  }
  load_values(archive, loaded->products);
  loaded->merged_samples = archive.get<std::int64_t>();
  if (loaded->merged_samples > 0) {
    loaded->merged = PairSums(lags, 1);
    loaded->merged.load(archive);
  }
  loaded->a.reserve(length);
  loaded->b.reserve(length);
  self_ = std::move(loaded);
}

void FftCorrelator::merge(const FftCorrelator& other) {
  Implementation& self = *self_;
  if (self.lags != other.self_->lags || self.transform->length() != other.self_->transform->length())
    throw std::invalid_argument("correlation functions of different settings cannot be merged");
  if (other.samples() == 0) return;
  const PairSums sums = other.self_->sums();
  const std::int64_t samples = other.samples();
  if (this->samples() == 0) self.reference = other.self_->reference;
  if (self.merged_samples == 0) self.merged = PairSums(self.lags, 1);
  self.merged.pool(sums, other.self_->reference, self.reference);
  self.merged_samples += samples;
}

}  // namespace lucy::measure
