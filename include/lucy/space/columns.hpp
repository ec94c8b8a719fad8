// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the particles carry, stored as columns: one contiguous, aligned array of doubles per quantity and component
// (x, y, p_x, ...), one entry per particle slot. Vector instructions read them straight.
#pragma once

#include <algorithm>
#include <cstddef>
#include <new>
#include <span>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/errors.hpp"

namespace lucy::space {

/// Allocates at the boundary of a cache line, which is also that of the widest vector registers.
template <class T>
struct CacheAligned {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};

  CacheAligned() = default;
  template <class U>
  CacheAligned(const CacheAligned<U>&) {}

  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), alignment)); }
  void deallocate(T* pointer, std::size_t) { ::operator delete(pointer, alignment); }
  friend bool operator==(const CacheAligned&, const CacheAligned&) { return true; }
};

template <class T>
using AlignedVector = std::vector<T, CacheAligned<T>>;

/// `count` columns of `slots` doubles. The number of slots in use may be smaller and is the owner's business.
class Columns {
 public:
  Columns() = default;
  Columns(int count, std::size_t slots)
      : count_(count), stride_((slots + 7) / 8 * 8), values_(static_cast<std::size_t>(count) * stride_) {}

  int count() const { return count_; }
  std::size_t slots() const { return stride_; }

  void save(ArchiveWriter& archive, std::size_t slots_in_use) const {
    for (int c = 0; c < count_; ++c) archive.put_sequence(std::span((*this)[c], slots_in_use));
  }
  /// Throws RunFailed unless every saved column has so many slots.
  void load(ArchiveReader& archive, std::size_t slots_in_use) {
    std::vector<double> column;
    for (int c = 0; c < count_; ++c) {
      archive.get_sequence(column);
      if (column.size() != slots_in_use) throw RunFailed("a saved state has columns of different lengths");
      std::copy(column.begin(), column.end(), (*this)[c]);
    }
  }

  double* operator[](int column) { return values_.data() + static_cast<std::size_t>(column) * stride_; }
  const double* operator[](int column) const { return values_.data() + static_cast<std::size_t>(column) * stride_; }

 private:
  int count_ = 0;
  std::size_t stride_ = 0;
  AlignedVector<double> values_;
};

}  // namespace lucy::space
