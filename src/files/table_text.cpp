// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/table_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "text_layout.hpp"

namespace lucy::files {

namespace {

using cases::ComparedCell;
using cases::Comparison;
using cases::Standing;
using cases::TableRow;

constexpr int most_decimals = 15;  // of a double near one

/// Power of ten of the first digit, after rounding to so many digits.
int leading_power(double value, int significant_digits) {
  const std::string text = fmt::format("{:.{}e}", value, significant_digits - 1);
  return std::stoi(text.substr(text.find('e') + 1));
}

std::string not_finite(double value) { return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf"; }

/// Plain decimals are for people; beyond this many characters nobody counts the zeros any more.
constexpr std::size_t widest_plain = 12;

bool too_wide(std::string_view number) {
  if (number.starts_with('-')) number.remove_prefix(1);
  return number.size() > widest_plain;
}

std::string without_last_zeros(std::string text) {
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

/// "13.52(14)"; both numbers finite, the error above zero.
std::string plain_with_error(double value, double error) {
  const int power = leading_power(error, 2);
  const int decimals = 1 - power;
  if (decimals > most_decimals) return fixed(value, most_decimals) + "(0)";
  if (power < 0) {
    const std::string digits = fmt::format("{:.0f}", error * std::pow(10.0, decimals));
    return fmt::format("{}({})", fixed(value, decimals), digits);
  }
  if (power == 0) return fmt::format("{}({:.1f})", fixed(value, 1), error);
  const double unit = std::pow(10.0, power - 1);
  return fmt::format("{}({:.0f})", fixed(std::round(value / unit) * unit, 0), std::round(error / unit) * unit);
}

/// The largest of N independent exponentially distributed energies (two dimensions) carries this part on average.
double expected_largest_share(std::int64_t particles) {
  const auto count = static_cast<double>(std::max<std::int64_t>(particles, 2));
  return (std::log(count) + std::numbers::egamma) / count;
}

std::string point_text(std::int64_t particles, double energy_per_particle, double strain_rate) {
  return fmt::format("{}, rate {}", state_text(particles, energy_per_particle), format_plain(strain_rate));
}

std::string published_text(const ComparedCell& cell) {
  if (!(cell.last_digit > 0.0)) return format_plain(cell.published);
  return fixed(cell.published,
               std::clamp(static_cast<int>(std::ceil(-std::log10(cell.last_digit) - 1e-9)), 0, most_decimals));
}

/// Reasons of misprints, numbered in the order of their first appearance.
class Footnotes {
 public:
  std::size_t number(const std::string& text) {
    const auto found = std::find(texts_.begin(), texts_.end(), text);
    if (found != texts_.end()) return static_cast<std::size_t>(found - texts_.begin()) + 1;
    texts_.push_back(text);
    return texts_.size();
  }
  const std::vector<std::string>& texts() const { return texts_; }

 private:
  std::vector<std::string> texts_;
};

std::string remark(const ComparedCell& cell, Footnotes& footnotes) {
  switch (cell.standing) {
    case Standing::judged:
      return std::abs(cell.difference) > 4.0 ? "DISAGREES" : "";
    case Standing::read_differently:
      return std::abs(cell.difference) > 4.0 ? "as it should read, DISAGREES" : "as it should read";
    case Standing::misprint:
      return fmt::format("as printed, a misprint [{}]: not judged", footnotes.number(cell.why));
    case Standing::instability_region:
      return "not judged";
    case Standing::no_error:
      return "no error bar: not judged";
  }
  return "";
}

int count_standing(const Comparison& comparison, Standing standing) {
  int count = 0;
  for (const auto& row : comparison.rows)
    count += static_cast<int>(std::ranges::count(row.cells, standing, &ComparedCell::standing));
  return count;
}

std::string verdict_text(const Comparison& comparison) {
  switch (comparison.verdict) {
    case cases::Verdict::agree:
      return "agree: no judged cell is beyond 4 combined standard errors.";
    case cases::Verdict::disagree:
      return fmt::format("disagree: {} of {} judged cells beyond 4 combined standard errors.", comparison.beyond[2],
                         comparison.judged);
    case cases::Verdict::nothing_to_judge:
      return "none: there is no cell that can be judged.";
  }
  return "";
}

}  // namespace

std::string format_plain(double value, int significant_digits) {
  if (!std::isfinite(value)) return not_finite(value);
  if (value == 0.0) return "0";
  const int power = leading_power(value, significant_digits);
  std::string text = without_last_zeros(fixed(value, std::max(significant_digits - 1 - power, 0)));
  if (!too_wide(text)) return text;
  const std::string digits = fmt::format("{:.{}e}", value, significant_digits - 1);
  return fmt::format("{}e{}", without_last_zeros(digits.substr(0, digits.find('e'))), power);
}

std::string format_with_error(double value, double error) {
  if (!std::isfinite(value)) return not_finite(value);
  if (!std::isfinite(error)) return format_plain(value, 4) + "(nan)";
  if (error <= 0.0) return format_plain(value) + "(0)";
  const int largest = leading_power(std::max(std::abs(value), error), 2);
  std::string text = plain_with_error(value, error);
  const double unit = std::pow(10.0, largest);
  if (!too_wide(text.substr(0, text.find('('))) || !(unit > 0.0)) return text;
  const std::string scaled = fmt::format("{}e{}", plain_with_error(value / unit, error / unit), largest);
  return scaled.size() < text.size() ? scaled : text;
}

std::string format_table(std::span<const TableRow> rows) {
  using cases::quantity;
  const auto share_of = [](const TableRow& row) { return row.estimates[quantity("largest_kinetic_share")].value; };
  const auto notable = [&](const TableRow& row) { return share_of(row) > 4.0 * expected_largest_share(row.particles); };
  const bool with_share = std::ranges::any_of(rows, notable);

  std::vector<std::string> header = {"N",       "E/N",       "rate",          "kT",    "Pxy kinetic",
                                     "Pxy pot", "viscosity", "normal stress", "status"};
  if (with_share) header.insert(header.end() - 1, "share");
  TextTable table(header, 0);
  for (const TableRow& row : rows) {
    std::vector<std::string> cells = {fmt::format("{}", row.particles), format_plain(row.energy_per_particle),
                                      format_plain(row.strain_rate)};
    for (const std::size_t place : {quantity("kinetic_temperature"), quantity("pxy_kinetic"), quantity("pxy_potential"),
                                    quantity("viscosity"), quantity("normal_stress")})
      cells.push_back(format_with_error(row.estimates[place].value, row.estimates[place].error));
    if (with_share) cells.push_back(notable(row) ? format_plain(share_of(row), 2) : "");
    cells.emplace_back(cases::status_name(row.status));
    table.add(std::move(cells));
  }

  std::string text = table.text();
  text +=
      "\nIn parentheses one standard error, in units of the last digits: blocking of each replica's series, pooled "
      "over\n"
      "replicas; with Student's factor where there are fewer than ten degrees of freedom.\n";
  const auto any = [&](cases::RowStatus status) {
    return std::ranges::any_of(rows, [&](const TableRow& row) { return row.status == status; });
  };
  if (with_share)
    text +=
        "share: the part of the kinetic energy that one particle carries, where it stands out; averages of such rows\n"
        "depend on the length of the run.\n";
  if (any(cases::RowStatus::too_short))
    text +=
        "short: too short for an error bar, or for the relative error that was asked for, by 50 effective samples;\n"
        "or sheared without a thermostat, which never becomes steady.\n";
  for (const TableRow& row : rows)
    if (row.status == cases::RowStatus::failed)
      text += fmt::format("failed: {}{}{}\n", point_text(row.particles, row.energy_per_particle, row.strain_rate),
                          row.failure.empty() ? "" : ": ", row.failure);
  return text;
}

std::string format_comparison(const Comparison& comparison) {
  std::string text = fmt::format("Ours beside {}: {}\n", comparison.name, comparison.source);
  const std::string theirs = comparison.in_print ? "published" : "theirs";
  TextTable table({"", "ours", theirs, "+-", "difference", ""}, 1);
  Footnotes footnotes;
  for (const auto& row : comparison.rows)
    for (const ComparedCell& cell : row.cells)
      table.add({fmt::format("  {}", cases::compared_quantities[cell.quantity]),
                 format_with_error(cell.ours, cell.our_error), published_text(cell),
                 format_plain(cell.published_error, 2), signed_errors(cell.difference), remark(cell, footnotes)});
  const auto lines = table.lines();
  std::size_t next = 1;
  if (!comparison.rows.empty()) text += lines.front() + '\n';
  for (const auto& row : comparison.rows) {
    text += fmt::format("{}; total time ours {}, {} {}{}\n",
                        point_text(row.particles, row.energy_per_particle, row.strain_rate), format_plain(row.our_time),
                        theirs, format_plain(row.published_time), row.instability_region ? "; instability region" : "");
    for (std::size_t i = 0; i < row.cells.size(); ++i) text += lines[next++] + '\n';
  }

  if (!comparison.only_ours.empty()) text += "\nOnly in our table:\n";
  for (const auto& row : comparison.only_ours)
    text += fmt::format("  {}\n", point_text(row.particles, row.energy_per_particle, row.strain_rate));
  if (!comparison.only_published.empty())
    text += comparison.in_print ? "\nOnly in the published table:\n" : "\nOnly in theirs:\n";
  for (const auto& row : comparison.only_published)
    text += fmt::format("  {}\n", point_text(row.particles, row.energy_per_particle, row.strain_rate));
  if (!footnotes.texts().empty()) text += '\n';
  for (const auto& footnote : footnotes.texts())
    text += wrapped(fmt::format("[{}] ", footnotes.number(footnote)), footnote);

  text +=
      comparison.in_print
          ? "\ndifference: (ours - published) over the combined standard error. +- is the standard error of the "
            "published\n"
            "value: its own where it is given, else one unit of the last printed digit over sqrt(12), and in "
            "quadrature our\n"
            "error times sqrt(our total time / theirs). The viscosity follows from the two printed parts of P_xy.\n\n"
          : "\ndifference: (ours - theirs) over the combined standard error; +- is the standard error of theirs.\n\n";
  text += comparison.in_print
              ? fmt::format("{} cells judged, {} of them printed: ", comparison.judged, comparison.independent)
              : fmt::format("{} cells judged; without the viscosities, which follow from P_xy: ", comparison.judged);
  text += fmt::format("chi squared {:.1f} for {}.", comparison.chi_squared, comparison.independent);
  if (comparison.judged > 0)
    text +=
        fmt::format(" Beyond 2: {}, beyond 3: {}, beyond 4: {}.\nLargest difference {:.1f}: {}.", comparison.beyond[0],
                    comparison.beyond[1], comparison.beyond[2], comparison.largest, comparison.largest_where);
  text += fmt::format(
      "\nNot judged: {} misprinted, {} in the instability region (averages depend on the run length), {} without "
      "an error bar.\n",
      count_standing(comparison, Standing::misprint), count_standing(comparison, Standing::instability_region),
      count_standing(comparison, Standing::no_error));
  return text + fmt::format("Verdict: {}\n", verdict_text(comparison));
}

}  // namespace lucy::files
