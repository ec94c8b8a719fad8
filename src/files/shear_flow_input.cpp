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
  return {
      {{.section = "shear",
        .name = "strain_rate",
        .unit = "1/time",
        .meaning = "Strain rate d u_x/d y, of either sign, not zero.",
        .required = true,
        .lists = Lists::multiply,
        .replaces_rows = true},
       stored_in(&P::strain_rate)},
      {{.section = "shear",
        .name = "cooling",
        .type = Type::choice,
        .meaning = "Where the heat of the shear goes. \"isoenergetic\": every particle gives up the same share of its "
                   "internal energy per time, so much that the total energy (internal and peculiar kinetic) is "
                   "constant; no momentum is touched. \"none\": it stays, and the fluid heats up for ever.",
        .choices = names_of(motion::cooling_names)},
       stored_by_name_in(&P::cooling, motion::cooling_names)},
  };
}

std::vector<BoundKey<P>> step_key() {
  return {
      {{.section = "run",
        .name = "step",
        .unit = "time",
        .meaning = "Time step of the Runge-Kutta integration.",
        .range = Range::above(0).at_most(0.2),
        .lists = Lists::one_per_entry,
        .entries_of = strain_rates},
       stored_in(member_of<P>(&P::step))},
  };
}

std::vector<BoundKey<P>> output_keys() {
  return {
      {{.section = "output",
        .name = "sample_interval",
        .unit = "time",
        .meaning = "Time between samples, a whole number of steps. Stresses, energies and powers are averages over the "
                   "steps between them; entropies, temperatures and gradients are those of the last.",
        .range = Range::above(0),
        .default_text = "the smaller of 1 and duration/10"},
       stored_unless_zero_in(&P::sample_interval)},
      {{.section = "output",
        .name = "frame_interval",
        .unit = "time",
        .meaning = "Time between recorded configurations of the first replica, a whole number of samples, after the "
                   "equilibration; 0 records none.",
        .range = Range::at_least(0)},
       stored_in(&P::frame_interval)},
  };
}

/// The keys that may differ from row to row.
std::vector<BoundKey<P>> point_keys() {
  const std::string equilibration =
      "Time run first and not recorded, per replica. More is discarded later where the data ask for it.";
  return joined(particles_key<P>(Lists::none), density_keys<P>(), weight_keys<P>(), fluid_keys<P>(), start_keys<P>(),
                shear_keys(), step_key(), length_keys<P>(equilibration, strain_rates), replica_keys<P>(),
                tolerance_keys<P>(), output_keys());
}

}  // namespace

Schema shear_flow_schema() {
  Schema schema;
  schema.introduction = introduction_of("shear-flow");
  schema.sections = {{"", "The experiment."},
                     {"system", "What is simulated."},
                     {"kernel", "The weight function."},
                     {"fluid", "What the smooth particles are made of."},
                     {"start", "How they start."},
                     {"shear", "What drives the flow, and what keeps it steady."},
                     {"run", "How it is integrated, how long, how often."},
                     {"output", "What is recorded."}};
  schema.foreign = {{"correlation", "it belongs to an input of `lucy green-kubo`"},
                    {"isentropic", "it belongs to an input of `lucy isomorphism`"},
                    {"wave", "it belongs to an input of `lucy shear-wave` or `lucy temperature-wave`"}};
  schema.rows = "point";
  schema.rows_meaning = point_tables_of("the strain rates", "particles or strain_rate");
  schema.keys = arranged(whole_keys<ShearFlowInput>(), point_keys());
  return schema;
}

ShearFlowInput read_shear_flow(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return read_input<ShearFlowInput>(file, overrides, shear_flow_schema(), point_keys(),
                                    [](const ShearFlowPoint& point) { cases::validate(point); });
}

std::string shear_flow_resolved_toml(const ShearFlowInput& input) {
  return resolved_input("sheared fluids", shear_flow_schema(), input, point_keys());
}

std::string explain_shear_flow(std::string_view filter) { return explain(shear_flow_schema(), filter); }

}  // namespace lucy::files
