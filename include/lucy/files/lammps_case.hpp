// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One state of a sweep as a case for LAMMPS (A. P. Thompson et al., Comput. Phys. Commun. 271, 108171 (2022)), an
// engine that shares nothing with this one but the input. The folder of a case holds
//
//     lucy.table        phi(r) and -dphi/dr at 16000 distances, evenly spaced in r^2, for pair_style table
//     start.data        the start: positions in the (tilted) cell, peculiar velocities
//     single_point.in   energy, forces and pressure tensor of the start by the table
//     exact_point.in    the same by two overlaid nm/cut styles, which make phi exactly
//     nve.in            motion at constant energy: nve_series.dat
//     sheared.in        where the rate is not zero: steady shear at a given temperature: sheared_series.dat
//
// Lucy's function is a polynomial, phi = A (1 - 6 x^2 + 8 x^3 - 3 x^4) with x = r/h, and so is the form of nm/cut,
// E_0/(n - m) [m (r_0/r)^n - n (r_0/r)^m], with negative exponents: (-2, -3) with E_0 = 2A and (-3, -4) with E_0 = -A,
// both with r_0 = h and shifted to zero there, add up to phi.
//
// Series have one row per sample, of the instant, with named columns: step, time, those of cases::observables, and
// pxy, pxx, pyy, energy (K + Phi, K peculiar), heat (what the thermostat has removed since the start), tilt. LAMMPS
// moves the sheared cell after it has computed forces: tilt is that of the box which the forces of the row have seen,
// of the step before; a frame of the same step has that of its own step.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lucy/cases/couette.hpp"
#include "lucy/cases/engine_verdict.hpp"
#include "lucy/kernel/lucy.hpp"

namespace lucy::files {

struct LammpsCase {
  cases::CouettePoint point;
  cases::Frame start;                             ///< with peculiar momenta
  double temperature = 0.0;                       ///< kT that sheared.in keeps; not looked at where the rate is zero
  std::string temperature_from = "as asked for";  ///< half a sentence for the script
};

/// Writes all files of the case into `folder`, which exists. Throws RunFailed when the disk refuses.
void write_lammps_case(const std::filesystem::path& folder, const LammpsCase& one);

/// What straight lines between the entries of the table, even in r^2, do to phi and to the force of one pair, and to
/// sums over the pairs of a fluid of number density `density` without structure.
struct TableError {
  double pair_energy = 0.0;  ///< largest of one pair
  double pair_force = 0.0;
  double energy = 0.0;    ///< of the potential energy per particle, were all errors of one sign
  double force = 0.0;     ///< root mean square of one component of a particle's force
  double pressure = 0.0;  ///< of P_xx, were all errors of one sign
};
TableError table_error(const kernel::Lucy<2>& kernel, double density);

/// Steps between the rows of a series: a fifth of a time unit or less (one step, if that is longer).
int series_steps(const cases::CouettePoint& point);

/// Steps of a whole run, equilibration included.
std::int64_t lammps_steps(const cases::CouettePoint& point);

/// Of a run that went on from a restart file, the rows that were run last. Throws BadInput when the file cannot be read
/// or lacks a column.
cases::EngineSeries read_lammps_series(const std::filesystem::path& path);

/// The same as a replica's record: rows after the point's equilibration, averaged over about the point's sample
/// interval. The energy error of a step is not known (nan).
cases::CouetteRecord record_of(const cases::EngineSeries& series, const cases::CouettePoint& point);

/// What a single point printed, and the forces of its dump. `name`: "single_point" or "exact_point". Throws BadInput
/// when a file cannot be read.
cases::PointSums read_lammps_point(const std::filesystem::path& folder, const std::string& name);

}  // namespace lucy::files
