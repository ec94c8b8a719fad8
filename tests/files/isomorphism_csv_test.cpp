// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows of isomorphism cases, in the file and on the terminal.
#include "lucy/files/isomorphism_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "lucy/errors.hpp"
#include "lucy/files/isomorphism_text.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using cases::isomorphism_quantity;
using cases::IsomorphismRow;
using testing::contents;
using ::testing::HasSubstr;
using testing::message_of;
using ::testing::Not;
using testing::put;
using testing::ScratchFolder;
using ::testing::StartsWith;
using testing::widest_line;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

IsomorphismRow example() {
  IsomorphismRow row;
  row.particles = 1024;
  row.energy_per_particle = 1.0;
  row.density = 1.0;
  row.range = 3.0;
  row.strain_rate = 0.1;
  row.thermostat = "isoenergetic";
  row.pressure = 4.0;
  row.reference_density = 2.0;
  row.step = 0.05;
  row.duration = 10000.0;
  row.replicas = 1;
  row.steps = 200000;
  row.comparisons = 1229806149;
  for (std::size_t i = 0; i < row.estimates.size(); ++i) {
    row.estimates[i].value = std::sin(1.0 + static_cast<double>(i));
    row.estimates[i].error = 1e-5 / (1.0 + static_cast<double>(i));
  }
  row.equilibration_discarded = 12.5;
  row.worst_energy_error = 3e-9;
  row.subdivided_steps = 7;
  return row;
}

IsomorphismRow differing(std::int64_t particle, int component) {
  IsomorphismRow row = example();
  row.replicas = 3;
  row.difference = {172, 8.6, particle, component, 0.1, std::nextafter(0.1, 1.0)};
  row.differing_replica = 1;
  row.estimates.fill({nan, nan, nan, 0});
  row.status = cases::RowStatus::too_short;
  return row;
}

TEST(IsomorphismCsv, GivesBackTheSameBits) {
  const ScratchFolder folder;
  IsomorphismRow failed = example();
  failed.estimates.fill({nan, nan, nan, 0});
  failed.status = cases::RowStatus::failed;
  const std::vector<IsomorphismRow> rows = {example(), differing(17, 3), differing(-1, 2), failed};
  write_isomorphism_csv(folder / "a.csv", rows);
  const auto again = read_isomorphism_csv(folder / "a.csv");
  ASSERT_EQ(again.size(), rows.size());
  write_isomorphism_csv(folder / "b.csv", again);
  EXPECT_EQ(contents(folder / "a.csv"), contents(folder / "b.csv"));
  EXPECT_EQ(again[0].thermostat, "isoenergetic");
  EXPECT_EQ(again[0].pressure, 4.0);
  EXPECT_EQ(again[0].reference_density, 2.0);
  EXPECT_EQ(again[0].comparisons, 1229806149);
  EXPECT_EQ(again[0].identical(), "yes");
  for (std::size_t i = 0; i < again[0].estimates.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(again[0].estimates[i].value),
              std::bit_cast<std::uint64_t>(rows[0].estimates[i].value));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(again[0].estimates[i].error),
              std::bit_cast<std::uint64_t>(rows[0].estimates[i].error));
  }
  ASSERT_TRUE(again[1].difference.has_value());
  EXPECT_EQ(again[1].identical(), "no");
  EXPECT_EQ(again[1].differing_replica, 1);
  EXPECT_EQ(again[1].difference->step, 172);
  EXPECT_EQ(again[1].difference->particle, 17);
  EXPECT_EQ(again[1].difference->component_name(), "p_y");
  EXPECT_EQ(again[1].difference->smooth, std::nextafter(0.1, 1.0));
  EXPECT_EQ(again[2].difference->particle, -1);
  EXPECT_EQ(again[2].difference->component_name(), "virial_xx");
  EXPECT_EQ(again[3].identical(), "unknown");
}

TEST(IsomorphismCsv, SaysInWordsWhatIsTheSameAndWhatDiffers) {
  const ScratchFolder folder;
  write_isomorphism_csv(folder / "a.csv", std::vector{example(), differing(17, 4)});
  const std::string text = contents(folder / "a.csv");
  EXPECT_THAT(text, StartsWith("particles,energy_per_particle,density,range,strain_rate,thermostat,"
                               "isentropic_pressure,isentropic_reference_density,step,duration,replicas,steps,"
                               "comparisons,identical,difference_replica,"));
  EXPECT_THAT(text, HasSubstr(",200000,1229806149,yes,nan,nan,nan,nan,none,nan,nan,"));
  EXPECT_THAT(text, HasSubstr(",200000,1229806149,no,1,172,8.6,17,F_x,0.1,0.10000000000000002,nan,"));
}

TEST(IsomorphismCsv, RefusesAComponentThatIsNone) {
  const ScratchFolder folder;
  write_isomorphism_csv(folder / "a.csv", std::vector{differing(17, 4)});
  std::string text = contents(folder / "a.csv");
  text.replace(text.find("F_x"), 3, "F_q");
  put(folder / "a.csv", text);
  const std::string message = message_of<BadInput>([&] { read_isomorphism_csv(folder / "a.csv"); });
  EXPECT_THAT(message, HasSubstr("a.csv:2: difference_component is \"F_q\""));
  put(folder / "b.csv", "particles\n1\n");
  EXPECT_THROW(read_isomorphism_csv(folder / "b.csv"), BadInput);
}

TEST(FormatIsomorphism, SaysThatEveryBitIsTheSameAndSetsBothReadingsSideBySide) {
  IsomorphismRow row = example();
  row.estimates[isomorphism_quantity("atoms_potential_energy")] = {0.4588, 0.0002, 50, 49};
  row.estimates[isomorphism_quantity("smooth_internal_energy")] = {0.5472194, 0.0002, 50, 49};
  row.estimates[isomorphism_quantity("atoms_viscosity_potential")] = {-0.0423, 0.0012, 50, 49};
  row.estimates[isomorphism_quantity("smooth_viscosity_tensor")] = {-0.0423, 0.0012, 50, 49};
  const std::string text = format_isomorphism(std::vector{row});
  EXPECT_THAT(text, StartsWith("N = 1024, E/N = 1, rate 0.1: identical in every bit: 200000 steps x 1024 particles, "
                               "1229806149 comparisons"));
  EXPECT_THAT(text,
              HasSubstr("viscosity, potential       -0.0423(12)      -0.0423(12)  by the SPAM pressure tensor\n"));
  EXPECT_THAT(text, HasSubstr(" 0.088419    of it the self term\n"));
  EXPECT_THAT(text, HasSubstr("one standard error"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_LE(widest_line(text), 118u);
}

TEST(FormatIsomorphism, ShowsAConservedEnergyWithoutAnError) {
  IsomorphismRow row = example();
  row.estimates[isomorphism_quantity("atoms_energy")] = {0.99998330596, nan, nan, 0};
  row.estimates[isomorphism_quantity("smooth_energy")] = {1.0884, 0.0, 10, 9};
  EXPECT_THAT(format_isomorphism(std::vector{row}),
              ::testing::ContainsRegex("energy E/N +0.9999833 +1.0884  sum of both\n"));
}

TEST(FormatIsomorphism, LeavesOutViscositiesAtRest) {
  IsomorphismRow row = example();
  row.strain_rate = 0.0;
  for (std::size_t i = 0; i < row.estimates.size(); ++i)
    if (cases::isomorphism_quantities[i].find("viscosity") != std::string_view::npos)
      row.estimates[i] = {nan, nan, nan, 0};
  const std::string text = format_isomorphism(std::vector{row});
  EXPECT_THAT(text, Not(HasSubstr("viscosity, ")));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_THAT(text, HasSubstr("P_xy, potential"));
}

TEST(FormatIsomorphism, NamesTheFirstDifferenceWithAllDigits) {
  std::string text = format_isomorphism(std::vector{differing(17, 3)});
  EXPECT_THAT(text, HasSubstr("N = 1024, E/N = 1, rate 0.1: not identical: in replica 2, after step 172 (time 8.6), "
                              "p_y of particle 17"));
  EXPECT_THAT(text, HasSubstr("0.10000000000000001"));
  EXPECT_THAT(text, HasSubstr("0.10000000000000002"));
  EXPECT_THAT(text, Not(HasSubstr("viscosity")));
  EXPECT_LE(widest_line(text), 118u);
  IsomorphismRow at_start = differing(-1, 0);
  at_start.replicas = 1;
  at_start.difference->step = 0;
  text = format_isomorphism(std::vector{at_start});
  EXPECT_THAT(text, HasSubstr("not identical: at the start, the energy is 0.1"));
  EXPECT_THAT(text, Not(HasSubstr("replica")));
}

TEST(FormatIsomorphism, TellsWhyACaseFailed) {
  IsomorphismRow row = example();
  row.status = cases::RowStatus::failed;
  row.failure = "there is no steady flow";
  const std::string text = format_isomorphism(std::vector{row});
  EXPECT_EQ(text, "N = 1024, E/N = 1, rate 0.1: failed: there is no steady flow\n");
}

}  // namespace
}  // namespace lucy::files
