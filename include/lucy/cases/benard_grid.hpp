// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rayleigh-Benard convection of the continuum (grid/flow.hpp): one fluid, one Rayleigh number, one mesh. Either the
// rolls run until they are steady, or small ones grow or decay and their rate is found.
//
//     Ra = g alpha L^3 (T_hot - T_cold)/(nu kappa)     nu = eta/rho, kappa = k/(rho C_V), rho = 1
//
// (O. Kum, W. G. Hoover and H. A. Posch, Phys. Rev. E 52, 4899 (1995), Sec. IV.) With the gravity that keeps the fluid
// at rest uniform, g L = f (T_hot - T_cold), this makes eta k = c L^2 (T_hot - T_cold)^2/Ra:
//
//                        f      c           alpha C_V = c/f
//     ideal gas          1      1           1
//     van der Waals      2      4/3         2/3
//     dense fluid        3.75   1.26        0.336
//
// In a gas so defined heat is carried at constant pressure while kappa has C_V, and the fluid at rest is stabilised by
// its compressibility: both factors cancel, so that rolls set in at the Ra of an incompressible fluid, 1707.8, when the
// difference of temperatures is small. Times are compared with the diffusion time tau = L^2/nu.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/grid/flow.hpp"
#include "lucy/spam/equation_of_state.hpp"

namespace lucy::cases {

/// Those with a temperature.
inline constexpr std::array<std::pair<std::string_view, spam::EquationOfStateName>, 3> benard_fluid_names = {{
    {"ideal-gas", spam::EquationOfStateName::ideal_gas},
    {"van-der-waals", spam::EquationOfStateName::van_der_waals},
    {"dense-fluid", spam::EquationOfStateName::dense_fluid},
}};

enum class BenardGoal { steady_state, growth_rate };
inline constexpr std::array<std::pair<std::string_view, BenardGoal>, 2> benard_goal_names = {
    {{"steady-state", BenardGoal::steady_state}, {"growth-rate", BenardGoal::growth_rate}}};

/// One row of benard_grid.csv (names as in the input file).
struct BenardGridPoint {
  // What the scheduler asks of every point: a continuum is one system, and has nothing random.
  static constexpr std::int64_t particles = 1;
  static constexpr int replicas = 1;
  static constexpr std::uint64_t seed = 0;

  // [cell]
  double height = 50.0;
  std::optional<double> width;  ///< unset: twice the height between periodic sides, the height between walls
  grid::Sides sides = grid::Sides::periodic;
  double hot = 1.5;
  double cold = 0.5;
  std::optional<double> gravity;  ///< unset: what keeps the fluid at rest uniform
  // [fluid]
  spam::EquationOfStateName equation_of_state = spam::EquationOfStateName::ideal_gas;
  std::optional<double> rayleigh;   ///< with eta = k; or else:
  std::optional<double> viscosity;  ///< eta, or eta/rho
  std::optional<double> conductivity;
  grid::Transport transport = grid::Transport::dynamic;
  // [start]
  std::optional<double>
      roll_velocity;  ///< unset: 0.085 (T_hot - T_cold), a hundred-thousandth of that for growth rates
  // [grid]
  int cells = 0;  ///< over the height
  // [run]
  BenardGoal find = BenardGoal::steady_state;
  std::optional<double> step;      ///< unset: seven tenths of the longest stable one
  std::optional<double> duration;  ///< at most; unset: 40 tau, 3 tau for growth rates
  double tolerance = 1e-6;         ///< steady: kinetic energy and Nusselt numbers change less than this share in tau
};

/// The point with everything set that may be unset.
BenardGridPoint resolved(const BenardGridPoint& point);

/// Refuses (BadInput, one sentence naming the key `section.key`, the value and what is accepted): a floor that is not
/// the hotter one; both a Rayleigh number and coefficients, or neither; a width that is no whole number of cells; a
/// step that is not stable.
void validate(const BenardGridPoint& point);

/// What the grid needs of it.
grid::Settings flow_settings(const BenardGridPoint& point);

double diffusion_time(const BenardGridPoint& point);

/// Steps of one interval, after which the flow is sampled: about a twentieth of tau. Intervals of the longest run.
int interval_steps(const BenardGridPoint& point);
std::int64_t interval_count(const BenardGridPoint& point);

/// The flow at the end of an interval.
struct BenardGridSample {
  double time = 0.0;
  double kinetic_energy = 0.0;  ///< per mass
  double nusselt_hot = 0.0;
  double nusselt_cold = 0.0;
  double nusselt_sides = 0.0;
  double largest_speed = 0.0;
  double roll_amplitude = 0.0;
  double mass_error = 0.0;  ///< of the mass at the start
};

struct BenardGridRecord {
  std::vector<BenardGridSample> samples;  ///< from the start on
  bool steady = false;
  std::string failure;        ///< why the run ended early; the samples and fields before stay
  grid::Flow::Fields fields;  ///< at the last sample
};

class BenardGridRun {
 public:
  /// Throws BadInput for what validate() refuses. One thread does the work; the other arguments are every case's.
  explicit BenardGridRun(const BenardGridPoint& point, int replica = 0, int threads = 1);

  /// Runs one interval; none when the flow is steady or has failed, so that interval_count() is soon reached.
  void advance_one_interval();
  std::int64_t intervals_done() const { return intervals_; }

  BenardGridRecord record() const;
  const grid::Flow& flow() const { return flow_; }

  void save(ArchiveWriter& archive) const;
  void load(ArchiveReader& archive);

 private:
  void sample();
  bool changes_little() const;

  BenardGridPoint point_;
  grid::Flow flow_;
  double initial_mass_;
  std::int64_t intervals_ = 0;
  std::vector<BenardGridSample> samples_;
  bool steady_ = false;
  std::string failure_;
};

}  // namespace lucy::cases
