// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lists of words for the values of an enumeration, such as motion::cooling_names, the other way round.
#pragma once

#include <string_view>

namespace lucy::files {

/// The word for `value`.
template <class Names, class Value>
std::string_view name_of(const Names& names, Value value) {
  for (const auto& [name, known] : names)
    if (known == value) return name;
  return "unknown";
}

}  // namespace lucy::files
