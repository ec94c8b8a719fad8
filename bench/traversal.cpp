// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pair traversal and what keeps its list: the quick force pass (stages 2 to 4 of a step), the full one (stage 1:
// energy and whole virial besides), sorting, and building the list. ns_per_particle is the figure to read.
#include <benchmark/benchmark.h>

#include "lucy/md/lucy_atoms.hpp"
#include "prepared_flow.hpp"

namespace {

using lucy::pairs::ClusterList;

// The particles of a prepared flow, sorted, with a list as the trajectory would make it.
struct Sorted {
  ClusterList<2> list;
  lucy::space::Box<2> box;
  lucy::space::Columns columns;  // x, y, p_x, p_y, F_x, F_y
  std::vector<std::int32_t> number;
  lucy::pairs::ListReach reach{3.0, 0.25, 0.045, 3.2, 0.73};

  explicit Sorted(std::int64_t particles)
      : list(particles, lengths(particles)), box(lengths(particles), 0.1), columns(6, list.capacity()) {
    const auto flow = lucy::bench::prepared_flow(particles, 1.0, 0.1, 1, particles > 100000 ? 1.0 : 20.0);
    box = flow.box();
    const auto position = flow.positions();
    const auto momentum = flow.momenta();
    lucy::space::Columns old(4, static_cast<std::size_t>(particles));
    std::vector<std::int32_t> names(static_cast<std::size_t>(particles));
    for (std::size_t i = 0; i < names.size(); ++i) {
      names[i] = static_cast<std::int32_t>(i);
      for (int d = 0; d < 2; ++d) {
        old[d][i] = position[2 * i + static_cast<std::size_t>(d)];
        old[2 + d][i] = momentum[2 * i + static_cast<std::size_t>(d)];
      }
    }
    const auto order = list.arrange({old[0], old[1]}, names);
    number.assign(order.begin(), order.end());
    for (std::size_t slot = 0; slot < order.size(); ++slot) {
      const bool empty = order[slot] == lucy::pairs::nobody;
      for (int c = 0; c < 4; ++c) columns[c][slot] = empty ? 0.0 : old[c][order[slot]];
      if (empty) columns[0][slot] = lucy::pairs::far_away(slot);
    }
    build();
  }

  static lucy::space::Vector<2> lengths(std::int64_t particles) {
    const double side = std::sqrt(static_cast<double>(particles));
    return {side, side};
  }

  void build() { list.build({columns[0], columns[1]}, {columns[2], columns[3]}, box, reach, lucy::Team(1)); }
};

void count_particles(benchmark::State& state) {
  const double done = static_cast<double>(state.iterations()) * static_cast<double>(state.range(0));
  state.counters["ns_per_particle"] =
      benchmark::Counter(done * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

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

BENCHMARK(forces<lucy::pairs::Wanted::shear_stress>)->Name("forces_and_shear_stress")->Arg(1024)->Arg(16384)->Arg(262144);
BENCHMARK(forces<lucy::pairs::Wanted::everything>)->Name("forces_energy_and_virial")->Arg(1024)->Arg(16384)->Arg(262144);
BENCHMARK(sort)->Arg(1024)->Arg(16384)->Arg(262144);
BENCHMARK(build_list)->Arg(1024)->Arg(16384)->Arg(262144);

BENCHMARK_MAIN();
