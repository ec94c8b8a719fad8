// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LAMMPS data files, of atom style atomic: a title, a header of counts and box bounds, sections. Flags of images at the
// end of an atom's line are passed over, since positions stand beside them wrapped; so are sections of coefficients.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <span>

#include "lucy/files/csv.hpp"
#include "particle_text.hpp"

namespace lucy::files {

namespace {

constexpr std::string_view flow_words = "flow of strain rate ";

constexpr std::size_t words_of_image_flags = 3;

/// A line that holds a word, or none at the end: its words, and what stands behind # in it.
struct Line {
  std::vector<std::string_view> words;
  std::string_view comment;
};

Line next_line(LineReader& lines) {
  std::string_view line;
  while (lines.next(line))
    if (auto words = words_of(line); !words.empty()) {
      lines.require_end_of_line();
      const std::size_t mark = line.find('#');
      return {std::move(words), mark == std::string_view::npos ? std::string_view() : line.substr(mark + 1)};
    }
  return {};
}

/// The words of a line of a section: `count` of them, or as many and the flags of images where those may be.
std::vector<std::string_view> entry(LineReader& lines, std::string_view section, std::size_t count,
                                    bool flags = false) {
  auto words = next_line(lines).words;
  if (words.empty()) lines.expect(fmt::format("an entry of {}", section));
  if (words.size() != count && !(flags && words.size() == count + words_of_image_flags))
    lines.refuse(fmt::format("{} words were found where an entry of {} has {}{}", words.size(), section, count,
                             flags ? fmt::format(", or {} with flags of images", count + words_of_image_flags) : ""));
  return words;
}

void read_masses(LineReader& lines, std::int64_t types) {
  for (std::int64_t type = 0; type < types; ++type)
    require_unit_mass(lines, lines.number(entry(lines, "Masses", 2)[1], "a mass"));
}

/// Sections say their style behind #, if they say it.
void require_style_atomic(const LineReader& lines, const Line& section) {
  if (const auto style = words_of(section.comment); !style.empty() && style[0] != "atomic")
    lines.refuse(fmt::format("{} are of style {}, but those of style atomic are read: id, type, x, y, z",
                             section.words[0], style[0]));
}

bool begins_with_letter(std::string_view word) {
  return (word[0] >= 'A' && word[0] <= 'Z') || (word[0] >= 'a' && word[0] <= 'z');
}

}  // namespace

RawState read_data(LineReader lines) {
  RawState state;
  const std::string_view title = lines.expect("the title of a LAMMPS data file");
  if (const auto at = title.find(flow_words); at != std::string_view::npos) {
    const auto words = words_of(title.substr(at + flow_words.size()));
    state.flow = lines.number(words.empty() ? "" : words[0], "a strain rate");
  }

  std::int64_t particles = 0;
  std::int64_t types = 1;
  std::array<double, 2> low{};
  std::array<double, 2> high{};
  bool bounds[2] = {false, false};
  double xy = 0.0;
  bool positions = false;
  bool coefficients = false;  // until the next line that begins with a word
  for (Line line = next_line(lines); !line.words.empty(); line = next_line(lines)) {
    const auto& words = line.words;
    if (coefficients && !begins_with_letter(words[0])) continue;
    coefficients = words.back() == "Coeffs";
    if (coefficients) continue;
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
      if (!velocities) require_style_atomic(lines, line);
      state.set_cell(lines, low, high, xy);
      auto& values = velocities ? state.velocity : state.position;
      values.resize(2 * static_cast<std::size_t>(particles));
      IdCount ids(static_cast<std::size_t>(particles));
      double plane = 0.0;
      for (std::int64_t i = 0; i < particles; ++i) {
        const std::size_t first = velocities ? 1 : 2;
        const auto cells = velocities ? entry(lines, "Velocities", 4) : entry(lines, "Atoms of style atomic", 5, true);
        const std::size_t place = 2 * ids.take(lines, lines.integer(cells[0], "the id of an atom"));
        for (std::size_t d = 0; d < 2; ++d) values[place + d] = lines.number(cells[first + d], "a coordinate");
        const double z = lines.number(cells[first + 2], "a coordinate");
        if (i == 0) plane = velocities ? 0.0 : z;
        if (z != plane) lines.refuse("the particles do not lie, or do not move, in one plane");
      }
      positions = positions || !velocities;
    } else if (ends_with({"zlo", "zhi"}) || ends_with({"bonds"}) || ends_with({"angles"}) || ends_with({"types"})) {
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
      "\n\n{} atoms\n1 atom types\n\n{} {} xlo xhi\n{} {} ylo yhi\n-0.5 0.5 zlo zhi\n{}\n"
      "Masses\n\n1 1\n\nAtoms # atomic\n\n",
      particles, state.origin[0], state.origin[0] + state.lengths[0], state.origin[1],
      state.origin[1] + state.lengths[1],
      state.tilt != 0.0 ? fmt::format("{} 0 0 xy xz yz\n", state.tilt) : std::string());
  for (std::size_t i = 0; i < particles; ++i)
    fmt::format_to(std::back_inserter(text), "{} 1 {} {} 0\n", i + 1, state.position[2 * i], state.position[2 * i + 1]);
  text += "\nVelocities\n\n";
  for (std::size_t i = 0; i < particles; ++i)
    fmt::format_to(std::back_inserter(text), "{} {} {} 0\n", i + 1, state.velocity[2 * i], state.velocity[2 * i + 1]);
  return text;
}

}  // namespace lucy::files
