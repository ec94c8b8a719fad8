// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Time correlation functions of sampled quantities,
//
//     C(k) = 1/(n - k) sum_{i=0}^{n-k-1} a_i b_{i+k}          (unbiased; k counts sampling intervals)
//
// by two accumulators of one shape: values go in as they are sampled, in order of time; the result can be asked for at
// any moment and leaves the accumulator as it was; save() and load() keep every bit; merge() pools the pairs of an
// independent series of the same settings.
//
//     FftCorrelator          every lag below `lags`, all pairs, by FFTW (Wiener and Khinchin, zero padding), segment by
//                            segment with what the next one needs of the last: memory is that of one segment
//     MultipleTauCorrelator  lags to the length of the series in levels, each level averaging `averaged` values of the
//                            one before (Ramirez, Sukumaran, Vorselaars, Likhtman, J. Chem. Phys. 133, 154103 (2010));
//                            memory grows with the logarithm of the longest lag; a value may be a vector, its
//                            correlation the scalar product
//
// Quantities with a mean of their own: with Means::subtracted the result is the covariance, the product of the means of
// exactly those a_i and b_{i+k} that take part in C(k) being taken off. Either way sums are taken from the first value
// that came in, so that a mean far larger than the fluctuations costs no digits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lucy/archive.hpp"

namespace lucy::measure {

enum class Means {
  known_zero,  ///< by symmetry: products as they are
  subtracted
};

/// A correlation function at increasing lags; lags that no pair has reached are not there.
struct Correlation {
  std::vector<double> lag;          ///< in sampling intervals
  std::vector<double> value;        ///< mean of the products
  std::vector<std::int64_t> pairs;  ///< products that were averaged
  std::vector<double> mean_a;       ///< of the a_i and b_{i+k} that took part, lag by lag; empty for vectors
  std::vector<double> mean_b;
};

class FftCorrelator {
 public:
  /// Lags 0 to lags - 1. `segment`: samples, at least, that one transform takes in (their partners apart); rounded up
  /// to a good length of the transform; 0: chosen (a few times `lags`). Throws std::invalid_argument for lags == 0.
  explicit FftCorrelator(std::size_t lags, std::size_t segment = 0);
  ~FftCorrelator();
  FftCorrelator(FftCorrelator&&) noexcept;
  FftCorrelator& operator=(FftCorrelator&&) noexcept;

  void add(double a, double b);
  void add(double a) { add(a, a); }
  /// Of everything added so far: what a double loop over the whole series gives, to rounding of C(0).
  Correlation result(Means means = Means::known_zero) const;
  /// Added here or to what was merged.
  std::int64_t samples() const;

  void save(ArchiveWriter& archive) const;
  /// Throws RunFailed when the state is of other settings or truncated, and leaves the accumulator as it was.
  void load(ArchiveReader& archive);
  /// Pools the pairs of `other`, an independent series; what is added afterwards continues this one's own. Throws
  /// std::invalid_argument when the settings differ.
  void merge(const FftCorrelator& other);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

class MultipleTauCorrelator {
 public:
  struct Settings {
    std::size_t components = 1;       ///< numbers per value; C is the sum over them
    double longest_lag = 1000.0;      ///< in sampling intervals; levels are added until they reach it
    std::size_t lags_per_level = 16;  ///< a multiple of `averaged`
    std::size_t averaged = 2;         ///< values that become one of the next level

    bool operator==(const Settings&) const = default;
  };

  /// Throws std::invalid_argument for settings that make no level.
  explicit MultipleTauCorrelator(const Settings& settings);
  ~MultipleTauCorrelator();
  MultipleTauCorrelator(MultipleTauCorrelator&&) noexcept;
  MultipleTauCorrelator& operator=(MultipleTauCorrelator&&) noexcept;

  /// `components` numbers each; throws std::invalid_argument for any other count.
  void add(std::span<const double> a, std::span<const double> b);
  void add(std::span<const double> a) { add(a, a); }
  void add(double a, double b) { add(std::span(&a, 1), std::span(&b, 1)); }
  void add(double a) { add(a, a); }
  /// On the first level what a double loop gives, to rounding; on level l the same for series averaged over averaged^l
  /// consecutive values, at the lags beyond those of level l - 1.
  Correlation result(Means means = Means::known_zero) const;
  /// Added here or to what was merged.
  std::int64_t samples() const;

  void save(ArchiveWriter& archive) const;
  /// As FftCorrelator::load.
  void load(ArchiveReader& archive);
  /// As FftCorrelator::merge.
  void merge(const MultipleTauCorrelator& other);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace lucy::measure
