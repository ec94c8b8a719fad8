// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// point_001.h5 of a convecting fluid: the layout of h5md.hpp. Observables stand in /observables/replica_01/NAME,
// averages over the sample interval that ends at their step and time, and in /observables/replica_01/instants/NAME,
// those of the instant; all of them from the start on, the attribute averaged_from saying where the equilibration
// ended. Frames carry internal energies; across walls their box has the boundary "none". Beside what H5MD knows, and as
// in the files of `lucy benard-grid` (benard_grid_h5.hpp), x and y counted from the middle of the cell:
//
//     /grid     x, y of the centres of the cells in which the fields are averaged
//     /fields   density, temperature, velocity_x, velocity_y, internal_energy, pressure: (n_y, n_x), of the moments
//               averaged from time_from to time_to: v = <rho v>/<rho>, e = <rho e>/<rho>, kT and P by the equation of
//               state; nan where no particle was ever near
//     /last     position, velocity, velocity_smoothed (N, 2), density, temperature (N) of the first replica at `time`
//
// /grid and /fields are missing when the run ended before anything was averaged, /last when nothing was sampled.
#pragma once

#include <filesystem>
#include <span>

#include "lucy/cases/benard.hpp"
#include "lucy/files/frame_spool.hpp"
#include "lucy/files/h5md.hpp"

namespace lucy::files {

/// Writes the file as write_h5md() of the other cases does: `records` and `frames` by replica (frames null or empty: no
/// particles group), `last` of the first. Throws RunFailed with path and reason.
void write_h5md(const std::filesystem::path& path, const cases::BenardPoint& point,
                std::span<const cases::BenardRecord> records, std::span<const FrameSpool* const> frames,
                const cases::BenardParticles& last, const H5mdAuthorship& authorship);

}  // namespace lucy::files
