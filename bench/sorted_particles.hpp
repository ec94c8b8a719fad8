// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Particles as a pass over the pairs finds them: sorted, with a list, to time single passes on.
#pragma once

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "prepared_flow.hpp"

namespace lucy::bench {

/// The particles of a prepared flow, sorted, with a list as the trajectory would make it.
struct Sorted {
  pairs::ClusterList<2> list;
  space::Box<2> box;
  space::Columns columns;  // x, y, p_x, p_y, F_x, F_y
  std::vector<std::int32_t> number;
  pairs::ListReach reach{3.0, 0.25, 0.045, 3.2, 0.73};

  explicit Sorted(std::int64_t particles)
      : list(particles, lengths(particles)), box(lengths(particles), 0.1), columns(6, list.capacity()) {
    const auto flow = prepared_flow(particles, 1.0, 0.1, 1, particles > 100000 ? 1.0 : 20.0);
    box = flow.box();
    const auto position = flow.positions();
    const auto momentum = flow.momenta();
    space::Columns old(4, static_cast<std::size_t>(particles));
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
      const bool empty = order[slot] == pairs::nobody;
      for (int c = 0; c < 4; ++c) columns[c][slot] = empty ? 0.0 : old[c][order[slot]];
      if (empty) columns[0][slot] = pairs::far_away(slot);
    }
    build();
  }

  static space::Vector<2> lengths(std::int64_t particles) {
    const double side = std::sqrt(static_cast<double>(particles));
    return {side, side};
  }

  void build() { list.build({columns[0], columns[1]}, {columns[2], columns[3]}, box, reach, Team(1)); }
};

/// ns_per_particle of a benchmark whose argument is the number of particles.
inline void count_particles(benchmark::State& state) {
  const double done = static_cast<double>(state.iterations()) * static_cast<double>(state.range(0));
  state.counters["ns_per_particle"] =
      benchmark::Counter(done * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

}  // namespace lucy::bench
