// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/pairs/cluster_list.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lucy/errors.hpp"

namespace lucy::pairs {

namespace {

// Edge of the square (cube) that holds eight particles at the mean density: pencils of this width give round clusters.
template <int D>
double cluster_edge(std::int64_t particles, const space::Vector<D>& lengths) {
  return std::pow(space::Box<D>(lengths).volume() * lane_count / static_cast<double>(particles), 1.0 / D);
}

int floor_divide(int value, int divisor) { return (value >= 0 ? value : value - divisor + 1) / divisor; }

int cell_along(double position, double length, int cells) {
  return std::min(static_cast<int>(position * (cells / length)), cells - 1);
}

}  // namespace

template <int D>
ImageTable<D> image_table(const space::Box<D>& box, double age) {
  ImageTable<D> table;
  for (int index = 0; index < ImageSet<D>::count; ++index) table[index] = box.image(ImageSet<D>::numbers(index), age);
  return table;
}
template ImageTable<1> image_table(const space::Box<1>&, double);
template ImageTable<2> image_table(const space::Box<2>&, double);
template ImageTable<3> image_table(const space::Box<3>&, double);

template <int D>
ClusterList<D>::ClusterList(std::int64_t particles, const space::Vector<D>& lengths, std::int64_t more)
    : lengths_(lengths) {
  const std::int64_t most = particles + more;
  if (particles < 1 || most > (std::int64_t{1} << 27)) throw BadInput("a cluster list takes 1 to 2^27 particles");
  const double edge = cluster_edge<D>(particles, lengths);
  std::size_t pencils = 1;
  pencils_[0] = 1;
  for (int d = 1; d < D; ++d) {
    pencils_[d] = std::max(1, static_cast<int>(lengths[d] / edge));
    pencils *= static_cast<std::size_t>(pencils_[d]);
  }
  capacity_ = (static_cast<std::size_t>(most) / lane_count + pencils + 1) * lane_count;
  pencil_begin_.assign(pencils + 1, 0);
  pencil_extent_.resize(pencils);
  const int cells_per_pencil = std::max(1, static_cast<int>(2.0 * lengths[0] / edge));
  cell_count_.resize(pencils * static_cast<std::size_t>(cells_per_pencil) + 1);
  sorted_.resize(static_cast<std::size_t>(most));
  order_.reserve(capacity_);
  const std::size_t most_clusters = capacity_ / lane_count;
  members_.reserve(most_clusters);
  extent_.reserve(most_clusters);
  start_low_x_.reserve(most_clusters);
  start_high_x_.reserve(most_clusters);
}

template <int D>
double ClusterList<D>::longest_lifetime(double range, double slack, double largest_speed, double strain_rate) const {
  // A row names images up to two boxes away across the pencils and three along them; a path shorter than the box keeps
  // within that. Very long paths are also cut off at one and a half ranges, since they widen the blocks.
  const double shortest = *std::min_element(lengths_.begin(), lengths_.end());
  const double path = std::min((shortest - range - 2.0 * slack) / 2.0, 1.5 * range);
  if (path <= 0.0) return 0.0;
  const double by_speed = largest_speed > 0.0 ? path / largest_speed : std::numeric_limits<double>::infinity();
  const double by_strain = strain_rate != 0.0 ? 0.5 / std::abs(strain_rate) : std::numeric_limits<double>::infinity();
  return std::min(by_speed, by_strain);
}

template <int D>
int ClusterList<D>::pencil_of(const std::array<const double*, D>& position, std::size_t slot) const {
  int pencil = 0;
  for (int d = D - 1; d >= 1; --d) {
    pencil = pencil * pencils_[d] + cell_along(position[d][slot], lengths_[d], pencils_[d]);
  }
  return pencil;
}

template <int D>
std::span<const std::int32_t> ClusterList<D>::arrange(const std::array<const double*, D>& position,
                                                      std::span<const std::int32_t> particle) {
  const std::size_t pencils = pencil_extent_.size();
  const int cells = static_cast<int>((cell_count_.size() - 1) / pencils);
  const auto cell_of = [&](std::size_t slot) {
    return static_cast<std::size_t>(pencil_of(position, slot)) * static_cast<std::size_t>(cells) +
           static_cast<std::size_t>(cell_along(position[0][slot], lengths_[0], cells));
  };

  // Counting sort into cells, stable, then insertion sort within each cell.
  std::fill(cell_count_.begin(), cell_count_.end(), 0);
  for (std::size_t slot = 0; slot < particle.size(); ++slot) {
    if (particle[slot] != nobody) ++cell_count_[cell_of(slot) + 1];
  }
  for (std::size_t cell = 1; cell < cell_count_.size(); ++cell) cell_count_[cell] += cell_count_[cell - 1];
  std::vector<std::uint32_t>& next = cell_count_;
  for (std::size_t slot = 0; slot < particle.size(); ++slot) {
    if (particle[slot] != nobody) sorted_[next[cell_of(slot)]++] = static_cast<std::int32_t>(slot);
  }
  // next[c] is now the end of cell c.
  const double* x = position[0];
  std::uint32_t begin = 0;
  for (std::size_t cell = 0; cell + 1 < cell_count_.size(); ++cell) {
    for (std::uint32_t k = begin + 1; k < next[cell]; ++k) {
      const std::int32_t moving = sorted_[k];
      std::uint32_t hole = k;
      for (; hole > begin && x[sorted_[hole - 1]] > x[moving]; --hole) sorted_[hole] = sorted_[hole - 1];
      sorted_[hole] = moving;
    }
    begin = next[cell];
  }

  order_.clear();
  members_.clear();
  std::uint32_t from = 0;
  for (std::size_t pencil = 0; pencil < pencils; ++pencil) {
    pencil_begin_[pencil] = members_.size();
    const std::uint32_t to = next[(pencil + 1) * static_cast<std::size_t>(cells) - 1];
    for (; from < to; from += lane_count) {
      const auto count = std::min<std::uint32_t>(lane_count, to - from);
      order_.insert(order_.end(), sorted_.begin() + from, sorted_.begin() + from + count);
      order_.insert(order_.end(), lane_count - count, nobody);
      members_.push_back(static_cast<std::uint8_t>(count));
    }
    from = to;
  }
  pencil_begin_[pencils] = members_.size();
  return order_;
}

template <int D>
void ClusterList<D>::sweep(const std::array<const double*, D>& position, const std::array<const double*, D>& velocity,
                           double lifetime) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  extent_.resize(clusters());
  start_low_x_.resize(clusters());
  start_high_x_.resize(clusters());
  for (std::size_t pencil = 0; pencil < pencil_extent_.size(); ++pencil) {
    Extent& whole = pencil_extent_[pencil];
    whole.low.fill(infinite);
    whole.high.fill(-infinite);
    for (std::size_t cluster = pencil_begin_[pencil]; cluster < pencil_begin_[pencil + 1]; ++cluster) {
      const std::size_t first = cluster * lane_count;
      const std::size_t last = first + members_[cluster] - 1;
      Extent& extent = extent_[cluster];
      extent.low.fill(infinite);
      extent.high.fill(-infinite);
      for (std::size_t slot = first; slot <= last; ++slot) {
        for (int d = 0; d < D; ++d) {
          const double start = position[d][slot];
          const double end = start + lifetime * velocity[d][slot];
          extent.low[d] = std::min(extent.low[d], std::min(start, end));
          extent.high[d] = std::max(extent.high[d], std::max(start, end));
        }
      }
      start_low_x_[cluster] = position[0][first];
      start_high_x_[cluster] = position[0][last];
      for (int d = 0; d < D; ++d) {
        whole.low[d] = std::min(whole.low[d], extent.low[d]);
        whole.high[d] = std::max(whole.high[d], extent.high[d]);
      }
    }
  }
}

template <int D>
void ClusterList<D>::plan_blocks(double reach_slowest) {
  const int rows = pencils_[D - 1];
  const double height = D == 1 ? 1.0 : lengths_[D - 1] / rows;
  const int fewest = D == 1 ? 1 : std::max(1, static_cast<int>(std::ceil(reach_slowest / height)));
  int count = rows / fewest;
  count -= count % 2;
  if (count < 2) count = 1;
  blocks_.resize(static_cast<std::size_t>(count));
  const std::size_t pencils_per_row = pencil_extent_.size() / static_cast<std::size_t>(rows);
  for (int b = 0; b < count; ++b) {
    const auto row = [&](int block) { return static_cast<std::size_t>(std::int64_t{rows} * block / count); };
    blocks_[b].first_cluster = pencil_begin_[row(b) * pencils_per_row];
    blocks_[b].last_cluster = pencil_begin_[row(b + 1) * pencils_per_row];
  }
}

template <int D>
void ClusterList<D>::build(const std::array<const double*, D>& position, const std::array<const double*, D>& velocity,
                           const space::Box<D>& box, const ListReach& reach, const Team& team) {
  if (reach.lifetime > longest_lifetime(reach.range, reach.slack, reach.largest_speed, box.strain_rate())) {
    throw RunFailed("a particle crosses the box within the lifetime of one neighbour list");
  }
  sweep(position, velocity, reach.lifetime);
  plan_blocks(reach.range + 2.0 * reach.slack + 2.0 * reach.largest_speed * reach.lifetime);
  const ImageTable<D> images = image_table(box, 0.0);
  team.share(static_cast<std::ptrdiff_t>(blocks_.size()),
             [&](std::ptrdiff_t b) { fill_block(blocks_[b], position, velocity, box, reach, images); });
}

template <int D>
void ClusterList<D>::fill_block(Block& block, const std::array<const double*, D>& position,
                                const std::array<const double*, D>& velocity, const space::Box<D>& box,
                                const ListReach& reach, const ImageTable<D>& images) const {
  const double near = reach.range + 2.0 * reach.slack;
  const double half_life = 0.5 * reach.lifetime;
  const double farthest = near + 2.0 * reach.largest_speed * reach.lifetime;  // of a partner, at the start
  space::Vector<D> margin;
  margin.fill(near);
  if constexpr (D > 1) margin[0] += std::abs(box.strain_rate()) * reach.lifetime * farthest;

  // A lane is near if its path, a segment of half length s about its middle c, comes within `near`:
  // |c| < near + s. Squared, with 2 near s <= near (s0 + s^2/s0) to save the root; s0 is a typical s.
  const double s0 = std::max(reach.typical_speed * reach.lifetime, 1e-3 * near);
  const double near_constant = near * near + near * s0;
  const double near_slope = 1.0 + near / s0;

  std::array<int, D> farthest_pencil{};
  for (int d = 1; d < D; ++d) farthest_pencil[d] = static_cast<int>(std::ceil(farthest * pencils_[d] / lengths_[d]));

  std::vector<RowEntry>& candidates = block.candidates;
  block.entries.clear();
  block.cluster_end.clear();

  std::size_t pencil = static_cast<std::size_t>(
      std::upper_bound(pencil_begin_.begin(), pencil_begin_.end(), block.first_cluster) - pencil_begin_.begin() - 1);
  for (std::size_t own = block.first_cluster; own < block.last_cluster; ++own) {
    while (own >= pencil_begin_[pencil + 1]) ++pencil;
    const Extent& mine = extent_[own];
    candidates.clear();

    // The clusters of one pencil, seen through all images along x.
    const auto look_into = [&](std::size_t other_pencil, std::array<int, D> n, bool same) {
      const Extent& whole = pencil_extent_[other_pencil];
      const space::Vector<D> across = images[ImageSet<D>::index(n)].position;
      for (int d = 1; d < D; ++d) {
        if (whole.low[d] + across[d] > mine.high[d] + margin[d]) return;
        if (whole.high[d] + across[d] < mine.low[d] - margin[d]) return;
      }
      const double wander = reach.largest_speed * reach.lifetime;
      for (int n_x = same ? 0 : -ImageSet<D>::reach_x; n_x <= ImageSet<D>::reach_x; ++n_x) {
        n[0] = n_x;
        const int image = ImageSet<D>::index(n);
        const space::Vector<D>& shift = images[image].position;
        const double low = mine.low[0] - margin[0] - shift[0];
        const double high = mine.high[0] + margin[0] - shift[0];
        if (whole.low[0] > high || whole.high[0] < low) continue;
        const auto first = start_high_x_.begin() + static_cast<std::ptrdiff_t>(pencil_begin_[other_pencil]);
        const auto last = start_high_x_.begin() + static_cast<std::ptrdiff_t>(pencil_begin_[other_pencil + 1]);
        auto other = static_cast<std::size_t>(std::lower_bound(first, last, low - wander) - start_high_x_.begin());
        if (same && n_x == 0) other = std::max(other, own + 1);
        for (; other < pencil_begin_[other_pencil + 1] && start_low_x_[other] <= high + wander; ++other) {
          bool apart = false;
          for (int d = 0; d < D; ++d) {
            apart |= extent_[other].low[d] + shift[d] > mine.high[d] + margin[d];
            apart |= extent_[other].high[d] + shift[d] < mine.low[d] - margin[d];
          }
          if (!apart) candidates.emplace_back(other, image);
        }
      }
    };

    // Pencils in the half space of larger (z, y), this one included.
    if constexpr (D == 1) {
      look_into(0, {}, true);
    } else {
      const int p_y = static_cast<int>(pencil) % pencils_[1];
      const int p_z = static_cast<int>(pencil) / pencils_[1];
      const int highest_z = D == 3 ? farthest_pencil[D - 1] : 0;
      for (int o_z = 0; o_z <= highest_z; ++o_z) {
        for (int o_y = D == 2 || o_z == 0 ? 0 : -farthest_pencil[1]; o_y <= farthest_pencil[1]; ++o_y) {
          std::array<int, D> n{};
          n[1] = floor_divide(p_y + o_y, pencils_[1]);
          int other = p_y + o_y - n[1] * pencils_[1];
          if constexpr (D == 3) {
            n[2] = (p_z + o_z) / pencils_[2];
            other += (p_z + o_z - n[2] * pencils_[2]) * pencils_[1];
          }
          bool nameable = true;
          for (int d = 1; d < D; ++d) nameable = nameable && std::abs(n[d]) <= ImageSet<D>::reach_other;
          if (nameable) look_into(static_cast<std::size_t>(other), n, o_y == 0 && o_z == 0);
        }
      }
    }

    for (int lane = 0; lane < members_[own]; ++lane) {
      const std::size_t slot = own * lane_count + static_cast<std::size_t>(lane);
      std::size_t size = block.entries.size();
      block.entries.resize(size + candidates.size());
      for (const RowEntry candidate : candidates) {
        const std::size_t at = candidate.cluster() * lane_count;
        const space::Vector<D>& shift = images[candidate.image()].position;
        std::array<Lanes, D> separation;
        std::array<Lanes, D> drift;
        for (int d = 0; d < D; ++d) {
          separation[d] = position[d][slot] - shift[d] - load(position[d] + at);
          drift[d] = velocity[d][slot] - load(velocity[d] + at);
        }
        if constexpr (D > 1) drift[0] += box.strain_rate() * separation[1];
        Lanes middle_squared = 0.0;
        Lanes half_path_squared = 0.0;
        for (int d = 0; d < D; ++d) {
          const Lanes half_path = half_life * drift[d];
          const Lanes middle = separation[d] + half_path;
          middle_squared += middle * middle;
          half_path_squared += half_path * half_path;
        }
        block.entries[size] = candidate.of_lane(lane);
        size += simd::any_of(middle_squared < near_constant + near_slope * half_path_squared) ? 1 : 0;
      }
      block.entries.resize(size);
    }
    block.cluster_end.push_back(static_cast<std::uint32_t>(block.entries.size()));
  }
  block.entries.emplace_back(block.first_cluster, ImageSet<D>::index({}));  // the traversal looks one entry ahead
}

template <int D>
std::size_t ClusterList<D>::entry_count() const {
  std::size_t count = 0;
  for (const Block& block : blocks_) count += block.entries.size() - 1;
  return count;
}

template class ClusterList<1>;
template class ClusterList<2>;
template class ClusterList<3>;

}  // namespace lucy::pairs
