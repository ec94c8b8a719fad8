// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The keys of a sweep, and where each is stored in a CouettePoint.
#include "lucy/files/input.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "lucy/errors.hpp"

namespace lucy::files {
namespace {

using cases::CouettePoint;

/// The keys that may differ from row to row.
std::vector<BoundKey<CouettePoint>> point_keys() {
  using P = CouettePoint;
  return {
      {{.section = "system",
        .name = "particles",
        .type = Type::integer,
        .meaning = "Number of particles N. They start from a nearly square lattice, a square one if N is a perfect "
                   "square; numbers that fill none are refused.",
        .range = Range::at_least(4).at_most(1e8),
        .required = true,
        .replaces_rows = true},
       stored_in(&P::particles)},
      {{.section = "system",
        .name = "energy_per_particle",
        .unit = "epsilon",
        .meaning = "Internal energy (Phi + K)/N, potential plus peculiar kinetic energy, without self terms. It must "
                   "exceed the potential energy of the lattice at the start (0.41305 at unit density and range 3).",
        .range = Range::above(0),
        .required = true,
        .lists = Lists::multiply,
        .replaces_rows = true},
       stored_in(&P::energy_per_particle)},
      {{.section = "system",
        .name = "density",
        .unit = "1/sigma^2",
        .meaning = "Number density n, particles per area.",
        .range = Range::above(0)},
       stored_in(&P::density)},
      {{.section = "system",
        .name = "dimension",
        .type = Type::integer,
        .meaning = "Dimension of space.",
        .range = Range::at_least(2).at_most(2)},
       stored_in(&P::dimension)},
      {{.section = "system",
        .name = "reading",
        .type = Type::choice,
        .meaning = "How the pair sum is read: \"md\", the particles are atoms.",
        .choices = {"md"}},
       stored_in(&P::reading)},
      {{.section = "system",
        .name = "kinetic_temperature",
        .unit = "epsilon/k",
        .meaning = "Target temperature K/(N-1) of the isokinetic and the Nose-Hoover thermostat.",
        .range = Range::above(0),
        .default_text = "that of the start"},
       stored_in(&P::kinetic_temperature)},
      {{.section = "kernel",
        .name = "name",
        .type = Type::choice,
        .meaning = "Weight function: \"lucy\", (5/(pi h^2)) (1 + 3r/h)(1 - r/h)^3.",
        .choices = {"lucy"}},
       stored_in(&P::kernel)},
      {{.section = "kernel",
        .name = "range",
        .unit = "sigma",
        .meaning = "Range h, the distance at which the weight function ends. The box must be at least twice as large.",
        .range = Range::above(0)},
       stored_in(&P::range)},
      {{.section = "shear",
        .name = "strain_rate",
        .unit = "1/time",
        .meaning = "Strain rate d u_x/d y, of either sign. At zero there is no shear and no viscosity.",
        .required = true,
        .lists = Lists::multiply,
        .replaces_rows = true},
       stored_in(&P::strain_rate)},
      {{.section = "shear",
        .name = "thermostat",
        .type = Type::choice,
        .meaning = "How the heat of the shear is removed: at constant internal energy (Gauss), at constant kinetic "
                   "energy (Gauss), by feedback (Nose and Hoover), or not at all.",
        .choices = names_of(motion::thermostat_names)},
       stored_by_name_in(&P::thermostat, motion::thermostat_names)},
      {{.section = "shear",
        .name = "relaxation_time",
        .unit = "time",
        .meaning = "Relaxation time tau of the Nose-Hoover thermostat.",
        .range = Range::above(0)},
       stored_in(&P::relaxation_time)},
      {{.section = "run",
        .name = "integrator",
        .type = Type::choice,
        .meaning = "Classic fourth-order Runge-Kutta, or velocity Verlet (plain Newtonian motion only).",
        .choices = names_of(motion::integrator_names)},
       stored_by_name_in(&P::integrator, motion::integrator_names)},
      {{.section = "run",
        .name = "step",
        .unit = "time",
        .meaning = "Time step.",
        .range = Range::above(0).at_most(0.2),
        .lists = Lists::one_per_entry,
        .entries_of = "shear.strain_rate"},
       stored_in(&P::step)},
      {{.section = "run",
        .name = "equilibration",
        .unit = "time",
        .meaning = "Time run first and not recorded, per replica. More is discarded later where the data ask for it.",
        .range = Range::at_least(0),
        .lists = Lists::one_per_entry,
        .entries_of = "shear.strain_rate"},
       stored_in(&P::equilibration)},
      {{.section = "run",
        .name = "duration",
        .unit = "time",
        .meaning = "Time recorded after the equilibration, per replica.",
        .range = Range::above(0),
        .required = true,
        .lists = Lists::one_per_entry,
        .entries_of = "shear.strain_rate"},
       stored_in(&P::duration)},
      {{.section = "run",
        .name = "replicas",
        .type = Type::integer,
        .meaning = "Independent runs per row, from different random starts.",
        .range = Range::at_least(1).at_most(10000)},
       stored_in(&P::replicas)},
      {{.section = "run",
        .name = "seed",
        .type = Type::integer,
        .meaning = "Seed of the random numbers; the same seed gives the same bits, with any number of threads.",
        .range = Range::at_least(0)},
       stored_in(&P::seed)},
      {{.section = "run",
        .name = "target_relative_error",
        .meaning =
            "Run each row until the viscosity is known to this fraction of its value, beyond duration if need be.",
        .range = Range::above(0).below(1),
        .default_text = "unset, run for duration"},
       stored_in(&P::target_relative_error)},
      {{.section = "run",
        .name = "maximum_duration",
        .unit = "time",
        .meaning = "With target_relative_error: the longest time recorded per replica, at least duration.",
        .range = Range::above(0),
        .default_text = "ten times duration"},
       stored_unless_zero_in(&P::maximum_duration)},
      {{.section = "run",
        .name = "rescale",
        .type = Type::boolean,
        .meaning = "Remove the integrator's residual energy error after each step by scaling the momenta; what it "
                   "removed is reported."},
       stored_in(&P::rescale)},
      {{.section = "run",
        .name = "energy_tolerance",
        .unit = "epsilon",
        .meaning = "Energy error per particle of one step above which the step is repeated in smaller parts.",
        .range = Range::above(0)},
       stored_in(&P::energy_tolerance)},
      {{.section = "output",
        .name = "sample_interval",
        .unit = "time",
        .meaning = "Time over which one recorded value averages, a whole number of steps.",
        .range = Range::above(0),
        .default_text = "the larger of 0.5 and duration/20000, at most duration/10"},
       stored_unless_zero_in(&P::sample_interval)},
      {{.section = "output",
        .name = "frame_interval",
        .unit = "time",
        .meaning =
            "Time between recorded configurations of the first replica, a whole number of steps; 0 records none. They "
            "fall on the end of the equilibration and on multiples of this interval after it. A sample_interval that "
            "is not set is shortened until it divides this one; one that is set must divide it.",
        .range = Range::at_least(0)},
       stored_in(&P::frame_interval)},
  };
}

/// The keys that are one for the whole sweep.
std::vector<BoundKey<SweepInput>> sweep_keys() {
  return {
      {{.name = "title",
        .type = Type::text,
        .meaning = "What this experiment is, for people.",
        .default_text = "empty",
        .in_rows = false},
       stored_in(&SweepInput::title)},
      {{.section = "run",
        .name = "threads",
        .type = Type::integer,
        .meaning = "Threads to run on. Their number never changes a result.",
        .range = Range::at_least(0).at_most(1024),
        .default_text = "all cores",
        .in_rows = false,
        .changes_results = false},
       stored_in(&SweepInput::threads)},
      {{.section = "run",
        .name = "checkpoint_interval",
        .unit = "seconds of wall time",
        .meaning = "Time between checkpoints, from which an interrupted sweep resumes.",
        .range = Range::above(0),
        .in_rows = false,
        .changes_results = false},
       stored_in(&SweepInput::checkpoint_interval)},
  };
}

/// Refuses what contradicts itself within one row; the physics is judged by cases::validate.
void refuse_contradictions(const CouettePoint& point) {
  if (point.maximum_duration > 0.0 && point.maximum_duration < point.duration)
    throw BadInput(fmt::format("run.maximum_duration = {} must be a number of at least run.duration = {}",
                               toml_text(point.maximum_duration), toml_text(point.duration)));
}

}  // namespace

Schema sweep_schema() {
  Schema schema;
  schema.introduction =
      "Keys of an input file of `lucy sweep`, in TOML. Reduced units: mass m, length sigma, energy epsilon and "
      "Boltzmann's constant k are one, so that time is in units of sigma (m/epsilon)^(1/2). An integer may stand for a "
      "real. Any key can be set from the command line, --set section.key=value, which beats the file and holds for "
      "every row.";
  schema.sections = {{"", "The experiment."},
                     {"system", "What is simulated."},
                     {"kernel", "The pair potential."},
                     {"shear", "What drives it, and what keeps it steady."},
                     {"run", "How it is integrated, how long, how often."},
                     {"output", "What is recorded."}};
  schema.rows = "point";
  schema.rows_meaning =
      "Without [[point]] tables, the rows of the result are all pairs of an energy_per_particle and a strain_rate: the "
      "energies outermost, the strain rates innermost. With [[point]] tables, each is one row: it may hold any key "
      "above but title, threads and checkpoint_interval, as `duration = 500` or as `run.duration = 500`, and takes "
      "what it does not hold from the sections. Lists are refused inside a [[point]] table, and so is taking a list "
      "from a section; a list there is allowed when every table has a value of its own. Setting particles, "
      "energy_per_particle or strain_rate with --set drops the [[point]] tables, so that the rows come from the "
      "sections again; setting another key changes it in every row.";
  for (const auto& bound : sweep_keys())
    if (bound.key.section.empty()) schema.keys.push_back(bound.key);
  for (const auto& bound : point_keys()) schema.keys.push_back(bound.key);
  // What belongs to the whole sweep stands at the end of its section.
  for (const auto& bound : sweep_keys()) {
    if (bound.key.section.empty()) continue;
    auto place = schema.keys.begin();
    for (auto key = schema.keys.begin(); key != schema.keys.end(); ++key)
      if (key->section == bound.key.section) place = key + 1;
    schema.keys.insert(place, bound.key);
  }
  return schema;
}

SweepInput read_sweep(const std::filesystem::path& file, std::span<const std::string> overrides) {
  const Schema schema = sweep_schema();
  const auto keys = point_keys();
  const Document document = read_document(file, overrides, schema);

  SweepInput input;
  for (const auto& bound : sweep_keys())
    if (const auto value = shared_value(document, schema, bound.key.path())) bound.binding.set(input, *value);

  for (const ResolvedRow& row : expand_rows(document, schema)) {
    const auto point = fill_row(row, keys);
    try {
      refuse_contradictions(point);
      cases::validate(point);
    } catch (const BadInput& refusal) {
      throw BadInput(locate_refusal(refusal.what(), row, document, schema));
    }
    input.points.push_back(point);
  }
  return input;
}

std::string resolved_toml(const SweepInput& input) {
  std::vector<std::map<std::string, Value>> rows;
  const auto keys = point_keys();
  for (const CouettePoint& point : input.points) rows.push_back(values_of(point, keys));
  return "# The resolved input of a sweep, as Lucy ran it; it can be run again as it is.\n\n" +
         resolved_text(sweep_schema(), values_of(input, sweep_keys()), rows);
}

std::string explain_text(std::string_view filter) { return explain(sweep_schema(), filter); }

}  // namespace lucy::files
