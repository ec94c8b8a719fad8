// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Frames of a LAMMPS dump in text. The bounds of a tilted box are those of the rectangle around it:
// xlo_bound = xlo + min(0, xy), xhi_bound = xhi + max(0, xy).
#include <algorithm>
#include <cmath>

#include "particle_text.hpp"

namespace lucy::files {

namespace {

constexpr std::string_view item = "ITEM: ";

/// What follows "ITEM: " in a line that must begin with it.
std::string_view next_item(LineReader& lines) {
  const std::string_view line = lines.expect("an ITEM of a LAMMPS dump");
  if (!line.starts_with(item))
    lines.refuse(fmt::format("'{}' was found where an ITEM of a LAMMPS dump is expected", line.substr(0, 40)));
  return line.substr(item.size());
}

struct Bounds {
  std::array<double, 2> low{};
  std::array<double, 2> high{};
  double xy = 0.0;
};

Bounds read_bounds(LineReader& lines, std::string_view header) {
  auto kinds = words_of(header);
  const bool tilted = header.find("xy xz yz") != std::string_view::npos;
  if (!tilted && header.find("abc") != std::string_view::npos)
    lines.refuse("boxes of three general edges are not read, only those with the bounds and xy xz yz");
  // Behind "BOX BOUNDS" and the names of the tilts, one word for each direction, if any: pp, ff, ss, fs ...
  kinds.erase(kinds.begin(), kinds.begin() + std::min<std::ptrdiff_t>(std::ssize(kinds), tilted ? 5 : 2));
  for (std::size_t d = 0; d < std::min<std::size_t>(kinds.size(), 2); ++d)
    if (kinds[d] != "pp")
      lines.refuse(fmt::format("the bounds of the box are of the kind {}, but only periodic ones, pp, are read",
                               fmt::join(kinds, " ")));
  Bounds box;
  for (std::size_t d = 0; d < 3; ++d) {
    const auto words = words_of(lines.expect("the bounds of the box"));
    if (words.size() != (tilted ? 3U : 2U))
      lines.refuse(fmt::format("{} numbers were found where the bounds of the box are {}", words.size(),
                               tilted ? "three" : "two"));
    if (d < 2) {
      box.low[d] = lines.number(words[0], "a bound of the box");
      box.high[d] = lines.number(words[1], "a bound of the box");
    }
    if (!tilted) continue;
    const double tilt = lines.number(words[2], "a tilt");
    if (d == 0) box.xy = tilt;
    if (d > 0 && tilt != 0.0) lines.refuse("the box is tilted out of the plane");
  }
  box.low[0] -= std::min(0.0, box.xy);
  box.high[0] -= std::max(0.0, box.xy);
  return box;
}

/// The place of the first of `names` among the columns.
std::optional<std::size_t> column_of(const std::vector<std::string_view>& columns,
                                     std::initializer_list<std::string_view> names) {
  for (const auto name : names)
    if (const auto found = std::ranges::find(columns, name); found != columns.end())
      return static_cast<std::size_t>(found - columns.begin());
  return std::nullopt;
}

}  // namespace

void skip_dump(LineReader& lines) {
  std::int64_t particles = -1;
  for (bool first = true;; first = false) {
    const std::string_view what = next_item(lines);
    if (first && !what.starts_with("TIME") && !what.starts_with("UNITS"))
      lines.refuse(fmt::format("a frame begins with '{}' where TIMESTEP is expected", what.substr(0, 40)));
    if (what.starts_with("ATOMS")) break;
    if (what.starts_with("NUMBER OF ATOMS")) {
      particles = lines.integer(lines.expect("the number of atoms"), "the number of atoms");
      if (particles < 1) lines.refuse("a frame has no atoms");
    } else {
      const int skipped = what.starts_with("BOX BOUNDS") ? 3 : 1;
      for (int i = 0; i < skipped; ++i) lines.expect("the contents of an ITEM");
    }
  }
  if (particles < 0) lines.refuse("ATOMS stands before NUMBER OF ATOMS");
  for (std::int64_t i = 0; i < particles; ++i) lines.expect("an atom");
}

RawState read_dump(LineReader lines) {
  RawState state;
  std::size_t particles = 0;
  std::vector<std::string_view> columns;
  while (true) {
    const std::string_view what = next_item(lines);
    if (what == "TIMESTEP") {
      state.step = lines.integer(lines.expect("the step"), "the step");
    } else if (what == "TIME") {
      state.time = lines.number(lines.expect("the time"), "the time");
    } else if (what == "NUMBER OF ATOMS") {
      particles = static_cast<std::size_t>(lines.integer(lines.expect("the number of atoms"), "the number of atoms"));
    } else if (what.starts_with("BOX BOUNDS")) {
      const Bounds box = read_bounds(lines, what);
      state.set_cell(lines, box.low, box.high, box.xy);
    } else if (what.starts_with("ATOMS")) {
      columns = words_of(what.substr(5));
      break;
    } else {
      lines.expect("the contents of an ITEM");
    }
  }
  if (!(state.lengths[0] > 0.0)) lines.refuse("ATOMS stands before BOX BOUNDS");
  const auto id = column_of(columns, {"id"});
  const bool scaled = !column_of(columns, {"x"});
  const auto x = column_of(columns, {"x", "xs"});
  const auto y = column_of(columns, {"y", "ys"});
  const auto vx = column_of(columns, {"vx"});
  const auto vy = column_of(columns, {"vy"});
  const auto z = column_of(columns, {"z", "zs"});
  const auto mass = column_of(columns, {"mass"});
  if (!id || !x || !y || scaled != (columns[*y] == "ys"))
    lines.refuse(
        fmt::format("the atoms have the columns {}; id and x y (or xs ys) are needed", fmt::join(columns, " ")));
  IdCount ids(particles);
  state.position.resize(2 * particles);
  if (vx && vy) state.velocity.resize(2 * particles);
  std::optional<double> plane;
  for (std::size_t i = 0; i < particles; ++i) {
    const auto words = words_of(lines.expect("an atom"));
    if (words.size() != columns.size())
      lines.refuse(fmt::format("{} words were found where the atoms have {} columns", words.size(), columns.size()));
    const std::size_t place = 2 * ids.take(lines, lines.integer(words[*id], "the id of an atom"));
    double at_x = lines.number(words[*x], "a coordinate");
    double at_y = lines.number(words[*y], "a coordinate");
    if (scaled) {
      at_x = state.origin[0] + at_x * state.lengths[0] + at_y * state.tilt;
      at_y = state.origin[1] + at_y * state.lengths[1];
    }
    state.position[place] = at_x;
    state.position[place + 1] = at_y;
    if (vx && vy) {
      state.velocity[place] = lines.number(words[*vx], "a velocity");
      state.velocity[place + 1] = lines.number(words[*vy], "a velocity");
    }
    if (mass) require_unit_mass(lines, lines.number(words[*mass], "a mass"));
    if (z) {
      const double at_z = lines.number(words[*z], "a coordinate");
      if (!plane) plane = at_z;
      if (at_z != *plane) lines.refuse("the particles do not lie in one plane");
    }
  }
  return state;
}

std::string dump_text(const RawState& state) {
  const std::size_t particles = state.position.size() / 2;
  const double x_low = state.origin[0];
  const double x_high = x_low + state.lengths[0];
  std::string text;
  if (state.time) text += fmt::format("ITEM: TIME\n{}\n", *state.time);
  text += fmt::format(
      "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS xy xz yz pp pp pp\n{} {} {}\n{} {} 0\n"
      "-0.5 0.5 0\nITEM: ATOMS id type x y z vx vy vz\n",
      state.step, particles, x_low + std::min(0.0, state.tilt), x_high + std::max(0.0, state.tilt), state.tilt,
      state.origin[1], state.origin[1] + state.lengths[1]);
  for (std::size_t i = 0; i < particles; ++i)
    fmt::format_to(std::back_inserter(text), "{} 1 {} {} 0 {} {} 0\n", i + 1, state.position[2 * i],
                   state.position[2 * i + 1], state.velocity[2 * i], state.velocity[2 * i + 1]);
  return text;
}

}  // namespace lucy::files
