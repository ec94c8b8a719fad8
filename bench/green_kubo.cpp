// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What sampling and correlating the stress adds to a run at equilibrium: `sampling_share` runs a recorded replica and
// an unrecorded one (the equilibration of the same state: the same steps without samples, correlators and spectra) in
// turn, interval by interval, and takes the ratio of the medians, so that a machine that is slow for a while is slow
// for both. The counter percent is that ratio less one. The time that is shown is that of all intervals together.
#include "lucy/cases/green_kubo.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

#include "lucy/measure/correlator.hpp"

namespace {

using lucy::cases::GreenKuboPoint;
using lucy::cases::GreenKuboRun;

constexpr double ever = 1e7;  // longer than anything that is timed
constexpr int warm_intervals = 20;
constexpr int replicas = 6;  // where a run's columns lie in memory makes a difference of some percent

GreenKuboPoint state_of(const benchmark::State& state) {
  GreenKuboPoint point;
  point.particles = state.range(0);
  point.energy_per_particle = static_cast<double>(state.range(1)) * 1e-2;
  point.preparation = 20.0;
  point.duration = ever;
  point.length = 400.0;
  point.method =
      state.range(2) == 0 ? lucy::cases::CorrelationMethod::fft : lucy::cases::CorrelationMethod::multiple_tau;
  return point;
}

/// Past its preparation, and some intervals of what is to be timed.
GreenKuboRun warm(const GreenKuboPoint& point, int replica) {
  GreenKuboRun run(point, replica);
  const double interval = 0.05 * static_cast<double>(interval_steps(point));
  const auto skipped = static_cast<int>(point.preparation / interval) + warm_intervals;
  for (int i = 0; i < skipped; ++i) run.advance_one_interval();
  return run;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Arguments: particles, energy per particle in hundredths, whether by multiple-tau, whether with heat flux, with
// velocities.
void sampling_share(benchmark::State& state) {
  GreenKuboPoint point = state_of(state);
  point.thermal_conductivity = state.range(3) != 0;
  point.diffusion = state.range(4) != 0;
  std::vector<GreenKuboRun> recorded;
  std::vector<GreenKuboRun> unrecorded;
  for (int replica = 0; replica < replicas; ++replica) {
    point.equilibration = 0.0;
    recorded.push_back(warm(point, replica));
    point.equilibration = ever;
    unrecorded.push_back(warm(point, replica));
  }
  std::vector<double> with;
  std::vector<double> without;
  const auto seconds = [](GreenKuboRun& run) {
    const auto begin = std::chrono::steady_clock::now();
    run.advance_one_interval();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  for (auto _ : state) {
    for (std::size_t replica = 0; replica < recorded.size(); ++replica) {
      with.push_back(seconds(recorded[replica]));
      without.push_back(seconds(unrecorded[replica]));
    }
  }
  const double steps = static_cast<double>(interval_steps(point)) * static_cast<double>(point.particles);
  state.counters["percent"] = 100.0 * (median(with) / median(without) - 1.0);
  state.counters["ns_per_particle_step"] = 1e9 * median(with) / steps;
}

void fft_correlator(benchmark::State& state) {
  lucy::measure::FftCorrelator correlator(static_cast<std::size_t>(state.range(0)));
  double x = 0.3;
  for (auto _ : state) {
    correlator.add(x);
    x = 3.9 * x * (1.0 - x);
  }
}

void multiple_tau_correlator(benchmark::State& state) {
  lucy::measure::MultipleTauCorrelator correlator({.longest_lag = static_cast<double>(state.range(0))});
  double x = 0.3;
  for (auto _ : state) {
    correlator.add(x);
    x = 3.9 * x * (1.0 - x);
  }
}

}  // namespace

BENCHMARK(sampling_share)
    ->ArgNames({"N", "E_percent", "multiple_tau", "heat_flux", "velocities"})
    ->Args({1024, 100, 0, 0, 0})
    ->Args({1024, 50, 0, 0, 0})
    ->Args({1024, 100, 1, 0, 0})
    ->Args({400, 100, 0, 0, 0})
    ->Args({4096, 100, 0, 0, 0})
    ->Args({1024, 100, 0, 1, 0})
    ->Args({1024, 100, 0, 0, 1})
    ->MinTime(4.0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(fft_correlator)->ArgName("lags")->Arg(2000);
BENCHMARK(multiple_tau_correlator)->ArgName("lags")->Arg(2000);

BENCHMARK_MAIN();
