// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/wave_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "choice_names.hpp"
#include "lucy/files/table_text.hpp"
#include "text_layout.hpp"

namespace lucy::files {

namespace {

using cases::wave_quantity;
using cases::WavePoint;
using cases::WaveQuantity;
using cases::WaveRow;
using statistics::DecayForm;

constexpr double largest_ratio_of_rates = 1e12;  // beyond it a stress or a time is that of another limit

bool of_atoms(const WavePoint& point) { return point.reading == motion::Reading::md; }

template <class Names, class Choice>
std::string word_for(const Names& names, Choice choice) {
  return std::string(name_of(names, choice));
}

/// What tells smooth-particle points apart, in the order in which it is said.
std::vector<std::string> traits(const WavePoint& p) {
  const auto named = [](std::string_view name, double value) {
    return fmt::format("{} {}", name, format_plain(value));
  };
  return {fmt::format("N {}", p.particles),
          named("n", p.density),
          word_for(kernel::weight_names, p.weight),
          named("h", p.range),
          word_for(spam::equation_of_state_names, p.equation_of_state),
          named("kT", p.temperature),
          named("eta", p.viscosity),
          named("bulk", p.bulk_viscosity),
          named("kappa", p.conductivity),
          word_for(spam::density_mean_names, p.density_mean) + " mean",
          named("A", p.amplitude),
          fmt::format("mode {}", p.mode),
          named("disorder", p.disorder),
          named("noise", p.noise),
          "uniform " + word_for(cases::uniform_start_names, p.uniform)};
}

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

/// Atoms by their state and wave vector, but for what is nearly always the same.
std::string atoms_text(const WavePoint& p) {
  std::vector<std::string> words = {fmt::format("atoms E/N {}", format_plain(p.energy_per_particle.value_or(0.0))),
                                    fmt::format("N {}", p.particles)};
  const WavePoint usual;
  if (p.density != usual.density) words.push_back("n " + format_plain(p.density));
  if (p.range != usual.range) words.push_back("h " + format_plain(p.range));
  if (p.mode != usual.mode) words.push_back(fmt::format("mode {}", p.mode));
  return joined(words);
}

std::string amplitude_text(const WavePoint& p) { return "A = " + format_plain(p.amplitude); }

std::string known_or_blank(const std::string& cell) { return cell == "nan" ? std::string() : cell; }

struct Column {
  std::string header;
  std::function<std::string(const WaveRow&)> cell;
};

Column estimate(std::string header, std::size_t quantity) {
  return {std::move(header), [quantity](const WaveRow& row) {
            const statistics::Estimate& estimate = row.estimates[quantity];
            return estimate.value == 0.0 && estimate.error == 0.0
                       ? "0"
                       : known_or_blank(format_with_error(estimate.value, estimate.error));
          }};
}

/// Of one form only: blank where another is preferred.
Column parameter(std::string header, std::size_t quantity, DecayForm form) {
  const Column all = estimate(std::move(header), quantity);
  return {all.header, [=](const WaveRow& row) {
            const double value = std::abs(row.estimates[quantity].value);
            const bool shown = row.preferred == form && value < largest_ratio_of_rates;
            return shown ? all.cell(row) : std::string();
          }};
}

Column plain(std::string header, double WaveRow::*member) {
  return {std::move(header), [member](const WaveRow& row) { return known_or_blank(format_plain(row.*member, 4)); }};
}

/// `columns` behind those that say which point it is. A column in which nothing is known is left out.
std::string table_text(std::span<const WaveRow> rows, const std::vector<Column>& columns, LastColumn last) {
  std::vector<Column> shown;
  for (const Column& column : columns) {
    const bool known = std::ranges::any_of(rows, [&](const WaveRow& row) { return !column.cell(row).empty(); });
    if (known) shown.push_back(column);
  }
  std::vector<std::string> header = {"", ""};
  for (const Column& column : shown) header.push_back(column.header);
  TextTable table(header, 2, last);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string difference = wave_difference(rows[i].settings, rows.front().settings);
    std::vector<std::string> cells = {fmt::format("{}", i + 1), i == 0               ? "as stated"
                                                                : difference.empty() ? "as 1"
                                                                                     : difference};
    for (const Column& column : shown) cells.push_back(column.cell(rows[i]));
    table.add(std::move(cells));
  }
  return table.text();
}

std::string explanation(std::span<const WaveRow> rows, WaveQuantity quantity) {
  const bool shear = quantity == WaveQuantity::shear;
  const auto preferred = [&](DecayForm form) {
    return std::ranges::any_of(
        rows, [&](const WaveRow& row) { return row.status != cases::RowStatus::failed && row.preferred == form; });
  };
  std::string text = wrapped(
      "",
      std::string("Reduced units. In parentheses one standard error, in units of the last digits: the scatter over "
                  "replicas, by the jackknife, with Student's factor below ten degrees of freedom. Blank: not known, "
                  "or without a meaning. All values are ") +
          (shear ? "kinematic viscosities nu but stresses, moduli and times."
                 : "thermal diffusivities kappa/(rho c_P) but times."));
  text += wrapped("by parts: ", fmt::format("what the amplitude a(t) lost up to the time in the last column, in units "
                                            "of k^2 int a dt. by integral: a(0)/(k^2 int a dt) over all times."));
  text += wrapped(
      "operator: ",
      shear ? "viscous forces; carried: momentum that particles take along; pressure forces: the rest, how the "
              "arrangement of the particles resists and yields. at the start: the operator's rate over eta k^2/rho."
            : "conduction; carried: entropy that particles take along; heating: the rest, viscous heating and "
              "compression that is not adiabatic. at the start: the operator's rate over kappa k^2/(rho c_V).");
  text += wrapped("form: ",
                  "the simplest that the replicas' likelihood (of too few: the residuals) does not speak against: "
                  "exponential; yielding, "
                  "a' = -G a - c; viscoelastic, a'' + a'/tau + (G/tau) a = 0. fitted: G/k^2.");
  if (shear && preferred(DecayForm::yielding))
    text += wrapped("yield stress: ", "pi rho c/(4 k), and in units of the pressure.");
  if (shear && preferred(DecayForm::viscoelastic)) text += wrapped("modulus: ", "rho G/(k^2 tau); time: tau.");
  text += wrapped("noise: ", "kinetic energy per particle beyond that of the wave, mean up to the same time.");
  return text;
}

}  // namespace

std::string wave_label(const WavePoint& point) {
  if (of_atoms(point)) return joined({atoms_text(point), amplitude_text(point)});
  const WavePoint usual;
  std::vector<std::string> words = {
      fmt::format("N = {}", point.particles),    word_for(kernel::weight_names, point.weight),
      "h = " + format_plain(point.range),        word_for(spam::equation_of_state_names, point.equation_of_state),
      "kT = " + format_plain(point.temperature), "eta = " + format_plain(point.viscosity)};
  if (point.conductivity != usual.conductivity) words.push_back("kappa = " + format_plain(point.conductivity));
  if (point.bulk_viscosity != usual.bulk_viscosity) words.push_back("bulk = " + format_plain(point.bulk_viscosity));
  if (point.density != usual.density) words.push_back("n = " + format_plain(point.density));
  if (point.density_mean != usual.density_mean)
    words.push_back(word_for(spam::density_mean_names, point.density_mean) + " mean");
  words.push_back(amplitude_text(point));
  if (point.mode != usual.mode) words.push_back(fmt::format("mode {}", point.mode));
  words.push_back("disorder " + format_plain(point.disorder));
  if (point.noise != usual.noise) words.push_back("noise " + format_plain(point.noise));
  if (point.uniform != usual.uniform) words.push_back("uniform " + word_for(cases::uniform_start_names, point.uniform));
  return joined(words);
}

std::string wave_difference(const WavePoint& point, const WavePoint& from) {
  if (of_atoms(point)) return wave_label(point) == wave_label(from) ? "" : atoms_text(point);
  if (of_atoms(from)) return wave_label(point);
  const std::vector<std::string> mine = traits(point);
  const std::vector<std::string> others = traits(from);
  std::vector<std::string> words;
  for (std::size_t i = 0; i < mine.size(); ++i)
    if (mine[i] != others[i]) words.push_back(mine[i]);
  return joined(words);
}

std::string format_waves(std::span<const WaveRow> rows) {
  const WaveQuantity quantity = rows.front().settings.quantity;
  const std::string rest = quantity == WaveQuantity::shear ? "pressure forces" : "heating";
  std::string text = wrapped("1: ", wave_label(rows.front().settings));
  if (rows.size() > 1) text += "The others differ from it in what is stated.\n";
  const Column form = {"form", [](const WaveRow& row) {
                         return row.status == cases::RowStatus::failed ? std::string()
                                                                       : std::string(statistics::name(row.preferred));
                       }};
  const Column status = {"status", [](const WaveRow& row) { return std::string(cases::status_name(row.status)); }};
  text += "\n" + table_text(rows,
                            {plain("prescribed", &WaveRow::prescribed), estimate("by parts", wave_quantity("total")),
                             estimate("by integral", wave_quantity("integral")), form, status},
                            LastColumn::words);
  if (std::ranges::any_of(rows, [](const WaveRow& row) { return row.status != cases::RowStatus::failed; })) {
    text += "\nThe parts:\n" +
            table_text(rows,
                       {estimate("at the start", wave_quantity("operator_factor")),
                        estimate("operator", wave_quantity("operator")), estimate(rest, wave_quantity("rest")),
                        estimate("carried", wave_quantity("carried")), plain("up to", &WaveRow::parts_until)},
                       LastColumn::numbers);
    const Column over_pressure = {
        "/ pressure", [](const WaveRow& row) {
          if (row.preferred != DecayForm::yielding) return std::string();
          const auto& stress = row.estimates[wave_quantity("yield_stress")];
          const double pressure = row.estimates[wave_quantity("pressure")].value;
          return known_or_blank(format_with_error(stress.value / pressure, stress.error / pressure));
        }};
    text += "\nThe preferred form:\n" +
            table_text(rows,
                       {estimate("fitted", wave_quantity("fitted")),
                        parameter("yield stress", wave_quantity("yield_stress"), DecayForm::yielding), over_pressure,
                        parameter("modulus", wave_quantity("modulus"), DecayForm::viscoelastic),
                        parameter("time", wave_quantity("relaxation_time"), DecayForm::viscoelastic),
                        estimate("noise", wave_quantity("particle_noise"))},
                       LastColumn::numbers);
    text += "\n" + explanation(rows, quantity);
  }
  if (std::ranges::any_of(rows, [](const WaveRow& row) { return row.status == cases::RowStatus::too_short; }))
    text += wrapped("short: ", "a single replica, which gives no error bars, or an amplitude that hardly fell.");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const std::string& warning : rows[i].warnings)
      text += wrapped("warning: ", fmt::format("point {}: {}", i + 1, warning));
    if (rows[i].status == cases::RowStatus::failed)
      text += wrapped("failed: ", fmt::format("point {}: {}", i + 1, rows[i].failure));
  }
  return text;
}

}  // namespace lucy::files
