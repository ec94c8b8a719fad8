// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vector registers as the pair traversal uses them: eight doubles at a time on every machine, so that the order of
// additions does not depend on the width of the hardware's registers.
#pragma once

#include <cstddef>
#include <experimental/simd>
#include <type_traits>

namespace lucy::pairs {

namespace simd = std::experimental;

inline constexpr int lane_count = 8;
using Lanes = simd::simd<double, simd::simd_abi::deduce_t<double, lane_count>>;
using LaneMask = Lanes::mask_type;

inline Lanes load(const double* from) { return Lanes(from, simd::vector_aligned); }
inline void store(double* to, const Lanes& value) { value.copy_to(to, simd::vector_aligned); }

/// Lane l of the result is lane (l + by) mod 8 of `value`.
template <int by>
Lanes rotate(const Lanes& value) {
  return Lanes([&](auto lane) { return value[(static_cast<std::size_t>(lane) + by) % lane_count]; });
}

/// body(0) ... body(count - 1), the argument being a constant: arrays of Lanes that are reached by constants alone stay
/// in registers, which a loop over their index would keep the compiler from.
template <int count, class Body>
[[gnu::always_inline]] inline void unrolled(const Body& body) {
  if constexpr (count > 0) {
    unrolled<count - 1>(body);
    body(std::integral_constant<int, count - 1>{});
  }
}

}  // namespace lucy::pairs
