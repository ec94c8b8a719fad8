// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cstdio>

#include "lucy/cases/comparison.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/published_csv.hpp"
#include "lucy/files/table_csv.hpp"
#include "lucy/files/table_text.hpp"
#include "program/commands.hpp"
#include "program/data_directory.hpp"

namespace lucy::program {

int compare(const std::filesystem::path& table, const std::string& published_name) {
  std::error_code error;  // what cannot be looked at will not be readable either
  const auto path = std::filesystem::is_directory(table, error) ? table / "table.csv" : table;
  const auto rows = files::read_table_csv(path);
  const auto published = files::read_published_table(published_name, data_directory() / "reference");
  const cases::Comparison comparison = cases::compare(rows, published);
  if (comparison.rows.empty())
    throw BadInput(
        fmt::format("{} has no row with the particles, energy_per_particle and strain_rate of a row of {}: "
                    "there is nothing to compare",
                    path.string(), published.name));
  std::fputs(files::format_comparison(comparison).c_str(), stdout);  // the verdict counts, read or not
  return comparison.verdict == cases::Verdict::agree ? 0 : 1;
}

}  // namespace lucy::program
