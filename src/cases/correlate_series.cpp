// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>

#include "cases/block_correlators.hpp"

namespace lucy::cases {

std::vector<CorrelationBlock> correlate_series(std::span<const double> pxy, std::span<const double> stress_difference,
                                               std::size_t lags, std::int64_t blocks) {
  std::vector<CorrelationBlock> results;
  const auto samples = static_cast<std::int64_t>(pxy.size());
  const std::int64_t usual = samples / blocks;
  for (std::int64_t number = 0; number < blocks; ++number) {
    const std::int64_t begin = number * usual;
    const std::int64_t end = number + 1 == blocks ? samples : begin + usual;
    measure::FftCorrelator correlate_xy(lags);
    measure::FftCorrelator correlate_difference(lags);
    measure::FftCorrelator correlate_noise(lags);
    measure::FftCorrelator correlate_reverse_noise(lags);
    measure::Periodogram spectrum_xy(BlockCorrelators::segment_samples(usual));
    measure::Periodogram spectrum_difference(BlockCorrelators::segment_samples(usual));
    for (std::int64_t i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      correlate_xy.add(pxy[at]);
      correlate_difference.add(stress_difference[at]);
      correlate_noise.add(pxy[at], stress_difference[at]);
      correlate_reverse_noise.add(stress_difference[at], pxy[at]);
      spectrum_xy.add(pxy[at]);
      spectrum_difference.add(stress_difference[at]);
    }
    CorrelationBlock block;
    block.samples = end - begin;
    block.stress[StressCorrelation::xy] = correlate_xy.result();
    block.stress[StressCorrelation::difference] = correlate_difference.result();
    block.stress[StressCorrelation::pure_noise] =
        BlockCorrelators::mean_correlation(correlate_noise.result(), correlate_reverse_noise.result());
    block.spectrum = BlockCorrelators::mean_spectrum(spectrum_xy.result(), spectrum_difference.result());
    results.push_back(std::move(block));
  }
  return results;
}

}  // namespace lucy::cases
