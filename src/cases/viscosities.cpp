// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/viscosities.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace lucy::cases {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Rows that may be fitted, by increasing |rate|; x = rate^2.
struct Rows {
  std::vector<double> x, viscosity, weight;
  std::vector<std::size_t> place;  ///< among the rows given
};

/// Weighted least squares for a + b x, with the covariances that the weights say.
struct Line {
  double a = 0.0, b = 0.0;
  double variance_a = 0.0, covariance = 0.0, variance_b = 0.0;
  double chi_squared = 0.0;
};

Line fit_line(const std::vector<double>& x, const std::vector<double>& weight, const std::vector<double>& y,
              std::size_t rows) {
  Line line;
  gsl_fit_wlinear(x.data(), 1, weight.data(), 1, y.data(), 1, rows, &line.a, &line.b, &line.variance_a,
                  &line.covariance, &line.variance_b, &line.chi_squared);
  return line;
}

/// eta_0 of eta_0/sqrt(1 + b x), by Gauss-Newton steps from what the straight line says, halved until chi^2 falls.
/// With d = 1 + b x and f = eta_0/sqrt(d), a step of (eta_0, b) changes f by (step of eta_0 - step of b eta_0 x/(2 d))
/// divided by sqrt(d): a straight line again.
double second_model(const Rows& rows, std::size_t count, const Line& line) {
  const auto chi_squared = [&](double eta_0, double b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double d = 1.0 + b * rows.x[i];
      if (!(d > 0.0)) return std::numeric_limits<double>::infinity();
      const double difference = rows.viscosity[i] - eta_0 / std::sqrt(d);
      sum += rows.weight[i] * difference * difference;
    }
    return sum;
  };
  constexpr int most_steps = 100;
  constexpr double smallest_step = 1e-9;
  double eta_0 = line.a;
  double b = std::max(0.0, -2.0 * line.b / line.a);
  double lowest = chi_squared(eta_0, b);
  std::vector<double> x(count), y(count), weight(count);
  for (int step = 0; step < most_steps; ++step) {
    for (std::size_t i = 0; i < count; ++i) {
      const double d = 1.0 + b * rows.x[i];
      x[i] = -eta_0 * rows.x[i] / (2.0 * d);
      y[i] = rows.viscosity[i] * std::sqrt(d) - eta_0;
      weight[i] = rows.weight[i] / d;
    }
    const Line towards = fit_line(x, weight, y, count);
    double part = 1.0;
    while (part > smallest_step && !(chi_squared(eta_0 + part * towards.a, b + part * towards.b) <= lowest))
      part /= 2.0;
    if (part <= smallest_step) break;  // rounding hides what is left to gain
    eta_0 += part * towards.a;
    b += part * towards.b;
    lowest = chi_squared(eta_0, b);
    if (std::abs(towards.a) <= smallest_step * std::abs(eta_0) &&
        std::abs(towards.b) * rows.x[count - 1] <= smallest_step)
      break;
  }
  return eta_0;
}

/// The fit to so many lowest rows.
struct Parabola {
  std::size_t rows = 0;
  Line line;
  double p_value = 0.0;
  double error = 0.0;        ///< of eta_0, widened
  double other_model = 0.0;  ///< its eta_0

  int degrees_of_freedom() const { return static_cast<int>(rows) - 2; }
  double widening() const { return std::max(1.0, line.chi_squared / degrees_of_freedom()); }  ///< of variances
};

Parabola fit_parabola(const Rows& rows, std::size_t count) {
  Parabola parabola{.rows = count, .line = fit_line(rows.x, rows.weight, rows.viscosity, count)};
  parabola.p_value = gsl_cdf_chisq_Q(parabola.line.chi_squared, parabola.degrees_of_freedom());
  parabola.error = std::sqrt(parabola.widening() * parabola.line.variance_a);
  parabola.other_model = second_model(rows, count, parabola.line);
  return parabola;
}

/// Whether a row may be fitted at all; `fitted` stands for yes.
FitPart part_of(const TableRow& row) {
  const statistics::Estimate& viscosity = row.estimates[quantity("viscosity")];
  if (row.status == RowStatus::failed || row.strain_rate == 0.0 || !std::isfinite(viscosity.value) ||
      !std::isfinite(viscosity.error) || !(viscosity.error > 0.0))
    return FitPart::no_error;
  return row.estimates[quantity("largest_kinetic_share")].value > largest_stable_share ? FitPart::unstable
                                                                                       : FitPart::fitted;
}

/// Rows of equal |rate| take part together.
bool same_rate(const Rows& rows, std::size_t i, std::size_t k) { return nearly_equal(rows.x[i], rows.x[k]); }

/// Numbers of lowest rows after which a rate ends, for every number of rates from `fewest_rates` on.
std::vector<std::size_t> ends_of_rates(const Rows& rows) {
  std::vector<std::size_t> ends;
  std::size_t rates = 0;
  for (std::size_t i = 0; i < rows.x.size(); ++i)
    if ((i + 1 == rows.x.size() || !same_rate(rows, i, i + 1)) && ++rates >= fewest_rates) ends.push_back(i + 1);
  return ends;
}

std::string count_text(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string too_few_rates(const Rows& rows, const std::vector<FitPart>& parts) {
  std::size_t rates = 0;
  for (std::size_t i = 0; i < rows.x.size(); ++i) rates += i == 0 || !same_rate(rows, i, i - 1);
  std::string text =
      fmt::format("no value: {} to fit where at least {} are needed", count_text(rates, "strain rate"), fewest_rates);
  if (const auto unstable = std::ranges::count(parts, FitPart::unstable); unstable > 0)
    text += fmt::format("; {} left out, where one particle holds most of the energy",
                        count_text(static_cast<std::size_t>(unstable), "unstable row"));
  return text;
}

/// What to beware of in a fit that was made.
std::string warning(const ZeroRateFit& fit) {
  const double eta_0 = fit.viscosity.value;
  if (!(eta_0 > 0.0)) return "not above zero: the sweep says nothing about zero rate, run longer or at lower rates";
  const double bend = std::abs(fit.curvature) * fit.highest_rate * fit.highest_rate / eta_0;
  if (bend > largest_bend)
    return fmt::format("reaches far: the fit bends by {:.0f} % over its rates, run lower ones", 100.0 * bend);
  return "";
}

double combined_z(double value, double error, double reference, double reference_error) {
  const double z = (value - reference) / std::hypot(error, reference_error);
  return std::isfinite(z) ? z : not_a_number;
}

Route published_route(const GreenKuboRow& ours, const PublishedGreenKubo& theirs) {
  const double time_ratio = ours.replicas * ours.duration / theirs.total_time;
  const auto z_of = [&](std::size_t place, const PublishedCell& cell) {
    const statistics::Estimate& estimate = ours.estimates[place];
    return combined_z(cell.value, error_of_print(cell, estimate.error, time_ratio), estimate.value, estimate.error);
  };
  constexpr std::size_t viscosity = green_kubo_quantity("viscosity");
  Route route{.name = "published-green-kubo",
              .value = theirs.viscosity.value,
              .error = error_of_print(theirs.viscosity, ours.estimates[viscosity].error, time_ratio),
              .z = z_of(viscosity, theirs.viscosity)};
  if (!theirs.viscosity.standard_error) route.note = "error not in print: ours, scaled to a run as long";
  const double pressure = z_of(green_kubo_quantity("pressure"), theirs.pressure);
  const double kinetic = z_of(green_kubo_quantity("pressure_kinetic"), theirs.pressure_kinetic);
  if (std::isfinite(pressure) && std::isfinite(kinetic))
    route.note += fmt::format("{}its pressure differs by {:+.1f} standard errors, the kinetic part by {:+.1f}",
                              route.note.empty() ? "" : "; ", pressure, kinetic);
  return route;
}

}  // namespace

std::string_view fit_part_name(FitPart part) {
  constexpr std::array<std::string_view, 4> names = {"fitted", "beyond", "unstable", "no-error"};
  return names[static_cast<std::size_t>(part)];
}

ZeroRateFit extrapolate_to_zero_rate(std::span<const TableRow> rows) {
  ZeroRateFit result{.viscosity = {not_a_number, not_a_number, not_a_number, 0},
                     .fit_error = not_a_number,
                     .other_model = not_a_number,
                     .curvature = not_a_number,
                     .curvature_error = not_a_number,
                     .covariance = not_a_number,
                     .highest_rate = not_a_number,
                     .chi_squared = not_a_number,
                     .degrees_of_freedom = 0,
                     .p_value = not_a_number,
                     .parts = {},
                     .note = {}};
  Rows usable;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    result.parts.push_back(part_of(rows[i]));
    if (result.parts.back() == FitPart::fitted) usable.place.push_back(i);
  }
  std::ranges::stable_sort(usable.place, {}, [&](std::size_t i) { return std::abs(rows[i].strain_rate); });
  for (const std::size_t i : usable.place) {
    const statistics::Estimate& viscosity = rows[i].estimates[quantity("viscosity")];
    usable.x.push_back(rows[i].strain_rate * rows[i].strain_rate);
    usable.viscosity.push_back(viscosity.value);
    usable.weight.push_back(1.0 / (viscosity.error * viscosity.error));
    result.parts[i] = FitPart::beyond;
  }

  const auto rate_of = [&](std::size_t i) { return std::abs(rows[usable.place[i]].strain_rate); };

  const std::vector<std::size_t> ends = ends_of_rates(usable);
  if (ends.empty()) {
    result.note = too_few_rates(usable, result.parts);
    return result;
  }
  std::optional<Parabola> best;
  for (const std::size_t end : ends) {
    const Parabola parabola = fit_parabola(usable, end);
    if (end == ends.front()) result.p_value = parabola.p_value;
    if (!(parabola.p_value >= least_p_value)) continue;
    if (!best || std::abs(parabola.other_model - parabola.line.a) <= largest_pull * parabola.error) best = parabola;
  }
  if (!best) {
    result.note = fmt::format(
        "no value: even the lowest rates, {} to {}, lie on no eta_0 + eta_2 rate^2 (p = {:.2g}), run lower ones",
        rate_of(0), rate_of(ends.front() - 1), result.p_value);
    return result;
  }

  const Line& line = best->line;
  result.viscosity = {line.a, std::hypot(best->error, best->other_model - line.a), static_cast<double>(best->rows),
                      best->degrees_of_freedom()};
  result.fit_error = best->error;
  result.other_model = best->other_model;
  result.chi_squared = line.chi_squared;
  result.degrees_of_freedom = best->degrees_of_freedom();
  result.p_value = best->p_value;
  result.curvature = line.b;
  result.curvature_error = std::sqrt(best->widening() * line.variance_b);
  result.covariance = best->widening() * line.covariance;
  result.highest_rate = rate_of(best->rows - 1);
  for (std::size_t i = 0; i < best->rows; ++i) result.parts[usable.place[i]] = FitPart::fitted;
  result.note = warning(result);
  return result;
}

std::vector<SideBySide> side_by_side(std::span<const TableRow> sweep, std::span<const GreenKuboRow> green_kubo,
                                     std::span<const PublishedGreenKubo> published, bool model_of_the_paper) {
  std::vector<SideBySide> states;
  for (const GreenKuboRow& ours : green_kubo) {
    SideBySide state{.particles = ours.particles,
                     .energy_per_particle = ours.energy_per_particle,
                     .fit = {},
                     .sweep = {},
                     .routes = {}};
    for (const TableRow& row : sweep)
      if (same_equilibrium_state(row, ours)) state.sweep.push_back(row);
    if (state.sweep.empty()) continue;
    state.fit = extrapolate_to_zero_rate(state.sweep);

    const statistics::Estimate& reference = ours.estimates[green_kubo_quantity("viscosity")];
    const statistics::Estimate& spectrum = ours.estimates[green_kubo_quantity("viscosity_spectrum")];
    const auto against_green_kubo = [&](std::string name, const statistics::Estimate& estimate, std::string note) {
      state.routes.push_back({std::move(name), estimate.value, estimate.error,
                              combined_z(estimate.value, estimate.error, reference.value, reference.error),
                              std::move(note)});
    };
    against_green_kubo("nemd", state.fit.viscosity, state.fit.note);
    state.routes.push_back({"green-kubo", reference.value, reference.error, not_a_number});
    // The same data gave both: the jackknife knows the error of their difference.
    state.routes.push_back({"green-kubo-spectrum", spectrum.value, spectrum.error,
                            0.0 - ours.spectrum_z,  // no minus zero

                            "of the same data, which its difference allows for"});
    if (model_of_the_paper) {
      for (const PublishedGreenKubo& theirs : published)
        if (same_equilibrium_state(theirs, ours)) state.routes.push_back(published_route(ours, theirs));
      against_green_kubo("weak-scattering",
                         weak_scattering_viscosity(ours.estimates[green_kubo_quantity("kinetic_temperature")]),
                         "an estimate: no error of its own, only that of kT");
    }
    states.push_back(std::move(state));
  }
  return states;
}

statistics::Estimate weak_scattering_viscosity(const statistics::Estimate& kinetic_temperature) {
  constexpr double factor = 35.0;
  const double root = std::sqrt(kinetic_temperature.value);
  return {factor * root * kinetic_temperature.value, factor * 1.5 * root * kinetic_temperature.error,
          kinetic_temperature.effective_samples, kinetic_temperature.degrees_of_freedom};
}

}  // namespace lucy::cases
