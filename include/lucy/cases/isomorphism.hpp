// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The isomorphism: one initial state, moved on twice, side by side. Once the particles are atoms with the Lucy
// potential, once they are smooth particles of an inviscid isentropic fluid,
//
//     atoms              a_i = - sum_j (epsilon sigma^2/m) grad_i w_ij
//     smooth particles   a_i = - m sum_j [ (P/rho^2)_i + (P/rho^2)_j ] grad_i w_ij      P = (P0/2)(rho/rho0)^2
//
// (Kum, Hoover and Posch, Phys. Rev. E 52, 4899 (1995), Sec. II; W. G. Hoover, Physica A 260, 244 (1998)). The second
// computes densities, pressures and P/rho^2 as it would for any equation of state. With P0/rho0^2 = 1 in reduced units
// both motions are the same, and after every step positions, momenta and forces of all particles are compared with the
// sums over them, not to a tolerance but bit by bit.
//
// What is the same motion is read twice. Every sample holds the kinetic and potential parts of the atoms' pressure
// tensor and their energies, and what the continuum makes of them: Reynolds stress and pressure tensor averaged over
// the volume, and energies with the self term,
//
//     V P_xy(Reynolds) = sum_i m v_x v_y           v_i individual peculiar velocities
//     V P_xy(field)    = sum_i m u_x u_y           the part in the smoothed velocity (measure/smoothed_velocity.hpp)
//     V P_xy(tensor)   = sum_{i<j} x_ij F_y,ij     F_ij the pair forces of the smooth particles
//     V P(fluid)       = sum_i m P_i/rho_i         the equation of state at every particle
//     e_i = P0 rho_i/(2 rho0^2)                    so that sum_i m e_i = Phi + N w(0)/2
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/cases/couette.hpp"
#include "lucy/cases/place_of.hpp"
#include "lucy/motion/settings.hpp"
#include "lucy/motion/start.hpp"
#include "lucy/motion/trajectory.hpp"

namespace lucy::cases {

/// One case with every key resolved (names as in the input file, reduced units).
struct IsomorphismPoint {
  // [system]
  std::int64_t particles = 0;
  double energy_per_particle = 0.0;  ///< (Phi + K)/N of the atoms, no self term
  double density = 1.0;              ///< number density n sigma^2
  int dimension = 2;
  // [isentropic]
  double pressure = 1.0;           ///< P0, a power of two
  double reference_density = 1.0;  ///< rho0, a power of two
  // [kernel]
  std::string kernel = "lucy";
  double range = 3.0;  ///< h
  // [shear]
  double strain_rate = 0.0;                                          ///< d u_x / d y
  motion::Thermostat thermostat = motion::Thermostat::isoenergetic;  ///< of a sheared flow; there is none at rest
  double relaxation_time = 1.0;                                      ///< tau of Nose-Hoover
  // [run]
  motion::Integrator integrator = motion::Integrator::runge_kutta_4;
  double step = 0.05;
  double equilibration = 100.0;  ///< compared as the rest, but not sampled
  double duration = 0.0;         ///< compared and sampled, per replica
  int replicas = 1;
  std::uint64_t seed = 1;
  double energy_tolerance = 1e-5;  ///< |dE|/N of one step above which the step is subdivided
  // [output]
  double sample_interval = 0.0;  ///< time between samples; 0: the smaller of 1 and a tenth of the duration
};

/// The row of a sweep whose atoms move as those of this case do. At rest they have no thermostat: Newton's equations.
CouettePoint sweep_row(const IsomorphismPoint& point);

/// Steps from one sample to the next, at least one.
int sample_steps(const IsomorphismPoint& point);

/// Intervals of so many steps in one replica, equilibration included.
std::int64_t interval_count(const IsomorphismPoint& point);

/// Refuses (BadInput, one sentence naming the key) what validate() refuses of the row of a sweep, and a P0 or rho0 that
/// is no power of two: P/rho^2 would not be the same number at every density.
void validate(const IsomorphismPoint& point);

/// The initial state of one replica, that of the same row of a sweep.
motion::Start<2> isomorphism_start(const IsomorphismPoint& point, int replica);

/// What is compared: D coordinates each of position, momentum and force of every particle; sums over all of them.
inline constexpr std::array<std::string_view, 6> compared_coordinates = {"x", "y", "p_x", "p_y", "F_x", "F_y"};
inline constexpr std::array<std::string_view, 5> compared_sums = {"energy", "friction", "virial_xx", "virial_xy",
                                                                  "virial_yy"};

/// The first numbers that differ in their bits: of the first step with a difference the positions and momenta, particle
/// by particle, then the forces, then the sums.
struct Difference {
  std::int64_t step = 0;       ///< after so many steps; 0: at the start
  double time = 0.0;           ///< of the start: 0
  std::int64_t particle = -1;  ///< from 0; -1: a sum over all of them
  int component = 0;           ///< of compared_coordinates, or of compared_sums
  double atoms = 0.0;          ///< the value of the atoms
  double smooth = 0.0;         ///< and of the smooth particles

  std::string_view component_name() const;
};

/// What is sampled, in this order. Energies are per particle, pressures the mean of P_xx and P_yy; viscosities are
/// -P_xy/rate (nan at rest). "of_field": of the smoothed velocities, a part of the quantity before it.
inline constexpr std::array<std::string_view, 24> isomorphism_quantities = {"atoms_potential_energy",
                                                                            "atoms_kinetic_energy",
                                                                            "atoms_energy",
                                                                            "atoms_pxy_kinetic",
                                                                            "atoms_pxy_potential",
                                                                            "atoms_pressure_kinetic",
                                                                            "atoms_pressure_potential",
                                                                            "atoms_viscosity_kinetic",
                                                                            "atoms_viscosity_potential",
                                                                            "atoms_viscosity",
                                                                            "smooth_internal_energy",
                                                                            "smooth_kinetic_energy",
                                                                            "smooth_kinetic_energy_of_field",
                                                                            "smooth_energy",
                                                                            "smooth_pxy_reynolds",
                                                                            "smooth_pxy_reynolds_of_field",
                                                                            "smooth_pxy_tensor",
                                                                            "smooth_pressure_reynolds",
                                                                            "smooth_pressure_tensor",
                                                                            "smooth_pressure_fluid",
                                                                            "smooth_viscosity_reynolds",
                                                                            "smooth_viscosity_reynolds_of_field",
                                                                            "smooth_viscosity_tensor",
                                                                            "smooth_viscosity"};
using IsomorphismSample = std::array<double, isomorphism_quantities.size()>;

/// Place of a name in `isomorphism_quantities`; a wrong name does not compile.
consteval std::size_t isomorphism_quantity(std::string_view name) { return place_of(isomorphism_quantities, name); }

/// What one replica has found so far.
struct IsomorphismRecord {
  std::int64_t steps = 0;        ///< taken by both readings and compared
  std::int64_t comparisons = 0;  ///< numbers whose bits were compared, those of the start among them
  std::optional<Difference> difference;
  double sample_interval = 0.0;            ///< time between samples
  std::vector<IsomorphismSample> samples;  ///< after the equilibration
  double worst_energy_error = 0.0;         ///< largest |dE|/N of one accepted step before rescaling
  std::int64_t subdivided_steps = 0;
};

/// One replica of one case, both readings of it. Between calls the complete state can be saved; a loaded run continues
/// with the same bits.
class IsomorphismRun {
 public:
  /// Compares the two readings of the start. `threads` share the work inside each reading; the result does not depend
  /// on their number. Throws BadInput for what validate() refuses.
  IsomorphismRun(const IsomorphismPoint& point, int replica, int threads = 1);
  /// With a start for each reading, as a check of the check.
  IsomorphismRun(const IsomorphismPoint& point, const motion::Start<2>& atoms, const motion::Start<2>& smooth,
                 int threads = 1);
  ~IsomorphismRun();
  IsomorphismRun(IsomorphismRun&&) noexcept;
  IsomorphismRun& operator=(IsomorphismRun&&) noexcept;

  /// Moves both readings on from one sample to the next, comparing after every step. Once a difference has been found
  /// nothing moves any more, and intervals are only counted.
  /// Throws RunFailed naming time, cause and step when the step cannot be made small enough.
  void advance_one_interval();
  std::int64_t intervals_done() const;

  const IsomorphismRecord& record() const;
  const motion::Trajectory<2>& atoms() const;
  const motion::Trajectory<2>& smooth() const;

  void save(ArchiveWriter& archive) const;
  /// Takes a state saved by a run of the same case, replica and build.
  void load(ArchiveReader& archive);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace lucy::cases
