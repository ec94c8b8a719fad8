// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the three passes and what lies between them have in common.
#pragma once

#include <array>
#include <cstddef>

#include "lucy/space/columns.hpp"
#include "lucy/spam/fluid.hpp"

namespace lucy::spam {

/// Pointers to `count` columns from `first` on, behind `begin` others.
template <std::size_t size>
void append(std::array<const double*, size>& to, std::size_t begin, const space::Columns& columns, int first,
            int count) {
  for (int c = 0; c < count; ++c) to[begin + static_cast<std::size_t>(c)] = columns[first + c];
}

/// Components of a symmetric tensor.
template <int D>
constexpr int triangle = D*(D + 1) / 2;

/// Newton's law without P_eq: the viscous stress of the particle at slot i, lower triangle by rows.
template <int D>
std::array<double, triangle<D>> viscous_stress(const Transport& transport, const space::Columns& gradients,
                                               std::size_t i) {
  double divergence = 0.0;
  for (int a = 0; a < D; ++a) divergence += gradients[a * D + a][i];
  const double spherical = (transport.bulk_viscosity - 2.0 / D * transport.viscosity) * divergence;
  std::array<double, triangle<D>> stress;
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b <= a; ++b) {
      const double shear = -transport.viscosity * (gradients[a * D + b][i] + gradients[b * D + a][i]);
      stress[a * (a + 1) / 2 + b] = a == b ? shear - spherical : shear;
    }
  }
  return stress;
}

}  // namespace lucy::spam
