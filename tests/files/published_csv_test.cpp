// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/published_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "lucy/errors.hpp"
#include "lucy/files/table_csv.hpp"
#include "lucy/files/table_text.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::message_of;
using testing::put;
using testing::ScratchFolder;
using ::testing::SizeIs;

const std::filesystem::path reference = std::filesystem::path(LUCY_SOURCE_DIRECTORY) / "reference";

constexpr std::size_t place(std::string_view name) {
  for (std::size_t i = 0; i < cases::compared_quantities.size(); ++i)
    if (cases::compared_quantities[i] == name) return i;
  throw "no such quantity";
}

const cases::PublishedRow& row_of(const cases::PublishedTable& table, std::int64_t particles, double rate) {
  for (const auto& row : table.rows)
    if (row.particles == particles && row.strain_rate == rate) return row;
  throw std::runtime_error("no such row");
}

TEST(PublishedTables, AreShippedUnderTheirNames) {
  EXPECT_THAT(published_table_names(reference), ElementsAre("posch1995_table1", "posch1995_table2"));
  const auto first = read_published_table("posch1995_table1", reference);
  const auto second = read_published_table("posch1995_table2", reference);
  EXPECT_THAT(first.rows, SizeIs(15));
  EXPECT_THAT(second.rows, SizeIs(15));
  EXPECT_EQ(first.rows[0].energy_per_particle, 0.5);
  EXPECT_EQ(second.rows[0].energy_per_particle, 1.0);
  EXPECT_THAT(first.source, HasSubstr("1711"));
}

TEST(PublishedTables, KnowHowManyDigitsEachCellWasPrintedWith) {
  const auto table = read_published_table("posch1995_table2", reference);
  const auto& unstable = row_of(table, 1024, 0.009);
  EXPECT_EQ(unstable.cells[place("pxx_kinetic")].value, 0.907);
  EXPECT_EQ(unstable.cells[place("pxx_kinetic")].last_digit, 1e-3);
  EXPECT_EQ(unstable.cells[place("pxy_kinetic")].last_digit, 1e-4);
  EXPECT_TRUE(unstable.instability_region);
  const auto& calm = row_of(table, 1024, 0.1);
  EXPECT_EQ(calm.cells[place("pyy_potential")].value, 0.49);
  EXPECT_EQ(calm.cells[place("pyy_potential")].last_digit, 1e-4);  // printed 0.4900
  EXPECT_FALSE(calm.instability_region);
  EXPECT_DOUBLE_EQ(calm.total_time, 3080.0);
}

TEST(PublishedTables, StayAsPrintedWhereTheSignIsWrong) {
  int misprinted_rows = 0;
  for (const char* name : {"posch1995_table1", "posch1995_table2"})
    for (const auto& row : read_published_table(name, reference).rows) {
      const auto& cell = row.cells[place("pxy_potential")];
      EXPECT_GE(cell.value, 0.0);
      if (!cell.misprint) continue;
      ++misprinted_rows;
      EXPECT_EQ(cell.reading, -cell.value);
      EXPECT_TRUE(row.cells[place("viscosity")].misprint);
      EXPECT_GT(*row.cells[place("viscosity")].reading, row.cells[place("viscosity")].value);
    }
  EXPECT_EQ(misprinted_rows, 9);
}

/// E/N = Phi/N + (Pxx + Pyy)/2 of the kinetic parts, at unit density.
TEST(PublishedTables, CloseTheirEnergySumExceptWhereThatIsSaid) {
  for (const char* name : {"posch1995_table1", "posch1995_table2"})
    for (const auto& row : read_published_table(name, reference).rows) {
      const auto& xx = row.cells[place("pxx_kinetic")];
      const auto& yy = row.cells[place("pyy_kinetic")];
      const double energy = row.cells[place("potential_energy")].value + (xx.value + yy.value) / 2.0;
      const bool closes = std::abs(energy - row.energy_per_particle) < 0.0012;
      EXPECT_EQ(closes, !xx.misprint) << name << ' ' << row.particles << ' ' << row.strain_rate;
      EXPECT_EQ(xx.misprint, yy.misprint);
      EXPECT_FALSE(xx.reading || yy.reading);
    }
}

TEST(PublishedTables, OfAnUnknownNameTellWhichThereAre) {
  EXPECT_THAT(message_of<BadInput>([] { read_published_table("posch1995_table3", reference); }),
              HasSubstr("\"posch1995_table3\": use posch1995_table1, posch1995_table2"));
}

constexpr const char* columns =
    "particles,energy_per_particle,run_length_in_inverse_rates,strain_rate,potential_energy_per_particle,pxy_kinetic,"
    "pxy_potential,pxx_kinetic,pxx_potential,pyy_kinetic,pyy_potential\n";

TEST(PublishedTables, MayBeAFileOfOnesOwn) {
  const ScratchFolder folder;
  put(folder / "mine.csv", columns + std::string("64,0.75,20,0.5,0.4,-1.25e-2,0.001,0.1,0.5,0.1,\n"));
  const auto table = read_published_table((folder / "mine.csv").string(), reference);
  ASSERT_THAT(table.rows, SizeIs(1));
  EXPECT_EQ(table.rows[0].energy_per_particle, 0.75);
  EXPECT_EQ(table.rows[0].cells[place("pxy_kinetic")].last_digit, 1e-4);
  EXPECT_TRUE(std::isnan(table.rows[0].cells[place("pyy_potential")].value));
  put(folder / "mine.csv", columns + std::string("64,0.75,20,0,0.4,-1.25e-2,0.001,0.1,0.5,0.1,\n"));
  EXPECT_THAT(message_of<BadInput>([&] { read_published_table((folder / "mine.csv").string(), reference); }),
              HasSubstr("mine.csv:2: a strain rate other than zero"));
  put(folder / "mine.csv", "particles,strain_rate,run_length_in_inverse_rates\n1,1,1\n");
  EXPECT_THAT(message_of<BadInput>([&] { read_published_table((folder / "mine.csv").string(), reference); }),
              HasSubstr("energy per particle is not known"));
}

TEST(PublishedTables, RefuseErrataThatDoNotFit) {
  const ScratchFolder folder;
  put(folder / "index.csv", "name,energy_per_particle,errata,source\nt,1,e.csv,somewhere\n");
  put(folder / "t.csv", columns + std::string("64,1,20,0.5,0.4,-0.0125,0.001,0.1,0.5,0.1,0.5\n"));
  const std::string header = "table,particles,strain_rate,quantity,printed,reading,why\n";
  put(folder / "e.csv", header + "t,64,0.5,pxy_potential,0.002,-0.002,sign\n");
  EXPECT_THAT(message_of<BadInput>([&] { read_published_table("t", folder.path()); }),
              HasSubstr("e.csv:2: the printed value is said to be 0.002, but t has 0.001"));
  put(folder / "e.csv", header + "t,32,0.5,pxy_potential,0.001,-0.001,sign\n");
  EXPECT_THAT(message_of<BadInput>([&] { read_published_table("t", folder.path()); }), HasSubstr("e.csv:2: t has no"));
  put(folder / "e.csv", header + "other,32,0.5,pxy_potential,0.001,-0.001,sign\n");
  EXPECT_FALSE(read_published_table("t", folder.path()).rows[0].cells[place("pxy_potential")].misprint);
}

TEST(PublishedGreenKubo, IsAsPrinted) {
  const auto values = read_published_green_kubo(reference / "posch1995_green_kubo.csv");
  ASSERT_THAT(values, SizeIs(2));
  EXPECT_EQ(values[0].particles, 1024);
  EXPECT_EQ(values[0].energy_per_particle, 0.5);
  EXPECT_EQ(values[0].viscosity.value, 0.548);
  EXPECT_EQ(values[0].viscosity.last_digit, 1e-3);
  EXPECT_EQ(values[0].total_time, 20000.0);
  EXPECT_EQ(values[0].pressure.value, 0.5562);
  EXPECT_EQ(values[0].pressure.last_digit, 1e-4);
  EXPECT_EQ(values[1].viscosity.value, 14.0);
  EXPECT_EQ(values[1].viscosity.last_digit, 0.1);
  EXPECT_FALSE(values[1].viscosity.standard_error);
  EXPECT_EQ(values[1].pressure_kinetic.value, 0.539);
  EXPECT_THAT(values[1].source, HasSubstr("1711"));
}

TEST(PublishedGreenKubo, MayHaveErrorsAndMayLackPressures) {
  const ScratchFolder folder;
  const std::string header =
      "particles,energy_per_particle,viscosity,viscosity_error,total_time,pressure,pressure_kinetic,source\n";
  put(folder / "mine.csv", header + "64,1,2.5,0.3,100,,,here\n");
  const auto values = read_published_green_kubo(folder / "mine.csv");
  ASSERT_THAT(values, SizeIs(1));
  EXPECT_EQ(values[0].viscosity.standard_error, 0.3);
  EXPECT_TRUE(std::isnan(values[0].pressure.value));
  put(folder / "mine.csv", header + "64,1,2.5,0.3,0,,,here\n");
  EXPECT_THAT(message_of<BadInput>([&] { read_published_green_kubo(folder / "mine.csv"); }),
              HasSubstr("mine.csv:2: total_time is 0 where a number above 0 was expected"));
  put(folder / "mine.csv", header + "64,1,,0.3,100,,,here\n");
  EXPECT_THAT(message_of<BadInput>([&] { read_published_green_kubo(folder / "mine.csv"); }),
              HasSubstr("mine.csv:2: viscosity is \"\" where a number was expected"));
}

TEST(PublishedGreenKubo, IsNoTableToCompareASweepWith) {
  EXPECT_THAT(
      message_of<BadInput>([] { read_published_table((reference / "posch1995_green_kubo.csv").string(), reference); }),
      HasSubstr("the header has no column strain_rate"));
}

/// Rows that repeat the published table as it should read, with small errors.
std::vector<cases::TableRow> faithful_rows(const cases::PublishedTable& table) {
  std::vector<cases::TableRow> rows;
  for (const auto& published : table.rows) {
    cases::TableRow row;
    row.particles = published.particles;
    row.energy_per_particle = published.energy_per_particle;
    row.strain_rate = published.strain_rate;
    row.duration = published.total_time;
    row.replicas = 1;
    for (std::size_t i = 0; i < cases::compared_quantities.size(); ++i)
      for (std::size_t k = 0; k < cases::quantities.size(); ++k)
        if (cases::quantities[k] == cases::compared_quantities[i])
          row.estimates[k] = {published.cells[i].reading.value_or(published.cells[i].value), 2e-4, 100.0, 99};
    rows.push_back(row);
  }
  return rows;
}

TEST(CompareWithPublished, AgreesWithItselfAndMarksWhatIsNotJudged) {
  const auto table = read_published_table("posch1995_table2", reference);
  const auto comparison = cases::compare(faithful_rows(table), table);
  EXPECT_EQ(comparison.verdict, cases::Verdict::agree);
  EXPECT_EQ(comparison.judged, 11 * 8 - 2);  // four rows of fifteen lie in the instability region
  EXPECT_LT(comparison.largest, 1e-9);
  const std::string text = format_comparison(comparison);
  EXPECT_THAT(text, HasSubstr("Verdict: agree"));
  EXPECT_THAT(text, HasSubstr("rate 0.009; total time ours 11666.7, published 11666.7; instability region"));
  EXPECT_THAT(text, HasSubstr("as printed, a misprint [1]: not judged"));
  EXPECT_THAT(text, HasSubstr("as it should read"));
  EXPECT_THAT(text, HasSubstr("[1] one digit of this"));
  EXPECT_THAT(text, HasSubstr("0.4900"));  // as many digits as in print
  EXPECT_THAT(text, ::testing::Not(HasSubstr("Only in")));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
}

TEST(CompareWithPublished, DisagreesWhereTheSignOfPrintWasFollowed) {
  const auto table = read_published_table("posch1995_table1", reference);
  auto rows = faithful_rows(table);
  for (auto& row : rows)
    if (row.strain_rate == 1.0) row.estimates[cases::quantity("pxy_potential")].value *= -1.0;
  rows[0].particles = 900;
  const auto comparison = cases::compare(rows, table);
  EXPECT_EQ(comparison.verdict, cases::Verdict::disagree);
  EXPECT_EQ(comparison.beyond[2], 3);
  EXPECT_EQ(comparison.largest_where.substr(0, 13), "pxy_potential");
  const std::string text = format_comparison(comparison);
  EXPECT_THAT(text, HasSubstr("Verdict: disagree: 3 of"));
  EXPECT_THAT(text, HasSubstr("DISAGREES"));
  EXPECT_THAT(text, HasSubstr("Only in our table:\n  N = 900, E/N = 0.5, rate 0.001"));
  EXPECT_THAT(text, HasSubstr("Only in the published table:\n  N = 1024, E/N = 0.5, rate 0.001"));
}

TEST(CompareWithPublished, TakesAnotherTableOfLucyWithItsErrors) {
  const ScratchFolder folder;
  const auto rows = faithful_rows(read_published_table("posch1995_table1", reference));
  write_table_csv(folder / "table.csv", rows);
  auto ours = rows;
  ours[3].estimates[cases::quantity("pyy_kinetic")].value += 3.0 * std::sqrt(2.0) * 2e-4;
  const auto comparison = cases::compare(ours, read_published_table((folder / "table.csv").string(), reference));
  EXPECT_EQ(comparison.judged, 15 * 8);
  EXPECT_NEAR(comparison.largest, 3.0, 1e-9);
  EXPECT_NEAR(comparison.chi_squared, 9.0, 1e-9);
}

}  // namespace
}  // namespace lucy::files
