// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/particle_file.hpp"

#include <cmath>
#include <fstream>

#include "lucy/files/atomic_file.hpp"
#include "lucy/files/h5md_reader.hpp"
#include "lucy/space/box.hpp"
#include "particle_text.hpp"

namespace lucy::files {

namespace {

constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";

bool is_hdf5(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string first(hdf5_signature.size(), '\0');
  file.read(first.data(), static_cast<std::streamsize>(first.size()));
  return file && first == hdf5_signature;
}

ParticleFormat format_of_text(const std::filesystem::path& path, std::string_view text) {
  if (text.find('\0') != std::string_view::npos)
    throw BadInput(fmt::format(
        "{} is binary: a LAMMPS data file, a LAMMPS dump in text, extended XYZ or a point file of Lucy is expected",
        path.string()));
  LineReader lines(path.string(), text);
  std::string_view first;
  std::string_view second;
  lines.next(first);
  lines.next(second);
  if (first.starts_with("ITEM:")) return ParticleFormat::lammps_dump;
  if (second.find("Lattice=") != std::string_view::npos) return ParticleFormat::extended_xyz;
  // A data file says how many atoms it has within its header, whatever its title.
  for (std::string_view line = second; !lines.done(); lines.next(line))
    if (const auto words = words_of(line); words.size() == 2 && words[1] == "atoms") return ParticleFormat::lammps_data;
  throw BadInput(fmt::format(
      "{} is none of these: a LAMMPS data file (it has no line 'N atoms'), a LAMMPS dump in text "
      "(it does not begin with ITEM:), extended XYZ (its second line has no Lattice=), a point file of Lucy",
      path.string()));
}

/// Numbers that arithmetic would lose: a place in the box, or a square.
void refuse_lost_digits(const RawState& state, const std::filesystem::path& path) {
  constexpr double most_boxes = 1e6;
  constexpr double most_speed = 1e100;
  for (std::size_t i = 0; i < state.position.size(); ++i)
    if (!(std::abs(state.position[i] - state.origin[i % 2]) < most_boxes * state.lengths[i % 2]))
      throw BadInput(fmt::format("{}: particle {} has the coordinate {}, a million boxes away", path.string(),
                                 i / 2 + 1, state.position[i]));
  for (std::size_t i = 0; i < state.velocity.size(); ++i)
    if (!(std::abs(state.velocity[i]) < most_speed))
      throw BadInput(fmt::format("{}: particle {} has the velocity {}", path.string(), i / 2 + 1, state.velocity[i]));
}

/// Peculiar momenta, the tilt as an offset, positions in the rectangle.
cases::Frame frame_of(const RawState& state, double flow) {
  cases::Frame frame;
  frame.step = state.step;
  frame.time = state.time.value_or(0.0);
  frame.box = state.lengths;
  const space::Box<2> box(state.lengths, 0.0, state.tilt);
  frame.offset = box.offset();
  frame.position.resize(state.position.size());
  frame.momentum = state.velocity;
  for (std::size_t i = 0; i < state.position.size(); i += 2) {
    space::Vector<2> at = {state.position[i] - state.origin[0], state.position[i + 1] - state.origin[1]};
    if (!frame.momentum.empty()) frame.momentum[i] -= flow * at[1];
    box.wrap(at);
    frame.position[i] = at[0];
    frame.position[i + 1] = at[1];
  }
  return frame;
}

/// Laboratory velocities, the offset as a tilt, positions in the cell.
RawState raw_state(const cases::Frame& frame, double flow) {
  RawState state;
  state.step = frame.step;
  state.time = frame.time;
  state.flow = flow;
  state.lengths = frame.box;
  state.tilt = tilt_of(frame);
  state.position = frame.position;
  state.velocity = frame.momentum;
  state.velocity.resize(state.position.size(), 0.0);
  for (std::size_t i = 0; i < state.position.size(); i += 2) {
    const double y = state.position[i + 1];
    const double left = state.tilt * y / state.lengths[1];
    state.position[i] -= state.lengths[0] * std::floor((state.position[i] - left) / state.lengths[0]);
    state.velocity[i] += flow * y;
  }
  return state;
}

}  // namespace

std::string_view format_name(ParticleFormat format) {
  switch (format) {
    case ParticleFormat::lammps_data:
      return "LAMMPS data file";
    case ParticleFormat::lammps_dump:
      return "LAMMPS dump";
    case ParticleFormat::extended_xyz:
      return "extended XYZ file";
    case ParticleFormat::h5md:
      break;
  }
  return "point file of Lucy";
}

double tilt_of(const cases::Frame& frame) {
  return frame.offset > 0.5 * frame.box[0] ? frame.offset - frame.box[0] : frame.offset;
}

ParticleReader::ParticleReader(const std::filesystem::path& path, int replica) : path_(path), replica_(replica) {
  if (is_hdf5(path)) {
    const H5mdReader reader(path, replica);
    format_ = ParticleFormat::h5md;
    frames_ = reader.times().size();
    strain_rate_ = reader.number("strain_rate");
    return;
  }
  text_ = read_text_file(path);
  format_ = format_of_text(path, text_);
  LineReader lines(path.string(), text_);
  const auto one_frame = [&] {
    starts_.push_back(lines.place());
    lines_.push_back(lines.next_line());
  };
  if (format_ == ParticleFormat::lammps_data) {
    one_frame();
  } else {
    try {
      while (text_.find_first_not_of(" \t\r\n", lines.place()) != std::string::npos) {
        one_frame();
        format_ == ParticleFormat::lammps_dump ? skip_dump(lines) : skip_extended_xyz(lines);
      }
    } catch (const EndsTooEarly& end) {
      if (starts_.size() == 1) throw;
      starts_.pop_back();
      unfinished_ = end.what();
    }
  }
  frames_ = starts_.size();
}

ParticleState ParticleReader::state(std::size_t index, std::optional<double> flow) const {
  if (index == frames_ && !unfinished_.empty())
    throw BadInput(fmt::format("frame {} is not finished: {}", index + 1, unfinished_));
  if (index >= frames_)
    throw BadInput(fmt::format("{} has frames 1 to {}, but not {}", path_.string(), frames_, index + 1));
  ParticleState state;
  if (format_ == ParticleFormat::h5md) {
    state.frame = H5mdReader(path_, replica_).frame(index);
    state.time = state.frame.time;
    state.flow_told = true;
    return state;
  }
  const LineReader lines(path_.string(), text_, starts_[index], lines_[index]);
  const RawState raw = format_ == ParticleFormat::lammps_data   ? read_data(lines)
                       : format_ == ParticleFormat::lammps_dump ? read_dump(lines)
                                                                : read_extended_xyz(lines);
  refuse_lost_digits(raw, path_);
  state.flow_told = raw.flow.has_value();
  state.flow = flow.value_or(raw.flow.value_or(0.0));
  state.frame = frame_of(raw, state.flow);
  state.time = raw.time;
  return state;
}

std::string particle_text(ParticleFormat format, const cases::Frame& frame, double flow, const std::string& title) {
  const RawState state = raw_state(frame, flow);
  switch (format) {
    case ParticleFormat::lammps_data:
      return data_text(state, title);
    case ParticleFormat::lammps_dump:
      return dump_text(state);
    case ParticleFormat::extended_xyz:
      return extended_xyz_text(state);
    case ParticleFormat::h5md:
      break;
  }
  throw BadInput("point files of Lucy are written by its runs alone");
}

ParticleFormat format_of_name(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".data") return ParticleFormat::lammps_data;
  if (ending == ".dump" || ending == ".lammpstrj") return ParticleFormat::lammps_dump;
  if (ending == ".xyz" || ending == ".extxyz") return ParticleFormat::extended_xyz;
  throw BadInput(
      fmt::format("{}: the ending of the name says what is written: .data (LAMMPS data file), .dump or .lammpstrj "
                  "(LAMMPS dump), .xyz or .extxyz (extended XYZ)",
                  path.string()));
}

}  // namespace lucy::files
