// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/shear_flow_h5md.hpp"

#include <string_view>
#include <utility>
#include <vector>

#include "fluid_parameters.hpp"
#include "h5md_parts.hpp"

namespace lucy::files {

namespace {

std::string_view meaning(std::string_view observable) {
  if (observable == "kinetic_temperature") return "kT = K/(N-1) of the peculiar velocities";
  if (observable == "internal_energy") return "sum of e over N";
  if (observable == "pxy_carried") return "sum of p_x p_y over V";
  if (observable == "pxy_newtonian") return "sum of -eta (dv_x/dy + dv_y/dx)/rho over V";
  if (observable == "pxy_pressure") return "sum over pairs of f_x y over V, less pxy_newtonian";
  if (observable == "work") return "-rate P_xy V/N: power of the flow";
  if (observable == "heating") return "mean of de/dt by the fluid's own equations";
  if (observable == "heat_removed") return "chi sum of e over N: power of the thermostat";
  if (observable == "temperature") return "mean over the particles";
  if (observable == "pressure") return "sum of P_eq/rho over V";
  if (observable == "velocity_gradient") return "mean over the particles of dv_x/dy";
  if (observable == "density_wave") return "|(2/N) sum exp(2 pi i y/L_y)|";
  if (observable == "entropy_viscosity") return "entropy production by viscosity, mean over the particles";
  if (observable == "entropy_conduction") return "entropy production by conduction, mean over the particles";
  if (observable == "entropy_removed") return "chi e/T, mean over the particles";
  if (observable == "least_entropy_production") return "entropy production of the particle that has least";
  return "";
}

void write_parameters(hid_t group, const cases::ShearFlowPoint& point) {
  using hdf5::add_attribute;
  add_fluid(group, point);
  add_attribute(group, "strain_rate", point.strain_rate);
  add_attribute(group, "cooling", name_of(motion::cooling_names, point.cooling));
}

void write_observables(hid_t group, const cases::ShearFlowPoint& point, const cases::ShearFlowRecord& record) {
  using hdf5::add_attribute;
  const std::int64_t interval = cases::sample_steps(point);
  const Pace pace = {cases::equilibration_intervals(point) * interval, interval, point.step};
  std::vector<std::array<double, cases::shear_flow_averages.size()>> averages;
  std::vector<std::array<double, cases::shear_flow_instants.size()>> instants;
  for (const cases::ShearFlowSample& sample : record.samples) {
    averages.push_back(sample.averages);
    instants.push_back(sample.instants);
  }
  write_samples(group, cases::shear_flow_averages, std::span(std::as_const(averages)), pace, Samples::averages,
                meaning);
  write_samples(hdf5::create_group(group, "instants"), cases::shear_flow_instants, std::span(std::as_const(instants)),
                pace, Samples::instants, meaning);
  add_attribute(group, "steps", record.steps);
  add_attribute(group, "subdivided_steps", record.subdivided_steps);
  add_attribute(group, "worst_energy_error", record.worst_energy_error);
  add_attribute(group, "energy_drift", record.energy_drift);
}

}  // namespace

void write_h5md(const std::filesystem::path& path, const cases::ShearFlowPoint& point,
                std::span<const H5mdShearFlowReplica> replicas, const H5mdAuthorship& authorship) {
  std::vector<ReplicaFrames> frames;
  for (const H5mdShearFlowReplica& replica : replicas) frames.push_back({replica.replica, replica.frames});
  write_point_file(
      path, authorship, point.strain_rate, frames, [&](hid_t group) { write_parameters(group, point); },
      [&](hid_t group, std::size_t r) { write_observables(group, point, *replicas[r].record); });
}

}  // namespace lucy::files
