// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/benard_grid_point.hpp"

#include <fmt/format.h>

#include "lucy/files/benard_grid_h5.hpp"
#include "lucy/files/benard_grid_input.hpp"
#include "lucy/files/benard_grid_text.hpp"

namespace lucy::program {

std::string BenardGridStatePoint::label() const { return files::benard_grid_label(settings()); }

std::string BenardGridStatePoint::identity() const {
  files::BenardGridInput alone;
  alone.points = {settings()};
  return files::benard_grid_resolved_toml(alone);
}

double BenardGridStatePoint::interval_cost() const {
  return static_cast<double>(settings().cells) * cases::flow_settings(settings()).cells_x *
         cases::interval_steps(settings());
}

std::optional<cases::BenardGridRow> BenardGridStatePoint::result_at(std::size_t /*stage*/,
                                                                    std::span<const Arrived> /*replicas*/,
                                                                    std::span<const Record> records) {
  files::write_benard_grid_h5(series(), settings(), records.front(),
                              fmt::format("{} {}", authorship().creator, authorship().creator_version));
  return cases::summarize(settings(), records.front());
}

cases::BenardGridRow BenardGridStatePoint::failed_result(const std::string& reason) const {
  return cases::failed_row(settings(), reason);
}

}  // namespace lucy::program
