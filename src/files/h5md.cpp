// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/h5md.hpp"

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "h5md_parts.hpp"
#include "lucy/motion/settings.hpp"

namespace lucy::files {

namespace {

using hdf5::add_attribute;

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

void write_parameters(hid_t group, const cases::CouettePoint& point) {
  add_state(group, point);
  add_attribute(group, "strain_rate", point.strain_rate);
  add_attribute(group, "thermostat", name_of(motion::thermostat_names, point.thermostat));
  add_run(group, point);
  if (point.kinetic_temperature) add_attribute(group, "kinetic_temperature", *point.kinetic_temperature);
  if (point.thermostat == motion::Thermostat::nose_hoover)
    add_attribute(group, "relaxation_time", point.relaxation_time);
}

void write_parameters(hid_t group, const cases::GreenKuboPoint& point) {
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

void write_observables(hid_t group, const cases::CouettePoint& point, const H5mdReplica& replica) {
  const cases::CouetteRecord& record = *replica.record;
  const std::int64_t interval = cases::sample_steps(point);
  write_samples(group, cases::observables, std::span(record.samples),
                {replica.equilibration_intervals * interval, interval, point.step}, Samples::averages, meaning);
  add_attribute(group, "steps", record.steps);
  add_attribute(group, "subdivided_steps", record.subdivided_steps);
  add_attribute(group, "worst_energy_error", record.worst_energy_error);
  add_attribute(group, "energy_rescaled", record.energy_rescaled);
}

void write_observables(hid_t group, const cases::GreenKuboPoint& point, const H5mdGreenKuboReplica& replica) {
  const cases::GreenKuboRecord& record = *replica.record;
  write_samples(group, cases::equilibrium_observables, std::span(record.samples),
                {replica.first_recorded_step, cases::interval_steps(point), point.step}, Samples::instants, meaning);
  add_attribute(group, "steps", record.steps);
  add_attribute(group, "subdivided_steps", record.subdivided_steps);
  add_attribute(group, "energy_drift", record.energy_drift);
  add_attribute(group, "largest_energy_error", record.largest_energy_error);
  if (replica.series.empty()) return;
  write_samples(hdf5::create_group(group, "stress"), cases::sampled_quantities, replica.series,
                {replica.first_recorded_step, std::llround(cases::sample_interval(point) / point.step), point.step},
                Samples::instants, meaning);
}

double strain_rate_of(const cases::CouettePoint& point) { return point.strain_rate; }
double strain_rate_of(const cases::GreenKuboPoint&) { return 0.0; }

template <class Point, class Replica>
void write_point(const std::filesystem::path& path, const Point& point, std::span<const Replica> replicas,
                 const H5mdAuthorship& authorship) {
  std::vector<ReplicaFrames> frames;
  for (const Replica& replica : replicas) frames.push_back({replica.replica, replica.frames});
  write_point_file(
      path, authorship, strain_rate_of(point), frames, [&](hid_t group) { write_parameters(group, point); },
      [&](hid_t group, std::size_t r) { write_observables(group, point, replicas[r]); });
}

}  // namespace

void write_h5md(const std::filesystem::path& path, const cases::CouettePoint& point,
                std::span<const H5mdReplica> replicas, const H5mdAuthorship& authorship) {
  write_point(path, point, replicas, authorship);
}

void write_h5md(const std::filesystem::path& path, const cases::GreenKuboPoint& point,
                std::span<const H5mdGreenKuboReplica> replicas, const H5mdAuthorship& authorship) {
  write_point(path, point, replicas, authorship);
}

}  // namespace lucy::files
