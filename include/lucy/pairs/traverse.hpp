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

#include <algorithm>
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

template <std::size_t D>
LUCY_INLINE Lanes squared_length(const std::array<Lanes, D>& displacement) {
  Lanes squared = displacement[0] * displacement[0];
  unrolled<static_cast<int>(D) - 1>([&](auto d) { squared = fma(displacement[d + 1], displacement[d + 1], squared); });
  return squared;
}

/// Displacements and distances of a particle from the eight of a cluster: what has to be known before the sum can
/// begin.
template <int D>
struct Apart {
  std::array<Lanes, D> displacement;
  Lanes distance;
};

template <int D, class Sum>
LUCY_INLINE Apart<D> measure(const Pass<D, Sum>& pass, const Lanes& range_squared, std::size_t slot,
                             std::size_t cluster, const space::ImageShift<D>& shift) {
  const std::size_t at = cluster * lane_count;
  Apart<D> apart;
  unrolled<D>([&](auto d) {
    apart.displacement[d] = (pass.position[d][slot] - shift.position[d]) - load(pass.position[d] + at);
  });
  apart.distance = sqrt(simd::min(squared_length(apart.displacement), range_squared));
  return apart;
}

/// The sum over the pairs of particle `slot` with the eight of `cluster`, an image of which is shifted by `shift`.
template <int D, class Sum>
LUCY_INLINE void pair_with_cluster(const Pass<D, Sum>& pass, const Sum& sum, const Apart<D>& apart,
                                   const std::array<Lanes, Sum::carried>& of_i, std::size_t cluster,
                                   const space::ImageShift<D>& shift, Given<Sum>& at_i,
                                   std::array<Lanes, Sum::totals>& totals) {
  const std::size_t at = cluster * lane_count;
  Pair<D, Sum::carried> pair;
  pair.displacement = apart.displacement;
  pair.distance = apart.distance;
  unrolled<Sum::carried>([&](auto c) {
    pair.of_i[c] = of_i[c];
    if constexpr (Sum::lab_velocity >= 0 && c >= Sum::lab_velocity && c < Sum::lab_velocity + D)
      pair.of_i[c] -= shift.velocity[c - Sum::lab_velocity];
    pair.of_j[c] = load(pass.carried[c] + at);
  });
  Given<Sum> to_i;
  Given<Sum> to_j;
  sum(pair, to_i, to_j, totals);
  unrolled<Sum::given>([&](auto c) {
    at_i[c] += to_i[c];
    double* target = pass.given[c] + at;
    store(target, load(target) + to_j[c]);
  });
}

/// The pairs of a cluster's own eight that are `turn` lanes apart: lane l with lane l + turn, each pair once.
template <int turn, int D, class Sum>
LUCY_INLINE void pair_within_cluster(const Pass<D, Sum>& pass, const Sum& sum, const Lanes& range_squared,
                                     const Lanes& once, std::size_t cluster, std::array<Lanes, Sum::totals>& totals) {
  const std::size_t at = cluster * lane_count;
  Pair<D, Sum::carried> pair;
  unrolled<D>([&](auto d) {
    const Lanes mine = load(pass.position[d] + at);
    pair.displacement[d] = mine - rotate<turn>(mine);
  });
  unrolled<Sum::carried>([&](auto c) {
    pair.of_i[c] = load(pass.carried[c] + at);
    pair.of_j[c] = rotate<turn>(pair.of_i[c]);
  });
  Lanes squared = squared_length(pair.displacement);
  if constexpr (turn == lane_count / 2) squared = simd::max(squared, once);  // lanes l and l + 4 meet twice
  pair.distance = sqrt(simd::min(squared, range_squared));
  Given<Sum> to_i;
  Given<Sum> to_j;
  sum(pair, to_i, to_j, totals);
  unrolled<Sum::given>([&](auto c) {
    double* target = pass.given[c] + at;
    store(target, load(target) + (to_i[c] + rotate<lane_count - turn>(to_j[c])));
  });
}

template <int D, class Sum>
LUCY_INLINE_ALL Totals<Sum> traverse_block(const typename ClusterList<D>::Block& block, const ImageTable<D>& images,
                                           double range, const Pass<D, Sum> pass, const Sum sum) {
  const Lanes range_squared = range * range;
  std::array<double, lane_count> upper_half{};  // range squared in lanes 4 to 7
  std::fill(upper_half.begin() + lane_count / 2, upper_half.end(), range * range);
  const Lanes once(upper_half.data(), simd::element_aligned);
  std::array<Lanes, Sum::totals> totals;
  unrolled<Sum::totals>([&](auto c) { totals[c] = 0.0; });
  // What a row gives to its particle stays in registers to the row's end, and is added up across lanes once per
  // cluster.
  std::array<std::array<Lanes, lane_count>, Sum::given> at_i;  // one row per particle of the cluster
  const space::ImageShift<D>* const shifts = images.data();
  const RowEntry* entry = block.entries.data();
  const std::uint32_t* cluster_end = block.cluster_end.data();
  for (std::size_t cluster = block.first_cluster; cluster < block.last_cluster; ++cluster, ++cluster_end) {
    const std::size_t first = cluster * lane_count;
    // Distances are known one entry ahead of their use, so that the root's long latency is hidden. The entry after the
    // last of the cluster is measured in vain.
    const auto look = [&](const RowEntry& e) {
      return measure(pass, range_squared, first + e.lane(), e.cluster(), shifts[e.image()]);
    };
    Apart<D> ahead = look(*entry);
    pair_within_cluster<1>(pass, sum, range_squared, once, cluster, totals);
    pair_within_cluster<2>(pass, sum, range_squared, once, cluster, totals);
    pair_within_cluster<3>(pass, sum, range_squared, once, cluster, totals);
    pair_within_cluster<4>(pass, sum, range_squared, once, cluster, totals);
    for (auto& rows : at_i) rows.fill(0.0);
    const RowEntry* const end = block.entries.data() + *cluster_end;
    while (entry != end) {
      const std::size_t lane = entry->lane();
      std::array<Lanes, Sum::carried> of_i;
      unrolled<Sum::carried>([&](auto c) { of_i[c] = pass.carried[c][first + lane]; });
      Given<Sum> given;
      unrolled<Sum::given>([&](auto c) { given[c] = 0.0; });
      do {
        const Apart<D> apart = ahead;
        const RowEntry now = *entry;
        ++entry;
        ahead = look(*entry);
        pair_with_cluster(pass, sum, apart, of_i, now.cluster(), shifts[now.image()], given, totals);
      } while (entry != end && entry->lane() == lane);
      unrolled<Sum::given>([&](auto c) { at_i[c][lane] = given[c]; });
    }
    unrolled<Sum::given>([&](auto c) {
      double* const target = pass.given[c] + first;
      store(target, load(target) + sums_of_rows(at_i[c]));
    });
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
