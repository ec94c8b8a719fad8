// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/wave_point.hpp"

#include "lucy/files/wave_h5md.hpp"
#include "lucy/files/wave_input.hpp"
#include "lucy/files/wave_text.hpp"

namespace lucy::program {

namespace {

// What a step of a particle costs, measured on one core in units of an atom's with range 3: in proportion to 12 + n h^2
// (the first for everything but pairs), more passes for smooth particles, and a kernel of two pieces.
constexpr double beside_pairs = 12.0;
constexpr double fluid_cost = 2.1;
constexpr double transport_cost = 4.2;
constexpr double monaghan_cost = 2.0;

}  // namespace

std::string WaveStatePoint::label() const { return files::wave_label(settings()); }

std::string WaveStatePoint::identity() const {
  files::WaveInput alone;
  alone.quantity = settings().quantity;
  alone.points = {settings()};
  return std::string(files::command_name(alone.quantity)) + '\n' + files::wave_resolved_toml(alone);
}

double WaveStatePoint::interval_cost() const {
  const cases::WavePoint& point = settings();
  const auto pairs = [](double density, double range) { return beside_pairs + density * range * range; };
  double cost = pairs(point.density, point.range) / pairs(1.0, 3.0);
  if (point.reading == motion::Reading::spam)
    cost *= cases::fluid_of(point).transport.none() ? fluid_cost : transport_cost;
  if (point.weight == kernel::WeightName::monaghan) cost *= monaghan_cost;
  return cost * static_cast<double>(point.particles) *
         static_cast<double>(cases::wave_schedule(point).steps_per_interval());
}

std::optional<cases::WaveResult> WaveStatePoint::result_at(std::size_t /*stage*/, std::span<const Arrived> replicas,
                                                           std::span<const Record> records) {
  std::vector<const files::FrameSpool*> frames;
  for (const Arrived& arrived : replicas) frames.push_back(arrived.frames);
  if (records_frames()) files::write_h5md(series(), settings(), records, frames, authorship());
  return cases::summarize(settings(), records);
}

cases::WaveResult WaveStatePoint::failed_result(const std::string& reason) const {
  cases::WaveResult result;
  result.row = cases::failed_row(settings(), reason);
  return result;
}

}  // namespace lucy::program
