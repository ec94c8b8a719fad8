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

/// a b + c, rounded once. std::experimental::fma goes lane by lane, and g++ does not always find the vector in that.
inline Lanes multiply_add(const Lanes& a, const Lanes& b, const Lanes& c) {
#if defined(__AVX512F__)
  return std::bit_cast<Lanes>(
      _mm512_fmadd_pd(std::bit_cast<__m512d>(a), std::bit_cast<__m512d>(b), std::bit_cast<__m512d>(c)));
#elif defined(__FMA__)
  using Halves = std::array<__m256d, 2>;
  const auto x = std::bit_cast<Halves>(a), y = std::bit_cast<Halves>(b), z = std::bit_cast<Halves>(c);
  return std::bit_cast<Lanes>(Halves{_mm256_fmadd_pd(x[0], y[0], z[0]), _mm256_fmadd_pd(x[1], y[1], z[1])});
#else
  return fma(a, b, c);
#endif
}

/// Lane l of the result is lane (l + by) mod 8 of `value`.
template <int by>
Lanes rotate(const Lanes& value) {
  return Lanes([&](auto lane) { return value[(static_cast<std::size_t>(lane) + by) % lane_count]; });
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

/// Chosen lanes of a (0 to 7) and b (8 to 15).
template <int... chosen>
Vector shuffled(const Vector& a, const Vector& b) {
  return __builtin_shufflevector(a, b, chosen...);
}

}  // namespace detail

/// Lane l of the result is the sum over the lanes of rows[l], each as ((0 + 4) + (2 + 6)) + ((1 + 5) + (3 + 7)).
inline Lanes sums_of_rows(const std::array<Lanes, lane_count>& rows) {
  using detail::shuffled, detail::Vector;
  std::array<Vector, 4> halves;  // of row r in lanes 0 to 3, of row r + 4 beyond
  unrolled<4>([&](auto r) {
    const auto a = std::bit_cast<Vector>(rows[r]);
    const auto b = std::bit_cast<Vector>(rows[r + 4]);
    halves[r] = shuffled<0, 1, 2, 3, 8, 9, 10, 11>(a, b) + shuffled<4, 5, 6, 7, 12, 13, 14, 15>(a, b);
  });
  std::array<Vector, 2> quarters;
  unrolled<2>([&](auto r) {
    const Vector& a = halves[r];
    const Vector& b = halves[r + 2];
    quarters[r] = shuffled<0, 1, 8, 9, 4, 5, 12, 13>(a, b) + shuffled<2, 3, 10, 11, 6, 7, 14, 15>(a, b);
  });
  const auto& [a, b] = quarters;
  return std::bit_cast<Lanes>(
      Vector(shuffled<0, 8, 2, 10, 4, 12, 6, 14>(a, b) + shuffled<1, 9, 3, 11, 5, 13, 7, 15>(a, b)));
}

}  // namespace lucy::pairs
