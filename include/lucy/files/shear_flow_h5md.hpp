// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// point_001.h5 of a sheared fluid: the layout of h5md.hpp. Observables stand in /observables/replica_01/NAME, averages
// over the sample interval that ends at their step and time, and in /observables/replica_01/instants/NAME, those of the
// instant; frames carry internal energies.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "lucy/cases/shear_flow.hpp"
#include "lucy/files/frame_spool.hpp"
#include "lucy/files/h5md.hpp"

namespace lucy::files {

/// What one replica contributes; both referred-to objects must live until the file is written.
struct H5mdShearFlowReplica {
  int replica = 0;  ///< from 0: group replica_01
  const cases::ShearFlowRecord* record = nullptr;
  const FrameSpool* frames = nullptr;  ///< null or empty: no particles group
};

/// As write_h5md() of the other cases. Throws RunFailed with path and reason.
void write_h5md(const std::filesystem::path& path, const cases::ShearFlowPoint& point,
                std::span<const H5mdShearFlowReplica> replicas, const H5mdAuthorship& authorship);

}  // namespace lucy::files
