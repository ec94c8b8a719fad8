// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A viscous, conducting fluid of smooth particles under homogeneous shear: SLLOD with sliding images, the heat of the
// flow taken out of the internal energies (motion/fluid_trajectory.hpp), one state point, one replica at a time.
//
// The shear stress has three parts (V the volume, p peculiar velocities, m = 1):
//
//     carried      V P_xy = sum_i p_x p_y                                momentum that moving particles carry
//     Newtonian    V P_xy = - eta sum_i (dv_x/dy + dv_y/dx)_i/rho_i      the constitutive law, with the gradients that
//                                                                        the particles measure
//     pressure     V P_xy = sum_{i<j} f_x,ij y_ij - the Newtonian one    the rest of the pairs' share: pressures of an
//                                                                        uneven arrangement, and what the discrete
//                                                                        divergence adds to the viscous stress
//
// A continuum has the Newtonian part alone: its viscosity is the prescribed one. The flow does work, -rate P_xy V. The
// energy equations of the particles make heat of it (`heating`, the mean of de/dt), and the thermostat removes the heat
// chi sum e. In a steady state as much is made as is removed; and of entropy viscosity and conduction make as much as
// leaves with the heat, sum chi e/T, but for what pressures make where neighbours differ much in temperature.
//
// A sheared perfect lattice stays one: no particle is pushed aside, until rounding breaks its symmetry. Hence the start
// is a little disordered. Reduced units m = sigma = epsilon = k = 1; pressures are force per length (D = 2).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/cases/fluid_settings.hpp"
#include "lucy/cases/frame.hpp"
#include "lucy/cases/place_of.hpp"
#include "lucy/motion/fluid_trajectory.hpp"

namespace lucy::cases {

/// One row of shear_flow.csv with every key resolved (names as in the input file, time in reduced units).
struct ShearFlowPoint : FluidSettings {
  ShearFlowPoint() {
    disorder = 0.1;
    step = 0.1;
  }

  // [shear]
  double strain_rate = 0.0;  ///< d u_x / d y
  motion::Cooling cooling = motion::Cooling::isoenergetic;
  // [output]
  double sample_interval = 0.0;  ///< time between samples; 0: the smaller of 1 and a tenth of the duration
  double frame_interval = 0.0;   ///< 0: no frames
};

/// Steps from one sample to the next, at least one. A frame_interval is a multiple of it.
int sample_steps(const ShearFlowPoint& point);

/// Intervals of so many steps in one replica, equilibration included; and those of the equilibration alone.
std::int64_t interval_count(const ShearFlowPoint& point);
std::int64_t equilibration_intervals(const ShearFlowPoint& point);

/// Refuses (BadInput, one sentence naming the key `section.key`, the value and the accepted range) what the fluid
/// refuses (fluid_settings.hpp), and besides a strain rate of zero, a step above 0.2 or one that strains the box by
/// more than a half, and a fluid that the thermostat cannot cool: one whose internal energy is not positive.
void validate(const ShearFlowPoint& point);

/// The seed of one replica's start, made from the point's seed, the replica's number and the state.
std::uint64_t replica_seed(const ShearFlowPoint& point, int replica);

/// What is sampled as the average over the steps of an interval. Energies are per particle, powers per particle and
/// time. kinetic_temperature is K/(N-1) of the peculiar velocities, the noise of the particles: in a continuum it is 0.
inline constexpr std::array<std::string_view, 8> shear_flow_averages = {
    "kinetic_temperature", "internal_energy", "pxy_carried", "pxy_pressure", "pxy_newtonian", "work", "heating",
    "heat_removed"};

/// What is sampled at the end of an interval. temperature: mean over the particles. pressure: P_eq averaged over the
/// volume, sum_i (P/rho)_i/V. velocity_gradient: mean over the particles of dv_x/dy as they measure it (they crowd
/// where it is small if the flow falls into bands). density_wave: amplitude of the density's longest wave across the
/// flow over its mean, |(2/N) sum exp(2 pi i y/L_y)|; of the order of N^(-1/2) when there are no bands. Entropies are
/// per particle and time: made by viscosity, made by conduction (spam/entropy_production.hpp), leaving with the heat.
/// least_entropy_production: that of the single particle that has least.
/// nan: without a meaning (temperature and entropies of the isentropic fluid; gradients without transport).
inline constexpr std::array<std::string_view, 8> shear_flow_instants = {
    "temperature",       "pressure",           "velocity_gradient", "density_wave",
    "entropy_viscosity", "entropy_conduction", "entropy_removed",   "least_entropy_production"};

struct ShearFlowSample {
  std::array<double, shear_flow_averages.size()> averages{};
  std::array<double, shear_flow_instants.size()> instants{};
};

/// Places in these; a wrong name does not compile.
consteval std::size_t shear_flow_average(std::string_view name) { return place_of(shear_flow_averages, name); }
consteval std::size_t shear_flow_instant(std::string_view name) { return place_of(shear_flow_instants, name); }

/// The recorded part of one replica and what was noticed on the way.
struct ShearFlowRecord {
  double sample_interval = 0.0;  ///< time
  std::vector<ShearFlowSample> samples;
  double worst_energy_error = 0.0;  ///< largest |dE|/N of one accepted step (dE minus work and heat)
  double energy_drift = 0.0;        ///< their sum since the start, signed
  std::int64_t steps = 0;           ///< equilibration included
  std::int64_t subdivided_steps = 0;
};

/// One replica of one point: created at its start (or loaded), advanced one sample interval at a time.
/// Between calls the complete state can be saved; a loaded run continues with the same bits.
class ShearFlowRun {
 public:
  /// `threads` share the work inside this system; the result does not depend on their number.
  /// Throws BadInput for what validate() refuses.
  ShearFlowRun(const ShearFlowPoint& point, int replica, int threads = 1);
  ~ShearFlowRun();
  ShearFlowRun(ShearFlowRun&&) noexcept;
  ShearFlowRun& operator=(ShearFlowRun&&) noexcept;

  /// Runs one sample interval (first through the equilibration, then recording). Throws RunFailed naming time and cause
  /// when the step cannot be made small enough, or when a temperature is no longer positive.
  void advance_one_interval();
  std::int64_t intervals_done() const;

  const ShearFlowRecord& record() const;
  const motion::FluidTrajectory<2>& trajectory() const;
  Frame frame() const;
  /// True when advance_one_interval() has just ended on a multiple of frame_interval of recorded time (and at its
  /// start).
  bool frame_due() const;

  void save(ArchiveWriter& archive) const;
  /// Takes a state saved by a run of the same point, replica and build.
  void load(ArchiveReader& archive);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace lucy::cases
