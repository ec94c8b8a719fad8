// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <span>
#include <string>

#include "lucy/cases/couette_table.hpp"
#include "text_layout.hpp"

namespace lucy::files {

/// What has to be said below a table: warnings and failures of numbered rows, which label(row) describes.
template <class Row, class Label>
std::string remarks_on(std::span<const Row> rows, const Label& label) {
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string where = fmt::format("row {} ({})", i + 1, label(rows[i]));
    for (const std::string& warning : rows[i].warnings)
      text += wrapped("warning: ", fmt::format("{}: {}", where, warning));
    if (rows[i].status == cases::RowStatus::failed)
      text += wrapped("failed: ", fmt::format("{}{}{}", where, rows[i].failure.empty() ? "" : ": ", rows[i].failure));
  }
  return text;
}

}  // namespace lucy::files
