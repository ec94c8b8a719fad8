// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What smooth particles cost beside atoms, on the same particles and the same list: the atomistic force pass of a
// Runge-Kutta stage, density and isentropic force, the rates of an inviscid fluid (two passes, energies included) and
// of a viscous, conducting one (three passes). Compare as ratios within one run.
#include "lucy/spam/smooth_particles.hpp"

#include <benchmark/benchmark.h>

#include "lucy/md/lucy_atoms.hpp"
#include "lucy/spam/isentropic_forces.hpp"
#include "sorted_particles.hpp"

namespace {

using lucy::bench::count_particles;
using lucy::bench::Sorted;

void atoms(benchmark::State& state) {
  Sorted sorted(state.range(0));
  const lucy::kernel::Lucy<2> kernel(3.0);
  const auto images = lucy::pairs::image_table(sorted.box, 0.0);
  for (auto _ : state) {
    auto totals = lucy::md::lucy_forces<2>(kernel, sorted.list, images, {sorted.columns[0], sorted.columns[1]},
                                           {sorted.columns[4], sorted.columns[5]}, lucy::pairs::Wanted::shear_stress,
                                           lucy::Team(1));
    benchmark::DoNotOptimize(totals);
  }
  count_particles(state);
}

void isentropic(benchmark::State& state) {
  Sorted sorted(state.range(0));
  const lucy::kernel::Lucy<2> kernel(3.0);
  lucy::space::Columns fluid(2, sorted.list.capacity());
  lucy::pairs::KeptPairs slopes;
  const auto images = lucy::pairs::image_table(sorted.box, 0.0);
  for (auto _ : state) {
    auto totals =
        lucy::spam::isentropic_forces<2>(kernel, lucy::spam::Isentropic(), sorted.list, images,
                                         {sorted.columns[0], sorted.columns[1]}, {sorted.columns[4], sorted.columns[5]},
                                         fluid[0], fluid[1], slopes, lucy::pairs::Wanted::shear_stress, lucy::Team(1));
    benchmark::DoNotOptimize(totals);
  }
  count_particles(state);
}

template <class Kernel>
void rates(benchmark::State& state, const lucy::spam::Transport& transport) {
  Sorted sorted(state.range(0));
  lucy::space::Columns energy(1, sorted.list.capacity());
  for (std::size_t slot = 0; slot < sorted.number.size(); ++slot)
    energy[0][slot] = sorted.number[slot] == lucy::pairs::nobody ? 0.0 : 1.0;
  lucy::spam::SmoothParticles<2> fluid({Kernel(3.0), lucy::spam::IdealGas(), transport}, sorted.list.capacity());
  const auto images = lucy::pairs::image_table(sorted.box, 0.0);
  const lucy::spam::Particles<2> particles{sorted.list,
                                           images,
                                           sorted.number,
                                           {sorted.columns[0], sorted.columns[1]},
                                           {sorted.columns[2], sorted.columns[3]},
                                           energy[0],
                                           sorted.box.strain_rate()};
  for (auto _ : state) {
    fluid.evaluate(particles, lucy::Team(1));
    benchmark::ClobberMemory();
  }
  count_particles(state);
}

void inviscid(benchmark::State& state) { rates<lucy::kernel::Lucy<2>>(state, {}); }
void three_passes(benchmark::State& state) { rates<lucy::kernel::Lucy<2>>(state, {0.5, 0.1, 0.5}); }
void three_passes_monaghan(benchmark::State& state) { rates<lucy::kernel::Monaghan<2>>(state, {0.5, 0.1, 0.5}); }

}  // namespace

BENCHMARK(atoms)->Arg(1024)->Arg(4096)->Arg(16384);
BENCHMARK(isentropic)->Arg(1024)->Arg(4096)->Arg(16384);
BENCHMARK(inviscid)->Arg(1024)->Arg(4096)->Arg(16384);
BENCHMARK(three_passes)->Arg(1024)->Arg(4096)->Arg(16384);
BENCHMARK(three_passes_monaghan)->Arg(1024)->Arg(4096)->Arg(16384);
