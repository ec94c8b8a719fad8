// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The keys of a sweep, and where each is stored in a CouettePoint.
#include "lucy/files/input.hpp"

#include <fmt/format.h>

#include "lucy/archive.hpp"
#include "lucy/cases/start_state.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/checkpoint.hpp"
#include "lucy/files/particle_file.hpp"
#include "shared_keys.hpp"

namespace lucy::files {
namespace {

using cases::CouettePoint;

/// The keys that may differ from row to row.
std::vector<BoundKey<CouettePoint>> point_keys() {
  using P = CouettePoint;
  const std::vector<BoundKey<P>> temperature = {
      {{.section = "system",
        .name = "kinetic_temperature",
        .unit = "epsilon/k",
        .meaning = "Target temperature K/(N-1) of the isokinetic and the Nose-Hoover thermostat.",
        .range = Range::above(0),
        .default_text = "that of the start"},
       stored_in(&P::kinetic_temperature)},
      {{.section = "system",
        .name = "start",
        .type = Type::text,
        .meaning =
            "File of the state to start from: the last frame of a LAMMPS data file or dump (box tilted or not), "
            "of extended XYZ, or of a point file. Its box takes the place of the lattice's; its peculiar momenta "
            "are scaled, by a tenth at most, so that the energy is energy_per_particle.",
        .default_text = "a lattice"},
       stored_unless_empty_in(&P::start)},
      {{.section = "system",
        .name = "start_strain_rate",
        .unit = "1/time",
        .meaning = "With start: the strain rate of the flow in the velocities of that file, which is taken out of them "
                   "(0: they are peculiar).",
        .default_text = "what the file says, or 0"},
       stored_in(&P::start_strain_rate)},
      {{.section = "system",
        .name = "start_checksum",
        .type = Type::text,
        .meaning =
            "With start: CRC-64 of the state that is meant (box, positions, peculiar momenta), as it stands in a "
            "resolved input. A file that holds another state is refused.",
        .default_text = "that of the state that is found"},
       stored_unless_empty_in(&P::start_checksum)}};
  const auto shear = joined(
      strain_rate_key<P>("Strain rate d u_x/d y, of either sign. At zero there is no shear and no viscosity."),
      thermostat_keys<P>("How the heat of the shear is removed: at constant internal energy (Gauss), at constant "
                         "kinetic energy (Gauss), by feedback (Nose and Hoover), or not at all."));
  const std::vector<BoundKey<P>> target = {
      {{.section = "run",
        .name = "target_relative_error",
        .meaning = "Run each row until the viscosity is known to this fraction of its value, by at least 50 effective "
                   "samples, beyond duration if need be.",
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
  };
  const auto output = joined(
      sample_interval_key<P>("Time over which one recorded value averages, a whole number of steps.",
                             "the larger of 0.5 and duration/20000, at most duration/10"),
      frame_interval_key<P>(
          "Time between recorded configurations of the first replica, a whole number of steps; 0 records none. They "
          "fall on the end of the equilibration and on multiples of this interval after it. A sample_interval that "
          "is not set is shortened until it divides this one; one that is set must divide it."));
  const std::string rates = "shear.strain_rate";
  const std::string equilibration =
      "Time run first and not recorded, per replica. More is discarded later where the data ask for it.";
  return joined(system_keys<P>(Lists::none), temperature, kernel_keys<P>(), shear, integration_keys<P>(rates),
                length_keys<P>(equilibration, rates), replica_keys<P>(), target, tolerance_keys<P>(), output);
}

/// Refuses what contradicts itself within one row; the physics is judged by cases::validate.
void refuse_contradictions(const CouettePoint& point) {
  if (point.maximum_duration > 0.0 && point.maximum_duration < point.duration)
    throw BadInput(fmt::format("run.maximum_duration = {} must be a number of at least run.duration = {}",
                               toml_text(point.maximum_duration), toml_text(point.duration)));
}

std::string checksum_of(const cases::Frame& frame) {
  ArchiveWriter state;
  state.put(frame.offset);
  state.put(frame.box);
  state.put_sequence(frame.position);
  state.put_sequence(frame.momentum);
  return fmt::format("CRC-64 {:016x}", crc64(state.bytes()));
}

/// The state that a point starts from, if that is one from a file.
void read_start(CouettePoint& point) {
  if (point.start.empty()) return;
  ParticleState state;
  try {
    const ParticleReader reader(point.start);
    if (reader.format() == ParticleFormat::h5md && point.start_strain_rate)
      throw BadInput(
          fmt::format("system.start_strain_rate = {}, but this is a point file of Lucy, whose momenta are "
                      "peculiar",
                      toml_text(*point.start_strain_rate)));
    state = reader.state(reader.frames() - 1, point.start_strain_rate);
  } catch (const BadInput& refusal) {
    throw BadInput(fmt::format("system.start = {}: {}", toml_text(point.start), refusal.what()));
  }
  const std::string checksum = checksum_of(state.frame);
  if (!point.start_checksum.empty() && point.start_checksum != checksum)
    throw BadInput(fmt::format("system.start_checksum = {}, but {} holds another state now, {}; \"\" takes that one",
                               toml_text(point.start_checksum), point.start, checksum));
  point.start_checksum = checksum;
  point.start_frame = std::make_shared<const cases::Frame>(std::move(state.frame));
  if (!state.flow_told && !point.start_strain_rate) cases::refuse_flow_in_start(point);
}

}  // namespace

Schema sweep_schema() {
  return input_schema<SweepInput>(
      "sweep",
      {{"", "The experiment."},
       {"system", "What is simulated."},
       {"kernel", "The pair potential."},
       {"shear", "What drives it, and what keeps it steady."},
       {"run", "How it is integrated, how long, how often."},
       {"output", "What is recorded."}},
      point_keys(),
      "all pairs of an energy_per_particle and a strain_rate: the energies outermost, the strain rates innermost",
      "particles, energy_per_particle or strain_rate");
}

SweepInput read_sweep(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return read_input<SweepInput>(file, overrides, sweep_schema(), point_keys(), [](CouettePoint& point) {
    refuse_contradictions(point);
    read_start(point);
    cases::validate(point);
  });
}

SweepInput read_sweep_without_starts(const std::filesystem::path& file) {
  return read_input<SweepInput>(file, {}, sweep_schema(), point_keys(), [](CouettePoint& point) {
    refuse_contradictions(point);
    if (point.start.empty()) cases::validate(point);
  });
}

std::string resolved_toml(const SweepInput& input, std::string_view what) {
  return resolved_input(what, sweep_schema(), input, point_keys());
}

}  // namespace lucy::files
