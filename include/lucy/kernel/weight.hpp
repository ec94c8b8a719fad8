// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A weight function chosen at run time, by the name used in input files. Loops over pairs are compiled for each; a
// visit to the variant chooses among them once per pass.
#pragma once

#include <array>
#include <string_view>
#include <utility>
#include <variant>

#include "lucy/kernel/lucy.hpp"
#include "lucy/kernel/monaghan.hpp"

namespace lucy::kernel {

template <int D>
using Weight = std::variant<Lucy<D>, Monaghan<D>>;

enum class WeightName { lucy, monaghan };
inline constexpr std::array<std::pair<std::string_view, WeightName>, 2> weight_names = {{
    {"lucy", WeightName::lucy},
    {"monaghan", WeightName::monaghan},
}};

/// Throws BadInput unless range > 0.
template <int D>
Weight<D> make_weight(WeightName name, double range) {
  if (name == WeightName::monaghan) return Monaghan<D>(range);
  return Lucy<D>(range);
}

template <int D>
double range_of(const Weight<D>& weight) {
  return std::visit([](const auto& kernel) { return kernel.range(); }, weight);
}

}  // namespace lucy::kernel
