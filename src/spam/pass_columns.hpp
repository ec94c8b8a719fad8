// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the three passes and what lies between them have in common.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "lucy/space/triangle.hpp"
#include "lucy/spam/fluid.hpp"
#include "lucy/team.hpp"

namespace lucy::spam {

using space::in_triangle, space::triangle;

/// Newton's law without P_eq: the viscous stress from the rate of deformation as GradientSum gives it, both lower
/// triangles by rows. T is double or Lanes.
template <int D, class T>
std::array<T, triangle<D>> viscous_stress(const Transport& transport, const std::array<T, triangle<D>>& deformation) {
  T divergence = 0.0;
  for (int a = 0; a < D; ++a) divergence += deformation[in_triangle(a, a)];
  const T spherical = (transport.bulk_viscosity - 2.0 / D * transport.viscosity) * divergence;
  std::array<T, triangle<D>> stress;
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < a; ++b) stress[in_triangle(a, b)] = -transport.viscosity * deformation[in_triangle(a, b)];
    stress[in_triangle(a, a)] = -2.0 * transport.viscosity * deformation[in_triangle(a, a)] - spherical;
  }
  return stress;
}

/// What a particle of this density carries for the rho_ij of gradients. T is double or Lanes.
template <class T>
T mean_factor(DensityMean mean, const T& density) {
  using std::sqrt;
  return mean == DensityMean::geometric ? 1.0 / sqrt(density) : density;
}

/// work(cluster) for every cluster, shared in chunks.
template <class Work>
void for_clusters(std::size_t clusters, const Team& team, const Work& work) {
  constexpr std::size_t chunk = 64;
  team.share(static_cast<std::ptrdiff_t>((clusters + chunk - 1) / chunk), [&](std::ptrdiff_t part) {
    const std::size_t begin = static_cast<std::size_t>(part) * chunk;
    const std::size_t end = std::min(begin + chunk, clusters);
    for (std::size_t cluster = begin; cluster < end; ++cluster) work(cluster);
  });
}

}  // namespace lucy::spam
