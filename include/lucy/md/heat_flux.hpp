// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The heat flux of the atoms at rest as a whole (total momentum zero, no shear), m = 1:
//
//     J V = sum_i (v_i^2/2) v_i + sum_{i<j} [ phi_ij (v_i + v_j)/2 + r_ij (F_ij . (v_i + v_j))/2 ]
//
// (Irving and Kirkwood, J. Chem. Phys. 18, 817 (1950); Hansen and McDonald, Theory of Simple Liquids, Sec. 8.5). Every
// particle carries its kinetic energy and half of each of its pair energies; the last term is the work that pairs
// exchange. With zero total momentum the enthalpy that a flow would carry drops out.
#pragma once

#include <array>

#include "lucy/kernel/lucy.hpp"
#include "lucy/pairs/cluster_list.hpp"
#include "lucy/pairs/traverse.hpp"
#include "lucy/team.hpp"

namespace lucy::md {

/// The pair sum: carries velocities, gives nothing back, totals the convected pair energy and the work, D each.
template <int D>
struct PairHeatFlux {
  static constexpr int carried = D;
  static constexpr int lab_velocity = 0;
  static constexpr int given = 0;
  static constexpr int totals = 2 * D;
  static constexpr pairs::Keeping keeping = pairs::Keeping::nothing;

  kernel::Lucy<D> kernel;

  void operator()(const pairs::Pair<D, D>& pair, std::array<pairs::Lanes, given>&, std::array<pairs::Lanes, given>&,
                  std::array<pairs::Lanes, totals>& sums) const {
    const pairs::Lanes phi = kernel.weight(pair.distance);
    const pairs::Lanes slope = kernel.slope(pair.distance);
    std::array<pairs::Lanes, D> mean_velocity;
    pairs::Lanes along = 0.0;  // r_ij . (v_i + v_j)/2
    for (int d = 0; d < D; ++d) {
      mean_velocity[d] = 0.5 * (pair.of_i[d] + pair.of_j[d]);
      along = pairs::multiply_add(pair.displacement[d], mean_velocity[d], along);
    }
    const pairs::Lanes power = slope * along;
    pairs::unrolled<D>([&](auto d) {
      sums[d] = pairs::multiply_add(phi, mean_velocity[d], sums[d]);
      sums[D + d] = pairs::multiply_add(pair.displacement[d], power, sums[D + d]);
    });
  }
};

/// J V apart: what particles carry as kinetic energy, as potential energy, and what pairs hand on as work.
template <int D>
struct HeatFlux {
  std::array<double, D> kinetic{};
  std::array<double, D> potential{};
  std::array<double, D> work{};

  double total(int d) const { return kinetic[d] + potential[d] + work[d]; }
};

/// Of one configuration: columns of slots as the list arranged them (empty slots hold zero velocities).
template <int D>
HeatFlux<D> heat_flux(const kernel::Lucy<D>& kernel, const pairs::ClusterList<D>& list,
                      const pairs::ImageTable<D>& images, const std::array<const double*, D>& position,
                      const std::array<const double*, D>& velocity, const Team& team);

}  // namespace lucy::md
