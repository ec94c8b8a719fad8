// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// THE pair loop. Molecular dynamics and smooth particles are two readings of one sum over pairs,
//
//     a_i = - sum_j c_ij grad_i w(r_ij)
//
// and every such sum is a small callable handed to `traverse`, which owns everything else: rows, images, vector
// registers, threads, the order of additions. A sum names, at compile time,
//
//     carried   columns it reads of both partners besides their positions (velocities, densities, ...)
//     lab_velocity  which of these is the x component of a laboratory velocity, shifted by the image's streaming
//                   velocity (-1: none)
//     given     columns it adds to, at i and at j
//     totals    numbers summed over all pairs (energy, virial, ...)
//
// and has the call operator
//
//     void operator()(const Pair<D, carried>& pair, std::array<Lanes, given>& to_i, std::array<Lanes, given>& to_j,
//                     std::array<Lanes, totals>& totals) const
//
// which sets to_i, to_j and adds to totals. It must vanish at the range: lanes that hold no partner (farther away, an
// empty slot, the particle itself) are presented with distance == range.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "lucy/pairs/cluster_list.hpp"
#include "lucy/pairs/lanes.hpp"

namespace lucy::pairs {

/// Eight pairs (i, j): displacement r_i - r_j of nearest images and its length, at most the range.
template <int D, int carried>
struct Pair {
  std::array<Lanes, D> displacement;
  Lanes distance;
  std::array<Lanes, carried> of_i;
  std::array<Lanes, carried> of_j;
};

/// The columns of one pass; slots as the list arranged them. `given` must hold the starting values (zeros, mostly).
template <int D, class Sum>
struct Pass {
  std::array<const double*, D> position;
  std::array<const double*, Sum::carried> carried;
  std::array<double*, Sum::given> given;
};

template <class Sum>
using Totals = std::array<double, Sum::totals>;

namespace detail {

template <class Sum>
using Given = std::array<Lanes, Sum::given>;

template <int D, int carried>
[[gnu::always_inline]] inline Lanes squared_distance(const Pair<D, carried>& pair) {
  Lanes squared = pair.displacement[0] * pair.displacement[0];
  for (int d = 1; d < D; ++d) squared = fma(pair.displacement[d], pair.displacement[d], squared);
  return squared;
}

/// The pairs of particle `slot` with the eight of `cluster`, an image of which is shifted by `shift`.
template <int D, class Sum>
[[gnu::always_inline]] inline void pair_with_cluster(const Pass<D, Sum>& pass, const Sum& sum,
                                                     const Lanes& range_squared, std::size_t slot, std::size_t cluster,
                                                     const space::ImageShift<D>& shift, Given<Sum>& at_i,
                                                     std::array<Lanes, Sum::totals>& totals) {
  const std::size_t at = cluster * lane_count;
  Pair<D, Sum::carried> pair;
  for (int d = 0; d < D; ++d) {
    pair.displacement[d] = (pass.position[d][slot] - shift.position[d]) - load(pass.position[d] + at);
  }
  for (int c = 0; c < Sum::carried; ++c) {
    double mine = pass.carried[c][slot];
    if constexpr (Sum::lab_velocity >= 0) {
      if (c >= Sum::lab_velocity && c < Sum::lab_velocity + D) mine -= shift.velocity[c - Sum::lab_velocity];
    }
    pair.of_i[c] = mine;
    pair.of_j[c] = load(pass.carried[c] + at);
  }
  pair.distance = sqrt(simd::min(squared_distance(pair), range_squared));
  Given<Sum> to_i;
  Given<Sum> to_j;
  sum(pair, to_i, to_j, totals);
  for (int c = 0; c < Sum::given; ++c) {
    at_i[c] += to_i[c];
    double* target = pass.given[c] + at;
    store(target, load(target) + to_j[c]);
  }
}

/// The pairs of a cluster's own eight that are `turn` lanes apart: lane l with lane l + turn, each pair once.
template <int turn, int D, class Sum>
[[gnu::always_inline]] inline void pair_within_cluster(const Pass<D, Sum>& pass, const Sum& sum,
                                                       const Lanes& range_squared, std::size_t cluster,
                                                       std::array<Lanes, Sum::totals>& totals) {
  const std::size_t at = cluster * lane_count;
  Pair<D, Sum::carried> pair;
  for (int d = 0; d < D; ++d) {
    const Lanes mine = load(pass.position[d] + at);
    pair.displacement[d] = mine - rotate<turn>(mine);
  }
  for (int c = 0; c < Sum::carried; ++c) {
    pair.of_i[c] = load(pass.carried[c] + at);
    pair.of_j[c] = rotate<turn>(pair.of_i[c]);
  }
  Lanes squared = squared_distance(pair);
  if constexpr (turn == lane_count / 2) {  // lanes l and l + 4 meet twice
    const Lanes lane_numbers([](auto lane) { return static_cast<double>(static_cast<int>(lane)); });
    simd::where(lane_numbers >= static_cast<double>(turn), squared) = range_squared;
  }
  pair.distance = sqrt(simd::min(squared, range_squared));
  Given<Sum> to_i;
  Given<Sum> to_j;
  sum(pair, to_i, to_j, totals);
  for (int c = 0; c < Sum::given; ++c) {
    double* target = pass.given[c] + at;
    store(target, load(target) + (to_i[c] + rotate<lane_count - turn>(to_j[c])));
  }
}

template <int D, class Sum>
Totals<Sum> traverse_block(const typename ClusterList<D>::Block& block, const ImageTable<D>& images, double range,
                           const Pass<D, Sum> pass, const Sum sum) {
  const Lanes range_squared = range * range;
  std::array<Lanes, Sum::totals> totals;
  unrolled<Sum::totals>([&](auto c) { totals[c] = 0.0; });
  // One loop over the rows of a whole cluster, without branches on where a row ends: what a row gives to its particle
  // is gathered in memory, lane by lane, and added up across lanes once per cluster.
  std::array<Given<Sum>, lane_count> at_i;
  const space::ImageShift<D>* const shifts = images.data();
  const RowEntry* entry = block.entries.data();
  const std::uint32_t* cluster_end = block.cluster_end.data();
  for (std::size_t cluster = block.first_cluster; cluster < block.last_cluster; ++cluster, ++cluster_end) {
    const std::size_t first = cluster * lane_count;
    pair_within_cluster<1>(pass, sum, range_squared, cluster, totals);
    pair_within_cluster<2>(pass, sum, range_squared, cluster, totals);
    pair_within_cluster<3>(pass, sum, range_squared, cluster, totals);
    pair_within_cluster<4>(pass, sum, range_squared, cluster, totals);
    for (auto& lane : at_i) lane.fill(0.0);
    for (const RowEntry* const end = block.entries.data() + *cluster_end; entry != end; ++entry) {
      pair_with_cluster(pass, sum, range_squared, first + entry->lane(), entry->cluster(), shifts[entry->image()],
                        at_i[entry->lane()], totals);
    }
    for (int c = 0; c < Sum::given; ++c) {
      double* target = pass.given[c] + first;
      for (int lane = 0; lane < lane_count; ++lane) target[lane] += simd::reduce(at_i[lane][c]);
    }
  }
  Totals<Sum> result{};
  unrolled<Sum::totals>([&](auto c) { result[c] = simd::reduce(totals[c]); });
  return result;
}

}  // namespace detail

/// Sums over all pairs within `range`. Adds to pass.given, returns the totals. The same bits for every team.
template <int D, class Sum>
Totals<Sum> traverse(const ClusterList<D>& list, const ImageTable<D>& images, double range, const Pass<D, Sum>& pass,
                     const Sum& sum, const Team& team) {
  const auto blocks = list.blocks();
  const auto count = static_cast<std::ptrdiff_t>(blocks.size());
  Totals<Sum> total{};
  const auto add = [&](const Totals<Sum>& part) {
    for (int c = 0; c < Sum::totals; ++c) total[c] += part[c];
  };
  for (std::ptrdiff_t colour = 0; colour < 2; ++colour) {
    if (team.threads() == 1) {
      for (std::ptrdiff_t b = colour; b < count; b += 2) {
        add(detail::traverse_block<D, Sum>(blocks[b], images, range, pass, sum));
      }
    } else {
      thread_local std::vector<Totals<Sum>> parts;  // kept from call to call: no allocation per step
      parts.resize(static_cast<std::size_t>((count - colour + 1) / 2));
      const std::span<Totals<Sum>> shared(parts);  // the others' own `parts` are empty
      team.share(static_cast<std::ptrdiff_t>(parts.size()), [&](std::ptrdiff_t part) {
        shared[static_cast<std::size_t>(part)] =
            detail::traverse_block<D, Sum>(blocks[2 * part + colour], images, range, pass, sum);
      });
      for (const auto& part : parts) add(part);
    }
  }
  return total;
}

}  // namespace lucy::pairs
