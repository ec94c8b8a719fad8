// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two engines on the same states, line by line. A line holds what each of them says, by how much they differ, and by
// how much they may:
//
//     single points   absolute differences, against rounding or against the error of an interpolated potential
//     averages        differences in combined standard errors, against four
//     trajectories    how long they stay together, against what the difference of integrators explains
//     Green-Kubo      one estimator on the stresses of both
//     heat            what the thermostat removed over the work done, which is one in both
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/cases/couette.hpp"
#include "lucy/cases/couette_table.hpp"
#include "lucy/kernel/lucy.hpp"
#include "lucy/statistics/pooling.hpp"

namespace lucy::cases {

/// One configuration, evaluated.
struct PointSums {
  double potential_energy = 0.0;      ///< of all particles
  std::array<double, 3> kinetic{};    ///< P_xx, P_yy, P_xy
  std::array<double, 3> potential{};  ///< P_xx, P_yy, P_xy
  std::vector<double> forces;         ///< by particle, x0 y0 x1 y1 ...
};

/// By this engine, of a frame with peculiar momenta.
PointSums evaluate(const kernel::Lucy<2>& kernel, const Frame& frame);

struct VerdictLine {
  std::string part;      ///< what was done with both engines
  std::string quantity;  ///< what is compared
  double lucy = 0.0;     ///< nan: no single number
  double lucy_error = 0.0;
  double other = 0.0;
  double other_error = 0.0;
  double difference = 0.0;
  double allowed = 0.0;
  bool in_standard_errors = false;  ///< difference and allowed
  bool judged = true;               ///< false: shown, no part of the verdict

  /// A difference that is not known (nan) does not agree.
  bool agrees() const;
};

/// How far a single point may be off.
struct PointAllowance {
  double energy = 0.0;         ///< per particle
  double largest_force = 0.0;  ///< any component of any particle's
  double typical_force = 0.0;  ///< root mean square of a component
  double kinetic = 0.0;        ///< any component of the kinetic pressure
  double potential = 0.0;      ///< any component of the potential pressure
};

/// Energy, forces and both parts of the pressure tensor.
std::vector<VerdictLine> compare_points(const std::string& part, const PointSums& lucy, const PointSums& other,
                                        const PointAllowance& allowed);

/// Averages with errors; four combined standard errors are allowed. They do not agree where a value or an error is
/// missing on either side (a short run), or where the combined error is above a quarter of `scale`, since anything
/// would agree then.
VerdictLine compare_estimates(const std::string& part, const std::string& quantity, const statistics::Estimate& lucy,
                              const statistics::Estimate& other, double scale);

/// Those of `names` (of cases::quantities) of two rows. The scale of a part of the pressure, kinetic or potential, is
/// the size of both parts.
std::vector<VerdictLine> compare_rows(const std::string& part, const TableRow& lucy, const TableRow& other,
                                      std::span<const std::string_view> names);

/// The integral of the stress autocorrelation (times V/kT) to `green_kubo_time`, and the viscosities, of stresses at
/// constant energy. A viscosity whose error is too large is shown, not judged.
inline constexpr double green_kubo_time = 5.0;
std::vector<VerdictLine> compare_green_kubo(const CouettePoint& point, const CouetteRecord& lucy,
                                            const TableRow& lucy_row, const CouetteRecord& other,
                                            const TableRow& other_row);

/// Root mean square distance of the particles of two frames in the same box, nearest images.
double separation(const Frame& a, const Frame& b);

/// The time at which a separation, known at equal intervals from time zero on, first exceeds `distance`; the end of the
/// series when it never does. Between two entries it grows exponentially.
double parting_time(std::span<const double> separations, double interval, double distance);

/// Frames of one start at equal intervals of time, by this engine's two integrators and by another engine's velocity
/// Verlet. The other must part from Runge-Kutta when the own Verlet does, and stay with the own Verlet half as long
/// again at least (or to the end). Where the own two never part, nothing is known.
struct Trajectories {
  double interval = 0.0;
  std::span<const Frame> runge_kutta;
  std::span<const Frame> verlet;
  std::span<const Frame> other;
};
std::vector<VerdictLine> compare_trajectories(const std::string& part, const Trajectories& trajectories,
                                              double distance);

/// What another engine wrote down, of instants.
struct EngineSeries {
  std::vector<double> time;
  std::vector<Sample> instants;  ///< what cases::observables names
  std::vector<double> energy;    ///< K + Phi, peculiar
  std::vector<double> heat;      ///< removed since the start
};

/// (heat + change of energy)/work after the equilibration, the work, - rate V int P_xy dt, by trapezoids.
double heat_over_work(const CouettePoint& point, const EngineSeries& series);

/// This engine's: its ergostat takes out as heat what is put in as work, and keeps the energy but for what rescaling
/// put back. `row`: of this record.
double heat_over_work(const CouettePoint& point, const CouetteRecord& record, const TableRow& row);

/// Judged by the worse of both. `lucy`: nothing where only the other's is meant.
VerdictLine compare_heat(const std::string& part, const std::string& quantity, std::optional<double> lucy,
                         double other);

}  // namespace lucy::cases
