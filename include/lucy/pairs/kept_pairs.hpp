// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a pass over the pairs leaves for further passes while nobody moves: the entries of the rows that have a partner
// within the range at this moment (about six of seven), and one number per pair, such as the slope of the weight. The
// root of the distance, the slowest thing about a pair, is then taken once.
#pragma once

#include <cstddef>
#include <cstdint>
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

  /// Makes room for all pairs of `list`, 72 bytes for an entry.
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
      grow(blocks_[b].entries, rows[b].entries.size());
      grow(blocks_[b].along, rows[b].entries.size());
    }
  }

  Block& operator[](std::size_t block) { return blocks_[block]; }

 private:
  std::vector<Block> blocks_;
};

/// Where a pass is among the kept pairs of its block.
template <Keeping keeping>
class KeptCursor {
 public:
  explicit KeptCursor(KeptPairs::Block& block)
      : block_(block),
        within_(block.within.data()),
        along_(block.along.data()),
        entry_(block.entries.data()),
        cluster_end_(block.cluster_end.data()) {}

  Lanes* within() const { return within_; }
  Lanes* along() const { return along_; }

  /// Past the entry `now`, which is left only if someone was met there; without a branch, what nobody needs is
  /// overwritten.
  void pass(const RowEntry& now, bool met) {
    if constexpr (keeping == Keeping::leaves) {
      *entry_ = now;
      entry_ += static_cast<std::ptrdiff_t>(met);
      along_ += static_cast<std::ptrdiff_t>(met);
    } else {
      ++along_;
    }
  }
  void end_cluster() {
    if constexpr (keeping == Keeping::leaves)
      *cluster_end_++ = static_cast<std::uint32_t>(entry_ - block_.entries.data());
    within_ += lane_count / 2;
  }

 private:
  KeptPairs::Block& block_;
  Lanes* within_;
  Lanes* along_;
  RowEntry* entry_;
  std::uint32_t* cluster_end_;
};

/// For a pass that keeps nothing.
template <>
class KeptCursor<Keeping::nothing> {
 public:
  explicit KeptCursor(KeptPairs::Block&) {}
  Lanes* within() const { return nullptr; }
  Lanes* along() const { return nullptr; }
  void pass(const RowEntry&, bool) {}
  void end_cluster() {}
};

}  // namespace lucy::pairs
