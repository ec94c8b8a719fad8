// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The correlators and spectra of one block of a Green-Kubo run, while samples come in.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "cases/green_kubo_schedule.hpp"
#include "lucy/archive.hpp"
#include "lucy/cases/green_kubo.hpp"
#include "lucy/measure/correlator.hpp"
#include "lucy/measure/periodogram.hpp"

namespace lucy::cases {

/// Without the lags beyond `longest`, which the last level of a multiple-tau correlator reaches.
inline measure::Correlation cut_at(measure::Correlation correlation, double longest) {
  const auto end = std::upper_bound(correlation.lag.begin(), correlation.lag.end(), longest);
  const auto kept = static_cast<std::size_t>(end - correlation.lag.begin());
  for (auto* values : {&correlation.lag, &correlation.value, &correlation.mean_a, &correlation.mean_b})
    values->resize(std::min(values->size(), kept));
  correlation.pairs.resize(kept);
  return correlation;
}

/// Either correlator, for a pair of numbers.
class PairCorrelator {
 public:
  PairCorrelator(CorrelationMethod method, std::size_t lags) : longest_lag_(static_cast<double>(lags - 1)) {
    if (method == CorrelationMethod::fft) {
      correlator_.emplace<measure::FftCorrelator>(lags);
    } else {
      measure::MultipleTauCorrelator::Settings settings;
      settings.longest_lag = longest_lag_;
      correlator_.emplace<measure::MultipleTauCorrelator>(settings);
    }
  }

  void add(double a, double b) {
    std::visit([&](auto& correlator) { correlator.add(a, b); }, correlator_);
  }
  void add(double a) { add(a, a); }
  measure::Correlation result() const {
    return std::visit([&](const auto& correlator) { return cut_at(correlator.result(), longest_lag_); }, correlator_);
  }
  /// Of quantities whose mean is zero: nobody asks for it.
  measure::Correlation result_without_means() const {
    measure::Correlation correlation = result();
    correlation.mean_a.clear();
    correlation.mean_b.clear();
    return correlation;
  }
  void save(ArchiveWriter& archive) const {
    std::visit([&](const auto& correlator) { correlator.save(archive); }, correlator_);
  }
  void load(ArchiveReader& archive) {
    std::visit([&](auto& correlator) { correlator.load(archive); }, correlator_);
  }

 private:
  double longest_lag_;
  std::variant<measure::FftCorrelator, measure::MultipleTauCorrelator> correlator_{measure::FftCorrelator(1)};
};

/// Everything that one block is made of, while samples come in.
class BlockCorrelators {
 public:
  explicit BlockCorrelators(const GreenKuboPoint& point)
      : particles_(static_cast<double>(point.particles)),
        longest_lag_(static_cast<double>(lag_count(point) - 1)),
        reverse_noise_(point.method, lag_count(point)),
        spectrum_xy_(segment_samples(point)),
        spectrum_difference_(segment_samples(point)) {
    const std::size_t lags = lag_count(point);
    for (std::size_t i = 0; i < stress_correlations; ++i) stress_.emplace_back(point.method, lags);
    if (point.diffusion) {
      measure::MultipleTauCorrelator::Settings settings;
      settings.components = 2 * static_cast<std::size_t>(point.particles);
      settings.longest_lag = static_cast<double>(lags - 1);
      velocity_.emplace(settings);
    }
    if (point.thermal_conductivity)
      for (std::size_t d = 0; d < 2; ++d) heat_.emplace_back(point.method, lags);
    for (const std::string& pair : point.pairs) {
      pairs_.push_back(parse_pair(pair));
      others_.emplace_back(point.method, lags);
    }
  }

  using Sample = std::array<double, sampled_quantities.size()>;

  /// `velocities` is looked at only for diffusion.
  void add(const Sample& sample, std::span<const double> velocities) {
    const double difference_kinetic = 0.5 * (sample[sampled("pxx_kinetic")] - sample[sampled("pyy_kinetic")]);
    const double difference_potential = 0.5 * (sample[sampled("pxx_potential")] - sample[sampled("pyy_potential")]);
    const double pxy = sample[sampled("pxy")];
    const double stress_difference = sample[sampled("stress_difference")];
    stress_[StressCorrelation::xy].add(pxy);
    stress_[StressCorrelation::xy_kinetic].add(sample[sampled("pxy_kinetic")]);
    stress_[StressCorrelation::xy_potential].add(sample[sampled("pxy_potential")]);
    stress_[StressCorrelation::difference].add(stress_difference);
    stress_[StressCorrelation::difference_kinetic].add(difference_kinetic);
    stress_[StressCorrelation::difference_potential].add(difference_potential);
    stress_[StressCorrelation::pure_noise].add(pxy, stress_difference);
    reverse_noise_.add(stress_difference, pxy);
    spectrum_xy_.add(pxy);
    spectrum_difference_.add(stress_difference);
    if (velocity_) velocity_->add(velocities);
    for (std::size_t d = 0; d < heat_.size(); ++d) heat_[d].add(sample[sampled("heat_flux_x") + d]);
    for (std::size_t i = 0; i < pairs_.size(); ++i) others_[i].add(sample[pairs_[i][0]], sample[pairs_[i][1]]);
    ++samples_;
  }

  std::int64_t samples() const { return samples_; }

  CorrelationBlock result() const {
    CorrelationBlock block;
    block.samples = samples_;
    for (std::size_t i = 0; i < stress_correlations; ++i) block.stress[i] = stress_[i].result_without_means();
    block.stress[StressCorrelation::pure_noise] =
        mean_correlation(block.stress[StressCorrelation::pure_noise], reverse_noise_.result());
    block.spectrum = mean_spectrum(spectrum_xy_.result(), spectrum_difference_.result());
    if (velocity_) {
      block.others.push_back(cut_at(velocity_->result(), longest_lag_));
      for (double& value : block.others.back().value) value *= 0.5 / particles_;
    }
    if (!heat_.empty()) {
      block.others.push_back(mean_correlation(heat_[0].result_without_means(), heat_[1].result()));
    }
    for (const auto& correlator : others_) block.others.push_back(correlator.result());
    return block;
  }

  void save(ArchiveWriter& archive) const {
    archive.put(samples_);
    for_all([&](const auto& accumulator) { accumulator.save(archive); }, *this);
  }

  void load(ArchiveReader& archive) {
    samples_ = archive.get<std::int64_t>();
    for_all([&](auto& accumulator) { accumulator.load(archive); }, *this);
  }

  static measure::Correlation mean_correlation(measure::Correlation a, const measure::Correlation& b) {
    for (std::size_t k = 0; k < a.value.size(); ++k) a.value[k] = 0.5 * (a.value[k] + b.value[k]);
    return a;
  }

  static measure::Spectrum mean_spectrum(measure::Spectrum a, const measure::Spectrum& b) {
    for (std::size_t k = 0; k < a.power.size(); ++k) a.power[k] = 0.5 * (a.power[k] + b.power[k]);
    return a;
  }

  /// Of one spectrum: as many whole ones as need be, so that none is longer than most_segment.
  static std::size_t segment_samples(std::int64_t block_samples) {
    constexpr std::int64_t most_segment = 32768;
    const std::int64_t segments = (block_samples + most_segment - 1) / most_segment;
    return static_cast<std::size_t>(std::max<std::int64_t>(2, block_samples / std::max<std::int64_t>(1, segments)));
  }

 private:
  static std::size_t segment_samples(const GreenKuboPoint& point) { return segment_samples(block_samples(point)); }

  template <class Action, class Self>
  static void for_all(Action action, Self& self) {
    for (auto& accumulator : self.stress_) action(accumulator);
    action(self.reverse_noise_);
    action(self.spectrum_xy_);
    action(self.spectrum_difference_);
    if (self.velocity_) action(*self.velocity_);
    for (auto& accumulator : self.heat_) action(accumulator);
    for (auto& accumulator : self.others_) action(accumulator);
  }

  double particles_;
  double longest_lag_;
  std::int64_t samples_ = 0;
  std::vector<PairCorrelator> stress_;
  PairCorrelator reverse_noise_;
  measure::Periodogram spectrum_xy_;
  measure::Periodogram spectrum_difference_;
  std::optional<measure::MultipleTauCorrelator> velocity_;
  std::vector<PairCorrelator> heat_;
  std::vector<std::array<std::size_t, 2>> pairs_;
  std::vector<PairCorrelator> others_;
};

}  // namespace lucy::cases
