// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The keys of an isomorphism input, and where each is stored in an IsomorphismPoint.
#include "lucy/files/isomorphism_input.hpp"

#include "shared_keys.hpp"

namespace lucy::files {
namespace {

using cases::IsomorphismPoint;
using P = IsomorphismPoint;

std::vector<BoundKey<P>> fluid_keys() {
  return {
      {{.section = "isentropic",
        .name = "pressure",
        .unit = "epsilon/sigma^2",
        .meaning = "P0 in the equation of state P = (P0/2)(rho/rho0)^2 of the smooth particles, a power of two. Only "
                   "with P0/rho0^2 = 1 do they move as the atoms.",
        .range = Range::above(0)},
       stored_in(&P::pressure)},
      {{.section = "isentropic",
        .name = "reference_density",
        .unit = "m/sigma^2",
        .meaning = "rho0 in that equation, a power of two.",
        .range = Range::above(0)},
       stored_in(&P::reference_density)},
  };
}

/// The keys that may differ from row to row.
std::vector<BoundKey<P>> point_keys() {
  const auto shear = joined(
      strain_rate_key<P>(
          "Strain rate d u_x/d y, of either sign. At zero the motion is Newton's, without a thermostat."),
      thermostat_keys<P>("How the heat of the shear is removed, in both readings: at constant internal energy (Gauss), "
                         "at constant kinetic energy (Gauss), by feedback (Nose and Hoover), or not at all. There is "
                         "none at strain rate zero."));
  const auto output = sample_interval_key<P>(
      "Time between samples of stresses and energies, a whole number of steps. Bits are compared after every step.",
      "the smaller of 1 and duration/10");
  const std::string rates = "shear.strain_rate";
  const std::string equilibration =
      "Time run first, per replica: compared as all the rest, but not sampled. More samples are discarded later where "
      "the data ask for it.";
  return joined(system_keys<P>(Lists::none), fluid_keys(), kernel_keys<P>(), shear, integration_keys<P>(rates),
                length_keys<P>(equilibration, rates), replica_keys<P>(), tolerance_keys<P>(), output);
}

}  // namespace

Schema isomorphism_schema() {
  return input_schema<IsomorphismInput>(
      "isomorphism",
      {{"", "The experiment."},
       {"system", "What is simulated, once as atoms and once as smooth particles."},
       {"isentropic", "What fluid the smooth particles are."},
       {"kernel", "The pair potential of the atoms, and the weight function of the smooth particles."},
       {"shear", "What drives both, and what keeps them steady."},
       {"run", "How both are integrated, how long, how often."},
       {"output", "What is recorded."}},
      point_keys(),
      "all pairs of an energy_per_particle and a strain_rate: the energies outermost, the strain rates innermost",
      "particles, energy_per_particle or strain_rate");
}

IsomorphismInput read_isomorphism(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return read_input<IsomorphismInput>(file, overrides, isomorphism_schema(), point_keys(),
                                      [](const IsomorphismPoint& point) { cases::validate(point); });
}

std::string isomorphism_resolved_toml(const IsomorphismInput& input) {
  return resolved_input("isomorphism cases", isomorphism_schema(), input, point_keys());
}

}  // namespace lucy::files
