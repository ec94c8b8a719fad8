// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LAMMPS data files, of atom style atomic: a title, a header of counts and box bounds, sections. Flags of images at the
// end of an atom's line are passed over, since positions stand beside them wrapped.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <span>

#include "lucy/files/csv.hpp"
#include "particle_text.hpp"

namespace lucy::files {

namespace {

constexpr std::string_view flow_words = "flow of strain rate ";

/// The next line that holds a word, or none at the end.
std::vector<std::string_view> next_words(LineReader& lines) {
  std::string_view line;
  while (lines.next(line))
    if (auto words = words_of(line); !words.empty()) return words;
  return {};
}

/// The words of a line of a section.
std::vector<std::string_view> entry(LineReader& lines, std::string_view section, std::size_t fewest) {
  auto words = next_words(lines);
  if (words.size() < fewest)
    lines.refuse(fmt::format("{} words where an entry of {} has at least {}", words.size(), section, fewest));
  return words;
}

void read_masses(LineReader& lines, std::int64_t types) {
  for (std::int64_t type = 0; type < types; ++type) {
    const auto words = entry(lines, "Masses", 2);
    if (const double mass = lines.number(words[1], "a mass"); mass != 1.0)
      lines.refuse(fmt::format("the mass is {}, but particles of Lucy have mass one", mass));
  }
}

}  // namespace

RawState read_data(LineReader lines) {
  RawState state;
  const std::string_view title = lines.expect("the title of a LAMMPS data file");
  if (const auto at = title.find(flow_words); at != std::string_view::npos)
    state.flow = lines.number(words_of(title.substr(at + flow_words.size())).at(0), "a strain rate");

  std::int64_t particles = 0;
  std::int64_t types = 1;
  std::array<double, 2> low{};
  std::array<double, 2> high{};
  bool bounds[2] = {false, false};
  double xy = 0.0;
  bool positions = false;
  for (auto words = next_words(lines); !words.empty(); words = next_words(lines)) {
    const auto ends_with = [&](std::initializer_list<std::string_view> last) {
      return words.size() > last.size() && std::ranges::equal(last, std::span(words).last(last.size()));
    };
    if (ends_with({"atoms"})) {
      particles = lines.integer(words[0], "the number of atoms");
      if (particles < 1 || particles > 100'000'000) lines.refuse(fmt::format("there cannot be {} atoms", particles));
    } else if (ends_with({"atom", "types"})) {
      types = lines.integer(words[0], "the number of types");
    } else if (ends_with({"xlo", "xhi"}) || ends_with({"ylo", "yhi"})) {
      const std::size_t d = words[2] == "xlo" ? 0 : 1;
      low[d] = lines.number(words[0], "a bound of the box");
      high[d] = lines.number(words[1], "a bound of the box");
      bounds[d] = true;
    } else if (ends_with({"xy", "xz", "yz"})) {
      xy = lines.number(words[0], "the tilt xy");
      if (lines.number(words[1], "the tilt xz") != 0.0 || lines.number(words[2], "the tilt yz") != 0.0)
        lines.refuse("the box is tilted out of the plane");
    } else if (words[0] == "Masses") {
      read_masses(lines, types);
    } else if (words[0] == "Atoms" || words[0] == "Velocities") {
      if (particles == 0 || !bounds[0] || !bounds[1])
        lines.refuse(fmt::format("{} stands before the number of atoms and the bounds of the box", words[0]));
      const bool velocities = words[0] == "Velocities";
      state.set_cell(lines, low, high, xy);
      auto& values = velocities ? state.velocity : state.position;
      values.resize(2 * static_cast<std::size_t>(particles));
      IdCount ids(static_cast<std::size_t>(particles));
      double plane = 0.0;
      for (std::int64_t i = 0; i < particles; ++i) {
        const std::size_t first = velocities ? 1 : 2;
        const auto cells = entry(lines, velocities ? "Velocities" : "Atoms", first + 3);
        const std::size_t place = 2 * ids.take(lines, lines.integer(cells[0], "the id of an atom"));
        for (std::size_t d = 0; d < 2; ++d) values[place + d] = lines.number(cells[first + d], "a coordinate");
        const double z = lines.number(cells[first + 2], "a coordinate");
        if (i == 0) plane = velocities ? 0.0 : z;
        if (z != plane) lines.refuse("the particles do not lie, or do not move, in one plane");
      }
      positions = positions || !velocities;
    } else if (ends_with({"zlo", "zhi"}) || ends_with({"bonds"}) || ends_with({"types"})) {
      continue;
    } else {
      lines.refuse(fmt::format("'{}' is no part of a LAMMPS data file of particles without bonds", words[0]));
    }
  }
  if (!positions) lines.refuse("the file ends without a section Atoms");
  return state;
}

std::string data_text(const RawState& state, const std::string& title) {
  const std::size_t particles = state.position.size() / 2;
  std::string text = title;
  if (state.flow && *state.flow != 0.0) text += fmt::format(", velocities with the {}{}", flow_words, *state.flow);
  text += fmt::format(
      "\n\n{} atoms\n1 atom types\n\n{} {} xlo xhi\n{} {} ylo yhi\n-0.5 0.5 zlo zhi\n{} 0 0 xy xz yz\n\n"
      "Masses\n\n1 1\n\nAtoms # atomic\n\n",
      particles, state.origin[0], state.origin[0] + state.lengths[0], state.origin[1],
      state.origin[1] + state.lengths[1], state.tilt);
  for (std::size_t i = 0; i < particles; ++i)
    fmt::format_to(std::back_inserter(text), "{} 1 {} {} 0\n", i + 1, state.position[2 * i], state.position[2 * i + 1]);
  text += "\nVelocities\n\n";
  for (std::size_t i = 0; i < particles; ++i)
    fmt::format_to(std::back_inserter(text), "{} {} {} 0\n", i + 1, state.velocity[2 * i], state.velocity[2 * i + 1]);
  return text;
}

}  // namespace lucy::files
