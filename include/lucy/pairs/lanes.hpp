// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vector registers as the pair traversal uses them: eight doubles at a time on every machine, so that the order of
// additions does not depend on the width of the hardware's registers.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <experimental/simd>
#include <type_traits>

#ifdef __FMA__
#include <immintrin.h>
#endif

// No call is left in the pair loop, for which registers would have to be saved. With the sanitizers' checks in it, it
// would be too large to compile so.
#ifdef __SANITIZE_ADDRESS__
#define LUCY_INLINE inline
#define LUCY_INLINE_ALL
#else
#define LUCY_INLINE [[gnu::always_inline]] inline
#define LUCY_INLINE_ALL [[gnu::flatten]]
#endif

namespace lucy::pairs {

namespace simd = std::experimental;

inline constexpr int lane_count = 8;
using Lanes = simd::simd<double, simd::simd_abi::deduce_t<double, lane_count>>;
using LaneMask = Lanes::mask_type;

inline Lanes load(const double* from) { return Lanes(from, simd::vector_aligned); }
inline void store(double* to, const Lanes& value) { value.copy_to(to, simd::vector_aligned); }

/// The same eight numbers as a T of the compiler's own vectors, and back. Where a register is narrower than eight
/// lanes, Lanes are no plain bits, and go through memory.
template <class T>
LUCY_INLINE T from_lanes(const Lanes& value) {
  if constexpr (std::is_trivially_copyable_v<Lanes>) {
    return std::bit_cast<T>(value);
  } else {
    alignas(64) std::array<double, lane_count> numbers;
    store(numbers.data(), value);
    return std::bit_cast<T>(numbers);
  }
}
template <class T>
LUCY_INLINE Lanes to_lanes(const T& value) {
  if constexpr (std::is_trivially_copyable_v<Lanes>) {
    return std::bit_cast<Lanes>(value);
  } else {
    alignas(64) const auto numbers = std::bit_cast<std::array<double, lane_count>>(value);
    return load(numbers.data());
  }
}

/// a b + c, rounded once. std::experimental::fma goes lane by lane, and g++ does not always find the vector in that.
LUCY_INLINE Lanes multiply_add(const Lanes& a, const Lanes& b, const Lanes& c) {
#if defined(__AVX512F__)
  return to_lanes(_mm512_fmadd_pd(from_lanes<__m512d>(a), from_lanes<__m512d>(b), from_lanes<__m512d>(c)));
#elif defined(__FMA__)
  using Halves = std::array<__m256d, 2>;
  const auto x = from_lanes<Halves>(a), y = from_lanes<Halves>(b), z = from_lanes<Halves>(c);
  return to_lanes(Halves{_mm256_fmadd_pd(x[0], y[0], z[0]), _mm256_fmadd_pd(x[1], y[1], z[1])});
#else
  return fma(a, b, c);
#endif
}

/// body(0) ... body(count - 1), the argument being a constant: arrays of Lanes that are reached by constants alone stay
/// in registers, which a loop over their index would keep the compiler from.
template <int count, class Body>
LUCY_INLINE void unrolled(const Body& body) {
  if constexpr (count > 0) {
    unrolled<count - 1>(body);
    body(std::integral_constant<int, count - 1>{});
  }
}

namespace detail {

using Vector [[gnu::vector_size(lane_count * sizeof(double))]] = double;
using Half [[gnu::vector_size(lane_count / 2 * sizeof(double))]] = double;

/// Chosen elements of a and, counted on, of b.
template <int... chosen, class V>
auto shuffled(const V& a, const V& b) {
  return __builtin_shufflevector(a, b, chosen...);
}

}  // namespace detail

/// Lane l of the result is lane (l + by) mod 8 of `value`.
template <int by>
LUCY_INLINE Lanes rotate(const Lanes& value) {
  static_assert(0 < by && by < lane_count);
  const auto v = from_lanes<detail::Vector>(value);
  return to_lanes(detail::shuffled<by, by + 1, by + 2, by + 3, by + 4, by + 5, by + 6, by + 7>(v, v));
}

/// One addition into the sum over lanes: l and l + 4.
using FoldedLanes = detail::Half;
LUCY_INLINE FoldedLanes folded(const Lanes& value) {
#ifdef __AVX512F__
  // g++ 12 shuffles a whole register for the upper half.
  const auto whole = from_lanes<__m512d>(value);
  return FoldedLanes(_mm256_add_pd(_mm512_castpd512_pd256(whole), _mm512_extractf64x4_pd(whole, 1)));
#else
  const auto v = from_lanes<detail::Vector>(value);
  return detail::shuffled<0, 1, 2, 3>(v, v) + detail::shuffled<4, 5, 6, 7>(v, v);
#endif
}

/// Lane l of the result is the sum over the lanes of rows[l], each as ((0 + 4) + (2 + 6)) + ((1 + 5) + (3 + 7)).
LUCY_INLINE Lanes sums_of_rows(const std::array<FoldedLanes, lane_count>& rows) {
  using detail::shuffled, detail::Half;
  const auto sums_of_four = [](const Half& a, const Half& b, const Half& c, const Half& d) -> Half {
    const Half ac = shuffled<0, 1, 4, 5>(a, c) + shuffled<2, 3, 6, 7>(a, c);
    const Half bd = shuffled<0, 1, 4, 5>(b, d) + shuffled<2, 3, 6, 7>(b, d);
    return shuffled<0, 4, 2, 6>(ac, bd) + shuffled<1, 5, 3, 7>(ac, bd);
  };
  const Half low = sums_of_four(rows[0], rows[1], rows[2], rows[3]);
  const Half high = sums_of_four(rows[4], rows[5], rows[6], rows[7]);
  return to_lanes(detail::Vector(shuffled<0, 1, 2, 3, 4, 5, 6, 7>(low, high)));
}

}  // namespace lucy::pairs
