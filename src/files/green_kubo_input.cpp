// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The keys of a Green-Kubo input, and where each is stored in a GreenKuboPoint.
#include "lucy/files/green_kubo_input.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lucy/cases/green_kubo_table.hpp"
#include "shared_keys.hpp"

namespace lucy::files {
namespace {

using cases::GreenKuboPoint;
using P = GreenKuboPoint;

constexpr const char* energies = "system.energy_per_particle";

std::vector<BoundKey<P>> run_keys() {
  const std::vector<BoundKey<P>> preparation = {
      {{.section = "run",
        .name = "preparation",
        .unit = "time",
        .meaning = fmt::format(
            "Time run first under shear at the rate {} and constant energy, rounded to a whole number of box lengths "
            "(less than half of one means none at all), so that nothing is left of the lattice at the start; 0 starts "
            "at rest from the lattice.",
            cases::preparation_rate),
        .range = Range::at_least(0)},
       stored_in(&P::preparation)}};
  const std::vector<BoundKey<P>> band = {
      {{.section = "run",
        .name = "energy_band",
        .unit = "epsilon",
        .meaning = "How far the energy per particle may be from that at the start of the recording; a state that "
                   "leaves this band has failed.",
        .range = Range::above(0)},
       stored_in(&P::energy_band)}};
  const std::string equilibration = "Time run at rest after the preparation and not recorded, per replica.";
  return joined(integration_keys<P>(energies), preparation, length_keys<P>(equilibration, energies), replica_keys<P>(),
                tolerance_keys<P>(), band);
}

std::vector<BoundKey<P>> correlation_keys() {
  return {
      {{.section = "correlation",
        .name = "method",
        .type = Type::choice,
        .meaning = "How stresses are correlated: every time up to length by Fourier transforms, or times spaced wider "
                   "and wider by averaging over levels, in memory that grows with the logarithm of length.",
        .choices = names_of(cases::correlation_method_names)},
       stored_by_name_in(&P::method, cases::correlation_method_names)},
      {{.section = "correlation",
        .name = "length",
        .unit = "time",
        .meaning = "Longest time over which stresses are correlated. It should hold twice the cut-off, so that the "
                   "plateau of the integral can be judged.",
        .range = Range::above(0),
        .default_text = "the smaller of 400 and duration/5",
        .lists = Lists::one_per_entry,
        .entries_of = energies},
       stored_unless_zero_in(&P::length)},
      {{.section = "correlation",
        .name = "cutoff",
        .unit = "time",
        .meaning =
            "Time at which the integral of the correlation function is cut off. Unset, it follows from the decay "
            "of the function alone; a value that is picked where the integral looks right has no honest error.",
        .range = Range::above(0),
        .default_text = fmt::format("{} decay times of the exponential fitted to the correlation function",
                                    cases::cutoff_in_decay_times),
        .lists = Lists::one_per_entry,
        .entries_of = energies},
       stored_unless_zero_in(&P::cutoff)},
      {{.section = "correlation",
        .name = "diffusion",
        .type = Type::boolean,
        .meaning = "Correlate velocities too, for the self-diffusion coefficient. In two dimensions its integral grows "
                   "without bound, as the logarithm of time (the velocity correlation decays as 1/t), once long-time "
                   "tails are reached: a number for this N and this cut-off."},
       stored_in(&P::diffusion)},
      {{.section = "correlation",
        .name = "thermal_conductivity",
        .type = Type::boolean,
        .meaning =
            "Correlate heat fluxes too (one more pair sum per sample), for the thermal conductivity. In two dimensions "
            "it has no limit for large systems either: a number for this N and this cut-off."},
       stored_in(&P::thermal_conductivity)},
      {{.section = "correlation",
        .name = "pairs",
        .type = Type::texts,
        .meaning = fmt::format(
            "Further correlations <a(0) b(t)> to be written to pairs.csv, each as the two names with a space between, "
            "such as [\"pressure pressure\"]. Names: {}. Means that symmetry does not make zero are taken off; in "
            "pairs.csv such a correlation is "
            "multiplied by the volume.",
            fmt::join(cases::sampled_quantities, ", "))},
       stored_in(&P::pairs)},
  };
}

std::vector<BoundKey<P>> output_keys() {
  const std::vector<BoundKey<P>> series = {
      {{.section = "output",
        .name = "series",
        .type = Type::boolean,
        .meaning = "Keep every sample of the stress, six numbers each, and write them to the H5MD file of the state."},
       stored_in(&P::series)}};
  return joined(
      sample_interval_key<P>(
          "Time between samples of the stress, a whole number of steps. At low energies part of the stress is "
          "forgotten within a time of 2: longer than a thermal particle takes to cross a quarter of the range is "
          "refused.",
          "the most whole steps within 0.2 and within half the time of that crossing, at least one"),
      frame_interval_key<P>("Time between recorded configurations of the first replica, a whole number of steps (and "
                            "of samples, if sample_interval is set); 0 records none. They fall on the start of the "
                            "recording and on multiples of this interval after it."),
      series);
}

/// The keys that may differ from row to row.
std::vector<BoundKey<P>> point_keys() {
  return joined(system_keys<P>(Lists::multiply), kernel_keys<P>(), run_keys(), correlation_keys(), output_keys());
}

}  // namespace

Schema green_kubo_schema() {
  Schema schema = input_schema<GreenKuboInput>(
      "green-kubo",
      {{"", "The experiment."},
       {"system", "What is simulated, at rest and at constant energy."},
       {"kernel", "The pair potential."},
       {"run", "How it is integrated, how long, how often."},
       {"correlation", "What is correlated, over what times."},
       {"output", "What is recorded."}},
      point_keys(),
      "all pairs of a number of particles and an energy_per_particle: the numbers of particles outermost, the energies "
      "innermost",
      "particles or energy_per_particle");
  schema.lacking = {{"shear", "a Green-Kubo state is at rest, its strain rate zero"}};
  return schema;
}

GreenKuboInput read_green_kubo(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return read_input<GreenKuboInput>(file, overrides, green_kubo_schema(), point_keys(),
                                    [](const GreenKuboPoint& point) { cases::validate(point); });
}

std::string green_kubo_resolved_toml(const GreenKuboInput& input) {
  return resolved_input("Green-Kubo states", green_kubo_schema(), input, point_keys());
}

}  // namespace lucy::files
