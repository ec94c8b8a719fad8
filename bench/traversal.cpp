// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pair traversal and what keeps its list: the quick force pass (stages 2 to 4 of a step), the full one (stage 1:
// energy and whole virial besides), sorting, and building the list. ns_per_particle is the figure to read.
#include <benchmark/benchmark.h>

#include "lucy/md/lucy_atoms.hpp"
#include "sorted_particles.hpp"

namespace {

using lucy::bench::count_particles;
using lucy::bench::Sorted;

template <lucy::pairs::Wanted wanted>
void forces(benchmark::State& state) {
  Sorted sorted(state.range(0));
  const lucy::kernel::Lucy<2> kernel(3.0);
  const auto images = lucy::pairs::image_table(sorted.box, 0.0);
  for (auto _ : state) {
    auto totals = lucy::md::lucy_forces<2>(kernel, sorted.list, images, {sorted.columns[0], sorted.columns[1]},
                                           {sorted.columns[4], sorted.columns[5]}, wanted, lucy::Team(1));
    benchmark::DoNotOptimize(totals);
  }
  count_particles(state);
  state.counters["rows_per_particle"] =
      static_cast<double>(sorted.list.entry_count()) / static_cast<double>(state.range(0));
}

void sort(benchmark::State& state) {
  Sorted sorted(state.range(0));
  for (auto _ : state) {
    auto order = sorted.list.arrange({sorted.columns[0], sorted.columns[1]}, sorted.number);
    benchmark::DoNotOptimize(order);
  }
  count_particles(state);
}

void build_list(benchmark::State& state) {
  Sorted sorted(state.range(0));
  for (auto _ : state) sorted.build();
  count_particles(state);
}

}  // namespace

BENCHMARK(forces<lucy::pairs::Wanted::shear_stress>)
    ->Name("forces_and_shear_stress")
    ->Arg(1024)
    ->Arg(16384)
    ->Arg(262144);
BENCHMARK(forces<lucy::pairs::Wanted::everything>)
    ->Name("forces_energy_and_virial")
    ->Arg(1024)
    ->Arg(16384)
    ->Arg(262144);
BENCHMARK(sort)->Arg(1024)->Arg(16384)->Arg(262144);
BENCHMARK(build_list)->Arg(1024)->Arg(16384)->Arg(262144);

BENCHMARK_MAIN();
