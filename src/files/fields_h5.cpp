// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/fields_h5.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <string_view>

#include "choice_names.hpp"
#include "hdf5_file.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/csv.hpp"

namespace lucy::files {

namespace {

using hdf5::add_attribute;
using hdf5::create_group;
using hdf5::Handle;

constexpr std::string_view velocity_unit = "(epsilon/m)^(1/2)";
constexpr std::string_view energy_density_unit = "epsilon/sigma^2";

struct Description {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
};

constexpr std::array<Description, 11> descriptions = {{
    {"density", "m/sigma^2", "rho(r) = sum over particles of m w(r - r_j)"},
    {"velocity_smoothed", velocity_unit,
     "laboratory velocity u(r) = sum of m v_j w / rho; v_j, the individual velocities, are in /particles"},
    {"velocity_smoothed_peculiar", velocity_unit,
     "the same without the mean flow: sum of m (v_j - rate y_j e_x) w / rho"},
    {"internal_energy", "epsilon/m", "e(r) = sum of m e_j w / rho, per mass"},
    {"temperature", "epsilon", "kT(rho, e) by the equation of state"},
    {"kinetic_temperature", "epsilon",
     "(<p^2> - <p>^2)/2 with the weights of the density: motion of the particles about the smoothed flow"},
    {"pressure", energy_density_unit,
     "of a fluid: P(rho, e) by the equation of state; of atoms: pressure_kinetic + pressure_potential"},
    {"pressure_kinetic", energy_density_unit, "rho times the kinetic temperature"},
    {"pressure_potential", energy_density_unit,
     "of atoms: rho^2/2, the isentropic fluid as which the sum over pairs can be read"},
    {"kinetic_energy_density_individual", energy_density_unit, "sum of (m p^2/2) w, peculiar velocities of particles"},
    {"kinetic_energy_density_smoothed", energy_density_unit, "rho u^2/2, u the smoothed peculiar velocity"},
}};

Description description_of(std::string_view name) {
  for (const Description& one : descriptions)
    if (one.name == name) return one;
  return {name, "", ""};
}

void describe(hid_t object, std::string_view unit, std::string_view meaning) {
  add_attribute(object, "unit", unit);
  add_attribute(object, "meaning", meaning);
}

void write_described(hid_t parent, const char* name, std::vector<hsize_t> shape, const std::vector<double>& values,
                     std::string_view unit, std::string_view meaning) {
  describe(hdf5::write_dataset(parent, name, shape, values), unit, meaning);
}

void write_provenance(hid_t file, const cases::SavedFields& fields, const FieldsProvenance& provenance) {
  const Handle group = create_group(file, "provenance");
  add_attribute(group, "source", provenance.source);
  add_attribute(group, "replica", provenance.replica);
  add_attribute(group, "frames", static_cast<std::int64_t>(fields.frames));
  add_attribute(group, "first_frame", static_cast<std::int64_t>(provenance.frames.front()));
  add_attribute(group, "frame", static_cast<std::int64_t>(provenance.frames.back()));
  add_attribute(group, "first_time", fields.first_time);
  add_attribute(group, "time", fields.time);
  add_attribute(group, "step", fields.step);
  add_attribute(group, "command", fmt::format("{}", fmt::join(provenance.command_line, " ")));
  add_attribute(group, "version", provenance.version);
  add_attribute(group, "commit", provenance.commit);
}

void write_parameters(hid_t file, const cases::FieldSettings& settings, const cases::SavedFields& fields) {
  const Handle group = create_group(file, "parameters");
  add_attribute(group, "particles", static_cast<std::int64_t>(fields.particles));
  add_attribute(group, "strain_rate", settings.strain_rate);
  add_attribute(group, "kernel", name_of(kernel::weight_names, settings.weight));
  add_attribute(group, "range", settings.range);
  add_attribute(group, "medium", medium_name(settings.medium));
}

void write_grid(hid_t file, const measure::Grid& grid, double offset) {
  const Handle group = create_group(file, "grid");
  const auto extent = [&](int d) { return static_cast<hsize_t>(grid.nodes[static_cast<std::size_t>(d)]); };
  write_described(group, "x", {extent(0)}, grid.axis(0), "sigma", "x of the nodes");
  write_described(group, "y", {extent(1)}, grid.axis(1), "sigma", "y of the nodes");
  add_attribute<double>(group, "edges", grid.lengths);
  add_attribute(group, "offset", offset);
  add_attribute(
      group, "meaning",
      std::string_view("f(x + offset, y + L_y) = f(x, y), f(x + L_x, y) = f(x, y); laboratory velocities gain "
                       "strain_rate L_y along x at every L_y"));
}

void write_fields(hid_t file, const measure::Grid& grid, const std::vector<measure::Field>& fields) {
  const Handle group = create_group(file, "fields");
  for (const measure::Field& field : fields) {
    std::vector<hsize_t> shape = {static_cast<hsize_t>(grid.nodes[1]), static_cast<hsize_t>(grid.nodes[0])};
    if (field.components > 1) shape.push_back(static_cast<hsize_t>(field.components));
    const Description about = description_of(field.name);
    write_described(group, std::string(field.name).c_str(), shape, field.values, about.unit, about.meaning);
  }
}

void write_spectra(hid_t file, const cases::SavedFields& fields) {
  const Handle group = create_group(file, "spectra");
  add_attribute(group, "whole_up_to", fields.spectra_whole_up_to);
  add_attribute(group, "meaning",
                std::string_view("mean over the frames of |f_k|^2, averaged over rings of |k|; the sum of modes times "
                                 "power is the variance of the field on the grid"));
  for (const auto& [name, rings] : fields.spectra) {
    const Handle element = create_group(group, name);
    std::vector<double> wave_number;
    std::vector<double> modes;
    std::vector<double> power;
    double variance = 0.0;
    for (const measure::SpectrumRing& ring : rings) {
      wave_number.push_back(ring.wave_number);
      modes.push_back(ring.modes);
      power.push_back(ring.power);
      variance += ring.modes * ring.power;
    }
    const auto count = static_cast<hsize_t>(rings.size());
    write_described(element, "wave_number", {count}, wave_number, "1/sigma", "mean |k| in the ring");
    write_described(element, "modes", {count}, modes, "1", "wave vectors in the ring, k and -k counted both");
    write_described(element, "power", {count}, power, "square of the field's unit", "mean |f_k|^2 in the ring");
    add_attribute(element, "variance", variance);
  }
}

void write_particles(hid_t file, const cases::SavedFields& fields) {
  if (fields.position.empty()) return;
  const Handle group = create_group(file, "particles");
  const auto count = static_cast<hsize_t>(fields.particles);
  write_described(group, "position", {count, 2}, fields.position, "sigma", "in [0, L)");
  write_described(group, "velocity_individual", {count, 2}, fields.velocity_individual, velocity_unit,
                  "laboratory velocity v_i with which the particle moves");
  write_described(group, "velocity_smoothed", {count, 2}, fields.velocity_smoothed, velocity_unit,
                  "laboratory velocity u(r_i) of the smoothed flow, the particle's own term included");
  write_described(group, "density", {count}, fields.density, "m/sigma^2", "rho(r_i), self term included");
  if (!fields.internal_energy.empty())
    write_described(group, "internal_energy", {count}, fields.internal_energy, "epsilon/m", "e_i per mass");
}

void write_kinetic_energies(hid_t file, const measure::KineticEnergies& energies) {
  const Handle group = create_group(file, "kinetic_energies");
  add_attribute(group, "individual", energies.individual);
  add_attribute(group, "smoothed", energies.smoothed);
  add_attribute(group, "field", energies.field);
  describe(group, "epsilon",
           "per particle, peculiar velocities: mean of v_i^2/2; mean of u(r_i)^2/2; integral of rho u^2/2 over N");
}

}  // namespace

std::string_view medium_name(const measure::Medium& medium) {
  // equation_of_state_names and the variant have one order.
  return medium ? spam::equation_of_state_names[medium->index()].first : "atoms";
}

void write_fields_h5(const std::filesystem::path& path, const cases::FieldSettings& settings,
                     const cases::SavedFields& fields, const FieldsProvenance& provenance) {
  hdf5::write_file(path, [&](hid_t file) {
    write_provenance(file, fields, provenance);
    write_parameters(file, settings, fields);
    write_grid(file, settings.grid, fields.offset);
    write_fields(file, settings.grid, fields.fields);
    write_spectra(file, fields);
    write_particles(file, fields);
    write_kinetic_energies(file, fields.kinetic_energies);
  });
}

void write_spectra_csv(const std::filesystem::path& path, const std::vector<cases::NamedSpectrum>& spectra) {
  std::string text = "field,wave_number,modes,power\n";
  for (const auto& [name, rings] : spectra) {
    for (const measure::SpectrumRing& ring : rings) {
      CsvLine line;
      line.add(std::string_view(name));
      for (const double value : {ring.wave_number, ring.modes, ring.power}) line.add(value);
      text += line.end();
    }
  }
  write_file_atomically(path, text);
}

}  // namespace lucy::files
