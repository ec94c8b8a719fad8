// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/benard_h5md.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "benard_fields_h5.hpp"
#include "h5md_parts.hpp"
#include "lucy/cases/benard_table.hpp"
#include "lucy/files/benard_input.hpp"

namespace lucy::files {

namespace {

using cases::BenardPoint;
using cases::BenardRecord;
using hdf5::add_attribute;

std::string_view meaning(std::string_view observable) {
  if (observable == "kinetic_energy_total") return "mean of v^2/2 over the particles";
  if (observable == "conduction_hot") return "heat per time from the floor, over that through the fluid at rest";
  if (observable == "work_hot") return "work per time of the floor, in the same unit";
  if (observable == "conduction_cold") return "heat per time from the ceiling, into the fluid, in the same unit";
  if (observable == "work_cold") return "work per time of the ceiling, in the same unit";
  if (observable == "conduction_sides") return "heat per time from side walls, in the same unit";
  if (observable == "work_sides") return "work per time of side walls, in the same unit";
  if (observable == "stored") return "what the total energy grows by per time, in the same unit";
  if (observable == "kinetic_energy_smoothed") return "mean of u^2/2 over the particles, u the smoothed velocity";
  if (observable == "internal_energy") return "sum of e over N";
  if (observable == "total_energy") return "internal, kinetic and that in gravity's field, over N";
  if (observable == "roll_amplitude") return "velocities projected on the pattern of the start";
  if (observable == "density_least") return "of any particle";
  if (observable == "density_largest") return "of any particle";
  if (observable == "temperature_least") return "of any particle";
  if (observable == "temperature_largest") return "of any particle";
  return "";
}

/// Every setting by the name of its key, resolved; the weight function's as `kernel`.
void write_parameters(hid_t group, const BenardPoint& point) {
  for (const auto& bound : benard_keys()) {
    const auto value = bound.binding.get(point);
    if (!value) continue;
    const std::string name = bound.key.path() == "kernel.name" ? "kernel" : bound.key.name;
    if (const auto* text = std::get_if<std::string>(&*value)) add_attribute(group, name.c_str(), *text);
    if (const auto* number = std::get_if<double>(&*value)) add_attribute(group, name.c_str(), *number);
    if (const auto* integer = std::get_if<std::int64_t>(&*value)) add_attribute(group, name.c_str(), *integer);
  }
}

double time_of_equilibration(const BenardPoint& point) {
  return static_cast<double>(cases::equilibration_intervals(point) * cases::sample_steps(point)) * point.step;
}

void write_observables(hid_t group, const BenardPoint& point, const BenardRecord& record) {
  const Pace pace = {0, cases::sample_steps(point), point.step};
  std::vector<std::array<double, cases::benard_averages.size()>> averages;
  std::vector<std::array<double, cases::benard_instants.size()>> instants;
  for (const cases::BenardSample& sample : record.samples) {
    averages.push_back(sample.averages);
    instants.push_back(sample.instants);
  }
  write_samples(group, cases::benard_averages, std::span(std::as_const(averages)), pace, Samples::averages, meaning);
  write_samples(hdf5::create_group(group, "instants"), cases::benard_instants, std::span(std::as_const(instants)), pace,
                Samples::instants, meaning);
  add_attribute(group, "averaged_from", time_of_equilibration(point));
  add_attribute(group, "steps", record.steps);
  add_attribute(group, "subdivided_steps", record.subdivided_steps);
  add_attribute(group, "reflections", record.reflections);
  add_attribute(group, "worst_energy_error", record.worst_energy_error);
  add_attribute(group, "energy_drift", record.energy_drift);
  if (!record.failure.empty()) add_attribute(group, "failure", record.failure);
}

/// Samples that the fields of the replica that got farthest are averaged over.
double averaged_samples(std::span<const BenardRecord> records) {
  double most = 0.0;
  for (const BenardRecord& record : records) {
    double samples = 0.0;
    for (const double count : record.block_samples) samples += count;
    most = std::max(most, samples);
  }
  return most;
}

void write_fields(hid_t file, const BenardPoint& point, std::span<const BenardRecord> records) {
  using M = measure::Moments<2>;
  const double samples = averaged_samples(records);
  if (samples == 0.0) return;
  const cases::FieldCells cells = cases::field_cells(point);
  std::array<std::vector<double>, 2> centres;
  for (int axis = 0; axis < 2; ++axis)
    for (int index = 0; index < cells.cells[axis]; ++index)
      centres[axis].push_back(cells.centre(axis, index) - 0.5 * cells.lengths[axis]);
  write_grid(file, centres[0], centres[1], "centres of the cells");

  const M moments = cases::averaged_moments(point, records);
  const auto& density = moments.column[M::density];
  const auto per_mass = [&](int column) {
    std::vector<double> values(density.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t k = 0; k < density.size(); ++k)
      if (density[k] > 0.0) values[k] = moments.column[static_cast<std::size_t>(column)][k] / density[k];
    return values;
  };
  const std::vector<double> energy = per_mass(M::energy);
  const auto by_state = [&](const auto& function) {
    std::vector<double> values(density.size());
    std::visit(
        [&](const auto& state) {
          for (std::size_t k = 0; k < density.size(); ++k) values[k] = function(state, density[k], energy[k]);
        },
        spam::make_equation_of_state(point.equation_of_state));
    return values;
  };
  const hdf5::Handle group = hdf5::create_group(file, "fields");
  const double begin = time_of_equilibration(point);
  add_attribute(group, "time_from", begin);
  add_attribute(group, "time_to", begin + samples * cases::sample_steps(point) * point.step);
  const std::vector<hsize_t> shape = {centres[1].size(), centres[0].size()};
  write_column(group, "density", shape, density, "m/sigma^2", "average over time");
  write_column(group, "temperature", shape,
               by_state([](const auto& state, double rho, double e) { return state.temperature(rho, e); }), "epsilon",
               "kT of the averages of density and energy");
  write_column(group, "velocity_x", shape, per_mass(M::momentum), "(epsilon/m)^(1/2)",
               "average of rho v_x over that of rho");
  write_column(group, "velocity_y", shape, per_mass(M::momentum + 1), "(epsilon/m)^(1/2)",
               "average of rho v_y over that of rho");
  write_column(group, "internal_energy", shape, energy, "epsilon/m", "average of rho e over that of rho");
  write_column(group, "pressure", shape,
               by_state([](const auto& state, double rho, double e) { return state.pressure(rho, e); }),
               "epsilon/sigma^2", "P of the averages of density and energy");
}

void write_last(hid_t file, const BenardPoint& point, const cases::BenardParticles& last) {
  if (last.position.empty()) return;
  const hdf5::Handle group = hdf5::create_group(file, "last");
  add_attribute(group, "time", last.time);
  std::vector<double> position = last.position;
  for (std::size_t i = 0; i < position.size(); i += 2) {
    position[i] -= 0.5 * point.width.value();
    position[i + 1] -= 0.5 * point.height;
  }
  const hsize_t count = last.density.size();
  write_column(group, "position", {count, 2}, position, "sigma", "from the middle of the cell");
  write_column(group, "velocity", {count, 2}, last.velocity, "(epsilon/m)^(1/2)", "of each particle");
  write_column(group, "velocity_smoothed", {count, 2}, last.velocity_smoothed, "(epsilon/m)^(1/2)",
               "weighted mean of the neighbours', walls among them");
  write_column(group, "density", {count}, last.density, "m/sigma^2", "at each particle");
  write_column(group, "temperature", {count}, last.temperature, "epsilon", "kT of each particle");
}

}  // namespace

void write_h5md(const std::filesystem::path& path, const BenardPoint& unresolved, std::span<const BenardRecord> records,
                std::span<const FrameSpool* const> frames, const cases::BenardParticles& last,
                const H5mdAuthorship& authorship) {
  const BenardPoint point = cases::resolved(unresolved);
  std::vector<ReplicaFrames> numbered;
  for (std::size_t r = 0; r < frames.size(); ++r) numbered.push_back({static_cast<int>(r), frames[r]});
  const PointFileExtras extras = {{point.sides == grid::Sides::walls, true}, [&](hid_t file) {
                                    write_fields(file, point, records);
                                    write_last(file, point, last);
                                  }};
  write_point_file(
      path, authorship, 0.0, numbered, [&](hid_t group) { write_parameters(group, point); },
      [&](hid_t group, std::size_t r) { write_observables(group, point, records[r]); }, extras);
}

}  // namespace lucy::files
