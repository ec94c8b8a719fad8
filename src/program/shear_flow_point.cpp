// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/shear_flow_point.hpp"

#include "lucy/files/shear_flow_h5md.hpp"
#include "lucy/files/shear_flow_input.hpp"
#include "lucy/files/shear_flow_text.hpp"

namespace lucy::program {

std::string ShearFlowStatePoint::label() const { return files::shear_flow_label(settings()); }

std::string ShearFlowStatePoint::identity() const {
  files::ShearFlowInput alone;
  alone.points = {settings()};
  return files::shear_flow_resolved_toml(alone);
}

double ShearFlowStatePoint::interval_cost() const {
  return static_cast<double>(settings().particles) * cases::sample_steps(settings());
}

statistics::Estimate ShearFlowStatePoint::estimate() const {
  return cases::current_viscosity(settings(), noted([](const Record& record) { return !record.samples.empty(); }));
}

std::optional<cases::ShearFlowRow> ShearFlowStatePoint::result_at(std::size_t /*stage*/,
                                                                  std::span<const Arrived> replicas,
                                                                  std::span<const Record> records) {
  std::vector<files::H5mdShearFlowReplica> series;
  for (std::size_t number = 0; number < replicas.size(); ++number)
    series.push_back({static_cast<int>(number), &records[number], replicas[number].frames});
  files::write_h5md(this->series(), settings(), series, authorship());
  return cases::summarize(settings(), records);
}

cases::ShearFlowRow ShearFlowStatePoint::failed_result(const std::string& reason) const {
  return cases::failed_row(settings(), reason);
}

}  // namespace lucy::program
