// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Extended XYZ: the number of particles, a line of key=value (Lattice with the three edges one after the other,
// Properties with name:kind:count of every column), one line per particle. OVITO, ASE and chemfiles read it.
#include <algorithm>
#include <cmath>
#include <map>

#include "particle_text.hpp"

namespace lucy::files {

namespace {

/// The keys of the second line; values may stand in quotes.
std::map<std::string, std::string> keys_of(std::string_view line) {
  std::map<std::string, std::string> keys;
  while (true) {
    const std::size_t start = line.find_first_not_of(" \t");
    if (start == std::string_view::npos) return keys;
    line.remove_prefix(start);
    const std::size_t end = std::min(line.find_first_of("= \t"), line.size());
    const std::string name(line.substr(0, end));
    line.remove_prefix(end);
    if (!line.starts_with('=')) {
      keys[name] = "T";
      continue;
    }
    line.remove_prefix(1);
    const bool quoted = line.starts_with('"');
    if (quoted) line.remove_prefix(1);
    const std::size_t last = std::min(line.find_first_of(quoted ? "\"" : " \t"), line.size());
    keys[name] = line.substr(0, last);
    line.remove_prefix(std::min(last + (quoted ? 1 : 0), line.size()));
  }
}

std::vector<double> numbers_of(const LineReader& lines, const std::string& text, std::size_t count,
                               std::string_view what) {
  std::vector<double> numbers;
  for (const auto word : words_of(text)) numbers.push_back(lines.number(word, what));
  if (numbers.size() != count)
    lines.refuse(fmt::format("{} has {} numbers where {} are expected", what, numbers.size(), count));
  return numbers;
}

struct Columns {
  std::size_t count = 0;
  std::optional<std::size_t> id = {};
  std::optional<std::size_t> position = {};
  std::optional<std::size_t> velocity = {};
  std::optional<std::size_t> mass = {};
};

Columns columns_of(const LineReader& lines, const std::string& properties) {
  Columns columns;
  std::string_view rest = properties;
  const auto field = [&] {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    const std::string_view word = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return word;
  };
  while (!rest.empty()) {
    const std::string_view name = field();
    field();
    const std::int64_t width = lines.integer(field(), "a number of columns in Properties");
    if (width < 1 || width > 1000) lines.refuse(fmt::format("Properties gives {} {} columns", name, width));
    if (name == "id") columns.id = columns.count;
    if ((name == "pos" || name == "velo") && width != 3)
      lines.refuse(fmt::format("{} has {} columns where three are expected", name, width));
    if (name == "pos") columns.position = columns.count;
    if (name == "velo") columns.velocity = columns.count;
    if (name == "mass" || name == "masses") columns.mass = columns.count;
    columns.count += static_cast<std::size_t>(width);
  }
  if (!columns.position) lines.refuse(fmt::format("Properties is '{}': it has no pos", properties));
  return columns;
}

std::size_t read_count(LineReader& lines) {
  const auto words = words_of(lines.expect("the number of particles"));
  const std::int64_t count = words.size() == 1 ? lines.integer(words[0], "the number of particles") : 0;
  if (count < 1 || count > 100'000'000) lines.refuse("the number of particles is expected, alone in its line");
  return static_cast<std::size_t>(count);
}

}  // namespace

void skip_extended_xyz(LineReader& lines) {
  const std::size_t particles = read_count(lines);
  for (std::size_t i = 0; i <= particles; ++i) lines.expect(i == 0 ? "the keys of extended XYZ" : "a particle");
}

RawState read_extended_xyz(LineReader lines) {
  RawState state;
  const std::size_t particles = read_count(lines);
  const auto keys = keys_of(lines.expect("the keys of extended XYZ"));
  const auto key = [&](const char* name) -> std::optional<std::string> {
    const auto found = keys.find(name);
    return found == keys.end() ? std::nullopt : std::optional(found->second);
  };
  if (!key("Lattice") || !key("Properties"))
    lines.refuse("extended XYZ has Lattice and Properties in its second line: one of them is missing");
  const auto lattice = numbers_of(lines, *key("Lattice"), 9, "Lattice");
  if (lattice[1] != 0.0 || lattice[2] != 0.0 || lattice[5] != 0.0)
    lines.refuse("the first edge of Lattice must lie along x, the second in the plane");
  std::array<double, 2> low{};
  if (const auto origin = key("Origin")) {
    const auto corner = numbers_of(lines, *origin, 3, "Origin");
    low = {corner[0], corner[1]};
  }
  state.set_cell(lines, low, {low[0] + lattice[0], low[1] + lattice[4]}, lattice[3]);
  state.lengths = {lattice[0], lattice[4]};
  if (const auto periodic = key("pbc"); periodic && !periodic->starts_with("T T"))
    lines.refuse(fmt::format("pbc is '{}', but only boxes that are periodic in the plane are read", *periodic));
  if (const auto time = key("Time")) state.time = lines.number(*time, "Time");
  if (const auto step = key("Step")) state.step = lines.integer(*step, "Step");
  if (const auto rate = key("strain_rate")) state.flow = lines.number(*rate, "strain_rate");

  const Columns columns = columns_of(lines, *key("Properties"));
  IdCount ids(particles);
  state.position.resize(2 * particles);
  if (columns.velocity) state.velocity.resize(2 * particles);
  std::optional<double> plane;
  for (std::size_t i = 0; i < particles; ++i) {
    const auto words = words_of(lines.expect("a particle"), true);
    if (words.size() != columns.count)
      lines.refuse(fmt::format("{} words were found where Properties gives {}", words.size(), columns.count));
    const std::int64_t id =
        columns.id ? lines.integer(words[*columns.id], "the id of a particle") : static_cast<std::int64_t>(i) + 1;
    const std::size_t place = 2 * ids.take(lines, id);
    for (std::size_t d = 0; d < 2; ++d) {
      state.position[place + d] = lines.number(words[*columns.position + d], "a coordinate");
      if (columns.velocity) state.velocity[place + d] = lines.number(words[*columns.velocity + d], "a velocity");
    }
    if (columns.mass) require_unit_mass(lines, lines.number(words[*columns.mass], "a mass"));
    const double z = lines.number(words[*columns.position + 2], "a coordinate");
    if (!plane) plane = z;
    if (z != *plane) lines.refuse("the particles do not lie in one plane");
  }
  return state;
}

std::string extended_xyz_text(const RawState& state) {
  const std::size_t particles = state.position.size() / 2;
  std::string text = fmt::format(
      "{}\nLattice=\"{} 0 0 {} {} 0 0 0 1\" Origin=\"{} {} -0.5\" Properties=id:I:1:species:S:1:pos:R:3:velo:R:3 "
      "pbc=\"T T F\" Step={} Time={} strain_rate={}\n",
      particles, state.lengths[0], state.tilt, state.lengths[1], state.origin[0], state.origin[1], state.step,
      state.time.value_or(0.0), state.flow.value_or(0.0));
  for (std::size_t i = 0; i < particles; ++i)
    fmt::format_to(std::back_inserter(text), "{} X {} {} 0 {} {} 0\n", i + 1, state.position[2 * i],
                   state.position[2 * i + 1], state.velocity[2 * i], state.velocity[2 * i + 1]);
  return text;
}

}  // namespace lucy::files
