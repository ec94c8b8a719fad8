// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/measure/periodogram.hpp"

#include <stdexcept>
#include <string>

#include "measure/pair_sums.hpp"
#include "measure/real_transform.hpp"

namespace lucy::measure {

struct Periodogram::Implementation {
  std::shared_ptr<const RealTransform> transform;
  RealTransform::Sequence samples;  // of the segment that is being filled
  std::size_t filled = 0;
  std::int64_t segments = 0;
  std::vector<double> power;  // summed over the segments
  RealTransform::Spectrum spectrum;

  explicit Implementation(std::size_t segment)
      : transform(RealTransform::of(segment)),
        samples(segment),
        power(transform->frequencies()),
        spectrum(transform->frequencies()) {}

  void finish_segment() {
    transform->forward(samples, spectrum);
    const auto length = static_cast<double>(samples.size());
    for (std::size_t k = 0; k < power.size(); ++k) {
      const double real = spectrum[k].real();
      const double imaginary = spectrum[k].imag();
      power[k] += (real * real + imaginary * imaginary) / length;
    }
    filled = 0;
    ++segments;
  }
};

Periodogram::Periodogram(std::size_t segment) {
  if (segment < 2) throw std::invalid_argument("a periodogram needs segments of at least two samples");
  self_ = std::make_unique<Implementation>(segment);
}
Periodogram::~Periodogram() = default;
Periodogram::Periodogram(Periodogram&&) noexcept = default;
Periodogram& Periodogram::operator=(Periodogram&&) noexcept = default;

void Periodogram::add(double x) {
  self_->samples[self_->filled++] = x;
  if (self_->filled == self_->samples.size()) self_->finish_segment();
}

Spectrum Periodogram::result() const {
  Spectrum result{self_->samples.size(), self_->segments, {}};
  if (self_->segments == 0) return result;
  result.power = self_->power;
  for (double& power : result.power) power /= static_cast<double>(self_->segments);
  return result;
}

void Periodogram::save(ArchiveWriter& archive) const {
  archive.put(self_->samples.size());
  archive.put_sequence(std::span(self_->samples).first(self_->filled));
  archive.put(self_->segments);
  archive.put_sequence(self_->power);
}

void Periodogram::load(ArchiveReader& archive) {
  const auto segment = archive.get<std::size_t>();
  if (segment != self_->samples.size()) {
    throw RunFailed("a saved spectrum has segments of " + std::to_string(segment) + " samples, where " +
                    std::to_string(self_->samples.size()) + " are asked for");
  }
  auto loaded = std::make_unique<Implementation>(segment);
  archive.get_sequence(loaded->samples);
  loaded->filled = loaded->samples.size();
  if (loaded->filled >= segment) throw RunFailed("a saved spectrum holds more samples than a segment has");
  loaded->samples.resize(segment);
  loaded->segments = archive.get<std::int64_t>();
  load_values(archive, loaded->power);
  self_ = std::move(loaded);
}

void Periodogram::merge(const Periodogram& other) {
  if (self_->samples.size() != other.self_->samples.size())
    throw std::invalid_argument("spectra of different segments cannot be merged");
  for (std::size_t k = 0; k < self_->power.size(); ++k) self_->power[k] += other.self_->power[k];
  self_->segments += other.self_->segments;
}

}  // namespace lucy::measure
