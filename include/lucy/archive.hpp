// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A state as a string of bytes: what `save` appends, `load` takes back in the same order, bit for bit.
// The archive knows no file; `files/checkpoint` writes its bytes with a checksum.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "lucy/errors.hpp"

namespace lucy {

/// Collects values; numbers are stored as they lie in memory (same machine, same build).
class ArchiveWriter {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put(const T& value) { append(&value, sizeof value); }

  /// A sequence of trivially copyable values, preceded by its length.
  template <class Range>
  requires requires(const Range& r) { std::span(r); }
  void put_sequence(const Range& range) {
    const std::span view(range);
    put(static_cast<std::uint64_t>(view.size()));
    append(view.data(), view.size_bytes());
  }

  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  void append(const void* from, std::size_t count) {
    const std::size_t old = bytes_.size();
    bytes_.resize(old + count);
    if (count > 0) std::memcpy(bytes_.data() + old, from, count);
  }

  std::vector<std::byte> bytes_;
};

/// Gives the values back in the order they were put. Throws RunFailed when the bytes run out.
class ArchiveReader {
 public:
  explicit ArchiveReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_trivially_copyable_v<T> T get() {
    T value;
    take(&value, sizeof value);
    return value;
  }

  /// Resizes `container` to the stored length and fills it.
  template <class Container>
  void get_sequence(Container& container) {
    const auto count = get<std::uint64_t>();
    if (count > bytes_.size() / sizeof(typename Container::value_type)) throw RunFailed("a saved state is truncated");
    container.resize(count);
    take(container.data(), count * sizeof(typename Container::value_type));
  }

  bool exhausted() const { return bytes_.empty(); }

 private:
  void take(void* to, std::size_t count) {
    if (count > bytes_.size()) throw RunFailed("a saved state is truncated");
    if (count > 0) std::memcpy(to, bytes_.data(), count);
    bytes_ = bytes_.subspan(count);
  }

  std::span<const std::byte> bytes_;
};

}  // namespace lucy
