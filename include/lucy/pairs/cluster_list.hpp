// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Who is near whom, and for how long.
//
// Particles are kept sorted in memory: the box is cut into pencils along x (strips in two dimensions), each pencil is
// sorted by x and cut into clusters of eight neighbours, so that one vector load fetches a cluster. For every particle
// there is a row: the clusters (with their image) that hold a partner, each unordered pair in one row only.
//
// The list is made for a stretch of time, the lifetime, not for a skin of fixed thickness. Between collisions with the
// soft cores a particle moves on a straight line in the laboratory frame (SLLOD's two shear terms cancel there), so a
// row takes the clusters with a particle that comes within the range along the straight relative path
//
//     r(t) = r + (v_rel + streaming) t,   0 <= t <= lifetime,   widened by twice the slack
//
// and the list holds for as long as no particle strays from its own line by more than the slack. The mean flow costs
// nothing (a pair's relative streaming is part of its path), and a single fast particle lengthens its own row only.
// Clusters: Pall and Hess, Comput. Phys. Commun. 184, 2641 (2013).
//
// Pencils are grouped into blocks wide enough that the rows of one block reach no further than the next block. Even
// blocks can then be worked on at the same time, and after them the odd ones, without two writers at one particle; the
// order of additions is fixed by the blocks and never by the number of threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lucy/pairs/lanes.hpp"
#include "lucy/space/box.hpp"
#include "lucy/space/columns.hpp"
#include "lucy/team.hpp"

namespace lucy::pairs {

/// The particle number of an empty slot, and where such slots lie along x (zero along the others, so that the mean
/// flow leaves them there): far from everything and, lane by lane, from each other, where no weight reaches.
inline constexpr std::int32_t nobody = -1;
inline double far_away(std::size_t slot) { return 1e8 * static_cast<double>(1 + slot % lane_count); }

/// One cluster in the row of one particle, seen through one image.
class RowEntry {
 public:
  static constexpr int image_bits = 7;
  static constexpr int lane_bits = 3;

  RowEntry() = default;
  RowEntry(std::size_t cluster, int image)
      : cluster_(static_cast<std::uint32_t>(cluster)), code_(static_cast<std::uint32_t>(image) << lane_bits) {}

  /// The same cluster and image in the row of the particle at `lane` of its own cluster.
  RowEntry of_lane(int lane) const {
    RowEntry entry = *this;
    entry.code_ |= static_cast<std::uint32_t>(lane);
    return entry;
  }

  std::size_t cluster() const { return cluster_; }
  std::size_t image() const { return code_ >> lane_bits; }
  std::size_t lane() const { return code_ & ((1U << lane_bits) - 1); }

 private:
  std::uint32_t cluster_;
  std::uint32_t code_;
};

/// The images that a half list can name: the slowest sorted direction looks upwards only.
template <int D>
struct ImageSet {
  static constexpr int reach_x = 3;
  static constexpr int reach_other = 2;
  static constexpr int count = D == 1 ? 7 : D == 2 ? 7 * 3 : 7 * 5 * 3;
  static_assert(count <= 1 << RowEntry::image_bits);

  /// n_x, n_y, n_z of image `index`.
  static constexpr std::array<int, D> numbers(int index) {
    std::array<int, D> n{};
    n[0] = index % 7 - reach_x;
    if constexpr (D == 2) n[1] = index / 7;
    if constexpr (D == 3) {
      n[1] = index / 7 % 5 - reach_other;
      n[2] = index / 35;
    }
    return n;
  }
  static constexpr int index(const std::array<int, D>& n) {
    int value = n[0] + reach_x;
    if constexpr (D == 2) value += 7 * n[1];
    if constexpr (D == 3) value += 7 * (n[1] + reach_other) + 35 * n[2];
    return value;
  }
};

/// Shifts of all images at one moment, ready for the traversal.
template <int D>
using ImageTable = std::array<space::ImageShift<D>, ImageSet<D>::count>;
template <int D>
ImageTable<D> image_table(const space::Box<D>& box, double age);

/// What bounds a list: the interaction range, the time it is made for, and the stray from straight lines it allows.
struct ListReach {
  double range = 0.0;
  double lifetime = 0.0;
  double slack = 0.0;
  double largest_speed = 0.0;  ///< of any particle, relative to the mean flow
  double typical_speed = 0.0;  ///< root mean square, per component; only the tightness of the rows depends on it
};

template <int D>
class ClusterList {
 public:
  /// One block: its pencils' clusters, and their rows.
  struct Block {
    std::size_t first_cluster = 0;
    std::size_t last_cluster = 0;            ///< one past
    std::vector<std::uint32_t> cluster_end;  ///< per cluster of the block, where its rows end in `entries`
    std::vector<RowEntry> entries;
    std::vector<RowEntry> candidates;  // scratch of build()
  };

  /// For `particles` particles in a box of the given edge lengths, and at times up to `more` besides.
  ClusterList(std::int64_t particles, const space::Vector<D>& lengths, std::int64_t more = 0);

  /// Slots to allocate: enough for every arrangement.
  std::size_t capacity() const { return capacity_; }
  /// Slots in use, a multiple of eight, empty ones among them.
  std::size_t slots() const { return clusters() * lane_count; }
  std::size_t clusters() const { return pencil_begin_.back(); }

  /// The longest lifetime for which pairs stay within the images that a list can name; zero when the box is shorter
  /// than range + 2 slack.
  double longest_lifetime(double range, double slack, double largest_speed, double strain_rate) const;

  /// Sorts the particles. Gives for every new slot the old slot it takes its particle from (nobody: empty).
  /// `position`: D columns, wrapped into the box; `particle`: the particle number of every old slot.
  /// The order depends on the positions and, between equals, on the old order.
  std::span<const std::int32_t> arrange(const std::array<const double*, D>& position,
                                        std::span<const std::int32_t> particle);

  /// Fills the rows for particles that lie as arrange() ordered them. `velocity`: peculiar, D columns.
  /// Throws RunFailed if the lifetime is above longest_lifetime().
  void build(const std::array<const double*, D>& position, const std::array<const double*, D>& velocity,
             const space::Box<D>& box, const ListReach& reach, const Team& team);

  std::span<const Block> blocks() const { return blocks_; }
  std::size_t entry_count() const;

 private:
  struct Extent {  // of a cluster, swept over the lifetime relative to the mean flow
    space::Vector<D> low;
    space::Vector<D> high;
  };

  int pencil_of(const std::array<const double*, D>& position, std::size_t slot) const;
  void plan_blocks(double reach_slowest);
  void sweep(const std::array<const double*, D>& position, const std::array<const double*, D>& velocity,
             double lifetime);
  void fill_block(Block& block, const std::array<const double*, D>& position,
                  const std::array<const double*, D>& velocity, const space::Box<D>& box, const ListReach& reach,
                  const ImageTable<D>& images) const;

  space::Vector<D> lengths_;
  std::array<int, D> pencils_{};  // number of pencils in y, z; entry 0 is 1
  std::size_t capacity_ = 0;
  std::vector<std::size_t> pencil_begin_;  // first cluster of each pencil, and the end
  std::vector<std::int32_t> order_;
  std::vector<std::uint8_t> members_;
  std::vector<Extent> extent_;         // per cluster
  std::vector<Extent> pencil_extent_;  // per pencil
  std::vector<double> start_high_x_;   // per cluster: largest x at the start; ascends within a pencil
  std::vector<double> start_low_x_;
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> cell_count_;  // scratch of arrange()
  std::vector<std::int32_t> sorted_;
};

extern template class ClusterList<1>;
extern template class ClusterList<2>;
extern template class ClusterList<3>;

}  // namespace lucy::pairs
