// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/green_kubo_point.hpp"

#include <fmt/format.h>

#include "lucy/files/green_kubo_input.hpp"
#include "lucy/files/h5md.hpp"
#include "lucy/files/table_text.hpp"

namespace lucy::program {

std::string GreenKuboStatePoint::label() const {
  return fmt::format("N = {}, E/N = {}", settings().particles, files::format_plain(settings().energy_per_particle));
}

std::string GreenKuboStatePoint::identity() const {
  files::GreenKuboInput alone;
  alone.points = {settings()};
  return files::green_kubo_resolved_toml(alone);
}

double GreenKuboStatePoint::interval_cost() const {
  return static_cast<double>(settings().particles) * static_cast<double>(cases::interval_steps(settings()));
}

statistics::Estimate GreenKuboStatePoint::estimate() const {
  return cases::current_viscosity(settings(), noted([](const Record& record) { return !record.blocks.empty(); }));
}

std::optional<cases::GreenKuboResult> GreenKuboStatePoint::result_at(std::size_t /*stage*/,
                                                                     std::span<const Arrived> replicas,
                                                                     std::span<const Record> records) {
  std::vector<files::H5mdGreenKuboReplica> series;
  for (std::size_t number = 0; number < replicas.size(); ++number) {
    const cases::GreenKuboRun& run = run_of(*replicas[number].replica);
    series.push_back(
        {static_cast<int>(number), &records[number], run.series(), run.first_recorded_step(), replicas[number].frames});
  }
  files::write_h5md(this->series(), settings(), series, authorship());
  return cases::summarize(settings(), records);
}

cases::GreenKuboResult GreenKuboStatePoint::failed_result(const std::string& reason) const {
  cases::GreenKuboResult result;
  result.row = cases::failed_row(settings(), reason);
  return result;
}

}  // namespace lucy::program
