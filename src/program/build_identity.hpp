// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which build of Lucy this is, as far as bits are concerned: a run is resumed only by the build that began it.
#pragma once

#include <string>
#include <vector>

#include "lucy/files/provenance.hpp"

namespace lucy::program {

/// Commit, compiler and arithmetic flags; where the commit does not fix the source (modified, or not known), the
/// checksum of the running program as well. One line.
std::string build_identity();

/// What the record of a run says of this program, and of how it was called.
files::Provenance provenance_of(const std::vector<std::string>& command_line);

}  // namespace lucy::program
