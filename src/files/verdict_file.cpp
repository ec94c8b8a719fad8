// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/verdict_file.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "lucy/errors.hpp"
#include "lucy/files/table_text.hpp"
#include "row_cells.hpp"
#include "text_layout.hpp"

namespace lucy::files {

namespace {

using cases::VerdictLine;

std::string value_text(double value, double error) {
  if (std::isnan(value)) return "";
  return error > 0.0 || std::isnan(error) ? format_with_error(value, error) : format_plain(value, 7);
}

/// Rounding has exponents that nobody would write out.
std::string size_text(double value) {
  if (value == 0.0) return "0";
  return std::abs(value) < 1e-4 ? fmt::format("{:.1e}", value) : format_plain(value, 3);
}

std::string_view verdict_word(const VerdictLine& line) {
  if (!line.judged) return "shown";
  if (std::isnan(line.difference)) return "unknown";
  return line.agrees() ? "agrees" : "differs";
}

/// What asks for a reader's attention stands in capitals.
std::string loud(std::string_view word) {
  if (word == "unknown") return "UNKNOWN";
  return word == "differs" ? "DIFFERS" : std::string(word);
}

}  // namespace

void write_verdict_csv(const std::filesystem::path& path, std::span<const VerdictLine> lines) {
  write_rows(path,
             {"part", "quantity", "lucy", "lucy_error", "other", "other_error", "difference", "allowed", "unit",
              "judged", "verdict"},
             lines, [](CsvLine& line, const VerdictLine& of) {
               line.add(of.part);
               line.add(of.quantity);
               for (const double value : {of.lucy, of.lucy_error, of.other, of.other_error, of.difference, of.allowed})
                 line.add(value);
               line.add(of.in_standard_errors ? std::string_view("standard errors") : std::string_view("absolute"));
               line.add(of.judged ? std::string_view("yes") : std::string_view("no"));
               line.add(verdict_word(of));
             });
}

std::vector<VerdictLine> read_verdict_csv(const std::filesystem::path& path) {
  const CsvFile file(path);
  std::vector<VerdictLine> lines;
  for (const auto& row : file.rows()) {
    const auto number = [&](const char* column) { return file.number(row, file.column(column)); };
    const auto word = [&](const char* column) { return row.cells[file.column(column)]; };
    VerdictLine line = {word("part"),    word("quantity"),      number("lucy"),       number("lucy_error"),
                        number("other"), number("other_error"), number("difference"), number("allowed")};
    line.in_standard_errors = word("unit") == "standard errors";
    line.judged = word("judged") == "yes";
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string format_verdict(std::span<const VerdictLine> lines, const std::string& other) {
  TextTable table({"", "Lucy", other, "difference", "allowed", "verdict"}, 1);
  std::vector<std::size_t> headings;  // before which line of the table
  std::string part;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const VerdictLine& line = lines[i];
    if (line.part != part) headings.push_back(i);
    part = line.part;
    const auto in_unit = [&](double value) -> std::string {
      if (std::isnan(value)) return "";
      return line.in_standard_errors ? fmt::format("{} s.e.", signed_errors(value)) : size_text(value);
    };
    table.add({"  " + line.quantity, value_text(line.lucy, line.lucy_error), value_text(line.other, line.other_error),
               in_unit(line.difference),
               line.in_standard_errors ? format_plain(line.allowed) + " s.e." : size_text(line.allowed),
               loud(verdict_word(line))});
  }
  const auto rows = table.lines();
  const std::size_t width = std::ranges::max(rows, {}, &std::string::size).size();
  std::string text = rows.front() + '\n' + std::string(width, '-') + '\n';
  std::size_t heading = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (heading < headings.size() && headings[heading] == i) {
      text += lines[i].part + '\n';
      ++heading;
    }
    text += rows[i + 1] + '\n';
  }
  const auto judged = std::ranges::count_if(lines, [](const VerdictLine& line) { return line.judged; });
  const auto differing = std::ranges::count_if(lines, [](const VerdictLine& line) { return !line.agrees(); });
  text += differing == 0
              ? fmt::format("\nBoth engines agree in all of {} lines.\n", judged)
              : fmt::format("\nThe engines differ, or could not be compared, in {} of {} lines.\n", differing, judged);
  return text;
}

}  // namespace lucy::files
