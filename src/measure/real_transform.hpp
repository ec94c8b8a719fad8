// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Discrete Fourier transforms of real sequences, by FFTW:
//
//     X_k = sum_{n=0}^{M-1} x_n exp(-2 pi i k n/M),     0 <= k <= M/2
//
// Plans are estimated, never timed, so that the same numbers give the same bits at every call.
#pragma once

#include <complex>
#include <cstddef>
#include <memory>

#include "lucy/space/columns.hpp"

namespace lucy::measure {

class RealTransform {
 public:
  using Sequence = space::AlignedVector<double>;
  using Spectrum = space::AlignedVector<std::complex<double>>;

  /// That of length M >= 1, shared by all who ask for this length. From any thread.
  static std::shared_ptr<const RealTransform> of(std::size_t length);

  ~RealTransform();
  RealTransform(const RealTransform&) = delete;
  RealTransform& operator=(const RealTransform&) = delete;

  std::size_t length() const { return length_; }
  std::size_t frequencies() const { return length_ / 2 + 1; }

  /// `x` of length() values, kept; `spectrum` of frequencies() values. From any thread.
  void forward(const Sequence& x, Spectrum& spectrum) const;
  /// The other way, length() times the inverse; overwrites `spectrum`. From any thread.
  void backward(Spectrum& spectrum, Sequence& x) const;

 private:
  struct Plans;

  explicit RealTransform(std::size_t length);

  std::size_t length_;
  std::unique_ptr<Plans> plans_;
};

}  // namespace lucy::measure
