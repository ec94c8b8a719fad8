// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "row_cells.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>

#include "lucy/errors.hpp"

namespace lucy::files {

void require_columns(const CsvFile& file, std::span<const std::string> columns, std::string_view kind) {
  for (const auto& column : columns)
    if (!file.has_column(column))
      throw BadInput(fmt::format("{}:1: the header of a {} has a column {}; this one has {}", file.path(), kind, column,
                                 fmt::join(file.columns(), ", ")));
}

void add_with_error(std::vector<std::string>& columns, std::string_view name) {
  columns.emplace_back(name);
  columns.push_back(fmt::format("{}_error", name));
}

void add(CsvLine& line, const statistics::Estimate& estimate) {
  line.add(estimate.value);
  line.add(estimate.error);
}

double RowCells::number(std::string_view column) const { return file_.number(row_, file_.column(column)); }

std::int64_t RowCells::integer(std::string_view column) const { return file_.integer(row_, file_.column(column)); }

int RowCells::count(std::string_view column) const {
  const std::int64_t value = integer(column);
  if (value < 0 || value > std::numeric_limits<int>::max())
    throw BadInput(fmt::format("{}:{}: {} is {} where a count was expected", file_.path(), row_.line, column, value));
  return static_cast<int>(value);
}

statistics::Estimate RowCells::estimate(std::string_view name) const {
  statistics::Estimate estimate;
  estimate.value = number(name);
  estimate.error = number(fmt::format("{}_error", name));
  if (estimate.error < 0.0)
    throw BadInput(fmt::format("{}:{}: {}_error is {} where an error (at least 0, or nan) was expected", file_.path(),
                               row_.line, name, estimate.error));
  return estimate;
}

cases::RowStatus RowCells::status() const {
  using cases::RowStatus;
  const std::string& name = text("status");
  for (const RowStatus status : {RowStatus::ok, RowStatus::too_short, RowStatus::failed})
    if (cases::status_name(status) == name) return status;
  throw BadInput(
      fmt::format("{}:{}: status is \"{}\" where ok, short or failed was expected", file_.path(), row_.line, name));
}

void RowCells::refuse_choice(std::string_view column, std::string_view cell, std::string_view known) const {
  throw BadInput(
      fmt::format("{}:{}: {} is \"{}\" where one of {} was expected", file_.path(), row_.line, column, cell, known));
}

}  // namespace lucy::files
