// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a pass over the pairs leaves for further passes while nobody moves: the entries of the rows that have a partner
// within the range at this moment (about six of seven), and one number per pair, such as the slope of the weight. The
// root of the distance, the slowest thing about a pair, is then taken once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lucy/pairs/cluster_list.hpp"
#include "lucy/pairs/lanes.hpp"

namespace lucy::pairs {

/// What a sum does with the number kept for a pair.
enum class Keeping {
  nothing,  ///< knows of none
  leaves,   ///< its call operator returns it
  finds     ///< reads it in Pair::kept; Pair::distance is not known
};

class KeptPairs {
 public:
  struct Block {
    std::vector<std::uint32_t> cluster_end;  ///< as in ClusterList::Block
    std::vector<RowEntry> entries;
    std::vector<Lanes> within;  ///< per cluster: its own pairs 1, 2, 3 and 4 lanes apart
    std::vector<Lanes> along;   ///< per entry
  };

  /// Makes room for all pairs of `list`, 80 bytes for an entry.
  template <int D>
  void fit(const ClusterList<D>& list) {
    const auto rows = list.blocks();
    if (blocks_.size() < rows.size()) blocks_.resize(rows.size());
    const auto grow = [](auto& values, std::size_t size) {
      if (values.size() < size) values.resize(size);
    };
    for (std::size_t b = 0; b < rows.size(); ++b) {
      const std::size_t clusters = rows[b].last_cluster - rows[b].first_cluster;
      grow(blocks_[b].cluster_end, clusters);
      grow(blocks_[b].within, clusters * lane_count / 2);
      grow(blocks_[b].entries, rows[b].entries.size() + 1);
      grow(blocks_[b].along, rows[b].entries.size() + 1);
    }
  }

  Block& operator[](std::size_t block) { return blocks_[block]; }

 private:
  std::vector<Block> blocks_;
};

}  // namespace lucy::pairs
