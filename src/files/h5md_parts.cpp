// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "h5md_parts.hpp"

#include <fmt/format.h>

#include <optional>

namespace lucy::files {

using hdf5::add_attribute;
using hdf5::checked;
using hdf5::create_dataset;
using hdf5::create_group;
using hdf5::Handle;

void Clock::put_into(hid_t parent, const std::string& element_name, hid_t element) {
  if (first_.empty()) {
    const std::array<hsize_t, 1> shape = {count()};
    hdf5::write_dataset(element, "step", shape, steps_);
    hdf5::write_dataset(element, "time", shape, times_);
    first_ = element_name;
    return;
  }
  for (const char* name : {"step", "time"})
    checked(H5Lcreate_hard(parent, fmt::format("{}/{}", first_, name).c_str(), parent,
                           fmt::format("{}/{}", element_name, name).c_str(), H5P_DEFAULT, H5P_DEFAULT));
}

Clock Pace::clock(std::size_t samples) const {
  std::vector<std::int64_t> steps;
  std::vector<double> times;
  for (std::size_t i = 0; i < samples; ++i) {
    steps.push_back(begin + (static_cast<std::int64_t>(i) + 1) * interval);
    times.push_back(static_cast<double>(steps.back()) * step);
  }
  return {std::move(steps), std::move(times)};
}

namespace {

/// A quantity of all particles, written frame by frame.
class ParticleElement {
 public:
  /// `shape`: frames, particles and, for vectors, components.
  ParticleElement(hid_t parent, std::string name, std::vector<hsize_t> shape, std::string_view description)
      : name_(std::move(name)),
        shape_(std::move(shape)),
        group_(create_group(parent, name_)),
        value_(create_dataset(group_, "value", H5T_IEEE_F64LE, shape_)) {
    if (!description.empty()) add_attribute(group_, "description", description);
  }

  void write(hsize_t frame, const std::vector<double>& values) const {
    std::vector<hsize_t> start(shape_.size(), 0);
    std::vector<hsize_t> count = shape_;
    start[0] = frame;
    count[0] = 1;
    const Handle target(H5Dget_space(value_), H5Sclose);
    checked(H5Sselect_hyperslab(target, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr));
    const Handle source(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
    checked(H5Dwrite(value_, H5T_NATIVE_DOUBLE, source, target, H5P_DEFAULT, values.data()));
  }

  void take_time_from(Clock& clock, hid_t parent) const { clock.put_into(parent, name_, group_); }

 private:
  std::string name_;
  std::vector<hsize_t> shape_;
  Handle group_;
  Handle value_;
};

void write_particles(hid_t particles, const std::string& name, double strain_rate, const FrameSpool& frames,
                     const std::array<bool, 2>& walled) {
  const Handle group = create_group(particles, name);
  const auto count = static_cast<hsize_t>(frames.count());
  const auto number = static_cast<hsize_t>(frames.particles());
  std::vector<std::int64_t> steps;
  std::vector<double> times;
  std::vector<double> edges;
  std::vector<double> offsets;

  // One frame in memory at a time; what is small is gathered for the elements that follow.
  const ParticleElement position(group, "position", {count, number, 2}, "");
  const ParticleElement velocity(group, "velocity", {count, number, 2},
                                 "laboratory velocity: peculiar momentum / m + strain_rate y e_x");
  const ParticleElement momentum(group, "momentum", {count, number, 2},
                                 "peculiar momentum, relative to the flow strain_rate y e_x");
  std::optional<ParticleElement> energy;
  if (frames.internal_energies()) {
    energy.emplace(group, "internal_energy", std::vector<hsize_t>{count, number}, "internal energy per mass");
  }
  for (hsize_t index = 0; index < count; ++index) {
    const cases::Frame frame = frames.read(static_cast<std::int64_t>(index));
    std::vector<double> laboratory = frame.momentum;  // m = 1
    for (std::size_t i = 0; i < laboratory.size(); i += 2) laboratory[i] += strain_rate * frame.position[i + 1];
    position.write(index, frame.position);
    velocity.write(index, laboratory);
    momentum.write(index, frame.momentum);
    if (energy) energy->write(index, frame.internal_energy);
    steps.push_back(frame.step);
    times.push_back(frame.time);
    edges.insert(edges.end(), {frame.box[0], 0.0, frame.offset, frame.box[1]});
    offsets.push_back(frame.offset);
  }

  Clock clock(std::move(steps), std::move(times));
  for (const ParticleElement* element : {&position, &velocity, &momentum}) element->take_time_from(clock, group);
  if (energy) energy->take_time_from(clock, group);

  const Handle box = create_group(group, "box");
  add_attribute(box, "dimension", 2);
  const Handle boundary_type = hdf5::text_type(8);
  const hsize_t two = 2;
  const Handle boundary_space(H5Screate_simple(1, &two, nullptr), H5Sclose);
  const Handle boundary(H5Acreate2(box, "boundary", boundary_type, boundary_space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  std::string boundaries;
  for (const bool walls : walled) boundaries += walls ? std::string("none\0\0\0\0", 8) : std::string("periodic");
  checked(H5Awrite(boundary, boundary_type, boundaries.data()));
  const std::array<hsize_t, 3> edges_shape = {count, 2, 2};
  write_element(group, "box/edges", clock, edges_shape, edges, "rows: (L_x, 0) and (offset, L_y)");

  const Handle sliding = create_group(group, "lees_edwards");
  const std::array<hsize_t, 2> column = {count, 1};
  write_element(group, "lees_edwards/offset", clock, column, offsets, "x-shift of the image above, in [0, L_x)");
  write_element(group, "lees_edwards/direction", clock, column, std::vector<int>(count, 0),
                "axis of the shift: 0 is x");
  write_element(group, "lees_edwards/normal", clock, column, std::vector<int>(count, 1),
                "axis of the gradient: 1 is y");
  add_attribute(sliding, "strain_rate", strain_rate);
}

}  // namespace

void write_point_file(const std::filesystem::path& path, const H5mdAuthorship& authorship, double strain_rate,
                      std::span<const ReplicaFrames> replicas, const std::function<void(hid_t group)>& parameters,
                      const std::function<void(hid_t group, std::size_t replica)>& observables,
                      const PointFileExtras& extras) {
  hdf5::write_file(path, [&](hid_t file) {
    const Handle root = create_group(file, "h5md");
    add_attribute<int>(root, "version", std::array<int, 2>{1, 1});
    const Handle author = create_group(root, "author");
    add_attribute(author, "name", authorship.author);
    const Handle creator = create_group(root, "creator");
    add_attribute(creator, "name", authorship.creator);
    add_attribute(creator, "version", authorship.creator_version);
    parameters(create_group(file, "parameters"));

    const auto name = [](const ReplicaFrames& one) { return fmt::format("replica_{:02}", one.replica + 1); };
    const Handle all_observables = create_group(file, "observables");
    for (std::size_t r = 0; r < replicas.size(); ++r) observables(create_group(all_observables, name(replicas[r])), r);
    std::optional<Handle> particles;
    for (const ReplicaFrames& one : replicas) {
      if (one.frames == nullptr || one.frames->count() == 0) continue;
      if (!particles) particles.emplace(create_group(file, "particles"));
      write_particles(*particles, name(one), strain_rate, *one.frames, extras.walled);
    }
    if (extras.further) extras.further(file);
  });
}

}  // namespace lucy::files
