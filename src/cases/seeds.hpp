// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Seeds for starts: one for each replica of each state, made of all that tells one state from another, so that the same
// row gives the same bits in whatever table it stands.
#pragma once

#include <bit>
#include <cstdint>
#include <initializer_list>

namespace lucy::cases {

/// Scrambles 64 bits (the finaliser of SplitMix64, Steele, Lea and Flood, 2014).
inline std::uint64_t scramble(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

/// `seed` as a person gave it, and the bits of everything else.
inline std::uint64_t mixed_seed(std::uint64_t seed, std::initializer_list<std::uint64_t> parts) {
  std::uint64_t mixed = scramble(seed);
  for (const std::uint64_t part : parts) mixed = scramble(mixed ^ part);
  return mixed;
}

inline std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

}  // namespace lucy::cases
