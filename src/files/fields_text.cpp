// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lucy/files/fields_h5.hpp"
#include "lucy/files/table_text.hpp"
#include "lucy/space/box.hpp"
#include "text_layout.hpp"

namespace lucy::files {

namespace {

/// Three digits of the variation, as many decimals for the rest of the row; what is constant, to six digits.
std::vector<std::string> row_of(std::string name, const measure::FieldSummary& of) {
  const double size = std::max(std::abs(of.lowest), std::abs(of.highest));
  const double scale = of.deviation > 1e-9 * size ? of.deviation : 1e-3 * size;
  const int decimals =
      scale > 0.0 && std::isfinite(scale) ? std::clamp(2 - static_cast<int>(std::floor(std::log10(scale))), 0, 9) : 0;
  std::vector<std::string> cells = {std::move(name)};
  for (const double value : {of.mean, of.deviation, of.lowest, of.highest}) cells.push_back(fixed(value, decimals));
  return cells;
}

}  // namespace

std::string format_fields(const cases::FieldSettings& settings, const cases::SavedFields& fields) {
  TextTable table({"field", "mean", "rms variation", "minimum", "maximum"}, 1, LastColumn::numbers);
  std::size_t unknown = 0;
  for (const measure::Field& field : fields.fields) {
    for (int c = 0; c < field.components; ++c) {
      const measure::FieldSummary of = measure::summary(field.component(c));
      const char* const axis = field.components == 1 ? "" : c == 0 ? " x" : " y";
      table.add(row_of(std::string(field.name) + axis, of));
      unknown = std::max(unknown, field.places() - of.known);
    }
  }
  std::string text = table.text();
  if (unknown > 0)
    text +=
        fmt::format("\nNo particle is within the range of {} of the {} nodes: no velocity and no temperature there.\n",
                    unknown, settings.grid.size());
  const double mass = measure::summary(measure::find_field(fields.fields, "density")->values).mean *
                      space::Box<2>(settings.grid.lengths).volume();
  text += fmt::format("\nParticles on the grid: {} of {}.\n", format_plain(mass, 9), fields.particles);
  const measure::KineticEnergies& energies = fields.kinetic_energies;
  text +=
      fmt::format("\nKinetic energy per particle{}:\n", settings.strain_rate != 0.0 ? ", without the mean flow" : "");
  text += fmt::format("  individual velocities               {}\n", format_plain(energies.individual, 5));
  text += fmt::format("  smoothed velocities, at particles   {}\n", format_plain(energies.smoothed, 5));
  text += fmt::format("  smoothed velocity, on the grid      {}\n", format_plain(energies.field, 5));
  return text;
}

}  // namespace lucy::files
