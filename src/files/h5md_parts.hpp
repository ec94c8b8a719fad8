// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the H5MD files of all cases have in common. A case writes its point with
//
//     write_point_file(path, authorship, strain_rate, replicas,
//                      [&](hid_t parameters) { add_attribute(parameters, "particles", point.particles); ... },
//                      [&](hid_t group, std::size_t r) { write_samples(group, names, samples of r, pace, ...); ... });
//
// as in h5md.cpp. h5md_reader.hpp says which parameters others look for.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "choice_names.hpp"
#include "hdf5_file.hpp"
#include "lucy/files/frame_spool.hpp"
#include "lucy/files/h5md.hpp"

namespace lucy::files {

/// Step and time of one series: written once, then hard-linked into every element that shares them.
class Clock {
 public:
  Clock(std::vector<std::int64_t> steps, std::vector<double> times)
      : steps_(std::move(steps)), times_(std::move(times)) {}

  hsize_t count() const { return steps_.size(); }
  void put_into(hid_t parent, const std::string& element_name, hid_t element);

 private:
  std::vector<std::int64_t> steps_;
  std::vector<double> times_;
  std::string first_;
};

/// A time-dependent element of H5MD with its `value` written at once; returns its group.
template <class T>
hdf5::Handle write_element(hid_t parent, const std::string& name, Clock& clock, std::span<const hsize_t> shape,
                           const std::vector<T>& values, std::string_view description) {
  hdf5::Handle element = hdf5::create_group(parent, name);
  clock.put_into(parent, name, element);
  hdf5::write_dataset(element, "value", shape, values);
  if (!description.empty()) hdf5::add_attribute(element, "description", description);
  return element;
}

/// The steps of samples at equal distances: the first one `interval` steps after `begin`.
struct Pace {
  std::int64_t begin = 0;
  std::int64_t interval = 1;
  double step = 0.0;  ///< time

  Clock clock(std::size_t samples) const;
};

enum class Samples { averages, instants };

/// One element per entry of a sample, each with its meaning; the group says what kind of samples these are.
template <std::size_t Count>
void write_samples(hid_t group, std::span<const std::string_view> names,
                   std::span<const std::array<double, Count>> samples, const Pace& pace, Samples kind,
                   std::string_view (*meaning)(std::string_view name)) {
  Clock clock = pace.clock(samples.size());
  const std::array<hsize_t, 1> shape = {clock.count()};
  for (std::size_t quantity = 0; quantity < Count; ++quantity) {
    std::vector<double> values(samples.size());
    std::ranges::transform(samples, values.begin(), [&](const auto& sample) { return sample[quantity]; });
    const hdf5::Handle element =
        write_element(group, std::string(names[quantity]), clock, shape, values, meaning(names[quantity]));
    if (kind == Samples::averages) hdf5::add_attribute(element, "averaged_over_steps", pace.interval);
  }
  hdf5::add_attribute(group, "description",
                      kind == Samples::averages
                          ? std::string_view("each value is the average over the steps that end at its step and time")
                          : std::string_view("each value is that of its step and time"));
}

/// One replica: its number from 0, and its frames, if there are any.
struct ReplicaFrames {
  int replica = 0;
  const FrameSpool* frames = nullptr;
};

/// What only some cases have.
struct PointFileExtras {
  std::array<bool, 2> walled{};                  ///< across x and y: walls, so that there are no periodic images
  std::function<void(hid_t file)> further = {};  ///< writes groups of the case's own
};

/// /h5md, /parameters, /observables/replica_01 ... and, where there are frames, /particles/replica_01 ...
/// `parameters` and `observables` fill groups that were made for them. Throws RunFailed with path and reason.
void write_point_file(const std::filesystem::path& path, const H5mdAuthorship& authorship, double strain_rate,
                      std::span<const ReplicaFrames> replicas, const std::function<void(hid_t group)>& parameters,
                      const std::function<void(hid_t group, std::size_t replica)>& observables,
                      const PointFileExtras& extras = {});

}  // namespace lucy::files
