// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/benard_point.hpp"

#include "lucy/files/benard_h5md.hpp"
#include "lucy/files/benard_input.hpp"
#include "lucy/files/benard_text.hpp"

namespace lucy::program {

std::string BenardStatePoint::label() const { return files::benard_label(settings()); }

std::string BenardStatePoint::identity() const {
  files::BenardInput alone;
  alone.points = {settings()};
  return files::benard_resolved_toml(alone);
}

double BenardStatePoint::interval_cost() const {
  return static_cast<double>(settings().particles) * cases::sample_steps(settings());
}

statistics::Estimate BenardStatePoint::estimate() const {
  return cases::current_kinetic_energy(settings(), noted([](const Record& record) { return !record.samples.empty(); }));
}

std::optional<cases::BenardRow> BenardStatePoint::result_at(std::size_t /*stage*/, std::span<const Arrived> replicas,
                                                            std::span<const Record> records) {
  std::vector<const files::FrameSpool*> frames;
  for (const Arrived& arrived : replicas) frames.push_back(arrived.frames);
  files::write_h5md(series(), settings(), records, frames, run_of(*replicas.front().replica).last(), authorship());
  return cases::summarize(settings(), records);
}

cases::BenardRow BenardStatePoint::failed_result(const std::string& reason) const {
  return cases::failed_row(settings(), reason);
}

}  // namespace lucy::program
