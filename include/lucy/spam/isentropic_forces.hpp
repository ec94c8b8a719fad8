// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The inviscid isentropic fluid as smooth particles, by the general path in two passes over the pairs:
//
//     rho_i = m sum_j w(r_ij)                         self term included (density.hpp)
//     P_i = P(rho_i), then (P/rho^2)_i                a division, never a reciprocal or a power
//     dv_i/dt = - m sum_j [ (P/rho^2)_i + (P/rho^2)_j ] grad_i w(r_ij)
//
// (Kum, Hoover and Posch, Phys. Rev. E 52, 4899 (1995), Eq. (5) with scalar pressures). What the second pass totals is
// the same as for atoms: the sum of w over pairs, which is the internal energy sum_i m e_i less its self terms when e =
// rho/2, and the virial, which is V times the volume-averaged pressure tensor.
#pragma once

#include <array>

#include "lucy/kernel/lucy.hpp"
#include "lucy/pairs/pair_force.hpp"
#include "lucy/spam/equation_of_state.hpp"

namespace lucy::spam {

/// Overwrites `force` (D columns), `density`, `specific_pressure` (P/rho^2) and `slopes`; slots as the list arranged
/// them.
template <int D>
pairs::PairTotals<D> isentropic_forces(const kernel::Lucy<D>& kernel, const Isentropic& state,
                                       const pairs::ClusterList<D>& list, const pairs::ImageTable<D>& images,
                                       const std::array<const double*, D>& position,
                                       const std::array<double*, D>& force, double* density, double* specific_pressure,
                                       pairs::KeptPairs& slopes, pairs::Wanted wanted, const Team& team);

}  // namespace lucy::spam
