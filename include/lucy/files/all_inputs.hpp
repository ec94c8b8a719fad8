// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// All commands that read an input file, and whose input a file is.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lucy/files/schema.hpp"

namespace lucy::files {

/// The commands that read an input file.
enum class InputKind { sweep, green_kubo, isomorphism, shear_flow, shear_wave, temperature_wave, benard, benard_grid };

/// As typed.
inline constexpr std::array<std::pair<std::string_view, InputKind>, 8> command_names = {
    {{"sweep", InputKind::sweep},
     {"green-kubo", InputKind::green_kubo},
     {"isomorphism", InputKind::isomorphism},
     {"shear-flow", InputKind::shear_flow},
     {"shear-wave", InputKind::shear_wave},
     {"temperature-wave", InputKind::temperature_wave},
     {"benard", InputKind::benard},
     {"benard-grid", InputKind::benard_grid}}};

Schema schema_of(InputKind kind);

/// The commands whose inputs have the key `name` in `section`. No section: in any; no name: any key.
std::vector<std::string> commands_with(std::string_view section, std::string_view name);

/// Whose input a file is, by the sections that it, its [[point]] tables and the overrides write: [cell] or [grid] is of
/// benard-grid, with [system] of benard; [isentropic] of isomorphism; [wave], or [fluid] or [start] without [shear], of
/// a wave; [fluid] or [start] with [shear] of shear-flow; [shear] without [correlation] of a sweep; anything else of
/// green-kubo. A wave's input is that of the only command that accepts it; throws BadInput when both do, or none.
InputKind kind_of_input(const std::filesystem::path& file, std::span<const std::string> overrides = {});

}  // namespace lucy::files
