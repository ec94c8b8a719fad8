// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// States of two-dimensional systems in the files of other programs, read and written: LAMMPS data files, LAMMPS dumps
// (text), extended XYZ; and read from point files of Lucy (H5MD). The sheared box is a cell with the edges (L_x, 0) and
// (tilt, L_y), the tilt being the offset of the image above folded to (-L_x/2, L_x/2]; the third edge is (0, 0, 1) and
// means nothing.
//
//     LAMMPS data      "N atoms", box bounds, "xy xz yz" when tilted, Atoms (style atomic), Velocities; one frame
//     LAMMPS dump      any columns that hold id, x y or xs ys, vx vy; written with ITEM: TIME
//     extended XYZ     Lattice, Origin, Properties with pos and velo, Time, Step, strain_rate
//
// Velocities in such files are laboratory ones where a flow is in them: v_x = p_x + flow y, y counted from the lower
// edge of the cell. LAMMPS does not say which rate its flow has; the files written here do where the format has a place
// for it (the title of a data file, strain_rate in extended XYZ).
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lucy/cases/frame.hpp"

namespace lucy::files {

enum class ParticleFormat { lammps_data, lammps_dump, extended_xyz, h5md };

/// In messages: "LAMMPS data file".
std::string_view format_name(ParticleFormat format);

/// A state from a file.
struct ParticleState {
  cases::Frame frame;  ///< peculiar momenta (mass one), positions wrapped into the rectangle; step 0 and time 0
                       ///< where the file says nothing; without momenta where it has no velocities
  std::optional<double> time = {};  ///< when the file tells it
  double flow = 0.0;                ///< the strain rate that was taken out of the velocities
  bool flow_told = false;  ///< whether the file says which one that is (point files: their momenta are peculiar)
};

class ParticleReader {
 public:
  /// Finds out what kind of file it is and where its frames are. `replica`: of a point file. Throws BadInput naming
  /// file and line, what was found and what is accepted: what is none of these files, or damaged.
  explicit ParticleReader(const std::filesystem::path& path, int replica = 1);

  ParticleFormat format() const { return format_; }
  /// Complete ones. Another one may be cut off at the end of the file, by who still writes it, say.
  std::size_t frames() const { return frames_; }
  bool has_unfinished_frame() const { return !unfinished_.empty(); }
  /// Of the motion in a point file of Lucy; nothing in other files.
  std::optional<double> strain_rate() const { return strain_rate_; }

  /// Frame `index` from 0, particles in the order of their ids. `flow`: the strain rate of the flow in the velocities,
  /// instead of what the file says, or else none. Throws BadInput as above: also for a frame that is not finished,
  /// particles that do not lie in a plane, masses other than one, ids that are not 1 to N, a box that is not periodic
  /// in the plane, and an atom style of a data file that is not atomic.
  ParticleState state(std::size_t index, std::optional<double> flow = {}) const;

 private:
  std::filesystem::path path_;
  ParticleFormat format_;
  std::size_t frames_ = 0;
  int replica_;
  std::optional<double> strain_rate_ = {};
  std::string text_ = {};
  std::vector<std::size_t> starts_ = {};  ///< in the text, of every frame
  std::vector<std::size_t> lines_ = {};   ///< their line numbers, from 1
  std::string unfinished_ = {};           ///< what is missing from the frame that is not, if there is one
};

/// A state as text of the format, with the flow of strain rate `flow` added to the velocities; `title` is the first
/// line of a data file, one line. Numbers read back with the same bits.
std::string particle_text(ParticleFormat format, const cases::Frame& frame, double flow, const std::string& title);

/// The format of a file to be written, by its name: .data, .dump or .lammpstrj, .xyz or .extxyz. Throws BadInput.
ParticleFormat format_of_name(const std::filesystem::path& path);

/// The tilt of the cell: the offset folded to (-L_x/2, L_x/2].
double tilt_of(const cases::Frame& frame);

}  // namespace lucy::files
