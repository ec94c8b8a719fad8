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
//     keeping   what it does with a number kept per pair from one pass to the next (kept_pairs.hpp)
//
// and has the call operator
//
//     void operator()(const Pair<D, carried>& pair, std::array<Lanes, given>& to_i, std::array<Lanes, given>& to_j,
//                     std::array<Lanes, totals>& totals) const
//
// which sets to_i, to_j and adds to totals (and returns Lanes to keep if it leaves something). It must vanish at the
// range: lanes that hold no partner (farther away, an empty slot, the particle itself) are presented with distance ==
// range.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "lucy/pairs/cluster_list.hpp"
#include "lucy/pairs/kept_pairs.hpp"
#include "lucy/pairs/lanes.hpp"

namespace lucy::pairs {

/// Eight pairs (i, j): displacement r_i - r_j of nearest images and its length, at most the range.
template <int D, int carried>
struct Pair {
  std::array<Lanes, D> displacement;
  Lanes distance;
  Lanes kept;
  std::array<Lanes, carried> of_i;
  std::array<Lanes, carried> of_j;
};

/// The columns of one pass; slots as the list arranged them. `given` must hold the starting values (zeros, mostly).
template <int D, class Sum>
struct Pass {
  std::array<const double*, D> position;
  std::array<const double*, Sum::carried> carried;
  std::array<double*, Sum::given> given;

  const double* position_of(int d, std::size_t cluster) const { return position[d] + cluster * lane_count; }
  const double* carried_of(int c, std::size_t cluster) const { return carried[c] + cluster * lane_count; }
  double* given_to(int c, std::size_t cluster) const { return given[c] + cluster * lane_count; }
};

template <class Sum>
using Totals = std::array<double, Sum::totals>;

namespace detail {

template <class Sum>
using Given = std::array<Lanes, Sum::given>;

template <std::size_t D>
LUCY_INLINE Lanes squared_length(const std::array<Lanes, D>& displacement) {
  Lanes squared = displacement[0] * displacement[0];
  unrolled<static_cast<int>(D) - 1>(
      [&](auto d) { squared = multiply_add(displacement[d + 1], displacement[d + 1], squared); });
  return squared;
}

/// Where a particle, seen from an image shifted by `shift`, is.
template <int D, class Sum>
LUCY_INLINE std::array<Lanes, D> seen_from(const Pass<D, Sum>& pass, std::size_t home, std::size_t lane,
                                           const space::ImageShift<D>& shift) {
  std::array<Lanes, D> place;
  unrolled<D>([&](auto d) { place[d] = pass.position_of(d, home)[lane] - shift.position[d]; });
  return place;
}

/// What has to be known of a particle at `place` and the eight of a cluster before the sum can begin.
template <int D, class Sum>
LUCY_INLINE void measure(const Pass<D, Sum>& pass, const Lanes& range_squared,
                         const std::type_identity_t<std::array<Lanes, D>>& place, std::size_t cluster,
                         Pair<D, Sum::carried>& pair) {
  unrolled<D>([&](auto d) { pair.displacement[d] = place[d] - load(pass.position_of(d, cluster)); });
  if constexpr (Sum::keeping != Keeping::finds)
    pair.distance = sqrt(simd::min(squared_length(pair.displacement), range_squared));
}

/// Calls the sum, with the kept number where it belongs.
template <int D, class Sum>
LUCY_INLINE void call(const Sum& sum, Pair<D, Sum::carried>& pair, Lanes* kept, Given<Sum>& to_i, Given<Sum>& to_j,
                      std::array<Lanes, Sum::totals>& totals) {
  if constexpr (Sum::keeping == Keeping::leaves) {
    *kept = sum(pair, to_i, to_j, totals);
  } else {
    if constexpr (Sum::keeping == Keeping::finds) pair.kept = *kept;
    sum(pair, to_i, to_j, totals);
  }
}

/// The sum over the pairs of a particle with the eight of `cluster`, an image of which is shifted by `shift`.
template <int D, class Sum>
LUCY_INLINE void pair_with_cluster(const Pass<D, Sum>& pass, const Sum& sum, Pair<D, Sum::carried>& pair,
                                   const std::array<Lanes, Sum::carried>& of_i, std::size_t cluster,
                                   const space::ImageShift<D>& shift, Lanes* kept, Given<Sum>& at_i,
                                   std::array<Lanes, Sum::totals>& totals) {
  unrolled<Sum::carried>([&](auto c) {
    pair.of_i[c] = of_i[c];
    if constexpr (Sum::lab_velocity >= 0 && c >= Sum::lab_velocity && c < Sum::lab_velocity + D)
      pair.of_i[c] -= shift.velocity[c - Sum::lab_velocity];
    pair.of_j[c] = load(pass.carried_of(c, cluster));
  });
  Given<Sum> to_i;
  Given<Sum> to_j;
  call(sum, pair, kept, to_i, to_j, totals);
  unrolled<Sum::given>([&](auto c) {
    at_i[c] += to_i[c];
    double* target = pass.given_to(c, cluster);
    store(target, load(target) + to_j[c]);
  });
}

/// The pairs of a cluster's own eight that are `turn` lanes apart: lane l with lane l + turn, each pair once. Adds to
/// `own`.
template <int turn, int D, class Sum>
LUCY_INLINE void pair_within_cluster(const Pass<D, Sum>& pass, const Sum& sum, const Lanes& range_squared,
                                     const Lanes& once, std::size_t cluster, Lanes* kept, Given<Sum>& own,
                                     std::array<Lanes, Sum::totals>& totals) {
  Pair<D, Sum::carried> pair;
  unrolled<D>([&](auto d) {
    const Lanes mine = load(pass.position_of(d, cluster));
    pair.displacement[d] = mine - rotate<turn>(mine);
  });
  unrolled<Sum::carried>([&](auto c) {
    pair.of_i[c] = load(pass.carried_of(c, cluster));
    pair.of_j[c] = rotate<turn>(pair.of_i[c]);
  });
  if constexpr (Sum::keeping != Keeping::finds) {
    Lanes squared = squared_length(pair.displacement);
    if constexpr (turn == lane_count / 2) squared = simd::max(squared, once);  // lanes l and l + 4 meet twice
    pair.distance = sqrt(simd::min(squared, range_squared));
  }
  Given<Sum> to_i;
  Given<Sum> to_j;
  call(sum, pair, kept + (turn - 1), to_i, to_j, totals);
  unrolled<Sum::given>([&](auto c) { own[c] += to_i[c] + rotate<lane_count - turn>(to_j[c]); });
}

template <int D, class Sum>
LUCY_INLINE_ALL Totals<Sum> traverse_block(const typename ClusterList<D>::Block& block, const ImageTable<D>& images,
                                           double range, const Pass<D, Sum> pass, const Sum sum,
                                           KeptPairs::Block& kept_of_block) {
  constexpr bool finds = Sum::keeping == Keeping::finds;
  constexpr std::size_t no_image = ~std::size_t{0};
  const Lanes range_squared = range * range;
  std::array<double, lane_count> upper_half{};  // range squared in lanes 4 to 7
  std::fill(upper_half.begin() + lane_count / 2, upper_half.end(), range * range);
  const Lanes once(upper_half.data(), simd::element_aligned);
  std::array<Lanes, Sum::totals> totals;
  unrolled<Sum::totals>([&](auto c) { totals[c] = 0.0; });
  // What a row gives to its particle stays in registers to the row's end, and is added up across lanes once per
  // cluster.
  std::array<std::array<FoldedLanes, lane_count>, Sum::given> at_i;  // one row per particle of the cluster
  const space::ImageShift<D>* const shifts = images.data();
  const RowEntry* const entries = finds ? kept_of_block.entries.data() : block.entries.data();
  const std::uint32_t* cluster_end = finds ? kept_of_block.cluster_end.data() : block.cluster_end.data();
  const RowEntry* entry = entries;
  KeptCursor<Sum::keeping> kept(kept_of_block);
  for (std::size_t cluster = block.first_cluster; cluster < block.last_cluster; ++cluster, ++cluster_end) {
    // Distances are known one entry ahead of their use, so that the root's long latency is hidden. The entry after the
    // last of the cluster is measured in vain.
    const auto look = [&](const RowEntry& e, Pair<D, Sum::carried>& pair) {
      measure(pass, range_squared, seen_from(pass, cluster, e.lane(), shifts[e.image()]), e.cluster(), pair);
    };
    Pair<D, Sum::carried> ahead;
    if constexpr (!finds) look(*entry, ahead);
    Given<Sum> own;
    unrolled<Sum::given>([&](auto c) { own[c] = load(pass.given_to(c, cluster)); });
    pair_within_cluster<1>(pass, sum, range_squared, once, cluster, kept.within(), own, totals);
    pair_within_cluster<2>(pass, sum, range_squared, once, cluster, kept.within(), own, totals);
    pair_within_cluster<3>(pass, sum, range_squared, once, cluster, kept.within(), own, totals);
    pair_within_cluster<4>(pass, sum, range_squared, once, cluster, kept.within(), own, totals);
    unrolled<Sum::given>([&](auto c) { store(pass.given_to(c, cluster), own[c]); });
    const RowEntry* const end = entries + *cluster_end;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      std::array<Lanes, Sum::carried> of_i;
      unrolled<Sum::carried>([&](auto c) { of_i[c] = pass.carried_of(c, cluster)[lane]; });
      Given<Sum> given;
      unrolled<Sum::given>([&](auto c) { given[c] = 0.0; });
      // Who finds slopes needs no root, and looks at once. Neighbours in a row are mostly of one image.
      std::array<Lanes, D> place;
      std::size_t image = no_image;
      while (entry != end && entry->lane() == lane) {
        Pair<D, Sum::carried> pair;
        const RowEntry now = *entry;
        ++entry;
        if constexpr (finds) {
          if (now.image() != image) {
            image = now.image();
            place = seen_from(pass, cluster, lane, shifts[image]);
          }
          measure(pass, range_squared, place, now.cluster(), pair);
        } else {
          unrolled<D>([&](auto d) { pair.displacement[d] = ahead.displacement[d]; });
          pair.distance = ahead.distance;
          look(*entry, ahead);
        }
        pair_with_cluster(pass, sum, pair, of_i, now.cluster(), shifts[now.image()], kept.along(), given, totals);
        kept.pass(now, finds || simd::any_of(pair.distance < range));
      }
      unrolled<Sum::given>([&](auto c) { at_i[c][lane] = folded(given[c]); });
    }
    kept.end_cluster();
    unrolled<Sum::given>([&](auto c) {
      double* const target = pass.given_to(c, cluster);
      store(target, load(target) + sums_of_rows(at_i[c]));
    });
  }
  Totals<Sum> result{};
  unrolled<Sum::totals>([&](auto c) { result[c] = simd::reduce(totals[c]); });
  return result;
}

}  // namespace detail

/// Sums over all pairs within `range`. Adds to what is given, returns the totals. The same bits for every team. `kept`:
/// for a sum that leaves or finds something; for one that finds, as left by a pass with the same list, images and
/// positions.
template <int D, class Sum>
Totals<Sum> traverse(const ClusterList<D>& list, const ImageTable<D>& images, double range, const Pass<D, Sum>& pass,
                     const Sum& sum, const Team& team, KeptPairs& kept) {
  if constexpr (Sum::keeping == Keeping::leaves) kept.fit(list);
  const auto blocks = list.blocks();
  const auto count = static_cast<std::ptrdiff_t>(blocks.size());
  KeptPairs::Block none;
  const auto over = [&](std::ptrdiff_t b) {
    const auto block = static_cast<std::size_t>(b);
    return detail::traverse_block<D, Sum>(blocks[block], images, range, pass, sum,
                                          Sum::keeping == Keeping::nothing ? none : kept[block]);
  };
  thread_local std::vector<Totals<Sum>> kept_parts;  // from call to call: no allocation per step
  kept_parts.resize(blocks.size());
  const std::span<Totals<Sum>> parts(kept_parts);  // the other threads' own are empty
  const auto work = [&](std::ptrdiff_t block) { parts[static_cast<std::size_t>(block)] = over(block); };
  if (team.threads() == 1) {
    // An odd block as soon as both its neighbours are done, when what they share is still in the caches.
    for (std::ptrdiff_t even = 0; even < count; even += 2) {
      work(even);
      if (even > 0) work(even - 1);
    }
    if (count % 2 == 0 && count > 0) work(count - 1);
  } else {
    for (std::ptrdiff_t colour = 0; colour < 2; ++colour)
      team.share((count - colour + 1) / 2, [&](std::ptrdiff_t part) { work(2 * part + colour); });
  }
  Totals<Sum> total{};
  for (std::size_t colour = 0; colour < 2; ++colour)
    for (std::size_t block = colour; block < parts.size(); block += 2)
      for (int c = 0; c < Sum::totals; ++c) total[c] += parts[block][c];
  return total;
}

/// The same for a sum that keeps nothing.
template <int D, class Sum>
requires(Sum::keeping == Keeping::nothing) Totals<Sum> traverse(const ClusterList<D>& list, const ImageTable<D>& images,
                                                                double range, const Pass<D, Sum>& pass, const Sum& sum,
                                                                const Team& team) {
  KeptPairs none;
  return traverse<D, Sum>(list, images, range, pass, sum, team, none);
}

}  // namespace lucy::pairs
