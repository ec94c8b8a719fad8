// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A fluid of smooth particles on its way through a periodic box, sheared or not, by classic RK4 (m = 1):
//
//     x' = p_x + rate y    y' = p_y         p: velocity relative to the mean flow u_x = rate y
//     p_x' = F_x - rate p_y    p_y' = F_y   F: the acceleration of spam/smooth_particles.hpp, gravity included
//     e' = (e' of the fluid) - chi e        chi: the thermostat's cooling rate
//
// These are SLLOD's equations (motion/sllod.hpp) with the heat taken from where viscosity puts it. The total energy
// U = sum p^2/2 + sum e changes by the work of flow and gravity and by the heat taken out,
//
//     dU/dt = -rate P_xy V + sum g.p - chi sum e            P_xy V = sum p_x p_y + sum_{i<j} f_x,ij y_ij
//
// (the work of gravity is that on the peculiar motion; a periodic box has no bottom, so the fluid falls).
//     Cooling::none           chi = 0: the flow heats up
//     Cooling::isoenergetic   chi = -rate P_xy V / sum e: U is constant. Every particle gives up the same share of its
//                             internal energy per time, as under a Gaussian thermostat it does of its kinetic energy;
//                             no momentum is touched. Where e is proportional to T, in the ideal gas, this makes no
//                             temperature gradient; a van der Waals fluid (e = T - a rho) cools less where it is dense,
//                             and for the dense fluid it depends on where its e is zero.
// Between walls (space/walls.hpp) there is no shear and no thermostat: dU/dt is the sum over the particles of their
// power, p.F + e', by which walls and gravity give what they give. A particle that a step carries across a wall is
// reflected. Positions are those in the cell, from its lowest corner.
//
// The integral of dU/dt is carried along, so that the integrator's own error can be told from it and watched.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/measure/kinetic.hpp"
#include "lucy/motion/neighbourhood.hpp"
#include "lucy/motion/runge_kutta.hpp"
#include "lucy/motion/subdivision.hpp"
#include "lucy/motion/wall_particles.hpp"
#include "lucy/spam/smooth_particles.hpp"
#include "lucy/team.hpp"

namespace lucy::motion {

/// Where a fluid starts, by particle number.
template <int D>
struct FluidStart {
  space::Vector<D> lengths{};
  std::vector<space::Vector<D>> position;
  std::vector<space::Vector<D>> velocity;  ///< relative to the mean flow
  std::vector<double> energy;              ///< internal, per mass
  space::Walls<D> walls{};                 ///< none: periodic
};

/// Places that take part in a fluid's fields, x0 y0 x1 y1 ... in the box around its cell (space/walls.hpp).
template <int D>
struct FieldPlaces {
  space::Box<D> box;
  std::vector<double> position;  ///< of the particles, by number, then of those that stand for walls
  std::vector<double> velocity;
  std::vector<double> energy;  ///< internal, per mass; at walls that of the wall's temperature
};

enum class Cooling { none, isoenergetic };
inline constexpr std::array<std::pair<std::string_view, Cooling>, 2> cooling_names = {{
    {"none", Cooling::none},
    {"isoenergetic", Cooling::isoenergetic},
}};

template <int D>
class FluidTrajectory {
 public:
  static constexpr int columns = 2 * D + 1;
  enum Number : std::size_t { energy_input = 0 };
  static constexpr std::size_t numbers = 1;

  /// Throws BadInput for a fluid that validate() refuses, for isoenergetic cooling of one without internal energy, for
  /// shear or cooling between walls, and for a cell between walls that is too narrow; RunFailed when the box is too
  /// small for the range, or for a start that advance() would refuse.
  FluidTrajectory(const spam::Fluid<D>& fluid, const FluidStart<D>& start, double strain_rate, Cooling cooling,
                  const Watch& watch, const Team& team);

  /// Moves on by `dt`. Throws RunFailed, naming time, cause and particle, when even the smallest substep fails or a
  /// temperature is no longer positive, or a density beyond what the equation of state describes.
  void advance(double dt);

  /// As Trajectory::renew_list(): a loaded trajectory goes on with the same bits as the saved one if both renew first.
  void renew_list(double dt);

  std::int64_t particles() const { return static_cast<std::int64_t>(near_.particles()); }
  double time() const { return time_; }
  double volume() const { return space::Box<D>(cell().lengths()).volume(); }
  const space::Cell<D>& cell() const { return walls_.cell(); }
  /// Periodic fluids: the box. Between walls there is room behind them.
  space::Box<D> box() const { return near_.box(); }
  const WatchReport& report() const { return report_; }

  /// Of the present state. The fluid's columns are by slot.
  const spam::SmoothParticles<D>& fluid() const { return fluid_; }
  const measure::KineticSums<D>& kinetic() const { return kinetic_; }
  double internal_energy() const { return internal_energy_; }  ///< sum of e
  double energy() const { return kinetic_.kinetic_energy() + internal_energy_; }
  double cooling_rate() const { return chi_; }
  /// dE - work - heat since the start, per particle: what the integrator got wrong.
  double energy_drift() const;
  /// See SmoothParticles::viscous_stress_xy.
  double viscous_stress_xy() const { return fluid_.viscous_stress_xy(near_.slots(), walls_.particles()); }
  /// See SmoothParticles::entropy_production; by particle number, two each.
  std::vector<double> entropy_production() const;

  /// What walls have given since the start, energies by wall number: the trapezoidal rule over every step, from its
  /// beginning to its end before reflections. (The power jumps where a particle is turned round.) Work has what gravity
  /// asks for when a particle is put back to its side of a wall.
  const std::array<spam::WallExchange, 2 * D>& given_by_walls() const { return given_by_walls_; }
  /// What they give now, per time.
  const std::array<spam::WallExchange, 2 * D>& power_of_walls() const { return power_of_walls_; }
  /// How often a particle crossed a wall and was reflected, since the start.
  std::int64_t reflections() const { return reflections_; }
  /// The particles and those that stand for walls.
  FieldPlaces<D> field_places() const;

  /// By particle number; vectors as x0 y0 x1 y1 ...; positions wrapped into the cell.
  std::vector<double> positions() const;
  std::vector<double> velocities() const { return by_particle(now_.columns, D, D); }  ///< peculiar
  std::vector<double> energies() const { return by_particle(now_.columns, 2 * D, 1); }
  std::vector<double> densities() const { return by_particle(fluid_.density(), 0, 1); }
  std::vector<double> temperatures() const { return by_particle(fluid_.temperature(), 0, 1); }
  std::vector<double> pressures() const { return by_particle(fluid_.pressure(), 0, 1); }
  std::vector<double> accelerations() const { return by_particle(fluid_.acceleration(), 0, D); }
  std::vector<double> energy_rates() const { return by_particle(fluid_.energy_rate(), 0, 1); }
  /// dv/dt (D numbers) and de/dt as they would be now were the particles of this fluid, whose weight must not reach
  /// farther: what transport adds to a rate is that of the fluid less that of the same fluid without it.
  std::vector<double> rates_of(const spam::Fluid<D>& fluid) const;
  /// d v_a/d x_b, D D each, then d T/d x_b, D each, by a pass over the pairs. Empty without transport.
  std::vector<double> gradients() const;

  void save(ArchiveWriter& archive) const;
  /// Takes a state saved by a trajectory of the same settings. Throws RunFailed when it is truncated or of others.
  void load(ArchiveReader& archive);

  // What runge_kutta_4 asks of its system.
  void prepare(Phase<numbers>& at, double age);
  void rate(const space::Columns& at, std::size_t begin, std::size_t count, ChunkRates<columns>& k) const;
  std::array<double, numbers> number_rates() const { return {energy_rate_}; }

 private:
  std::vector<double> by_particle(const space::Columns& columns, int first, int count) const;
  spam::Particles<D> particles_at(const space::Columns& at, const pairs::ImageTable<D>& images) const;
  double largest_acceleration() const;
  bool list_lasts(double dt);
  bool try_step(double dt);
  void find_power_of_walls();
  void count_what_walls_gave(double dt);
  void reflect_at_walls(double dt);
  void refuse_impossible_particles() const;
  std::string why_stuck(bool near, double piece) const;

  double strain_rate_;
  Cooling cooling_;
  Watch watch_;
  Team team_;
  WallParticles<D> walls_;
  Neighbourhood<D> near_;
  spam::SmoothParticles<D> fluid_;
  Phase<numbers> now_;
  Phase<numbers> next_;
  space::Columns sum_;  // scratch of the integrator
  double time_ = 0.0;
  double start_energy_ = 0.0;

  int halvings_ = 0;         // of the present step
  double last_error_ = 0.0;  // |dE|/N of the last trial step
  measure::KineticSums<D> kinetic_;
  double internal_energy_ = 0.0;
  double chi_ = 0.0;
  double energy_rate_ = 0.0;
  std::array<spam::WallExchange, 2 * D> power_of_walls_{};
  std::array<spam::WallExchange, 2 * D> given_by_walls_{};
  std::int64_t reflections_ = 0;
  WatchReport report_;
};

extern template class FluidTrajectory<1>;
extern template class FluidTrajectory<2>;
extern template class FluidTrajectory<3>;

}  // namespace lucy::motion
