// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Homogeneous plane Couette flow of the Lucy fluid (Posch, Hoover and Kum, Phys. Rev. E 52, 1711 (1995), Secs. III-IV):
// SLLOD with sliding images, one state point, one replica at a time.
// Reduced units m = sigma = epsilon = k = 1. Pressures are force per length (D = 2), compression positive.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/cases/frame.hpp"
#include "lucy/motion/settings.hpp"

namespace lucy::cases {

/// One row of a viscosity table with every key resolved (names as in the input file, time in reduced units).
struct CouettePoint {
  // [system]
  std::int64_t particles = 0;
  double energy_per_particle = 0.0;  ///< (Phi + K)/N, no self term
  double density = 1.0;              ///< number density n sigma^2
  int dimension = 2;
  motion::Reading reading = motion::Reading::md;
  std::optional<double> kinetic_temperature;  ///< target kT of isokinetic and Nose-Hoover; default: the start's
  std::string start;                          ///< file of the state to start from; empty: a lattice
  std::optional<double> start_strain_rate;    ///< of the flow in its velocities; default: as the file says, or none
  std::string start_checksum;                 ///< of the state in it; empty: not known yet
  std::shared_ptr<const Frame> start_frame;   ///< what was read from it
  // [kernel]
  std::string kernel = "lucy";
  double range = 3.0;  ///< h
  // [shear]
  double strain_rate = 0.0;  ///< d u_x / d y
  motion::Thermostat thermostat = motion::Thermostat::isoenergetic;
  double relaxation_time = 1.0;  ///< tau of Nose-Hoover
  // [run]
  motion::Integrator integrator = motion::Integrator::runge_kutta_4;
  double step = 0.05;
  double equilibration = 100.0;
  double duration = 0.0;  ///< recorded time per replica
  int replicas = 1;
  std::uint64_t seed = 1;
  std::optional<double> target_relative_error;  ///< of the viscosity
  double maximum_duration = 0.0;                ///< per replica, with target_relative_error; 0: ten times `duration`
  bool rescale = true;                          ///< remove the integrator's residual energy error after each step
  double energy_tolerance = 1e-5;               ///< |dE|/N of one step above which the step is subdivided
  // [output]
  double sample_interval = 0.0;  ///< time over which one recorded value averages; 0: chosen by `sample_steps`
  double frame_interval = 0.0;   ///< 0: no frames
};

/// Steps that one recorded value averages over: the stated `sample_interval`, or else the larger of 0.5 time units and
/// 1/20000 of the duration (never more than a tenth of the duration); at least 1. A frame_interval is a multiple of it.
int sample_steps(const CouettePoint& point);

/// Refuses (BadInput, one sentence naming the key `section.key`, the value and the accepted range) what cannot be run:
/// a box below twice the range, an energy at or below the start lattice's potential energy, a step above 0.2, a
/// particle number without a near-square lattice, velocity Verlet with shear or thermostat, a start from a file that is
/// not of this system (start_state.hpp), and the like.
void validate(const CouettePoint& point);

/// The seed of one replica's start, made from the point's seed, the replica's number and the state point: the same
/// row gives the same bits in whatever table it stands.
std::uint64_t replica_seed(const CouettePoint& point, int replica);

/// What is recorded, in this order, one value per sample interval (averages over all its steps).
/// `largest_kinetic_share` is max_i K_i / K.
inline constexpr std::array<std::string_view, 9> observables = {
    "potential_energy", "kinetic_temperature", "pxy_kinetic",   "pxy_potential",        "pxx_kinetic",
    "pxx_potential",    "pyy_kinetic",         "pyy_potential", "largest_kinetic_share"};
using Sample = std::array<double, observables.size()>;

/// The recorded part of one replica and what was noticed on the way.
struct CouetteRecord {
  double sample_interval = 0.0;   ///< time per sample
  std::vector<Sample> samples;    ///< production only
  double worst_energy_error = 0;  ///< largest |dE|/N of one accepted step before rescaling (dE minus work and heat)
  std::int64_t steps = 0;         ///< accepted steps, equilibration included
  std::int64_t subdivided_steps = 0;
  double energy_rescaled = 0;  ///< sum over steps of the energy per particle that momentum rescaling put back (signed)
};

/// One replica of one point: created at its start (or loaded), advanced one sample at a time.
/// Between calls the complete state can be saved; a loaded run continues with the same bits.
class CouetteRun {
 public:
  /// `threads` share the work inside this system; the result does not depend on their number.
  /// Throws BadInput for what validate() refuses.
  CouetteRun(const CouettePoint& point, int replica, int threads = 1);
  ~CouetteRun();
  CouetteRun(CouetteRun&&) noexcept;
  CouetteRun& operator=(CouetteRun&&) noexcept;

  /// Runs one sample interval (first through the equilibration, then recording).
  /// Throws RunFailed naming time, cause and step when the step cannot be made small enough.
  void advance_one_sample();

  /// Sample intervals done so far and needed for `duration`, both counting the equilibration.
  std::int64_t intervals_done() const;
  std::int64_t intervals_needed(double duration) const;

  const CouetteRecord& record() const;
  Frame frame() const;
  /// True when advance_one_sample() has just ended on a multiple of frame_interval of recorded time (and at its start).
  bool frame_due() const;

  void save(ArchiveWriter& archive) const;
  /// Takes a state saved by a run of the same point, replica and build.
  void load(ArchiveReader& archive);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace lucy::cases
