// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/h5md.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <array>
#include <cmath>
#include <mutex>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"

namespace lucy::files {

namespace {

/// The library describes a failure from the call that was made down to its cause; the last description is the cause.
herr_t keep_description(unsigned, const H5E_error2_t* error, void* text) {
  if (error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
  return 0;
}

std::string deepest_description() {
  std::string text = "unknown reason";
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_description, &text);
  return text;
}

/// Thrown here, caught in write_h5md, which knows the path.
struct LibraryFailure {
  std::string reason;
};

template <class Result>
Result checked(Result result) {
  if (result < 0) throw LibraryFailure{deepest_description()};
  return result;
}

/// An object of the library, closed at the end of its scope.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(checked(id)), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// The library prints nothing by itself while this lives: what went wrong is told in the exception.
class Quiet {
 public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

template <class T>
hid_t memory_type();
template <>
hid_t memory_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t memory_type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t memory_type<int>() {
  return H5T_NATIVE_INT;
}

template <class T>
hid_t file_type();
template <>
hid_t file_type<double>() {
  return H5T_IEEE_F64LE;
}
template <>
hid_t file_type<std::int64_t>() {
  return H5T_STD_I64LE;
}
template <>
hid_t file_type<int>() {
  return H5T_STD_I32LE;
}

Handle create_group(hid_t parent, const std::string& name) {
  return Handle(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
}

template <class T>
void add_attribute(hid_t object, const char* name, std::span<const T> values) {
  const hsize_t count = values.size();
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Handle attribute(H5Acreate2(object, name, file_type<T>(), space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checked(H5Awrite(attribute, memory_type<T>(), values.data()));
}

template <class T>
requires std::is_arithmetic_v<T>
void add_attribute(hid_t object, const char* name, T value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name, file_type<T>(), space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checked(H5Awrite(attribute, memory_type<T>(), &value));
}

Handle text_type(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  checked(H5Tset_size(type, length));
  checked(H5Tset_strpad(type, H5T_STR_NULLPAD));
  checked(H5Tset_cset(type, H5T_CSET_UTF8));
  return type;
}

void add_attribute(hid_t object, const char* name, std::string_view text) {
  const std::string padded = text.empty() ? std::string(1, '\0') : std::string(text);
  const Handle type = text_type(padded.size());
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checked(H5Awrite(attribute, type, padded.data()));
}

Handle create_dataset(hid_t parent, const char* name, hid_t type, std::span<const hsize_t> shape) {
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  checked(H5Pset_obj_track_times(properties, false));  // the same contents, the same bytes
  return Handle(H5Dcreate2(parent, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
}

template <class T>
void write_dataset(hid_t parent, const char* name, std::span<const hsize_t> shape, const std::vector<T>& values) {
  const Handle dataset = create_dataset(parent, name, file_type<T>(), shape);
  checked(H5Dwrite(dataset, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
}

/// Writes entry `index` along the first axis.
void write_entry(hid_t dataset, std::span<const hsize_t> shape, hsize_t index, const std::vector<double>& values) {
  std::vector<hsize_t> start(shape.size(), 0);
  std::vector<hsize_t> count(shape.begin(), shape.end());
  start[0] = index;
  count[0] = 1;
  const Handle target(H5Dget_space(dataset), H5Sclose);
  checked(H5Sselect_hyperslab(target, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr));
  const Handle source(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
  checked(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, source, target, H5P_DEFAULT, values.data()));
}

/// Step and time of one series: written once, then hard-linked into every element that shares them.
class Clock {
 public:
  Clock(std::vector<std::int64_t> steps, std::vector<double> times)
      : steps_(std::move(steps)), times_(std::move(times)) {}

  hsize_t count() const { return steps_.size(); }

  void put_into(hid_t parent, const std::string& element_name, hid_t element) {
    if (first_.empty()) {
      const std::array<hsize_t, 1> shape = {count()};
      write_dataset(element, "step", shape, steps_);
      write_dataset(element, "time", shape, times_);
      first_ = element_name;
      return;
    }
    for (const char* name : {"step", "time"})
      checked(H5Lcreate_hard(parent, fmt::format("{}/{}", first_, name).c_str(), parent,
                             fmt::format("{}/{}", element_name, name).c_str(), H5P_DEFAULT, H5P_DEFAULT));
  }

 private:
  std::vector<std::int64_t> steps_;
  std::vector<double> times_;
  std::string first_;
};

/// A time-dependent element of H5MD with its `value` written at once; returns its group.
template <class T>
Handle write_element(hid_t parent, const std::string& name, Clock& clock, std::span<const hsize_t> shape,
                     const std::vector<T>& values, std::string_view description) {
  Handle element = create_group(parent, name);
  clock.put_into(parent, name, element);
  write_dataset(element, "value", shape, values);
  if (!description.empty()) add_attribute(element, "description", description);
  return element;
}

template <class Names, class Value>
std::string_view name_of(const Names& names, Value value) {
  for (const auto& [name, known] : names)
    if (known == value) return name;
  return "unknown";
}

/// What every state has, in the order of the attributes.
template <class Point>
void add_state(hid_t group, const Point& point) {
  add_attribute(group, "particles", point.particles);
  add_attribute(group, "energy_per_particle", point.energy_per_particle);
  add_attribute(group, "density", point.density);
  add_attribute(group, "dimension", point.dimension);
  add_attribute(group, "reading", name_of(motion::reading_names, point.reading));
  add_attribute(group, "kernel", point.kernel);
  add_attribute(group, "range", point.range);
}

template <class Point>
void add_run(hid_t group, const Point& point) {
  add_attribute(group, "integrator", name_of(motion::integrator_names, point.integrator));
  add_attribute(group, "step", point.step);
  add_attribute(group, "equilibration", point.equilibration);
  add_attribute(group, "duration", point.duration);
  add_attribute(group, "seed", static_cast<std::int64_t>(point.seed));
}

void write_parameters(hid_t file, const cases::CouettePoint& point) {
  const Handle group = create_group(file, "parameters");
  add_state(group, point);
  add_attribute(group, "strain_rate", point.strain_rate);
  add_attribute(group, "thermostat", name_of(motion::thermostat_names, point.thermostat));
  add_run(group, point);
  if (point.kinetic_temperature) add_attribute(group, "kinetic_temperature", *point.kinetic_temperature);
  if (point.thermostat == motion::Thermostat::nose_hoover)
    add_attribute(group, "relaxation_time", point.relaxation_time);
}

void write_parameters(hid_t file, const cases::GreenKuboPoint& point) {
  const Handle group = create_group(file, "parameters");
  add_state(group, point);
  add_attribute(group, "strain_rate", 0.0);
  add_run(group, point);
  add_attribute(group, "preparation", point.preparation);
  add_attribute(group, "preparation_rate", cases::preparation_rate);
  add_attribute(group, "sample_interval", cases::sample_interval(point));
}

std::string_view meaning(std::string_view observable) {
  if (observable == "potential_energy") return "Phi/N, no self term";
  if (observable == "kinetic_temperature") return "kT = K/(N-1) (two dimensions), peculiar momenta";
  if (observable == "largest_kinetic_share") return "largest K_i over K";
  if (observable == "pressure_kinetic") return "K/V (two dimensions)";
  if (observable == "pressure_potential") return "half the sum over pairs of r . F over V";
  if (observable.ends_with("_kinetic")) return "sum of p p/m over V, peculiar momenta";
  return "sum over pairs of r F over V";
}

/// The steps of samples at equal distances: the first one `interval` steps after `begin`.
struct Pace {
  std::int64_t begin = 0;
  std::int64_t interval = 1;
  double step = 0.0;  ///< time

  Clock clock(std::size_t samples) const {
    std::vector<std::int64_t> steps;
    std::vector<double> times;
    for (std::size_t i = 0; i < samples; ++i) {
      steps.push_back(begin + (static_cast<std::int64_t>(i) + 1) * interval);
      times.push_back(static_cast<double>(steps.back()) * step);
    }
    return {std::move(steps), std::move(times)};
  }
};

enum class Samples { averages, instants };

/// One element per entry of a sample.
template <std::size_t Count>
void write_samples(hid_t group, std::span<const std::string_view> names,
                   std::span<const std::array<double, Count>> samples, const Pace& pace, Samples kind) {
  Clock clock = pace.clock(samples.size());
  const std::array<hsize_t, 1> shape = {clock.count()};
  for (std::size_t quantity = 0; quantity < Count; ++quantity) {
    std::vector<double> values;
    values.reserve(samples.size());
    for (const auto& sample : samples) values.push_back(sample[quantity]);
    const Handle element =
        write_element(group, std::string(names[quantity]), clock, shape, values, meaning(names[quantity]));
    if (kind == Samples::averages) add_attribute(element, "averaged_over_steps", pace.interval);
  }
}

constexpr std::string_view about_averages = "each value is the average over the steps that end at its step and time";
constexpr std::string_view about_instants = "each value is that of its step and time";

void write_observables(hid_t observables, const std::string& name, const cases::CouettePoint& point,
                       const H5mdReplica& replica) {
  const Handle group = create_group(observables, name);
  const cases::CouetteRecord& record = *replica.record;
  const std::int64_t interval = cases::sample_steps(point);
  write_samples(group, cases::observables, std::span(record.samples),
                {replica.equilibration_intervals * interval, interval, point.step}, Samples::averages);
  add_attribute(group, "description", about_averages);
  add_attribute(group, "steps", record.steps);
  add_attribute(group, "subdivided_steps", record.subdivided_steps);
  add_attribute(group, "worst_energy_error", record.worst_energy_error);
  add_attribute(group, "energy_rescaled", record.energy_rescaled);
}

void write_observables(hid_t observables, const std::string& name, const cases::GreenKuboPoint& point,
                       const H5mdGreenKuboReplica& replica) {
  const Handle group = create_group(observables, name);
  const cases::GreenKuboRecord& record = *replica.record;
  write_samples(group, cases::equilibrium_observables, std::span(record.samples),
                {replica.first_recorded_step, cases::interval_steps(point), point.step}, Samples::instants);
  add_attribute(group, "description", about_instants);
  add_attribute(group, "steps", record.steps);
  add_attribute(group, "subdivided_steps", record.subdivided_steps);
  add_attribute(group, "energy_drift", record.energy_drift);
  add_attribute(group, "largest_energy_error", record.largest_energy_error);
  if (replica.series.empty()) return;
  const Handle stress = create_group(group, "stress");
  write_samples(stress, cases::sampled_quantities, replica.series,
                {replica.first_recorded_step, std::llround(cases::sample_interval(point) / point.step), point.step},
                Samples::instants);
  add_attribute(stress, "description", about_instants);
}

void write_particles(hid_t particles, const std::string& name, double strain_rate, const FrameSpool& frames) {
  const Handle group = create_group(particles, name);
  const auto count = static_cast<hsize_t>(frames.count());
  std::vector<std::int64_t> steps;
  std::vector<double> times;
  std::vector<double> edges;
  std::vector<double> offsets;

  // One frame in memory at a time; what is small is gathered for the elements that follow.
  const std::array<hsize_t, 3> shape = {count, static_cast<hsize_t>(frames.particles()), 2};
  const Handle position = create_group(group, "position");
  const Handle velocity = create_group(group, "velocity");
  const Handle momentum = create_group(group, "momentum");
  const Handle position_value = create_dataset(position, "value", H5T_IEEE_F64LE, shape);
  const Handle velocity_value = create_dataset(velocity, "value", H5T_IEEE_F64LE, shape);
  const Handle momentum_value = create_dataset(momentum, "value", H5T_IEEE_F64LE, shape);
  for (hsize_t index = 0; index < count; ++index) {
    const cases::Frame frame = frames.read(static_cast<std::int64_t>(index));
    std::vector<double> laboratory = frame.momentum;  // m = 1
    for (std::size_t i = 0; i < laboratory.size(); i += 2) laboratory[i] += strain_rate * frame.position[i + 1];
    write_entry(position_value, shape, index, frame.position);
    write_entry(velocity_value, shape, index, laboratory);
    write_entry(momentum_value, shape, index, frame.momentum);
    steps.push_back(frame.step);
    times.push_back(frame.time);
    edges.insert(edges.end(), {frame.box[0], 0.0, frame.offset, frame.box[1]});
    offsets.push_back(frame.offset);
  }
  add_attribute(velocity, "description", "laboratory velocity: peculiar momentum / m + strain_rate y e_x");
  add_attribute(momentum, "description", "peculiar momentum, relative to the flow strain_rate y e_x");

  Clock clock(std::move(steps), std::move(times));
  clock.put_into(group, "position", position);
  clock.put_into(group, "velocity", velocity);
  clock.put_into(group, "momentum", momentum);

  const Handle box = create_group(group, "box");
  add_attribute(box, "dimension", 2);
  const Handle boundary_type = text_type(8);
  const hsize_t two = 2;
  const Handle boundary_space(H5Screate_simple(1, &two, nullptr), H5Sclose);
  const Handle boundary(H5Acreate2(box, "boundary", boundary_type, boundary_space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checked(H5Awrite(boundary, boundary_type, "periodicperiodic"));
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

double strain_rate_of(const cases::CouettePoint& point) { return point.strain_rate; }
double strain_rate_of(const cases::GreenKuboPoint&) { return 0.0; }

template <class Point, class Replica>
void write_contents(hid_t file, const Point& point, std::span<const Replica> replicas,
                    const H5mdAuthorship& authorship) {
  const Handle root = create_group(file, "h5md");
  add_attribute<int>(root, "version", std::array<int, 2>{1, 1});
  const Handle author = create_group(root, "author");
  add_attribute(author, "name", authorship.author);
  const Handle creator = create_group(root, "creator");
  add_attribute(creator, "name", authorship.creator);
  add_attribute(creator, "version", authorship.creator_version);
  write_parameters(file, point);

  const Handle observables = create_group(file, "observables");
  bool with_frames = false;
  for (const Replica& replica : replicas) {
    write_observables(observables, fmt::format("replica_{:02}", replica.replica + 1), point, replica);
    with_frames = with_frames || (replica.frames != nullptr && replica.frames->count() > 0);
  }
  if (!with_frames) return;
  const Handle particles = create_group(file, "particles");
  for (const Replica& replica : replicas)
    if (replica.frames != nullptr && replica.frames->count() > 0)
      write_particles(particles, fmt::format("replica_{:02}", replica.replica + 1), strain_rate_of(point),
                      *replica.frames);
}

/// The finished file as it would stand on disk, handed to `use` while the library holds it.
template <class Write, class Use>
void with_file_image(const Write& write, const Use& use) {
  constexpr std::size_t growth = std::size_t{1} << 20;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  checked(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG));
  checked(H5Pset_fapl_core(access, growth, false));
  const Handle file(H5Fcreate("in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  write(file);
  checked(H5Fflush(file, H5F_SCOPE_GLOBAL));
  const auto size = static_cast<std::size_t>(checked(H5Fget_file_image(file, nullptr, 0)));
  void* image = nullptr;
  checked(H5Fget_vfd_handle(file, H5P_DEFAULT, &image));
  use(std::span(*static_cast<const std::byte* const*>(image), size));
}

/// The library has one state for the whole process, and Debian's build of it is not meant for two threads at once.
std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

template <class Point, class Replica>
void write_file(const std::filesystem::path& path, const Point& point, std::span<const Replica> replicas,
                const H5mdAuthorship& authorship) {
  const std::scoped_lock turn(library_mutex());
  const Quiet quiet;
  try {
    // Made in memory and written here: the library itself does not survive a disk that refuses.
    const auto write = [&](hid_t file) { write_contents(file, point, replicas, authorship); };
    with_file_image(write, [&path](std::span<const std::byte> image) {
      const std::array<std::span<const std::byte>, 1> pieces = {image};
      write_file_atomically(path, pieces);
    });
  } catch (const LibraryFailure& failure) {
    throw RunFailed(fmt::format("cannot write {}: {}", path.string(), failure.reason));
  }
}

}  // namespace

void write_h5md(const std::filesystem::path& path, const cases::CouettePoint& point,
                std::span<const H5mdReplica> replicas, const H5mdAuthorship& authorship) {
  write_file(path, point, replicas, authorship);
}

void write_h5md(const std::filesystem::path& path, const cases::GreenKuboPoint& point,
                std::span<const H5mdGreenKuboReplica> replicas, const H5mdAuthorship& authorship) {
  write_file(path, point, replicas, authorship);
}

}  // namespace lucy::files
