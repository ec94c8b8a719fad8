// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/benard_grid_h5.hpp"

#include <array>
#include <cstdint>
#include <vector>

#include "benard_fields_h5.hpp"
#include "choice_names.hpp"
#include "hdf5_file.hpp"

namespace lucy::files {

namespace {

using cases::BenardGridSample;
using hdf5::add_attribute;
using hdf5::create_group;

struct Quantity {
  const char* name;
  double BenardGridSample::*member;
  std::string_view unit;
  std::string_view meaning;
};
constexpr std::array<Quantity, 8> quantities = {{
    {"time", &BenardGridSample::time, "sigma (m/epsilon)^(1/2)", "since the start"},
    {"kinetic_energy", &BenardGridSample::kinetic_energy, "epsilon/m", "of the flow, per mass"},
    {"nusselt_hot", &BenardGridSample::nusselt_hot, "1", "heat into the fluid by the floor, over that at rest"},
    {"nusselt_cold", &BenardGridSample::nusselt_cold, "1", "heat out of the fluid by the ceiling, over that at rest"},
    {"nusselt_sides", &BenardGridSample::nusselt_sides, "1", "heat into the fluid by side walls, over that at rest"},
    {"largest_speed", &BenardGridSample::largest_speed, "(epsilon/m)^(1/2)", "at any node"},
    {"roll_amplitude", &BenardGridSample::roll_amplitude, "(epsilon/m)^(1/2)",
     "v_y projected on its pattern at the start"},
    {"mass_error", &BenardGridSample::mass_error, "1", "relative change of the mass since the start"},
}};

void write_parameters(hid_t file, const cases::BenardGridPoint& point) {
  const hdf5::Handle group = create_group(file, "parameters");
  const cases::BenardGridPoint all = cases::resolved(point);
  add_attribute(group, "find", name_of(cases::benard_goal_names, all.find));
  add_attribute(group, "equation_of_state", name_of(cases::benard_fluid_names, all.equation_of_state));
  add_attribute(group, "transport", name_of(grid::transport_names, all.transport));
  add_attribute(group, "side", name_of(grid::sides_names, all.sides));
  add_attribute(group, "cells", all.cells);
  add_attribute(group, "height", all.height);
  add_attribute(group, "width", all.width.value());
  add_attribute(group, "hot", all.hot);
  add_attribute(group, "cold", all.cold);
  add_attribute(group, "gravity", all.gravity.value());
  add_attribute(group, "rayleigh", all.rayleigh.value());
  add_attribute(group, "viscosity", all.viscosity.value());
  add_attribute(group, "conductivity", all.conductivity.value());
  add_attribute(group, "roll_velocity", all.roll_velocity.value());
  add_attribute(group, "step", all.step.value());
}

}  // namespace

void write_benard_grid_h5(const std::filesystem::path& path, const cases::BenardGridPoint& point,
                          const cases::BenardGridRecord& record, std::string_view program) {
  hdf5::write_file(path, [&](hid_t file) {
    add_attribute(file, "program", program);
    write_parameters(file, point);
    {
      const hdf5::Handle group = create_group(file, "history");
      for (const Quantity& quantity : quantities) {
        std::vector<double> values;
        for (const BenardGridSample& sample : record.samples) values.push_back(sample.*quantity.member);
        write_column(group, quantity.name, {values.size()}, values, quantity.unit, quantity.meaning);
      }
    }
    const grid::Flow::Fields& fields = record.fields;
    write_grid(file, fields.x, fields.y, "nodes");
    const hdf5::Handle group = create_group(file, "fields");
    add_attribute(group, "time", record.samples.back().time);
    const std::vector<hsize_t> shape = {fields.y.size(), fields.x.size()};
    write_column(group, "density", shape, fields.density, "m/sigma^2", "mean of the cells around the node");
    write_column(group, "temperature", shape, fields.temperature, "epsilon", "kT");
    write_column(group, "velocity_x", shape, fields.velocity_x, "(epsilon/m)^(1/2)", "v_x");
    write_column(group, "velocity_y", shape, fields.velocity_y, "(epsilon/m)^(1/2)", "v_y");
  });
}

}  // namespace lucy::files
