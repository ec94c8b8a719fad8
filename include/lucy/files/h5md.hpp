// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// point_001.h5: time series and frames of one point in H5MD 1.1 (P. de Buyl, P. H. Colberg, F. Hoefling, Comput. Phys.
// Commun. 185, 1546 (2014)), reduced units.
//
//     /h5md                              version [1,1], author, creator
//     /parameters                        the point, as attributes
//     /observables/replica_01/NAME       step, time, value [samples]; step and time are one dataset, hard-linked
//                            /stress/NAME  likewise: every stress of a Green-Kubo state that keeps its series
//     /particles/replica_01/position     step, time, value [frames][N][2]: wrapped into [0, L)
//                          /velocity     laboratory: peculiar momentum / m + strain_rate y e_x
//                          /momentum     peculiar
//                          /internal_energy  per mass [frames][N]; of smooth particles that have them
//                          /box          dimension, boundary; edges: step, time, value [frames][2][2], the rows being
//                                        the edge vectors (L_x, 0) and (offset, L_y)
//                          /lees_edwards offset (x-shift of the image above), direction (0: x), normal (1: y)
//
// Further cases write theirs with the parts in src/files/h5md_parts.hpp; h5md_reader.hpp reads any of them.
// The value at (step, time) of an observable of a Couette point is the average over the sample interval that ends
// there; those of a Green-Kubo state, /stress included, are of the instant itself. Step and time count from the start
// of the run, equilibration included; steps are those of the stated size, however subdivided.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "lucy/cases/couette.hpp"
#include "lucy/cases/green_kubo.hpp"
#include "lucy/files/frame_spool.hpp"

namespace lucy::files {

struct H5mdAuthorship {
  std::string author = "unknown";
  std::string creator = "lucy";
  std::string creator_version;
};

/// What one replica contributes; both referred-to objects must live until the file is written.
struct H5mdReplica {
  int replica = 0;  ///< from 0: group replica_01
  const cases::CouetteRecord* record = nullptr;
  std::int64_t equilibration_intervals = 0;  ///< CouetteRun::intervals_needed(0)
  const FrameSpool* frames = nullptr;        ///< null or empty: no particles group
};

/// What one replica of a Green-Kubo state contributes; what is referred to must live until the file is written.
struct H5mdGreenKuboReplica {
  int replica = 0;  ///< from 0: group replica_01
  const cases::GreenKuboRecord* record = nullptr;
  std::span<const cases::StressSample> series;  ///< empty: not kept
  std::int64_t first_recorded_step = 0;         ///< GreenKuboRun::first_recorded_step()
  const FrameSpool* frames = nullptr;           ///< null or empty: no particles group
};

/// Writes the file under a temporary name and renames it. The same contents give the same bytes (no time stamps).
/// The file is put together in memory (72 bytes per sample, 48 per particle and frame). May be called from several
/// threads; they take turns. Throws RunFailed with path and reason.
void write_h5md(const std::filesystem::path& path, const cases::CouettePoint& point,
                std::span<const H5mdReplica> replicas, const H5mdAuthorship& authorship);

/// The same of a Green-Kubo state (strain rate zero; steps and times count from the end of the preparation; 48 bytes
/// per stress sample that was kept).
void write_h5md(const std::filesystem::path& path, const cases::GreenKuboPoint& point,
                std::span<const H5mdGreenKuboReplica> replicas, const H5mdAuthorship& authorship);

}  // namespace lucy::files
