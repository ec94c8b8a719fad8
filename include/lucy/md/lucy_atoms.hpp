// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Lucy fluid read as atoms: phi(r) = epsilon sigma^2 w(r), in reduced units phi = w
// (Posch, Hoover and Kum, Phys. Rev. E 52, 1711 (1995), Eq. (2)).
//
//     Phi = sum_{i<j} w(r_ij)                                 no self term
//     F_i = sum_j c_ij slope(r_ij) r_ij, c_ij = 1             slope = -(1/r) dw/dr, r_ij = r_i - r_j
//     P^Phi V = sum_{i<j} r_ij F_ij                           potential part of the pressure tensor
//
// The sum itself, and the other reading of it, are in pairs/pair_force.hpp.
#pragma once

#include <array>

#include "lucy/kernel/lucy.hpp"
#include "lucy/pairs/pair_force.hpp"

namespace lucy::md {

/// Overwrites `force` (D columns, slots as the list arranged them) and returns the totals.
template <int D>
pairs::PairTotals<D> lucy_forces(const kernel::Lucy<D>& kernel, const pairs::ClusterList<D>& list,
                                 const pairs::ImageTable<D>& images, const std::array<const double*, D>& position,
                                 const std::array<double*, D>& force, pairs::Wanted wanted, const Team& team);

}  // namespace lucy::md
