// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rayleigh-Benard convection (convection.hpp) of the continuum (grid/flow.hpp): one fluid, one Rayleigh number, one
// mesh. Either the rolls run until they are steady, or small ones grow or decay and their rate is found.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/cases/convection.hpp"
#include "lucy/grid/flow.hpp"

namespace lucy::cases {

enum class BenardGoal { steady_state, growth_rate };
inline constexpr std::array<std::pair<std::string_view, BenardGoal>, 2> benard_goal_names = {
    {{"steady-state", BenardGoal::steady_state}, {"growth-rate", BenardGoal::growth_rate}}};

/// One row of benard_grid.csv (names as in the input file).
struct BenardGridPoint : Convection {
  // What the scheduler asks of every point: a continuum is one system, and has nothing random.
  static constexpr std::int64_t particles = 1;
  static constexpr int replicas = 1;
  static constexpr std::uint64_t seed = 0;

  // [fluid], besides what Convection has; its unset roll velocity: a hundred-thousandth of the usual for growth rates
  grid::Transport transport = grid::Transport::dynamic;
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
