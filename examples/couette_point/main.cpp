// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shear viscosity of one state point: two replicas of 400 particles sheared at rate 0.5.
#include <fmt/format.h>

#include <lucy/cases/couette.hpp>
#include <lucy/cases/couette_table.hpp>
#include <vector>

int main() {
  lucy::cases::CouettePoint point;
  point.particles = 400;
  point.energy_per_particle = 1.0;
  point.strain_rate = 0.5;
  point.duration = 1000.0;
  point.replicas = 2;
  lucy::cases::validate(point);

  std::vector<lucy::cases::CouetteRecord> records;
  for (int replica = 0; replica < point.replicas; ++replica) {
    lucy::cases::CouetteRun run(point, replica);
    while (run.intervals_done() < run.intervals_needed(point.duration)) run.advance_one_sample();
    records.push_back(run.record());
  }

  const auto row = lucy::cases::summarize(point, point.duration, records);
  const auto viscosity = row.estimates[lucy::cases::quantity("viscosity")];
  fmt::print("viscosity {:.4f} +- {:.4f}\n", viscosity.value, viscosity.error);
}
