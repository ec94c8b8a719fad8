// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/viscosities_csv.hpp"

#include <string>
#include <string_view>

#include "lucy/files/atomic_file.hpp"
#include "lucy/files/csv.hpp"

namespace lucy::files {

namespace {

/// A sentence as one cell.
std::string quoted_cell(std::string_view text) {
  if (text.empty()) return "";
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + '"';
}

/// A line that starts with what names a state.
CsvLine line_of(const cases::SideBySide& state) {
  CsvLine line;
  line.add(state.particles);
  line.add(state.energy_per_particle);
  return line;
}

}  // namespace

void write_viscosities_csv(const std::filesystem::path& path, std::span<const cases::SideBySide> states) {
  std::string text = "particles,energy_per_particle,route,viscosity,viscosity_error,z,note\n";
  for (const cases::SideBySide& state : states)
    for (const cases::Route& route : state.routes) {
      CsvLine line = line_of(state);
      line.add(route.name);
      line.add(route.value);
      line.add(route.error);
      line.add(route.z);
      line.add(quoted_cell(route.note));
      text += line.end();
    }
  write_file_atomically(path, text);
}

void write_sweep_fit_csv(const std::filesystem::path& path, std::span<const cases::SideBySide> states) {
  std::string text =
      "particles,energy_per_particle,strain_rate,viscosity,viscosity_error,part,eta_0,eta_0_error,eta_2,eta_2_error,"
      "eta_covariance\n";
  for (const cases::SideBySide& state : states)
    for (std::size_t i = 0; i < state.sweep.size(); ++i) {
      const auto& viscosity = state.sweep[i].estimates[cases::quantity("viscosity")];
      CsvLine line = line_of(state);
      line.add(state.sweep[i].strain_rate);
      line.add(viscosity.value);
      line.add(viscosity.error);
      line.add(cases::fit_part_name(state.fit.parts[i]));
      line.add(state.fit.viscosity.value);
      line.add(state.fit.fit_error);
      line.add(state.fit.curvature);
      line.add(state.fit.curvature_error);
      line.add(state.fit.covariance);
      text += line.end();
    }
  write_file_atomically(path, text);
}

void write_nemd_csv(const std::filesystem::path& path, std::span<const cases::SideBySide> states) {
  std::string text = "particles,energy_per_particle,viscosity,viscosity_error\n";
  for (const cases::SideBySide& state : states) {
    CsvLine line = line_of(state);
    line.add(state.fit.viscosity.value);
    line.add(state.fit.viscosity.error);
    text += line.end();
  }
  write_file_atomically(path, text);
}

}  // namespace lucy::files
