// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Lucy fluid at equilibrium, watched for its fluctuations (Posch, Hoover and Kum, Phys. Rev. E 52, 1711 (1995),
// Sec. V): one state, one replica at a time. A replica is prepared, equilibrated and recorded:
//
//     preparation     sheared at preparation_rate under the isoenergetic ergostat, a whole number of box lengths: so
//                     nothing is left of the lattice while the energy stays exact
//     equilibration   at rest, Newton's equations
//     duration        the same, recorded: stresses every sample_interval, correlated on the fly in blocks
//
// Reduced units m = sigma = epsilon = k = 1. Pressures are force per length (D = 2), compression positive.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/cases/couette.hpp"
#include "lucy/measure/correlator.hpp"
#include "lucy/measure/periodogram.hpp"
#include "lucy/motion/settings.hpp"

namespace lucy::cases {

enum class CorrelationMethod { fft, multiple_tau };

inline constexpr std::array<std::pair<std::string_view, CorrelationMethod>, 2> correlation_method_names = {
    {{"fft", CorrelationMethod::fft}, {"multiple-tau", CorrelationMethod::multiple_tau}}};

inline constexpr double preparation_rate = 0.5;

/// One state with every key resolved (names as in the input file, time in reduced units).
struct GreenKuboPoint {
  // [system]
  std::int64_t particles = 0;
  double energy_per_particle = 0.0;  ///< (Phi + K)/N, no self term
  double density = 1.0;              ///< number density n sigma^2
  int dimension = 2;
  motion::Reading reading = motion::Reading::md;
  // [kernel]
  std::string kernel = "lucy";
  double range = 3.0;  ///< h
  // [run]
  motion::Integrator integrator = motion::Integrator::velocity_verlet;
  double step = 0.05;
  double preparation = 40.0;     ///< time sheared before the equilibration, rounded to a whole number of box lengths
  double equilibration = 200.0;  ///< at rest, not recorded
  double duration = 0.0;         ///< recorded time per replica
  int replicas = 8;
  std::uint64_t seed = 1;
  double energy_tolerance = 1e-5;  ///< |dE|/N of one RK4 step above which it is subdivided
  double energy_band = 0.001;      ///< |E - E_0|/N above which the run has failed
  // [correlation]
  CorrelationMethod method = CorrelationMethod::fft;
  double length = 0.0;  ///< longest lag; 0: the smaller of 400 and duration/5
  double cutoff = 0.0;  ///< of the integral; 0: by the rule of green_kubo_table.hpp
  bool diffusion = false;
  bool thermal_conductivity = false;
  std::vector<std::string> pairs;  ///< further pairs, two names of sampled_quantities each: "pressure pressure"
  // [output]
  double sample_interval = 0.0;  ///< 0: the most whole steps within 0.2, at least one
  double frame_interval = 0.0;   ///< 0: no frames
  bool series = false;           ///< keep every sample of the stress
};

/// What is sampled, and can be named in `pairs`. Pressures over V; heat fluxes J (over V); `stress_difference` is
/// (P_xx - P_yy)/2; `pressure` is (P_xx + P_yy)/2.
inline constexpr std::array<std::string_view, 13> sampled_quantities = {
    "pxy_kinetic",      "pxy_potential", "pxx_kinetic",       "pxx_potential", "pyy_kinetic",
    "pyy_potential",    "pxy",           "stress_difference", "pressure",      "kinetic_temperature",
    "potential_energy", "heat_flux_x",   "heat_flux_y"};

/// The two quantities that a string of `pairs` names, as places in sampled_quantities. Throws BadInput.
std::array<std::size_t, 2> parse_pair(std::string_view pair);

/// Whether the mean of a sampled quantity is zero by symmetry (stresses off the diagonal, differences, heat fluxes).
bool mean_is_zero(std::size_t quantity);

/// The interval between samples in time units, the longest lag in samples, blocks per replica and samples per block.
double sample_interval(const GreenKuboPoint& point);
std::size_t lag_count(const GreenKuboPoint& point);
std::int64_t block_count(const GreenKuboPoint& point);
std::int64_t block_samples(const GreenKuboPoint& point);

/// Steps of one interval of a run, and intervals of a whole run (preparation and equilibration included).
std::int64_t interval_steps(const GreenKuboPoint& point);
std::int64_t interval_count(const GreenKuboPoint& point);

/// Refuses (BadInput, one sentence naming the key `section.key`, the value and the accepted range) what cannot be run
/// or is unsound: besides what a Couette point refuses, a sampling interval longer than the stress remembers (the time
/// in which a thermal particle crosses a quarter of the range), a length or a cutoff beyond the duration, unknown
/// pairs.
void validate(const GreenKuboPoint& point);

/// The seed of one replica's start, made from the point's seed, the replica's number and the state.
std::uint64_t replica_seed(const GreenKuboPoint& point, int replica);

/// The correlations of the stress in a block, of pressures as sampled (no factor V/kT): autocorrelations of P_xy and of
/// (P_xx - P_yy)/2, whole and of their kinetic and potential parts; and P_xy with (P_xx - P_yy)/2 in either order,
/// which isotropy makes zero: a sample of pure noise, as wide as that of the mean of both autocorrelations.
enum StressCorrelation : std::size_t {
  xy,
  xy_kinetic,
  xy_potential,
  difference,
  difference_kinetic,
  difference_potential,
  pure_noise
};
inline constexpr std::size_t stress_correlations = 7;

/// A stretch of one replica, correlated apart from all others: what errors are made from.
struct CorrelationBlock {
  std::int64_t samples = 0;
  std::array<measure::Correlation, stress_correlations> stress;  ///< parts are empty when only totals are known
  measure::Spectrum spectrum;                                    ///< mean of those of P_xy and (P_xx - P_yy)/2
  std::vector<measure::Correlation> others;  ///< <v(0) . v(t)>/2 if asked for, then heat flux x and y (summed over
                                             ///< both, halved), then `pairs`: products, with the means of their factors
};

/// The state at the end of an interval.
inline constexpr std::array<std::string_view, 4> equilibrium_observables = {"kinetic_temperature", "pressure_kinetic",
                                                                            "pressure_potential", "potential_energy"};
using EquilibriumSample = std::array<double, equilibrium_observables.size()>;

/// The stress as sampled, if the series is kept.
using StressSample = std::array<double, 6>;  ///< the first six of sampled_quantities

struct GreenKuboRecord {
  double sample_interval = 0.0;            ///< time between stress samples
  double interval = 0.0;                   ///< time between EquilibriumSamples
  std::vector<EquilibriumSample> samples;  ///< production only
  std::vector<CorrelationBlock> blocks;    ///< those that are complete
  double energy_drift = 0.0;               ///< change of E/N from the first interval recorded to the last
  double largest_energy_error = 0.0;       ///< largest |E/N - energy_per_particle| at the end of any interval
  std::int64_t steps = 0;                  ///< all of them
  std::int64_t subdivided_steps = 0;
};

/// One replica of one state: created at its start (or loaded), advanced one interval at a time. Between calls the
/// complete state can be saved; a loaded run continues with the same bits.
class GreenKuboRun {
 public:
  /// `threads` share the work inside this system; the result does not depend on their number. Throws BadInput for what
  /// validate() refuses.
  GreenKuboRun(const GreenKuboPoint& point, int replica, int threads = 1);
  ~GreenKuboRun();
  GreenKuboRun(GreenKuboRun&&) noexcept;
  GreenKuboRun& operator=(GreenKuboRun&&) noexcept;

  /// Runs one interval (first through preparation and equilibration, then recording). Throws RunFailed.
  void advance_one_interval();
  std::int64_t intervals_done() const;
  std::int64_t intervals_needed() const;

  const GreenKuboRecord& record() const;
  /// Every stress that was sampled, in order of time; empty unless the point asks for it.
  const std::vector<StressSample>& series() const;
  /// Steps at rest that had been run when the recording began.
  std::int64_t first_recorded_step() const;
  Frame frame() const;
  bool frame_due() const;

  void save(ArchiveWriter& archive) const;
  void load(ArchiveReader& archive);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

/// The blocks of a series that was sampled elsewhere: stresses P_xy and (P_xx - P_yy)/2 at equal intervals, of equal
/// length. Kinetic and potential parts stay empty.
std::vector<CorrelationBlock> correlate_series(std::span<const double> pxy, std::span<const double> stress_difference,
                                               std::size_t lags, std::int64_t blocks);

}  // namespace lucy::cases
