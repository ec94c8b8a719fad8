// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rayleigh-Benard convection (convection.hpp) by smooth particles, one state point, one replica at a time. Particles
// start on a square lattice half a spacing from the walls (space/walls.hpp), with the rolls' velocities, at density 1
// and a temperature that falls linearly from floor to ceiling.
//
// The kinetic energy per mass has three values, since particles move about the flow that they make:
//
//     total      mean of v_i^2/2
//     smoothed   mean of u_i^2/2, u the smoothed velocity at the particles (measure/fields.hpp), walls among the
//                neighbours
//     field      of the flow averaged over time: sum |<rho v>|^2/(2 <rho>) over sum <rho>, on a grid
//
// Walls give energy by conduction and by work (spam/wall_exchange.hpp); both together, over what conduction carries
// through the fluid at rest, make the Nusselt numbers. (O. Kum, W. G. Hoover and H. A. Posch, Phys. Rev. E 52, 4899
// (1995), Secs. IV to VI.) Reduced units m = sigma = epsilon = k = 1; D = 2.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/cases/convection.hpp"
#include "lucy/cases/frame.hpp"
#include "lucy/cases/place_of.hpp"
#include "lucy/kernel/weight.hpp"
#include "lucy/measure/fields.hpp"
#include "lucy/motion/fluid_trajectory.hpp"
#include "lucy/space/walls.hpp"
#include "lucy/spam/fluid.hpp"

namespace lucy::cases {

/// One row of benard.csv (names as in the input file).
struct BenardPoint : Convection {
  BenardPoint() { height = 0.0; }  // 0: what makes the density 1

  // [system]
  std::int64_t particles = 0;
  // [cell], besides what Convection has
  space::WallKind wall = space::WallKind::mirror_images;
  // [kernel]
  kernel::WeightName weight = kernel::WeightName::lucy;
  double range = 3.0;  ///< h
  // [fluid]
  double bulk_viscosity = 0.0;
  spam::DensityMean density_mean = spam::DensityMean::geometric;
  // [start]
  double disorder = 0.0;  ///< offsets from the lattice are uniform in +- this many spacings along each axis
  // [run]
  double step = 0.5;
  double equilibration = 0.0;  ///< recorded, but left out of all averages
  double duration = 0.0;       ///< averaged over
  int replicas = 1;
  std::uint64_t seed = 1;
  double energy_tolerance = 1e-4;  ///< |dE|/N of one step above which it is subdivided
  // [output]
  int cells = 30;                ///< of the averaged fields, over the height
  double sample_interval = 0.0;  ///< 0: ten steps
  double frame_interval = 0.0;   ///< 0: no frames
};

/// The point with everything set that may be unset.
BenardPoint resolved(const BenardPoint& point);

/// Refuses (BadInput, one sentence naming the key, the value and what is accepted) what validate(Convection) refuses; a
/// cell whose area is not the number of particles, or that no square lattice fits; one too small for the range; fluids
/// that are no fluids at these temperatures; steps above 1; and intervals that are no whole numbers of steps.
void validate(const BenardPoint& point);

int sample_steps(const BenardPoint& point);
std::int64_t interval_count(const BenardPoint& point);
std::int64_t equilibration_intervals(const BenardPoint& point);

/// Replicas start alike on a perfect lattice.
inline bool all_replicas_alike(const BenardPoint& point) { return point.disorder == 0.0; }
std::uint64_t replica_seed(const BenardPoint& point, int replica);

/// The cells over which fields are averaged, by their centres; nodes[0] along x. The corner of the cell is the origin.
struct FieldCells {
  std::array<int, 2> cells{};
  space::Vector<2> lengths{};

  std::size_t size() const { return static_cast<std::size_t>(cells[0]) * static_cast<std::size_t>(cells[1]); }
  double centre(int axis, int index) const { return (index + 0.5) * lengths[axis] / cells[axis]; }
  /// x0 y0 x1 y1 ..., along x first.
  std::vector<double> points() const;
};
FieldCells field_cells(const BenardPoint& point);

/// What is sampled as the average over the steps of an interval. Kinetic energy per mass; heat and work of the walls
/// per time, into the fluid, over heat_at_rest(): of the floor, the ceiling and the side walls together. stored: what
/// the total energy grew by, in the same unit.
inline constexpr std::array<std::string_view, 8> benard_averages = {
    "kinetic_energy_total", "conduction_hot", "work_hot", "conduction_cold", "work_cold",
    "conduction_sides",     "work_sides",     "stored"};

/// What is sampled at the end of an interval. Energies per particle: internal; total, with that in gravity's field.
/// roll_amplitude: the velocities projected on the pattern of the start. Extremes over the particles.
inline constexpr std::array<std::string_view, 8> benard_instants = {
    "kinetic_energy_smoothed", "internal_energy", "total_energy",      "roll_amplitude",
    "density_least",           "density_largest", "temperature_least", "temperature_largest"};

struct BenardSample {
  std::array<double, benard_averages.size()> averages{};
  std::array<double, benard_instants.size()> instants{};
};

/// Places in these; a wrong name does not compile.
consteval std::size_t benard_average(std::string_view name) { return place_of(benard_averages, name); }
consteval std::size_t benard_instant(std::string_view name) { return place_of(benard_instants, name); }

/// The particles at one moment, by number; vectors as x0 y0 x1 y1 ...; x and y from the corner of the cell.
struct BenardParticles {
  double time = 0.0;
  std::vector<double> position;
  std::vector<double> velocity;
  std::vector<double> velocity_smoothed;
  std::vector<double> density;
  std::vector<double> temperature;
};

/// What one replica recorded.
struct BenardRecord {
  double sample_interval = 0.0;       ///< time
  std::vector<BenardSample> samples;  ///< from the start on, equilibration among them
  /// Sums of moments (measure/fields.hpp) in the cells over the samples of each block of the duration, and how many.
  std::vector<measure::Moments<2>> blocks;
  std::vector<double> block_samples;
  double worst_energy_error = 0.0;
  double energy_drift = 0.0;  ///< what the integrator got wrong since the start, per particle
  std::int64_t steps = 0;
  std::int64_t subdivided_steps = 0;
  std::int64_t reflections = 0;
  std::string failure;  ///< why the run ended early; what was recorded before stays
};

class BenardRun {
 public:
  /// Throws BadInput for what validate() refuses.
  BenardRun(const BenardPoint& point, int replica, int threads);
  ~BenardRun();
  BenardRun(BenardRun&&) noexcept;
  BenardRun& operator=(BenardRun&&) noexcept;

  /// Runs one interval; none after a failure, so that interval_count() is soon reached.
  void advance_one_interval();
  std::int64_t intervals_done() const;
  const BenardRecord& record() const;
  /// At the last sample.
  const BenardParticles& last() const;
  const motion::FluidTrajectory<2>& trajectory() const;

  bool frame_due() const;
  Frame frame() const;

  void save(ArchiveWriter& archive) const;
  void load(ArchiveReader& archive);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace lucy::cases
