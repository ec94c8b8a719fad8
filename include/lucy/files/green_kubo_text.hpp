// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Green-Kubo results for people, at most 118 columns wide.
#pragma once

#include <span>
#include <string>

#include "lucy/cases/green_kubo_table.hpp"
#include "lucy/cases/viscosities.hpp"

namespace lucy::files {

/// The states in four tables: the viscosity; how it depends on the cut-off and what the spectrum says; its parts; how
/// the run went, with diffusion and conductivity where they are known. Below them how errors were estimated and the
/// cut-off was chosen, what the status words mean (only those that occur), warnings, and why states failed. Columns in
/// which nothing is known, such as the parts of a series sampled elsewhere, are left out. Ends with a line feed.
std::string format_green_kubo(std::span<const cases::GreenKuboRow> rows);

/// Per state every route to the viscosity, and the extrapolation to zero rate: what was fitted, how well, and which
/// rates were left out and why. Ends with a line feed.
std::string format_side_by_side(std::span<const cases::SideBySide> states);

}  // namespace lucy::files
