// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/isomorphism_point.hpp"

#include "lucy/files/isomorphism_input.hpp"
#include "program/couette_point.hpp"

namespace lucy::program {

std::string IsomorphismStatePoint::label() const { return point_label(cases::sweep_row(settings())); }

std::string IsomorphismStatePoint::identity() const {
  files::IsomorphismInput alone;
  alone.points = {settings()};
  return files::isomorphism_resolved_toml(alone);
}

double IsomorphismStatePoint::interval_cost() const {
  return static_cast<double>(settings().particles) * cases::sample_steps(settings());
}

std::optional<cases::IsomorphismRow> IsomorphismStatePoint::result_at(std::size_t /*stage*/,
                                                                      std::span<const Arrived> /*replicas*/,
                                                                      std::span<const Record> records) {
  return cases::summarize(settings(), records);
}

cases::IsomorphismRow IsomorphismStatePoint::failed_result(const std::string& reason) const {
  return cases::failed_row(settings(), reason);
}

}  // namespace lucy::program
