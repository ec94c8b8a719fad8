// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/green_kubo_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "lucy/files/table_text.hpp"
#include "text_layout.hpp"

namespace lucy::files {

namespace {

using cases::FitPart;
using cases::green_kubo_quantity;
using cases::GreenKuboRow;
using cases::SideBySide;
using cases::ZeroRateFit;

using Rows = std::vector<const GreenKuboRow*>;

struct Column {
  std::string header;
  std::function<std::string(const GreenKuboRow&)> cell;
  bool always = false;  ///< stays when nothing is known
};

Column estimate(std::string header, std::size_t quantity, bool always = false) {
  const auto cell = [quantity](const GreenKuboRow& row) {
    return format_with_error(row.estimates[quantity].value, row.estimates[quantity].error);
  };
  return {std::move(header), cell, always};
}

Column plain(std::string header, double GreenKuboRow::*member, int significant_digits) {
  return {std::move(header), [=](const GreenKuboRow& row) { return format_plain(row.*member, significant_digits); }};
}

/// Of a series that was sampled elsewhere neither particles nor energy are known.
bool state_is_known(const GreenKuboRow& row) { return row.particles > 0; }

std::string state_of(const GreenKuboRow& row) {
  return state_is_known(row) ? state_text(row.particles, row.energy_per_particle) : "series";
}

/// `columns` behind those that say which state it is.
std::string table_text(const Rows& rows, const std::vector<Column>& columns, LastColumn last = LastColumn::numbers) {
  std::vector<Column> shown;
  if (std::ranges::any_of(rows, [](const GreenKuboRow* row) { return state_is_known(*row); })) {
    shown.push_back({"N", [](const GreenKuboRow& row) { return fmt::format("{}", row.particles); }});
    shown.push_back({"E/N", [](const GreenKuboRow& row) { return format_plain(row.energy_per_particle); }});
  }
  for (const Column& column : columns) {
    const auto unknown = [&](const GreenKuboRow* row) { return column.cell(*row) == "nan"; };
    if (column.always || !std::ranges::all_of(rows, unknown)) shown.push_back(column);
  }
  std::vector<std::string> header;
  for (const Column& column : shown) header.push_back(column.header);
  TextTable table(header, 0, last);
  for (const GreenKuboRow* row : rows) {
    std::vector<std::string> cells;
    for (const Column& column : shown) cells.push_back(column.cell(*row));
    table.add(std::move(cells));
  }
  return table.text();
}

bool known(const Rows& rows, std::size_t quantity) {
  return std::ranges::any_of(rows,
                             [&](const GreenKuboRow* row) { return !std::isnan(row->estimates[quantity].value); });
}

std::string details(const Rows& rows) {
  const Column viscosity = estimate("viscosity", green_kubo_quantity("viscosity"), true);
  std::string text = "\nHow the viscosity depends on the cut-off, and what the spectrum says:\n";
  text += table_text(rows, {estimate("half cut-off", green_kubo_quantity("viscosity_half_cutoff")),
                            viscosity,
                            estimate("twice cut-off", green_kubo_quantity("viscosity_twice_cutoff")),
                            estimate("spectrum", green_kubo_quantity("viscosity_spectrum")),
                            {"difference", [](const GreenKuboRow& row) { return signed_errors(row.spectrum_z); }},
                            plain("p-value", &GreenKuboRow::spectrum_p_value, 2)});
  text += "\nThe parts of the viscosity, and the two stresses alone:\n";
  text += table_text(rows, {viscosity, estimate("kinetic", green_kubo_quantity("viscosity_kinetic")),
                            estimate("cross", green_kubo_quantity("viscosity_cross")),
                            estimate("potential", green_kubo_quantity("viscosity_potential")),
                            estimate("from P_xy", green_kubo_quantity("viscosity_xy")),
                            estimate("from (P_xx - P_yy)/2", green_kubo_quantity("viscosity_difference"))});
  text += "\nHow it was recorded, and how well the energy was kept:\n";
  text += table_text(rows, {{"replicas", [](const GreenKuboRow& row) { return fmt::format("{}", row.replicas); }},
                            plain("duration", &GreenKuboRow::duration, 6),
                            plain("interval", &GreenKuboRow::sample_interval, 4),
                            {"blocks", [](const GreenKuboRow& row) { return fmt::format("{}", row.blocks); }},
                            plain("drift of E/N", &GreenKuboRow::energy_drift, 2),
                            plain("largest error", &GreenKuboRow::largest_energy_error, 2)});
  if (known(rows, green_kubo_quantity("self_diffusion")) || known(rows, green_kubo_quantity("thermal_conductivity"))) {
    text += "\nOther transport coefficients, each up to a cut-off of its own:\n";
    text += table_text(rows, {estimate("self-diffusion", green_kubo_quantity("self_diffusion")),
                              plain("up to", &GreenKuboRow::self_diffusion_cutoff, 4),
                              estimate("conductivity", green_kubo_quantity("thermal_conductivity")),
                              plain("up to", &GreenKuboRow::thermal_conductivity_cutoff, 4)});
  }
  return text;
}

/// What the columns mean, in the order in which they stand.
std::string explanation(const Rows& rows) {
  std::string text = wrapped(
      "",
      "Reduced units. In parentheses one standard error, in units of the last digits: by the jackknife over blocks of "
      "all "
      "replicas, each correlated apart, with Student's factor where there are fewer than ten degrees of freedom; of kT "
      "and pressures by blocking.");
  text += wrapped("cut-off: ",
                  fmt::format("unless it is set, {} decay times of the exponential fitted to the correlation function, "
                              "of which {:.2f} % is left there: chosen by the decay, never by the integral. Half and "
                              "twice the cut-off show what that choice is worth.",
                              cases::cutoff_in_decay_times, 100.0 * std::exp(-cases::cutoff_in_decay_times)));
  text += wrapped("spectrum: ",
                  "a Lorentzian on a constant, fitted by maximum likelihood to the low-frequency end of the stress "
                  "spectrum, the error from the curvature of the likelihood; a small p-value says that it has another "
                  "shape. difference: viscosity - spectrum in "
                  "standard errors of that difference, both coming from the same data.");
  if (known(rows, green_kubo_quantity("self_diffusion")) || known(rows, green_kubo_quantity("thermal_conductivity")))
    text += wrapped("",
                    "self-diffusion, conductivity: up to a cut-off of their own, by the same rule. In two dimensions "
                    "long-time tails make such integrals grow as the logarithm of time, without a limit: numbers for "
                    "this N and this cut-off.");
  return text;
}

std::string fit_part_text(FitPart part) {
  switch (part) {
    case FitPart::fitted:
      return "fitted";
    case FitPart::beyond:
      return "too high for the fit";
    case FitPart::unstable:
      return fmt::format("one particle holds more than {} % of the kinetic energy",
                         format_plain(100.0 * cases::largest_stable_share));
    case FitPart::no_error:
      return "failed, at rest, or without an error bar";
  }
  return "";
}

/// The rates of one kind in the order of the sweep, "" when there are none.
std::string rates_of(const SideBySide& state, FitPart part) {
  std::vector<std::string> rates;
  for (std::size_t i = 0; i < state.sweep.size() && i < state.fit.parts.size(); ++i)
    if (state.fit.parts[i] == part) rates.push_back(format_plain(state.sweep[i].strain_rate));
  return fmt::format("{}", fmt::join(rates, ", "));
}

std::string fit_text(const SideBySide& state) {
  const ZeroRateFit& fit = state.fit;
  std::string text;
  if (std::isnan(fit.viscosity.value)) {
    text += wrapped("Extrapolation: ", "none.");
  } else {
    text += wrapped("Extrapolation: ",
                    fmt::format("eta_0 + eta_2 rate^2 up to rate {}: eta_0 = {} by the fit alone, eta_2 = {}, chi "
                                "squared {:.1f} for {} degree{} of freedom, p-value {}; eta_0 = {} by "
                                "eta_0/sqrt(1 + (rate/rate_0)^2).",
                                format_plain(fit.highest_rate), format_with_error(fit.viscosity.value, fit.fit_error),
                                format_with_error(fit.curvature, fit.curvature_error), fit.chi_squared,
                                fit.degrees_of_freedom, fit.degrees_of_freedom == 1 ? "" : "s",
                                format_plain(fit.p_value, 2), format_plain(fit.other_model, 4)));
    text += wrapped("  rates fitted: ", rates_of(state, FitPart::fitted));
  }
  for (const FitPart part : {FitPart::beyond, FitPart::unstable, FitPart::no_error})
    if (const std::string rates = rates_of(state, part); !rates.empty())
      text += wrapped("  left out: ", fmt::format("{} ({})", rates, fit_part_text(part)));
  return text;
}

std::string routes_text(const SideBySide& state) {
  TextTable table({"route", "viscosity", "difference", ""}, 1);
  for (const cases::Route& route : state.routes)
    table.add({route.name, format_with_error(route.value, route.error), signed_errors(route.z), ""});
  const auto lines = table.lines();
  const std::size_t width = std::ranges::max(lines, {}, &std::string::size).size();
  std::string text = lines.front() + '\n';
  for (std::size_t i = 0; i < state.routes.size(); ++i) {
    const std::string& note = state.routes[i].note;
    text += note.empty() ? lines[i + 1] + '\n' : wrapped(fmt::format("{:<{}}  ", lines[i + 1], width), note);
  }
  return text;
}

}  // namespace

std::string format_green_kubo(std::span<const GreenKuboRow> rows) {
  Rows all;
  Rows finished;
  for (const GreenKuboRow& row : rows) {
    all.push_back(&row);
    if (row.status != cases::RowStatus::failed) finished.push_back(&row);
  }
  std::string text = table_text(
      all,
      {estimate("kT", green_kubo_quantity("kinetic_temperature")),
       estimate("P kinetic", green_kubo_quantity("pressure_kinetic")),
       estimate("P potential", green_kubo_quantity("pressure_potential")),
       estimate("decay time", green_kubo_quantity("decay_time"), true),
       plain("cut-off", &GreenKuboRow::cutoff, 4),
       estimate("viscosity", green_kubo_quantity("viscosity"), true),
       {"status", [](const GreenKuboRow& row) { return std::string(cases::status_name(row.status)); }, true}},
      LastColumn::words);
  if (!finished.empty()) text += details(finished) + '\n' + explanation(finished);
  if (std::ranges::any_of(rows, [](const GreenKuboRow& row) { return row.status == cases::RowStatus::too_short; }))
    text +=
        wrapped("short: ", fmt::format("recorded for less than {} cut-offs per replica, too short for an error bar, "
                                       "or without a decay time to cut off by.",
                                       cases::least_duration_in_cutoffs));
  for (const GreenKuboRow& row : rows) {
    for (const std::string& warning : row.warnings)
      text += wrapped("warning: ", fmt::format("{}: {}", state_of(row), warning));
    if (row.status == cases::RowStatus::failed)
      text += wrapped("failed: ", state_of(row) + (row.failure.empty() ? "" : ": " + row.failure));
  }
  return text;
}

std::string format_side_by_side(std::span<const SideBySide> states) {
  if (states.empty()) return "No state is in both tables.\n";
  std::string text;
  for (const SideBySide& state : states)
    text += fmt::format("{}\n{}{}\n", state_text(state.particles, state.energy_per_particle), routes_text(state),
                        fit_text(state));
  return text + wrapped("",
                        "Reduced units. In parentheses one standard error, in units of the last digits. difference: "
                        "from Green-Kubo, "
                        "in combined standard errors. The error of the extrapolation is that of the weighted fit, "
                        "widened by the square root of chi squared over its degrees of freedom where that is above "
                        "one, and in quadrature the difference between both models.");
}

}  // namespace lucy::files
