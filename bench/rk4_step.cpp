// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole sheared RK4 stage: forces, stress, ergostat, energy watch, list upkeep, update. The figure to read is
// ns_per_particle_stage (wall time over steps, stages and particles), its sweep over N the scaling.
#include <benchmark/benchmark.h>

#include "prepared_flow.hpp"

namespace {

// Arguments: particles, energy per particle in hundredths, rate in thousandths, step in thousandths, threads.
void sheared_step(benchmark::State& state) {
  const std::int64_t particles = state.range(0);
  const double step = static_cast<double>(state.range(3)) * 1e-3;
  auto flow = lucy::bench::prepared_flow(particles, static_cast<double>(state.range(1)) * 1e-2,
                                         static_cast<double>(state.range(2)) * 1e-3, static_cast<int>(state.range(4)),
                                         particles > 100000 ? 2.0 : 20.0);
  for (auto _ : state) flow.advance(step);
  const double stages = 4.0 * static_cast<double>(state.iterations()) * static_cast<double>(particles);
  state.counters["ns_per_particle_stage"] =
      benchmark::Counter(stages * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

}  // namespace

BENCHMARK(sheared_step)
    ->ArgNames({"N", "E_percent", "rate_permille", "step_permille", "threads"})
    ->Args({1024, 100, 100, 50, 1})
    ->Args({1024, 100, 100, 20, 1})
    ->Args({1024, 100, 1000, 50, 1})
    ->Args({1024, 50, 100, 50, 1})
    ->Args({4096, 100, 100, 50, 1})
    ->Args({16384, 100, 100, 50, 1})
    ->Args({65536, 100, 100, 50, 1})
    ->Args({262144, 100, 100, 50, 1})
    ->Args({1048576, 100, 100, 50, 1})
    ->Args({16384, 100, 100, 50, 2})
    ->Args({262144, 100, 100, 50, 2})
    ->Args({1048576, 100, 100, 50, 2})
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

BENCHMARK_MAIN();
