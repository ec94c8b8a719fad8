// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One system on its way: particles in a sheared periodic box, moved step by step, with the list of neighbours kept up
// and the energy watched. This is where kernel, box, pairs, equations of motion and integrator meet:
//
//     advance(dt):  list still good for dt? else wrap, sort, list anew
//                   integrate a trial step                        (four pair sums; the last step's last one serves too)
//                   |dE - work - heat|/N above the tolerance?     back, and again in two halves
//                   rescale momenta against the residual error    (Posch, Hoover and Kum, Sec. III)
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/kernel/lucy.hpp"
#include "lucy/md/heat_flux.hpp"
#include "lucy/md/lucy_atoms.hpp"
#include "lucy/measure/kinetic.hpp"
#include "lucy/motion/neighbourhood.hpp"
#include "lucy/motion/settings.hpp"
#include "lucy/motion/sllod.hpp"
#include "lucy/motion/start.hpp"
#include "lucy/motion/subdivision.hpp"
#include "lucy/space/box.hpp"
#include "lucy/spam/isentropic_forces.hpp"

namespace lucy::motion {

template <int D>
class Trajectory {
 public:
  static constexpr int columns = 2 * D;

  /// The isokinetic thermostat scales the start to its target kinetic energy, when one is given.
  /// Throws RunFailed when the box is too small for the range.
  /// `fluid` is what smooth particles are made of; with P0/rho0^2 = 1 they move as the atoms do, to the bit.
  Trajectory(const kernel::Lucy<D>& kernel, const Start<D>& start, const Shear& shear, Integrator integrator,
             const Watch& watch, const Team& team, Reading reading = Reading::md,
             const spam::Isentropic& fluid = spam::Isentropic());

  /// Moves on by `dt`. Throws RunFailed, naming time and cause, when even the smallest substep fails.
  /// `wanted`: what is to be known of the new state. Velocity Verlet goes on without energy and stress: where they are
  /// not wanted they stay unknown (nan), the energy unwatched in that step and the next, and it takes a quarter less
  /// time.
  void advance(double dt, pairs::Wanted wanted = pairs::Wanted::everything);

  /// Sorts the particles and makes the neighbour list anew, for steps of `dt`. The list is no part of what save()
  /// writes: a loaded trajectory goes on with the same bits as the saved one if both renew their list first.
  void renew_list(double dt);

  std::int64_t particles() const { return static_cast<std::int64_t>(near_.particles()); }
  double time() const { return time_; }
  double volume() const { return near_.box().volume(); }
  /// The box as it is now.
  space::Box<D> box() const { return near_.box(); }
  const WatchReport& report() const { return report_; }

  /// Pair sums, kinetic sums and total energy of the present state.
  const pairs::PairTotals<D>& pair_totals() const { return pair_totals_; }
  const measure::KineticSums<D>& kinetic() const { return kinetic_; }
  double energy() const { return pair_totals_.potential_energy + kinetic_.kinetic_energy(); }
  double friction() const { return friction_.zeta; }
  /// Without shear: sum over particles and pairs, see md/heat_flux.hpp. Costs a pass over the pairs.
  md::HeatFlux<D> heat_flux() const;

  /// By particle number, wrapped into the box: x0 y0 x1 y1 ...; peculiar momenta in the same order; forces likewise.
  std::vector<double> positions() const { return near_.wrapped_positions(now_.columns); }
  std::vector<double> momenta() const;
  std::vector<double> forces() const;
  /// The same without an allocation, `values` holding D numbers per particle; positions as they lie in memory, wrapped
  /// when the list was made.
  void copy_positions(std::span<double> values) const { near_.copy_by_particle(now_.columns, 0, values); }
  void copy_momenta(std::span<double> values) const { near_.copy_by_particle(now_.columns, D, values); }
  void copy_forces(std::span<double> values) const { near_.copy_by_particle(force_, 0, values); }
  /// Of smooth particles only: the density at every particle, self term included.
  void copy_densities(std::span<double> values) const { near_.copy_by_particle(density_, 0, values, 1); }

  void save(ArchiveWriter& archive) const;
  /// Takes a state saved by a trajectory of the same settings. Throws RunFailed when it is truncated or of others.
  void load(ArchiveReader& archive);

  // What runge_kutta_4 asks of its system.
  void prepare(const Phase<sllod_numbers>& at, double age);
  void rate(const space::Columns& at, std::size_t begin, std::size_t count, ChunkRates<columns>& k) const {
    sllod_rate<D>(at, force_, shear_.strain_rate, friction_.zeta, begin, count, k);
  }
  std::array<double, sllod_numbers> number_rates() const { return {friction_.zeta_rate, friction_.energy_rate}; }

 private:
  double largest_acceleration() const;
  bool rescales() const;
  double rescaling_target() const;
  void scale_momenta(double factor);
  std::string why_stuck(bool near, double piece) const;
  bool list_lasts(double dt);
  bool try_step(double dt, pairs::Wanted wanted);
  void evaluate(const Phase<sllod_numbers>& at, double age, pairs::Wanted wanted);
  void rescale();

  kernel::Lucy<D> kernel_;
  Shear shear_;
  Integrator integrator_;
  Watch watch_;
  Team team_;
  Reading reading_;
  spam::Isentropic fluid_;
  Neighbourhood<D> near_;

  Phase<sllod_numbers> now_;
  Phase<sllod_numbers> next_;
  space::Columns sum_;       // scratch of the integrator
  space::Columns force_;     // at `now_`, between steps
  pairs::KeptPairs slopes_;  // of one evaluation, from pass to pass
  space::Columns density_;   // of smooth particles only, and their P/rho^2
  space::Columns specific_pressure_;
  double time_ = 0.0;

  int halvings_ = 0;         // of the present step
  double last_error_ = 0.0;  // |dE|/N of the last trial step
  bool spent_ = false;       // the last trial step left no kinetic energy to rescale
  double conserved_ = 0.0;   // E (isoenergetic) or K (isokinetic) at the start

  pairs::PairTotals<D> pair_totals_;
  measure::KineticSums<D> kinetic_;
  SllodFriction friction_;
  WatchReport report_;
};

extern template class Trajectory<2>;
extern template class Trajectory<3>;

}  // namespace lucy::motion
