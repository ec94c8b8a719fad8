// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/green_kubo_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "green_kubo_rows.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using cases::green_kubo_quantity;
using testing::green_kubo_row;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::unknown;
using testing::widest_line;

std::size_t lines_with(const std::string& text, const std::string& part) {
  std::istringstream lines(text);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) count += line.find(part) != std::string::npos ? 1 : 0;
  return count;
}

TEST(FormatGreenKubo, ShowsValuesWithErrorsAndSaysHowTheyWereMade) {
  auto row = green_kubo_row();
  row.estimates[green_kubo_quantity("pressure_kinetic")] = {0.0712, 0.00014, 128, 127};
  row.estimates[green_kubo_quantity("viscosity_spectrum")] = {0.6012, 0.0213, 128, 127};
  const std::string text = format_green_kubo(std::vector{row});
  EXPECT_THAT(text, HasSubstr("1024  0.5"));
  EXPECT_EQ(lines_with(text, "0.592(12)"), 3u);  // alone, over the cut-offs, over the parts
  EXPECT_THAT(text, HasSubstr("0.07120(14)"));
  EXPECT_THAT(text, HasSubstr("0.601(21)        -0.8     0.44"));
  EXPECT_THAT(text, HasSubstr("60.25"));
  EXPECT_THAT(text, HasSubstr("-0.000000003"));
  EXPECT_THAT(text, HasSubstr("one standard error"));
  EXPECT_THAT(text, HasSubstr("jackknife"));
  EXPECT_THAT(text, HasSubstr("6 decay times"));
  EXPECT_THAT(text, HasSubstr("of which 0.25 %"));
  EXPECT_THAT(text, Not(HasSubstr("self-diffusion")));
  EXPECT_THAT(text, Not(HasSubstr("short:")));
  EXPECT_THAT(text, Not(HasSubstr("warning:")));
}

TEST(FormatGreenKubo, DiffusionAndConductivityComeWithTheirCaveat) {
  auto rows = std::vector{green_kubo_row(), green_kubo_row()};
  rows[1].estimates[green_kubo_quantity("self_diffusion")] = {1.25, 0.025, 128, 127};
  const std::string text = format_green_kubo(rows);
  EXPECT_THAT(text, HasSubstr("1.250(25)"));
  EXPECT_THAT(text, HasSubstr("In two dimensions"));
  EXPECT_EQ(lines_with(text, "conductivity"), 1u);  // of the caveat; no column
}

TEST(FormatGreenKubo, TellsOfWarningsAndOfWhatFailed) {
  auto rows = std::vector{green_kubo_row(), green_kubo_row(), green_kubo_row()};
  rows[0].warnings = {"the integral still rises beyond the cut-off"};
  rows[1].status = cases::RowStatus::too_short;
  rows[2].energy_per_particle = 2.0;
  rows[2].estimates.fill({unknown, unknown, unknown, 0});
  rows[2].status = cases::RowStatus::failed;
  rows[2].failure = "the energy left its band";
  const std::string text = format_green_kubo(rows);
  EXPECT_THAT(text, HasSubstr("warning: N = 1024, E/N = 0.5: the integral still rises beyond the cut-off\n"));
  EXPECT_THAT(text, HasSubstr("failed: N = 1024, E/N = 2: the energy left its band\n"));
  EXPECT_THAT(text, HasSubstr("short: recorded for less than 10 cut-offs"));
  EXPECT_EQ(lines_with(text, "1024    2"), 1u);  // nothing more is known of what failed
  EXPECT_EQ(lines_with(text, "1024  0.5"), 8u);
}

TEST(FormatGreenKubo, LeavesOutWhatASeriesSampledElsewhereDoesNotTell) {
  auto row = green_kubo_row();
  row.particles = 0;
  row.energy_drift = row.largest_energy_error = unknown;
  row.warnings = {"few blocks"};
  for (const auto name : {green_kubo_quantity("viscosity_kinetic"), green_kubo_quantity("viscosity_cross"),
                          green_kubo_quantity("viscosity_potential"), green_kubo_quantity("pressure_kinetic"),
                          green_kubo_quantity("pressure_potential")})
    row.estimates[name] = {unknown, unknown, unknown, 0};
  const std::string text = format_green_kubo(std::vector{row});
  for (const char* absent : {"nan", "kinetic", "cross", "E/N  ", "drift"}) EXPECT_THAT(text, Not(HasSubstr(absent)));
  EXPECT_THAT(text, HasSubstr("warning: series: few blocks"));
}

TEST(FormatGreenKubo, FitsATerminal) {
  auto rows = std::vector{green_kubo_row(), green_kubo_row()};
  rows[0].particles = 262144;
  rows[0].energy_per_particle = 0.4567;
  for (auto& estimate : rows[1].estimates) estimate = {-123.4567, 0.0123, 128, 127};
  rows[1].status = cases::RowStatus::failed;
  rows[1].failure = std::string(60, 'x') + " " + std::string(60, 'y');
  rows[0].warnings = {"the integral rises on and on, " + std::string(70, 'z') + " and on and on"};
  EXPECT_LE(widest_line(format_green_kubo(rows)), 118u);
  rows[0].energy_drift = -1.2e-10;
  for (auto& estimate : rows[0].estimates) estimate = {-123.4567, 0.0123, 128, 127};
  EXPECT_LE(widest_line(format_green_kubo(rows)), 118u);
}

TEST(FormatGreenKubo, OfNoRowsIsOnlyTheHeader) { EXPECT_THAT(format_green_kubo({}), HasSubstr("viscosity")); }

cases::SideBySide state() {
  cases::SideBySide state;
  state.particles = 1024;
  state.energy_per_particle = 0.5;
  for (const double rate : {0.0, 0.0089, 0.02, 0.05, 0.1, 1.0}) {
    cases::TableRow row;
    row.strain_rate = rate;
    state.sweep.push_back(row);
  }
  using cases::FitPart;
  state.fit.viscosity = {0.5834, 0.0101, 3, 1};
  state.fit.fit_error = 0.0074;
  state.fit.other_model = 0.5902;
  state.fit.curvature = -4.25;
  state.fit.curvature_error = 0.31;
  state.fit.highest_rate = 0.1;
  state.fit.chi_squared = 1.21;
  state.fit.degrees_of_freedom = 1;
  state.fit.p_value = 0.27;
  state.fit.parts = {FitPart::no_error, FitPart::unstable, FitPart::fitted,
                     FitPart::fitted,   FitPart::fitted,   FitPart::beyond};
  state.routes = {{"nemd", 0.5834, 0.0101, -0.56, "the fit bends by more than half of its value over its rates"},
                  {"green-kubo", 0.5923, 0.0123, unknown, ""},
                  {"weak-scattering", 0.69, unknown, unknown, std::string(50, 'n') + ' ' + std::string(50, 'm')}};
  return state;
}

TEST(FormatSideBySide, ShowsEveryRouteAndTheFit) {
  const std::string text = format_side_by_side(std::vector{state()});
  EXPECT_THAT(text, HasSubstr("N = 1024, E/N = 0.5\nroute"));
  EXPECT_THAT(text, HasSubstr("nemd             0.583(10)        -0.6  the fit bends"));
  EXPECT_THAT(text, HasSubstr("\ngreen-kubo       0.592(12)         nan\n"));
  EXPECT_THAT(text, HasSubstr("0.69(nan)"));
  EXPECT_THAT(text, HasSubstr("up to rate 0.1: eta_0 = 0.5834(74) by the fit alone, eta_2 = -4.25(31)"));
  EXPECT_THAT(text, HasSubstr("  rates fitted: 0.02, 0.05, 0.1\n"));
  EXPECT_THAT(text, HasSubstr("  left out: 1 (too high for the fit)\n"));
  EXPECT_THAT(text, HasSubstr("  left out: 0.0089 (one particle holds more than 20 % of the kinetic energy)\n"));
  EXPECT_THAT(text, HasSubstr("  left out: 0 (failed, at rest, or without an error bar)\n"));
  EXPECT_LE(widest_line(text), 118u);
}

TEST(FormatSideBySide, SaysWhenThereIsNothingToShow) {
  EXPECT_EQ(format_side_by_side({}), "No state is in both tables.\n");
  auto without = state();
  without.fit.viscosity = {unknown, unknown, unknown, 0};
  without.fit.parts.assign(without.sweep.size(), cases::FitPart::no_error);
  const std::string text = format_side_by_side(std::vector{without});
  EXPECT_THAT(text, HasSubstr("Extrapolation: none.\n  left out: 0, 0.0089, 0.02, 0.05, 0.1, 1 (failed"));
}

}  // namespace
}  // namespace lucy::files
