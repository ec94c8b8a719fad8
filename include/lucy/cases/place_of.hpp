// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Quantities are kept in arrays and found by name.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace lucy::cases {

/// The place of a name in a table of names; a wrong name does not compile.
template <std::size_t Count>
consteval std::size_t place_of(const std::array<std::string_view, Count>& names, std::string_view name) {
  for (std::size_t i = 0; i < Count; ++i)
    if (names[i] == name) return i;
  throw "no such name";
}

}  // namespace lucy::cases
