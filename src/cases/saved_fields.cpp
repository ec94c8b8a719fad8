// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/saved_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "lucy/errors.hpp"
#include "lucy/space/box.hpp"
#include "lucy/team.hpp"

namespace lucy::cases {

namespace {

using Moments = measure::Moments<2>;

std::vector<double> laboratory(std::vector<double> peculiar, const std::vector<double>& position, double strain_rate) {
  for (std::size_t k = 0; k < peculiar.size(); k += 2) peculiar[k] += strain_rate * position[k + 1];
  return peculiar;
}

}  // namespace

struct FieldAverage::State {
  FieldSettings settings;
  kernel::Weight<2> weight;
  std::vector<double> nodes;
  Moments sums;
  measure::KineticEnergies energies;
  struct Spectrum {
    std::string field;
    measure::FieldSpectrum spectrum;
  };
  std::vector<Spectrum> spectra;
  Frame last;
  Moments at_particles;  // of the last frame
  std::size_t frames = 0;
  double first_time = 0.0;

  explicit State(const FieldSettings& given)
      : settings(given),
        weight(kernel::make_weight<2>(given.weight, given.range)),
        nodes(given.grid.points()),
        sums(given.grid.size()) {
    (void)measure::FieldSpectrum(given.grid.nodes, given.grid.lengths);  // refuses a grid that is too small
  }

  std::vector<measure::Field> fields(const Moments& moments) const {
    return measure::fields_of<2>(moments, nodes, settings.strain_rate, settings.medium, !last.internal_energy.empty());
  }

  /// Adds the spectra of one frame; the first one says which there are.
  void add_spectra(const std::vector<measure::Field>& all) {
    std::size_t next = 0;
    for (const measure::Field& field : all) {
      if (field.name == "velocity_smoothed" && settings.strain_rate != 0.0) continue;
      for (int c = 0; c < field.components; ++c, ++next) {
        if (next == spectra.size()) {
          constexpr std::array<std::string_view, 2> axes = {"_x", "_y"};
          spectra.push_back(
              {std::string(field.name) + std::string(field.components == 1 ? "" : axes[static_cast<std::size_t>(c)]),
               measure::FieldSpectrum(settings.grid.nodes, settings.grid.lengths)});
        }
        spectra[next].spectrum.add(field.component(c), last.offset);
      }
    }
  }
};

FieldAverage::FieldAverage(const FieldSettings& settings) : state_(std::make_unique<State>(settings)) {}
FieldAverage::~FieldAverage() = default;

void FieldAverage::add(const Frame& frame) {
  State& state = *state_;
  const FieldSettings& settings = state.settings;
  if (frame.box != settings.grid.lengths ||
      (state.frames > 0 && (frame.position.size() != state.last.position.size() ||
                            frame.internal_energy.size() != state.last.internal_energy.size())))
    throw BadInput(
        fmt::format("the frame at time {} is of other particles or another box than those before it", frame.time));
  if (state.frames == 0) state.first_time = frame.time;
  ++state.frames;
  state.last = frame;
  const measure::FieldSource<2> source{space::Box<2>(frame.box, settings.strain_rate, frame.offset), frame.position,
                                       frame.momentum, frame.internal_energy};
  // Half a second for 512 x 512 nodes over 16384 particles: one thread will do.
  auto sums = measure::moments<2>(state.weight, source, state.nodes, Team(1));
  state.energies.add(measure::kinetic_energies(source, sums.particles));
  state.sums.add(sums.points);
  state.at_particles = std::move(sums.particles);
  state.add_spectra(state.fields(sums.points));
}

SavedFields FieldAverage::result() const {
  const State& state = *state_;
  const auto frames = static_cast<double>(state.frames);
  Moments mean = state.sums;
  mean.divide_by(frames);

  SavedFields result;
  result.particles = state.last.position.size() / 2;
  result.frames = state.frames;
  result.step = state.last.step;
  result.time = state.last.time;
  result.first_time = state.first_time;
  result.offset = state.last.offset;
  result.fields = state.fields(mean);
  for (const auto& [field, spectrum] : state.spectra) {
    result.spectra.push_back({field, spectrum.rings()});
    result.spectra_whole_up_to = spectrum.whole_up_to();
  }
  result.kinetic_energies = state.energies;
  result.kinetic_energies.divide_by(frames);
  result.kinetic_energies.field =
      measure::field_kinetic_energy(mean, space::Box<2>(state.settings.grid.lengths).volume(), result.particles);
  if (state.frames > 1) return result;

  result.position = state.last.position;
  result.velocity_individual = laboratory(state.last.momentum, state.last.position, state.settings.strain_rate);
  const auto at_particles = measure::fields_of<2>(state.at_particles, state.last.position, state.settings.strain_rate,
                                                  state.settings.medium, false);
  result.velocity_smoothed = measure::find_field(at_particles, "velocity_smoothed")->values;
  result.density = measure::find_field(at_particles, "density")->values;
  result.internal_energy = state.last.internal_energy;
  return result;
}

}  // namespace lucy::cases
