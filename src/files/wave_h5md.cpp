// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/wave_h5md.hpp"

#include <array>
#include <string_view>
#include <vector>

#include "h5md_parts.hpp"
#include "lucy/cases/wave_table.hpp"
#include "lucy/files/wave_input.hpp"

namespace lucy::files {

namespace {

using cases::WavePoint;
using hdf5::add_attribute;

constexpr std::size_t sampled = 6;

/// Every setting by the name of its key; the kernel's as `kernel`. Of atoms, those of fluids are left out.
void write_parameters(hid_t group, const WavePoint& point) {
  for (const auto& bound : wave_point_keys(point.quantity)) {
    const auto value = bound.binding.get(point);
    const bool of_fluids = bound.key.section == "fluid" || bound.key.section == "start";
    if (!value || (of_fluids && point.reading == motion::Reading::md)) continue;
    const std::string name = bound.key.path() == "kernel.name" ? "kernel" : bound.key.name;
    if (const auto* text = std::get_if<std::string>(&*value)) add_attribute(group, name.c_str(), *text);
    if (const auto* number = std::get_if<double>(&*value)) add_attribute(group, name.c_str(), *number);
    if (const auto* integer = std::get_if<std::int64_t>(&*value)) add_attribute(group, name.c_str(), *integer);
  }
  add_attribute(group, "strain_rate", 0.0);
  add_attribute(group, "wave_vector", cases::wave_vector(point));
}

std::string_view meaning(std::string_view name) {
  if (name == "amplitude") return "(2/N) sum of q sin(k y), q the velocity along x or the entropy per mass";
  if (name == "particle_noise") return "kinetic energy per particle beyond that of the wave";
  if (name == "pressure") return "mean over the volume";
  return "part of the rate of the amplitude";
}

void write_observables(hid_t group, const WavePoint& point, const cases::WaveRecord& record) {
  const std::array<std::string_view, sampled> names = {"amplitude",     "particle_noise", "pressure",
                                                       "rate_operator", "rate_rest",      "rate_carried"};
  std::vector<std::array<double, sampled>> samples;
  for (const cases::WaveSample& sample : record.samples)
    samples.push_back({sample.amplitude, sample.particle_noise, sample.pressure, sample.parts[cases::part_operator],
                       sample.parts[cases::part_rest], sample.parts[cases::part_carried]});
  const cases::WaveSchedule schedule = cases::wave_schedule(point);
  write_samples(group, names, std::span<const std::array<double, sampled>>(samples),
                {schedule.equilibration_steps - schedule.steps_per_sample, schedule.steps_per_sample, point.step},
                Samples::instants, meaning);
  add_attribute(group, "steps", record.steps);
  add_attribute(group, "subdivided_steps", record.subdivided_steps);
  add_attribute(group, "worst_energy_error", record.worst_energy_error);
  add_attribute(group, "imposed_amplitude", record.imposed_amplitude);
}

}  // namespace

void write_h5md(const std::filesystem::path& path, const WavePoint& point, std::span<const cases::WaveRecord> replicas,
                std::span<const FrameSpool* const> frames, const H5mdAuthorship& authorship) {
  std::vector<ReplicaFrames> numbered;
  for (std::size_t r = 0; r < frames.size(); ++r) numbered.push_back({static_cast<int>(r), frames[r]});
  write_point_file(
      path, authorship, 0.0, numbered, [&](hid_t group) { write_parameters(group, point); },
      [&](hid_t group, std::size_t r) { write_observables(group, point, replicas[r]); });
}

}  // namespace lucy::files
