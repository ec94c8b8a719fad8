// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The power spectrum of a sampled quantity of mean zero, averaged over consecutive segments of S samples:
//
//     I_k = 1/S |sum_{n=0}^{S-1} x_n exp(-i omega_k n)|^2,     omega_k = 2 pi k/S per sampling interval, 0 <= k <= S/2
//
// no window, no detrending. For a Gaussian process each I_k (0 < k < S/2) of one segment is exponentially distributed
// about its mean, a mean over m of them follows a Gamma distribution of shape m. The samples of a last, unfinished
// segment are in no spectrum.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "lucy/archive.hpp"

namespace lucy::measure {

struct Spectrum {
  std::size_t segment = 0;    ///< S
  std::int64_t segments = 0;  ///< that were averaged
  std::vector<double> power;  ///< I_k, k = 0 ... S/2; empty without any segment
};

class Periodogram {
 public:
  /// Throws std::invalid_argument for fewer than 2 samples per segment.
  explicit Periodogram(std::size_t segment);
  ~Periodogram();
  Periodogram(Periodogram&&) noexcept;
  Periodogram& operator=(Periodogram&&) noexcept;

  void add(double x);
  Spectrum result() const;

  void save(ArchiveWriter& archive) const;
  void load(ArchiveReader& archive);
  void merge(const Periodogram& other);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace lucy::measure
