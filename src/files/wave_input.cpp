// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The keys of a wave's input, and where each is stored in a WavePoint.
#include "lucy/files/wave_input.hpp"

#include "fluid_keys.hpp"
#include "shared_keys.hpp"

namespace lucy::files {
namespace {

using cases::WavePoint;
using cases::WaveQuantity;
using P = WavePoint;

constexpr const char* numbers_of_particles = "system.particles";

/// Of atoms beside smooth particles: shear waves have both.
std::vector<BoundKey<P>> reading_keys() {
  return {
      {{.section = "system",
        .name = "reading",
        .type = Type::choice,
        .meaning = "What the particles are: \"spam\", smooth particles of the fluid of [fluid]; \"md\", the Lucy "
                   "fluid's atoms at equilibrium, to which [fluid] and [start] do not apply.",
        .choices = names_of(motion::reading_names)},
       stored_by_name_in(&P::reading, motion::reading_names)},
      {{.section = "system",
        .name = "energy_per_particle",
        .unit = "epsilon",
        .meaning = "Of atoms, which need it: the energy (Phi + K)/N before the wave is superposed, without self terms. "
                   "It must exceed that of the lattice at the start (0.41305 at unit density and range 3).",
        .range = Range::above(0),
        .default_text = "none; refused for smooth particles"},
       stored_in(&P::energy_per_particle)},
  };
}

std::vector<BoundKey<P>> wave_keys(WaveQuantity quantity) {
  const bool shear = quantity == WaveQuantity::shear;
  return {
      {{.section = "wave",
        .name = "amplitude",
        .unit = shear ? "(epsilon/m)^(1/2)" : "",
        .meaning = shear ? "A in the velocity v_x = A sin(k y) that is superposed."
                         : "A in the factor 1 + A sin(k y) by which temperatures are multiplied.",
        .range = shear ? Range::above(0) : Range::above(0).below(1)},
       stored_in(&P::amplitude)},
      {{.section = "wave",
        .name = "mode",
        .type = Type::integer,
        .meaning = "Wavelengths in the height of the box, k = 2 pi mode/L_y.",
        .range = Range::at_least(1).at_most(1000000)},
       stored_in(&P::mode)},
  };
}

std::vector<BoundKey<P>> output_keys() {
  return joined(sample_interval_key<P>("Time between samples of the amplitude, a whole number of steps.",
                                       "the most whole steps within 2 and duration/200, at least one"),
                frame_interval_key<P>(
                    "Time between recorded configurations of the first replica, a whole number of samples, from "
                    "the start of the wave on; 0 records none."));
}

}  // namespace

std::string_view command_name(WaveQuantity quantity) {
  return quantity == WaveQuantity::shear ? "shear-wave" : "temperature-wave";
}

std::vector<BoundKey<P>> wave_point_keys(WaveQuantity quantity) {
  auto system = joined(particles_key<P>(Lists::multiply), density_keys<P>());
  if (quantity == WaveQuantity::shear) system = joined(system, reading_keys());
  return joined(system, weight_keys<P>(), fluid_keys<P>(), start_keys<P>(), wave_keys(quantity),
                step_key<P>("Time step of the Runge-Kutta integration; that of atoms at most 0.2.", 0.5, ""),
                length_keys<P>("Time run first without the wave and not recorded, per replica.", numbers_of_particles),
                replica_keys<P>(), tolerance_keys<P>(), output_keys());
}

Schema wave_schema(WaveQuantity quantity) {
  const bool shear = quantity == WaveQuantity::shear;
  Schema schema = input_schema<WaveInput>(
      std::string(command_name(quantity)),
      {{"", "The experiment."},
       {"system", "What is in the periodic box."},
       {"kernel", "The weight function, which for atoms is the pair potential."},
       {"fluid", "What the smooth particles are made of."},
       {"start", "How they start."},
       {"wave", shear ? "The sinusoidal velocity that decays." : "The sinusoidal temperature that decays."},
       {"run", "How it is integrated, how long, how often."},
       {"output", "What is recorded."}},
      wave_point_keys(quantity), "the numbers of particles", "particles");
  schema.lacking = {{"shear", "a wave decays in a box at rest"}};
  return schema;
}

WaveInput read_wave(WaveQuantity quantity, const std::filesystem::path& file, std::span<const std::string> overrides) {
  auto input =
      read_input<WaveInput>(file, overrides, wave_schema(quantity), wave_point_keys(quantity), [&](WavePoint& point) {
        point.quantity = quantity;
        cases::validate(point);
      });
  input.quantity = quantity;
  return input;
}

std::string wave_resolved_toml(const WaveInput& input) {
  const std::string what = input.quantity == WaveQuantity::shear ? "shear waves" : "temperature waves";
  return resolved_input(what, wave_schema(input.quantity), input, wave_point_keys(input.quantity));
}

}  // namespace lucy::files
