// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/h5md_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <system_error>

#include "file_descriptor.hpp"
#include "hdf5_file.hpp"
#include "lucy/errors.hpp"
#include "lucy/space/box.hpp"

namespace lucy::files {

using hdf5::checked;
using hdf5::Handle;

namespace {

bool exists(hid_t place, const std::string& name) { return H5Lexists(place, name.c_str(), H5P_DEFAULT) > 0; }

std::vector<hsize_t> shape_of(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = checked(H5Sget_simple_extent_ndims(space));
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  if (rank > 0) checked(H5Sget_simple_extent_dims(space, shape.data(), nullptr));
  return shape;
}

template <class T>
std::vector<T> read_all(hid_t dataset) {
  hsize_t count = 1;
  for (const hsize_t extent : shape_of(dataset)) count *= extent;
  std::vector<T> values(count);
  checked(H5Dread(dataset, hdf5::memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  return values;
}

/// Entry `index` along the first axis.
std::vector<double> read_entry(hid_t dataset, std::size_t index) {
  std::vector<hsize_t> count = shape_of(dataset);
  std::vector<hsize_t> start(count.size(), 0);
  start[0] = index;
  count[0] = 1;
  const Handle source(H5Dget_space(dataset), H5Sclose);
  checked(H5Sselect_hyperslab(source, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr));
  const Handle target(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
  std::vector<double> values(static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(target))));
  checked(H5Dread(dataset, H5T_NATIVE_DOUBLE, target, source, H5P_DEFAULT, values.data()));
  return values;
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

std::vector<std::string> names_in(hid_t group) {
  std::vector<std::string> names;
  checked(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names));
  return names;
}

void refuse_what_is_no_hdf5(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    throw BadInput(fmt::format("cannot read {}: there is no such file", path.string()));
  if (status.type() != std::filesystem::file_type::regular)
    throw BadInput(fmt::format("cannot read {}: it is no file of numbers but a directory or device", path.string()));
  errno = 0;
  if (const FileDescriptor file(path.string(), O_RDONLY); !file.is_open())
    throw BadInput(fmt::format("cannot read {}: {}", path.string(), system_reason(errno)));
  if (H5Fis_hdf5(path.c_str()) <= 0)
    throw BadInput(
        fmt::format("{} is not an HDF5 file: a point file of Lucy (point_001.h5) is expected", path.string()));
}

}  // namespace

struct H5mdReader::Contents {
  std::filesystem::path path;
  int replica;
  std::optional<Handle> file;
  std::optional<Handle> parameters;
  std::optional<Handle> group;
  std::vector<std::int64_t> steps;
  std::vector<double> times;
  std::int64_t particles = 0;
  bool internal_energies = false;

  Contents(std::filesystem::path where, int number) : path(std::move(where)), replica(number) {}
  ~Contents() {
    const hdf5::Turn turn;
    group.reset();
    parameters.reset();
    file.reset();
  }
  Contents(const Contents&) = delete;
  Contents& operator=(const Contents&) = delete;

  /// What `read` gives; where the library refuses, a sentence about this file.
  template <class Read>
  auto reading(const Read& read) const {
    const hdf5::Turn turn;
    try {
      return read();
    } catch (const hdf5::LibraryFailure& failure) {
      throw BadInput(fmt::format("cannot read {}: {}", path.string(), failure.reason));
    }
  }

  std::string group_name() const { return fmt::format("replica_{:02}", replica); }

  Handle dataset(const std::string& name) const {
    return Handle(H5Dopen2(*group, (name + "/value").c_str(), H5P_DEFAULT), H5Dclose);
  }

  void open() {
    refuse_what_is_no_hdf5(path);
    file.emplace(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!exists(*file, "h5md") || !exists(*file, "parameters"))
      throw BadInput(fmt::format(
          "{} is an HDF5 file but no point file of Lucy (H5MD): it has no groups h5md and parameters", path.string()));
    parameters.emplace(H5Gopen2(*file, "parameters", H5P_DEFAULT), H5Gclose);
    if (!exists(*file, "particles"))
      throw BadInput(fmt::format("{} holds no particles: it was written without output.frame_interval", path.string()));
    const Handle all(H5Gopen2(*file, "particles", H5P_DEFAULT), H5Gclose);
    if (!exists(all, group_name()))
      throw BadInput(fmt::format("{} has no frames of replica {} (frames of: {})", path.string(), replica,
                                 fmt::join(names_in(all), ", ")));
    group.emplace(H5Gopen2(all, group_name().c_str(), H5P_DEFAULT), H5Gclose);
    for (const char* name : {"position", "momentum", "box", "lees_edwards"})
      if (!exists(*group, name))
        throw BadInput(fmt::format("{} was not written by Lucy: its {} has no {}", path.string(), group_name(), name));
    steps = read_all<std::int64_t>(Handle(H5Dopen2(*group, "position/step", H5P_DEFAULT), H5Dclose));
    times = read_all<double>(Handle(H5Dopen2(*group, "position/time", H5P_DEFAULT), H5Dclose));
    internal_energies = exists(*group, "internal_energy");
    const auto shape = shape_of(dataset("position"));
    if (shape.size() == 3) particles = static_cast<std::int64_t>(shape[1]);
    check_shapes();
  }

  void check_shapes() const {
    const auto frames = static_cast<hsize_t>(times.size());
    const auto number = static_cast<hsize_t>(particles);
    const auto has_shape = [&](const std::string& name, const std::vector<hsize_t>& expected) {
      if (shape_of(dataset(name)) == expected) return;
      throw BadInput(fmt::format("{} was not written by Lucy: {} of {} has not the shape ({})", path.string(), name,
                                 group_name(), fmt::join(expected, ", ")));
    };
    if (frames == 0 || steps.size() != times.size() || particles < 1)
      throw BadInput(fmt::format("{} holds no frames of replica {}", path.string(), replica));
    has_shape("position", {frames, number, 2});
    has_shape("momentum", {frames, number, 2});
    has_shape("box/edges", {frames, 2, 2});
    has_shape("lees_edwards/offset", {frames, 1});
    if (internal_energies) has_shape("internal_energy", {frames, number});
  }

  std::optional<Handle> parameter(const std::string& name, H5T_class_t expected, std::string_view what) const {
    if (checked(H5Aexists(*parameters, name.c_str())) == 0) return std::nullopt;
    Handle attribute(H5Aopen(*parameters, name.c_str(), H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    const H5T_class_t kind = H5Tget_class(type);
    const bool fits = expected == H5T_STRING ? kind == H5T_STRING && H5Tis_variable_str(type) == 0
                                             : kind == H5T_FLOAT || kind == H5T_INTEGER;
    const Handle space(H5Aget_space(attribute), H5Sclose);
    if (!fits || H5Sget_simple_extent_npoints(space) != 1)
      throw BadInput(fmt::format("{}: the parameter {} is not {}", path.string(), name, what));
    return attribute;
  }
};

H5mdReader::H5mdReader(const std::filesystem::path& path, int replica)
    : contents_(std::make_unique<Contents>(path, replica)) {
  contents_->reading([&] { contents_->open(); });
}

H5mdReader::~H5mdReader() = default;
H5mdReader::H5mdReader(H5mdReader&&) noexcept = default;
H5mdReader& H5mdReader::operator=(H5mdReader&&) noexcept = default;

std::optional<double> H5mdReader::number(const std::string& name) const {
  return contents_->reading([&]() -> std::optional<double> {
    const auto attribute = contents_->parameter(name, H5T_FLOAT, "a number");
    if (!attribute) return std::nullopt;
    double value = 0.0;
    checked(H5Aread(*attribute, H5T_NATIVE_DOUBLE, &value));
    return value;
  });
}

std::optional<std::string> H5mdReader::word(const std::string& name) const {
  return contents_->reading([&]() -> std::optional<std::string> {
    const auto attribute = contents_->parameter(name, H5T_STRING, "a word");
    if (!attribute) return std::nullopt;
    const Handle type(H5Aget_type(*attribute), H5Tclose);
    std::string text(H5Tget_size(type), '\0');
    checked(H5Aread(*attribute, type, text.data()));
    text.erase(std::min(text.find('\0'), text.size()));
    return text;
  });
}

std::int64_t H5mdReader::particles() const { return contents_->particles; }
bool H5mdReader::has_internal_energies() const { return contents_->internal_energies; }
const std::vector<double>& H5mdReader::times() const { return contents_->times; }

cases::Frame H5mdReader::frame(std::size_t index) const {
  const Contents& contents = *contents_;
  if (index >= contents.times.size())
    throw BadInput(fmt::format("{} has no frame {} of replica {}: it has frames 1 to {}", contents.path.string(),
                               index + 1, contents.replica, contents.times.size()));
  cases::Frame frame;
  contents.reading([&] {
    frame.step = contents.steps[index];
    frame.time = contents.times[index];
    frame.offset = read_entry(contents.dataset("lees_edwards/offset"), index)[0];
    const auto edges = read_entry(contents.dataset("box/edges"), index);  // (L_x, 0), (offset, L_y)
    frame.box = {edges[0], edges[3]};
    frame.position = read_entry(contents.dataset("position"), index);
    frame.momentum = read_entry(contents.dataset("momentum"), index);
    if (contents.internal_energies) frame.internal_energy = read_entry(contents.dataset("internal_energy"), index);
  });
  const auto finite = [](const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
  };
  const auto refuse = [&] {
    throw BadInput(fmt::format("frame {} of replica {} in {} holds values that are no finite numbers", index + 1,
                               contents.replica, contents.path.string()));
  };
  if (!std::isfinite(frame.offset) || !std::isfinite(frame.time) || !(frame.box[0] > 0.0) || !(frame.box[1] > 0.0) ||
      !std::isfinite(frame.box[0] * frame.box[1]) || !finite(frame.position) || !finite(frame.momentum) ||
      !finite(frame.internal_energy))
    refuse();
  const space::Box<2> box(frame.box, 0.0, frame.offset);
  frame.offset = box.offset();
  for (std::size_t i = 0; i < frame.position.size(); i += 2) {
    space::Vector<2> position = {frame.position[i], frame.position[i + 1]};
    box.wrap(position);
    for (int d = 0; d < 2; ++d)  // a number too large to be wrapped is as good as infinite
      if (!(position[d] >= 0.0 && position[d] < frame.box[d])) refuse();
    std::ranges::copy(position, frame.position.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return frame;
}

}  // namespace lucy::files
