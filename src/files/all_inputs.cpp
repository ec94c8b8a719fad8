// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/all_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "lucy/errors.hpp"
#include "lucy/files/benard_grid_input.hpp"
#include "lucy/files/benard_input.hpp"
#include "lucy/files/green_kubo_input.hpp"
#include "lucy/files/input.hpp"
#include "lucy/files/isomorphism_input.hpp"
#include "lucy/files/shear_flow_input.hpp"
#include "lucy/files/wave_input.hpp"

namespace lucy::files {
namespace {

/// The section that a key of a [[point]] table is of, in the input of whatever command: itself, if it is a section.
std::set<std::string> sections_of_row_key(const std::string& name) {
  std::set<std::string> sections;
  for (const auto& [command, kind] : command_names)
    for (const Key& key : schema_of(kind).keys)
      if (key.name == name || key.section == name) sections.insert(key.section);
  return sections;
}

InputKind kind_of_wave(const std::filesystem::path& file, std::span<const std::string> overrides) {
  std::string shear_refused;
  std::string temperature_refused;
  const auto try_to_read = [&](cases::WaveQuantity quantity, std::string& refused) {
    try {
      read_wave(quantity, file, overrides);
    } catch (const BadInput& refusal) {
      refused = refusal.what();
    }
  };
  try_to_read(cases::WaveQuantity::shear, shear_refused);
  try_to_read(cases::WaveQuantity::temperature, temperature_refused);
  if (shear_refused.empty() && temperature_refused.empty())
    throw BadInput(
        fmt::format("{}: is an input both of `lucy shear-wave` and of `lucy temperature-wave`; say which with --for "
                    "shear-wave or --for temperature-wave",
                    file.string()));
  // Where both refuse, the sentence on shear waves is as good: they have all the keys of temperature waves.
  if (!shear_refused.empty() && !temperature_refused.empty()) throw BadInput(shear_refused);
  return shear_refused.empty() ? InputKind::shear_wave : InputKind::temperature_wave;
}

}  // namespace

Schema schema_of(InputKind kind) {
  switch (kind) {
    case InputKind::sweep:
      return sweep_schema();
    case InputKind::green_kubo:
      return green_kubo_schema();
    case InputKind::isomorphism:
      return isomorphism_schema();
    case InputKind::shear_flow:
      return shear_flow_schema();
    case InputKind::shear_wave:
      return wave_schema(cases::WaveQuantity::shear);
    case InputKind::benard:
      return benard_schema();
    case InputKind::benard_grid:
      return benard_grid_schema();
    case InputKind::temperature_wave:
      break;
  }
  return wave_schema(cases::WaveQuantity::temperature);
}

std::vector<std::string> commands_with(std::string_view section, std::string_view name) {
  std::vector<std::string> commands;
  for (const auto& [command, kind] : command_names) {
    const Schema schema = schema_of(kind);
    const bool has = std::ranges::any_of(schema.keys, [&](const Key& key) {
      return (section.empty() || key.section == section) && (name.empty() || key.name == name);
    });
    if (has) commands.emplace_back(command);
  }
  return commands;
}

InputKind kind_of_input(const std::filesystem::path& file, std::span<const std::string> overrides) {
  Outline written = outline_of(file, "point");
  for (const std::string& override : overrides) written.sections.insert(override.substr(0, override.find('.')));
  for (const std::string& key : written.row_keys) written.sections.merge(sections_of_row_key(key));
  const auto has = [&](const char* section) { return written.sections.contains(section); };
  if (has("cell") || has("grid")) return has("system") ? InputKind::benard : InputKind::benard_grid;
  if (has("isentropic")) return InputKind::isomorphism;
  const bool of_fluid = has("fluid") || has("start");
  if (has("wave") || (of_fluid && !has("shear"))) return kind_of_wave(file, overrides);
  if (of_fluid) return InputKind::shear_flow;
  return has("shear") && !has("correlation") ? InputKind::sweep : InputKind::green_kubo;
}

}  // namespace lucy::files
