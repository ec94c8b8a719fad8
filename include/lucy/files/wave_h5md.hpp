// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// point_001.h5 of a wave whose frames are recorded (h5md.hpp): what every replica sampled, and the frames. Steps and
// times count from the start of the run, equilibration included.
#pragma once

#include <filesystem>
#include <span>

#include "lucy/cases/wave.hpp"
#include "lucy/files/frame_spool.hpp"
#include "lucy/files/h5md.hpp"

namespace lucy::files {

/// `frames[r]`: of replica r; null: none. As write_h5md of h5md.hpp.
void write_h5md(const std::filesystem::path& path, const cases::WavePoint& point,
                std::span<const cases::WaveRecord> replicas, std::span<const FrameSpool* const> frames,
                const H5mdAuthorship& authorship);

}  // namespace lucy::files
