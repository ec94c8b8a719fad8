// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the input files of all experiments share: keys of every state and of every file, and the way from a file to the
// structs of a case and back. `Row` is the struct of one state, `Input` that of a whole file.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lucy/errors.hpp"
#include "lucy/files/all_inputs.hpp"
#include "lucy/files/schema.hpp"
#include "lucy/motion/settings.hpp"

namespace lucy::files {

/// Several lists of keys in one.
template <class Row, class... More>
std::vector<BoundKey<Row>> joined(std::vector<BoundKey<Row>> keys, const More&... more) {
  (keys.insert(keys.end(), more.begin(), more.end()), ...);
  return keys;
}

/// A member of `Row` that it may have from a base.
template <class Row, class Owner, class Member>
Member Row::*member_of(Member Owner::*member) {
  return member;
}

/// `particles`: what a list of particle numbers means.
template <class Row>
std::vector<BoundKey<Row>> particles_key(Lists particles) {
  return {
      {{.section = "system",
        .name = "particles",
        .type = Type::integer,
        .meaning = "Number of particles N. They start from a nearly square lattice, a square one if N is a perfect "
                   "square; numbers that fill none are refused.",
        .range = Range::at_least(4).at_most(1e8),
        .required = true,
        .lists = particles,
        .replaces_rows = true},
       stored_in(member_of<Row>(&Row::particles))},
  };
}

template <class Row>
std::vector<BoundKey<Row>> energy_key() {
  return {
      {{.section = "system",
        .name = "energy_per_particle",
        .unit = "epsilon",
        .meaning = "Internal energy (Phi + K)/N, potential plus peculiar kinetic energy, without self terms. It must "
                   "exceed the potential energy of the lattice at the start (0.41305 at unit density and range 3).",
        .range = Range::above(0),
        .required = true,
        .lists = Lists::multiply,
        .replaces_rows = true},
       stored_in(member_of<Row>(&Row::energy_per_particle))},
  };
}

template <class Row>
std::vector<BoundKey<Row>> density_keys() {
  return {
      {{.section = "system",
        .name = "density",
        .unit = "1/sigma^2",
        .meaning = "Number density n, particles per area.",
        .range = Range::above(0)},
       stored_in(member_of<Row>(&Row::density))},
      {{.section = "system",
        .name = "dimension",
        .type = Type::integer,
        .meaning = "Dimension of space.",
        .range = Range::at_least(2).at_most(2)},
       stored_in(member_of<Row>(&Row::dimension))},
  };
}

template <class Row>
std::vector<BoundKey<Row>> reading_key() {
  return {
      {{.section = "system",
        .name = "reading",
        .type = Type::choice,
        .meaning =
            "How the pair sum is read: \"md\", the particles are atoms; \"spam\", they are smooth particles of a fluid "
            "with P = rho^2/2 (reduced units), whose densities and pressures are computed. Both give the same bits.",
        .choices = names_of(motion::reading_names)},
       stored_by_name_in(member_of<Row>(&Row::reading), motion::reading_names)},
  };
}

/// `particles`: what a list of particle numbers means. `reading` is a key only where a row has one reading.
template <class Row>
std::vector<BoundKey<Row>> system_keys(Lists particles) {
  auto keys = joined(particles_key<Row>(particles), energy_key<Row>(), density_keys<Row>());
  if constexpr (requires(Row row) { row.reading; }) keys = joined(keys, reading_key<Row>());
  return keys;
}

template <class Row>
std::vector<BoundKey<Row>> range_key() {
  return {
      {{.section = "kernel",
        .name = "range",
        .unit = "sigma",
        .meaning = "Range h, the distance at which the weight function ends. The box must be at least twice as large.",
        .range = Range::above(0)},
       stored_in(member_of<Row>(&Row::range))},
  };
}

/// Of the Lucy fluid.
template <class Row>
std::vector<BoundKey<Row>> kernel_keys() {
  const std::vector<BoundKey<Row>> name = {
      {{.section = "kernel",
        .name = "name",
        .type = Type::choice,
        .meaning = "Weight function: \"lucy\", (5/(pi h^2)) (1 + 3r/h)(1 - r/h)^3.",
        .choices = {"lucy"}},
       stored_in(member_of<Row>(&Row::kernel))}};
  return joined(name, range_key<Row>());
}

/// `meaning` of the rate.
template <class Row>
std::vector<BoundKey<Row>> strain_rate_key(const std::string& meaning) {
  return {
      {{.section = "shear",
        .name = "strain_rate",
        .unit = "1/time",
        .meaning = meaning,
        .required = true,
        .lists = Lists::multiply,
        .replaces_rows = true},
       stored_in(member_of<Row>(&Row::strain_rate))},
  };
}

/// `meaning` of the thermostat.
template <class Row>
std::vector<BoundKey<Row>> thermostat_keys(const std::string& meaning) {
  return {
      {{.section = "shear",
        .name = "thermostat",
        .type = Type::choice,
        .meaning = meaning,
        .choices = names_of(motion::thermostat_names)},
       stored_by_name_in(member_of<Row>(&Row::thermostat), motion::thermostat_names)},
      {{.section = "shear",
        .name = "relaxation_time",
        .unit = "time",
        .meaning = "Relaxation time tau of the Nose-Hoover thermostat.",
        .range = Range::above(0)},
       stored_in(member_of<Row>(&Row::relaxation_time))},
  };
}

/// `entries_of`: the key whose list a list of steps follows; empty: lists are refused.
template <class Row>
std::vector<BoundKey<Row>> step_key(const std::string& meaning, double most, const std::string& entries_of) {
  return {
      {{.section = "run",
        .name = "step",
        .unit = "time",
        .meaning = meaning,
        .range = Range::above(0).at_most(most),
        .lists = entries_of.empty() ? Lists::none : Lists::one_per_entry,
        .entries_of = entries_of},
       stored_in(member_of<Row>(&Row::step))},
  };
}

/// `entries_of` as above.
template <class Row>
std::vector<BoundKey<Row>> integration_keys(const std::string& entries_of) {
  const std::vector<BoundKey<Row>> integrator = {
      {{.section = "run",
        .name = "integrator",
        .type = Type::choice,
        .meaning = "Classic fourth-order Runge-Kutta, or velocity Verlet (plain Newtonian motion only).",
        .choices = names_of(motion::integrator_names)},
       stored_by_name_in(member_of<Row>(&Row::integrator), motion::integrator_names)}};
  return joined(integrator, step_key<Row>("Time step.", 0.2, entries_of));
}

/// `equilibration`: what that key means; `entries_of` as above.
template <class Row>
std::vector<BoundKey<Row>> length_keys(const std::string& equilibration, const std::string& entries_of) {
  return {
      {{.section = "run",
        .name = "equilibration",
        .unit = "time",
        .meaning = equilibration,
        .range = Range::at_least(0),
        .lists = Lists::one_per_entry,
        .entries_of = entries_of},
       stored_in(member_of<Row>(&Row::equilibration))},
      {{.section = "run",
        .name = "duration",
        .unit = "time",
        .meaning = "Time recorded after the equilibration, per replica.",
        .range = Range::above(0),
        .required = true,
        .lists = Lists::one_per_entry,
        .entries_of = entries_of},
       stored_in(member_of<Row>(&Row::duration))},
  };
}

template <class Row>
std::vector<BoundKey<Row>> replica_keys() {
  return {
      {{.section = "run",
        .name = "replicas",
        .type = Type::integer,
        .meaning = "Independent runs per row, from different random starts.",
        .range = Range::at_least(1).at_most(10000)},
       stored_in(member_of<Row>(&Row::replicas))},
      {{.section = "run",
        .name = "seed",
        .type = Type::integer,
        .meaning = "Seed of the random numbers; the same seed gives the same bits, with any number of threads.",
        .range = Range::at_least(0)},
       stored_in(member_of<Row>(&Row::seed))},
  };
}

template <class Row>
std::vector<BoundKey<Row>> tolerance_keys() {
  return {
      {{.section = "run",
        .name = "energy_tolerance",
        .unit = "epsilon",
        .meaning = "Energy error per particle of one step above which the step is repeated in smaller parts.",
        .range = Range::above(0)},
       stored_in(member_of<Row>(&Row::energy_tolerance))},
  };
}

/// `usual`: the interval where none is set, in words.
template <class Row>
std::vector<BoundKey<Row>> sample_interval_key(const std::string& meaning, const std::string& usual) {
  return {
      {{.section = "output",
        .name = "sample_interval",
        .unit = "time",
        .meaning = meaning,
        .range = Range::above(0),
        .default_text = usual},
       stored_unless_zero_in(member_of<Row>(&Row::sample_interval))},
  };
}

template <class Row>
std::vector<BoundKey<Row>> frame_interval_key(const std::string& meaning) {
  return {
      {{.section = "output", .name = "frame_interval", .unit = "time", .meaning = meaning, .range = Range::at_least(0)},
       stored_in(member_of<Row>(&Row::frame_interval))},
  };
}

/// The keys that are one for the whole file.
template <class Input>
std::vector<BoundKey<Input>> whole_keys() {
  return {
      {{.name = "title",
        .type = Type::text,
        .meaning = "What this experiment is, for people.",
        .default_text = "empty",
        .in_rows = false},
       stored_in(&Input::title)},
      {{.section = "run",
        .name = "threads",
        .type = Type::integer,
        .meaning = "Threads to run on. Their number never changes a result.",
        .range = Range::at_least(0).at_most(1024),
        .default_text = "all cores",
        .in_rows = false,
        .changes_results = false},
       stored_in(&Input::threads)},
      {{.section = "run",
        .name = "checkpoint_interval",
        .unit = "seconds of wall time",
        .meaning = "Time between checkpoints, from which an interrupted run resumes.",
        .range = Range::above(0),
        .in_rows = false,
        .changes_results = false},
       stored_in(&Input::checkpoint_interval)},
  };
}

/// The first paragraph of an explanation; `command` as typed, without the program's name.
inline std::string introduction_of(const std::string& command) {
  return "Keys of an input file of `lucy " + command +
         "`, in TOML. Reduced units: mass m, length sigma, energy epsilon and Boltzmann's constant k are one, so that "
         "time is in units of sigma (m/epsilon)^(1/2). An integer may stand for a real. Any key can be set from the "
         "command line, --set section.key=value, which beats the file and holds for every row.";
}

/// What [[point]] tables mean. `product`: what the rows are without them; `dropping`: the keys whose --set drops them.
inline std::string point_tables_of(const std::string& product, const std::string& dropping) {
  return "Without [[point]] tables, the rows of the result are " + product +
         ". With [[point]] tables, each is one row: it may hold any key above but title, threads and "
         "checkpoint_interval, as `duration = 500` or as `run.duration = 500`, and takes what it does not hold from "
         "the "
         "sections. Lists of numbers are refused inside a [[point]] table, and so is taking one from a section; a list "
         "there is allowed when every table has a value of its own. Setting " +
         dropping +
         " with --set drops the [[point]] tables, so that the rows come from the sections again; setting another key "
         "changes it in every row.";
}

/// All keys of a file in the order of explanation: what belongs to the whole file stands before the first section, or
/// at the end of its section.
template <class Input, class Row>
std::vector<Key> arranged(const std::vector<BoundKey<Input>>& whole, const std::vector<BoundKey<Row>>& rows) {
  std::vector<Key> keys;
  for (const auto& bound : whole)
    if (bound.key.section.empty()) keys.push_back(bound.key);
  for (const auto& bound : rows) keys.push_back(bound.key);
  for (const auto& bound : whole) {
    if (bound.key.section.empty()) continue;
    auto place = keys.begin();
    for (auto key = keys.begin(); key != keys.end(); ++key)
      if (key->section == bound.key.section) place = key + 1;
    keys.insert(place, bound.key);
  }
  return keys;
}

/// `command` as typed, without the program's name; `product` and `dropping` as above.
template <class Input, class Row>
Schema input_schema(const std::string& command, std::vector<Section> sections, const std::vector<BoundKey<Row>>& keys,
                    const std::string& product, const std::string& dropping) {
  Schema schema;
  schema.introduction = introduction_of(command);
  schema.sections = std::move(sections);
  schema.keys = arranged(whole_keys<Input>(), keys);
  schema.rows = "point";
  schema.rows_meaning = point_tables_of(product, dropping);
  schema.owners = commands_with;
  return schema;
}

/// Reads a file into its struct, whose rows are `points`; `check` refuses (BadInput) what cannot be run.
template <class Input, class Row, class Check>
Input read_input(const std::filesystem::path& file, std::span<const std::string> overrides, const Schema& schema,
                 const std::vector<BoundKey<Row>>& keys, const Check& check) {
  const Document document = read_document(file, overrides, schema);
  Input input;
  for (const auto& bound : whole_keys<Input>())
    if (const auto value = shared_value(document, schema, bound.key.path())) bound.binding.set(input, *value);
  for (const ResolvedRow& row : expand_rows(document, schema)) {
    auto point = fill_row(row, keys);
    try {
      check(point);
    } catch (const BadInput& refusal) {
      throw BadInput(locate_refusal(refusal.what(), row, document, schema));
    }
    input.points.push_back(std::move(point));
  }
  return input;
}

/// `what` was run: "a sweep".
template <class Input, class Row>
std::string resolved_input(std::string_view what, const Schema& schema, const Input& input,
                           const std::vector<BoundKey<Row>>& keys) {
  std::vector<std::map<std::string, Value>> rows;
  for (const Row& point : input.points) rows.push_back(values_of(point, keys));
  return resolved_heading(what) + "\n\n" + resolved_text(schema, values_of(input, whole_keys<Input>()), rows);
}

}  // namespace lucy::files
