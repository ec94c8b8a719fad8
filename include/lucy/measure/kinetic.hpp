// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sums over the particles' peculiar momenta (m = 1): what temperature, kinetic stress and thermostats need.
//
//     K = sum p^2/2      P^K V = sum p p      kT = K/(N - 1)  in two dimensions, since total momentum is zero
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "lucy/archive.hpp"
#include "lucy/team.hpp"

namespace lucy::measure {

template <int D>
struct KineticSums {
  Eigen::Matrix<double, D, D> momentum_flux = Eigen::Matrix<double, D, D>::Zero();  ///< sum p p
  double force_power = 0.0;                                                         ///< sum F.p
  double largest_square = 0.0;                                                      ///< max p^2

  double kinetic_energy() const { return 0.5 * momentum_flux.trace(); }
  double largest_share() const { return largest_square / momentum_flux.trace(); }

  void save(ArchiveWriter& archive) const {
    for (int a = 0; a < D * D; ++a) archive.put(momentum_flux.data()[a]);
    archive.put(force_power);
    archive.put(largest_square);
  }
  void load(ArchiveReader& archive) {
    for (int a = 0; a < D * D; ++a) momentum_flux.data()[a] = archive.get<double>();
    force_power = archive.get<double>();
    largest_square = archive.get<double>();
  }
};

/// Over all slots (a multiple of eight; empty ones hold zeros). Fixed order of additions for every team.
template <int D>
KineticSums<D> kinetic_sums(const std::array<const double*, D>& momentum, const std::array<const double*, D>& force,
                            std::size_t slots, const Team& team);

/// max_i sum_d column_d[i]^2.
template <int D>
double largest_square(const std::array<const double*, D>& columns, std::size_t slots);

/// The sum of a column over all slots (a multiple of eight), in their order.
double column_sum(const double* column, std::size_t slots);

}  // namespace lucy::measure
