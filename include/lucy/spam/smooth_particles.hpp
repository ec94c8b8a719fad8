// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rates of a fluid of smooth particles, in three passes of the one pair loop:
//
//     1  density.hpp      rho;            then P_eq(rho, e), T(rho, e) particle by particle
//     2  gradients.hpp    grad v + grad v^T, grad T; then P/rho^2 and Q/rho^2 from the transport laws (fluid.hpp)
//     3  rates.hpp        dv/dt, de/dt
//
// A fluid without viscosity and conduction leaves out the second.
#pragma once

#include <cstdint>
#include <span>

#include "lucy/pairs/cluster_list.hpp"
#include "lucy/pairs/pair_force.hpp"
#include "lucy/space/columns.hpp"
#include "lucy/spam/fluid.hpp"
#include "lucy/spam/wall_exchange.hpp"
#include "lucy/team.hpp"

namespace lucy::spam {

/// A slot that stands for a wall: its velocity is in the column of velocities, its temperature here. It acts on others
/// and is acted on by nobody. An image has density, pressure tensor and heat flux of its parent, unmirrored; a boundary
/// particle its own.
struct WallParticle {
  static constexpr std::uint32_t no_parent = 0xffffffffU;

  std::uint32_t slot = 0;
  std::uint32_t parent = no_parent;  ///< the slot whose mirror image this is
  int wall = 0;                      ///< its number (space/walls.hpp)
  double temperature = 0.0;

  bool has_parent() const { return parent != no_parent; }
};

/// Where the particles are, slots as a list arranged them. Velocities are peculiar: relative to u_x = strain_rate y.
template <int D>
struct Particles {
  const pairs::ClusterList<D>& list;
  const pairs::ImageTable<D>& images;
  std::span<const std::int32_t> number;  ///< pairs::nobody where a slot is empty
  std::array<const double*, D> position;
  std::array<const double*, D> velocity;
  const double* energy;  ///< internal, per mass
  double strain_rate = 0.0;
  std::span<const WallParticle> walls{};
};

/// The working columns of the passes, and what they leave there.
template <int D>
class SmoothParticles {
 public:
  /// `slots`: ClusterList::capacity(). Throws BadInput for what Fluid::validate() refuses.
  SmoothParticles(const Fluid<D>& fluid, std::size_t slots);

  const Fluid<D>& fluid() const { return fluid_; }

  /// The rates; every column below is overwritten. The same bits for every team.
  void evaluate(const Particles<D>& particles, const Team& team);

  /// Left by evaluate(): one value per slot, zero in empty ones where it matters.
  const space::Columns& acceleration() const { return acceleration_; }  ///< D columns, gravity included
  const space::Columns& energy_rate() const { return energy_rate_; }
  const space::Columns& density() const { return density_; }
  const space::Columns& temperature() const { return temperature_; }
  const space::Columns& pressure() const { return pressure_; }  ///< P_eq
  /// The rate of deformation, lower triangle by rows (d v_a/d x_a on the diagonal, d v_a/d x_b + d v_b/d x_a below it),
  /// then d T/d x_b. Without transport these are not computed: no columns.
  const space::Columns& deformation() const { return deformation_; }
  /// sum_{i<j} f_x,ij y_ij: V times the xy component of the pairs' share of the pressure tensor. Without a meaning
  /// between walls, whose particles are counted.
  double virial_xy() const { return virial_xy_; }
  /// What the walls give, see wall_exchange.hpp, by wall number; of the state that was just evaluated, with the list it
  /// was evaluated with.
  std::array<WallExchange, 2 * D> wall_exchange(const Particles<D>& particles, const Team& team);
  /// V times the average over the volume of the Newtonian stress -eta (dv_x/dy + dv_y/dx): sum_i m (P_xy/rho)_i.
  double viscous_stress_xy(std::size_t slots, std::span<const WallParticle> walls = {}) const;

  /// The columns that the list's upkeep sorts along, so that what evaluate() left stays with its particles.
  std::array<space::Columns*, 6> columns_to_sort() {
    return {&density_, &temperature_, &pressure_, &deformation_, &acceleration_, &energy_rate_};
  }
  /// Gives new images of walls what evaluate() would have left with them.
  void renew_walls(std::span<const WallParticle> walls);
  /// What those hold, and the sums.
  void save(ArchiveWriter& archive, std::size_t slots) const;
  void load(ArchiveReader& archive, std::size_t slots);

  /// The whole gradients at the state last evaluated: d v_a/d x_b in column a D + b, then d T/d x_b. A pass of its own.
  space::Columns gradients(const Particles<D>& particles, const Team& team) const;

  /// Entropy production by viscosity and by conduction, per particle, of the state last evaluated: sums over pairs,
  ///     viscosity    -(1/2) f_visc,ij . (v_i - v_j) / T          to each, with its own T
  ///     conduction   (heat from j to i) (1/T_i - 1/T_j) / 2      to each
  /// Their totals are sum_i (de_i/dt)/T_i of the two terms. Two columns; needs a fluid with temperature.
  space::Columns entropy_production(const Particles<D>& particles, const Team& team) const;

 private:
  void apply_equation_of_state(const Particles<D>& particles, const Team& team);
  void find_deformation(const Particles<D>& particles, const Team& team);
  void apply_transport(const Particles<D>& particles, const Team& team);
  void find_rates(const Particles<D>& particles, const Team& team);

  Fluid<D> fluid_;
  pairs::KeptPairs slopes_;  // of the first pass, for the others
  space::Columns density_;
  space::Columns temperature_;
  space::Columns pressure_;
  space::Columns mean_factor_;  // rho^(-1/2) or rho: what the gradients carry
  space::Columns deformation_;
  space::Columns stress_;  // P/rho^2, one column or the lower triangle; then Q/rho^2
  space::Columns wall_;    // of wall_exchange()
  space::Columns acceleration_;
  space::Columns energy_rate_;
  double virial_xy_ = 0.0;
};

extern template class SmoothParticles<1>;
extern template class SmoothParticles<2>;
extern template class SmoothParticles<3>;

}  // namespace lucy::spam
