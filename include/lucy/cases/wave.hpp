// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A wave that decays in a periodic box: what transport a fluid of particles has, and where it comes from. One point,
// one replica at a time: smooth particles, or the Lucy fluid's atoms at equilibrium. After the equilibration a sine is
// superposed, k = 2 pi mode/L_y,
//
//     shear wave          v_x,i += A sin(k y_i)           of no net momentum
//     temperature wave    T_i *= 1 + A sin(k y_i)         the density stays, so a sound wave starts too
//
// and then followed by its amplitude, for q_i the individual velocity v_x or the entropy s(rho, e) per mass (which a
// sound wave leaves alone) less its mean over the particles (what all have alike would make a wave of every sound),
//
//     a = (2/N) sum_i q_i sin(k y_i)
//
// The particles move, and what they carry changes. The amplitude's rate is exactly the sum of three parts:
//
//     shear          da/dt = (2/N) sum F_visc,x sin(k y)    the discrete viscous operator
//                          + (2/N) sum F_eq,x sin(k y)      pressure forces: how the arrangement resists and yields
//                          + (2/N) k sum v_x v_y cos(k y)   momentum carried by moving particles
//
//     temperature    da/dt = (2/N) sum e'_cond/T sin(k y)   the discrete operator of conduction
//                          + (2/N) sum s'_rest sin(k y)     viscous heating, and compression that is not adiabatic
//                          + (2/N) k sum s v_y cos(k y)     entropy carried by moving particles
//
// with F_eq the acceleration of the same state without transport, e'_cond what conduction adds to de/dt, and rho' the
// rate of the particle's own density in T s' = e' - (P/rho^2) rho' (of entropies and their rates the means are taken
// off). In a continuum a' = -nu k^2 a with nu = eta/rho, or D_T = kappa/(rho c_P) once the sound has died; each part in
// units of -k^2 a is its contribution to nu or D_T. Reduced units.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/cases/fluid_settings.hpp"
#include "lucy/cases/frame.hpp"
#include "lucy/motion/settings.hpp"

namespace lucy::cases {

enum class WaveQuantity { shear, temperature };

/// One point with every key resolved (names as in the input file, time in reduced units).
struct WavePoint : FluidSettings {
  WavePoint() { replicas = 8; }

  WaveQuantity quantity = WaveQuantity::shear;  ///< no key: the command's
  // [system]
  motion::Reading reading = motion::Reading::spam;
  std::optional<double> energy_per_particle;  ///< of atoms: (Phi + K)/N before the wave, no self term
  // [wave]
  double amplitude = 0.05;  ///< A
  int mode = 1;             ///< wavelengths in L_y
  // [output]
  double sample_interval = 0.0;  ///< 0: the most whole steps within 2 and duration/200, at least one
  double frame_interval = 0.0;   ///< 0: no frames
};

/// A run in steps, samples and intervals; an interval of the equilibration holds as many steps as one of the recording,
/// and the last one of each may be shorter.
struct WaveSchedule {
  std::int64_t equilibration_steps = 0;
  std::int64_t steps_per_sample = 1;
  std::int64_t samples_per_interval = 1;
  std::int64_t samples = 0;  ///< after the one at the start of the wave

  std::int64_t equilibration_intervals() const;
  std::int64_t intervals() const;  ///< of all
  std::int64_t steps_per_interval() const { return steps_per_sample * samples_per_interval; }
  double sample_interval(const WavePoint& point) const { return static_cast<double>(steps_per_sample) * point.step; }
};
WaveSchedule wave_schedule(const WavePoint& point);

/// k = 2 pi mode/L_y, L_y the shorter side of the box.
double wave_vector(const WavePoint& point);

/// What the constitutive law says: eta/rho, or kappa/(rho c_P) at the stated density and temperature; nan for atoms.
double prescribed_diffusivity(const WavePoint& point);

/// Refuses (BadInput, one sentence naming the key `section.key`, the value and the accepted range) what cannot be run:
/// besides what the fluid or a state of atoms refuses, a step above 0.5 (atoms: 0.2), keys of fluids for atoms and of
/// atoms for fluids, a wavelength below twice the range, a temperature wave without an entropy or of A at least 1.
void validate(const WavePoint& point);

/// The seed of one replica's start, made from the point's seed, the replica's number and the physical settings.
std::uint64_t replica_seed(const WavePoint& point, int replica);

/// Parts of da/dt, in this order.
inline constexpr std::size_t wave_parts = 3;
enum WavePart : std::size_t { part_operator, part_rest, part_carried };

struct WaveSample {
  double amplitude = 0.0;                  ///< a
  std::array<double, wave_parts> parts{};  ///< of da/dt, of this instant
  double particle_noise = 0.0;  ///< kinetic energy per particle beyond that of the wave (the shear wave's a^2/4; of a
                                ///< temperature wave's sound, the same of v_y along the cosine)
  double pressure = 0.0;        ///< mean over the volume, that of the noise included
};

struct WaveRecord {
  double sample_interval = 0.0;     ///< time
  double imposed_amplitude = 0.0;   ///< by how much superposing the wave changed a
  std::vector<WaveSample> samples;  ///< the first just after that
  double worst_energy_error = 0.0;  ///< largest |dE|/N of one step
  std::int64_t steps = 0;           ///< all of them
  std::int64_t subdivided_steps = 0;
};

/// One replica of one point: created at its start (or loaded), advanced one interval at a time. Between calls the
/// complete state can be saved; a loaded run continues with the same bits.
class WaveRun {
 public:
  /// `threads` share the work inside this system; the result does not depend on their number. Throws BadInput for what
  /// validate() refuses.
  WaveRun(const WavePoint& point, int replica, int threads = 1);
  ~WaveRun();
  WaveRun(WaveRun&&) noexcept;
  WaveRun& operator=(WaveRun&&) noexcept;

  /// Runs one interval (first through the equilibration, then recording). Throws RunFailed.
  void advance_one_interval();
  std::int64_t intervals_done() const;
  std::int64_t intervals_needed() const;

  const WaveRecord& record() const;
  Frame frame() const;
  /// True when an interval has just ended on a multiple of frame_interval of recorded time.
  bool frame_due() const;

  void save(ArchiveWriter& archive) const;
  /// Takes a state saved by a run of the same point, replica and build.
  void load(ArchiveReader& archive);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace lucy::cases
