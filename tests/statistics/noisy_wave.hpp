// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Replicas of a decaying wave with a known answer: one of the forms, and on it noise that is correlated in time.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lucy/statistics/decay_forms.hpp"
#include "lucy/statistics/wave_decay.hpp"
#include "statistics/autoregressive_series.hpp"

namespace lucy::statistics {

struct NoisyWave {
  DecayForm form = DecayForm::exponential;
  DecayParameters truth;
  double interval = 1.0;
  std::size_t samples = 100;
  std::size_t replicas = 8;
  double noise = 0.05;           // standard deviation
  double relaxation_time = 5.0;  // of the noise

  DecayingWave realisation(std::uint64_t seed) const {
    AutoregressiveSeries series(std::exp(-interval / relaxation_time), seed);
    std::vector<std::vector<double>> amplitudes;
    for (std::size_t r = 0; r < replicas; ++r) {
      std::vector<double>& amplitude = amplitudes.emplace_back(series.stationary(samples));
      for (std::size_t i = 0; i < samples; ++i)
        amplitude[i] = noise * amplitude[i] + decay_form(form, truth, interval * static_cast<double>(i));
    }
    return {interval, amplitudes};
  }
};

}  // namespace lucy::statistics
