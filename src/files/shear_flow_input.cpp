// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The keys of a sheared fluid's input, and where each is stored in a ShearFlowPoint.
#include "lucy/files/shear_flow_input.hpp"

#include "fluid_keys.hpp"
#include "shared_keys.hpp"

namespace lucy::files {
namespace {

using cases::ShearFlowPoint;
using P = ShearFlowPoint;

constexpr const char* strain_rates = "shear.strain_rate";

std::vector<BoundKey<P>> shear_keys() {
  const std::vector<BoundKey<P>> cooling = {
      {{.section = "shear",
        .name = "cooling",
        .type = Type::choice,
        .meaning = "Where the heat of the shear goes. \"isoenergetic\": every particle gives up the same share of its "
                   "internal energy per time, so much that the total energy (internal and peculiar kinetic) is "
                   "constant; no momentum is touched. \"none\": it stays, and the fluid heats up for ever.",
        .choices = names_of(motion::cooling_names)},
       stored_by_name_in(&P::cooling, motion::cooling_names)}};
  return joined(strain_rate_key<P>("Strain rate d u_x/d y, of either sign, not zero."), cooling);
}

std::vector<BoundKey<P>> output_keys() {
  return joined(
      sample_interval_key<P>(
          "Time between samples, a whole number of steps. Stresses, energies and powers are averages "
          "over the steps between them; entropies, temperatures and gradients are those of the "
          "last.",
          "the smaller of 1 and duration/10"),
      frame_interval_key<P>("Time between recorded configurations of the first replica, a whole number of samples, "
                            "after the equilibration; 0 records none."));
}

/// The keys that may differ from row to row.
std::vector<BoundKey<P>> point_keys() {
  const std::string equilibration =
      "Time run first and not recorded, per replica. More is discarded later where the data ask for it.";
  return joined(particles_key<P>(Lists::none), density_keys<P>(), weight_keys<P>(), fluid_keys<P>(), start_keys<P>(),
                shear_keys(), step_key<P>("Time step of the Runge-Kutta integration.", 0.2, strain_rates),
                length_keys<P>(equilibration, strain_rates), replica_keys<P>(), tolerance_keys<P>(), output_keys());
}

}  // namespace

Schema shear_flow_schema() {
  return input_schema<ShearFlowInput>("shear-flow",
                                      {{"", "The experiment."},
                                       {"system", "What is simulated."},
                                       {"kernel", "The weight function."},
                                       {"fluid", "What the smooth particles are made of."},
                                       {"start", "How they start."},
                                       {"shear", "What drives the flow, and what keeps it steady."},
                                       {"run", "How it is integrated, how long, how often."},
                                       {"output", "What is recorded."}},
                                      point_keys(), "the strain rates", "particles or strain_rate");
}

ShearFlowInput read_shear_flow(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return read_input<ShearFlowInput>(file, overrides, shear_flow_schema(), point_keys(),
                                    [](const ShearFlowPoint& point) { cases::validate(point); });
}

std::string shear_flow_resolved_toml(const ShearFlowInput& input) {
  return resolved_input("sheared fluids", shear_flow_schema(), input, point_keys());
}

}  // namespace lucy::files
