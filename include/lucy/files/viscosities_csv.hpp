// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// viscosities.csv, sweep_fit.csv and nemd.csv: the routes to the viscosity of a state side by side, and the
// extrapolation to zero rate that one of them needs. Numbers are the shortest text that reads back as the same bits;
// what is not known is nan.
#pragma once

#include <filesystem>
#include <span>

#include "lucy/cases/viscosities.hpp"

namespace lucy::files {

/// One line for each state and route: particles, energy_per_particle, route, viscosity, viscosity_error, z, note.
/// These throw RunFailed when the disk refuses; an earlier file is then untouched.
void write_viscosities_csv(const std::filesystem::path& path, std::span<const cases::SideBySide> states);

/// One line for each row of the sweep: particles, energy_per_particle, strain_rate, viscosity, viscosity_error, part
/// (cases::fit_part_name), and the fit of its state: eta_0, eta_0_error, eta_2, eta_2_error, eta_covariance (errors and
/// covariance of the fit alone, so that a band can be drawn from them).
void write_sweep_fit_csv(const std::filesystem::path& path, std::span<const cases::SideBySide> states);

/// The extrapolated viscosities: particles, energy_per_particle, viscosity, viscosity_error.
void write_nemd_csv(const std::filesystem::path& path, std::span<const cases::SideBySide> states);

}  // namespace lucy::files
