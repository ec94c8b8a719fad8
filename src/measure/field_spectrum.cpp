// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/measure/field_spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "lucy/errors.hpp"
#include "measure/real_transform.hpp"

namespace lucy::measure {

namespace {

using Complex = std::complex<double>;
constexpr double two_pi = 2.0 * std::numbers::pi;

/// The ring b of |k|, with (b - 1/2) width <= |k| < (b + 1/2) width.
std::size_t ring_of(double wave_number, double width) {
  return static_cast<std::size_t>(std::lround(wave_number / width));
}

/// z_k = sum_n z_n exp(-2 pi i k n/M), 0 <= k < M, of complex z, from the transforms of its real and imaginary parts.
class ComplexTransform {
 public:
  explicit ComplexTransform(std::size_t length)
      : transform_(RealTransform::of(length)),
        part_(length),
        of_real_(transform_->frequencies()),
        of_imaginary_(transform_->frequencies()) {}

  void forward(std::vector<Complex>& z) {
    const std::size_t length = z.size();
    std::ranges::transform(z, part_.begin(), [](const Complex& c) { return c.real(); });
    transform_->forward(part_, of_real_);
    std::ranges::transform(z, part_.begin(), [](const Complex& c) { return c.imag(); });
    transform_->forward(part_, of_imaginary_);
    constexpr Complex i(0.0, 1.0);
    for (std::size_t k = 0; k < length; ++k) {
      z[k] = k < of_real_.size() ? of_real_[k] + i * of_imaginary_[k]
                                 : std::conj(of_real_[length - k]) + i * std::conj(of_imaginary_[length - k]);
    }
  }

 private:
  std::shared_ptr<const RealTransform> transform_;
  RealTransform::Sequence part_;
  RealTransform::Spectrum of_real_;
  RealTransform::Spectrum of_imaginary_;
};

}  // namespace

FieldSpectrum::FieldSpectrum(const std::array<int, 2>& nodes, const space::Vector<2>& lengths)
    : nodes_(nodes), lengths_(lengths), width_(two_pi / std::max(lengths[0], lengths[1])) {
  if (nodes[0] < 2 || nodes[1] < 2)
    throw BadInput(fmt::format("a spectrum needs at least 2 x 2 nodes, not {} x {}", nodes[0], nodes[1]));
  const double largest = std::numbers::pi * std::hypot(nodes[0] / lengths[0], nodes[1] / lengths[1]);
  sums_.resize(ring_of(largest, width_) + 2);
}

void FieldSpectrum::add(std::span<const double> values, double offset) {
  const auto n_x = static_cast<std::size_t>(nodes_[0]);
  const auto n_y = static_cast<std::size_t>(nodes_[1]);
  const auto rows = RealTransform::of(n_x);
  ComplexTransform columns(n_y);
  RealTransform::Sequence row(n_x);
  std::vector<RealTransform::Spectrum> of_rows(n_y, RealTransform::Spectrum(rows->frequencies()));
  for (std::size_t j = 0; j < n_y; ++j) {
    std::copy_n(values.data() + j * n_x, n_x, row.data());
    rows->forward(row, of_rows[j]);
  }

  const double all = static_cast<double>(n_x) * static_cast<double>(n_y);
  // Shorter by whole edges: the same wave vectors, numbered so that they turn little from row to row.
  const double tilt = std::remainder(offset / lengths_[0], 1.0);
  std::vector<Complex> column(n_y);
  for (std::size_t a = 0; a < rows->frequencies(); ++a) {
    const auto a_tilt = static_cast<double>(a) * tilt;
    for (std::size_t j = 0; j < n_y; ++j)
      column[j] = of_rows[j][a] * std::polar(1.0, two_pi * a_tilt * static_cast<double>(j) / nodes_[1]);
    columns.forward(column);
    // A real field has P(-k) = P(k): all but the first column, and the last of an even number, stand for two.
    const double weight = a == 0 || 2 * a == n_x ? 1.0 : 2.0;
    for (std::size_t b = 0; b < n_y; ++b) {
      if (a == 0 && b == 0) continue;
      const double along_y = std::remainder(static_cast<double>(b) - a_tilt, nodes_[1]);
      const double wave_number =
          std::hypot(two_pi * static_cast<double>(a) / lengths_[0], two_pi * along_y / lengths_[1]);
      SpectrumRing& ring = sums_[ring_of(wave_number, width_)];
      ring.wave_number += weight * wave_number;
      ring.modes += weight;
      ring.power += weight * std::norm(column[b] / all);
    }
  }
  spectra_ += 1.0;
}

std::vector<SpectrumRing> FieldSpectrum::rings() const {
  std::vector<SpectrumRing> result;
  for (const SpectrumRing& sum : sums_)
    if (sum.modes > 0.0) result.push_back({sum.wave_number / sum.modes, sum.modes / spectra_, sum.power / sum.modes});
  return result;
}

double FieldSpectrum::whole_up_to() const {
  return std::numbers::pi * std::min(nodes_[0] / lengths_[0], nodes_[1] / lengths_[1]);
}

}  // namespace lucy::measure
