// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The table that LAMMPS is given, its stated error, and series read back. LAMMPS itself runs the scripts in
// tests/program/lammps_test.py.
#include "lucy/files/lammps_case.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lucy/files/series_file.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using testing::put;
using testing::ScratchFolder;

cases::CouettePoint point_of(double rate) {
  cases::CouettePoint point;
  point.particles = 64;
  point.energy_per_particle = 1.0;
  point.strain_rate = rate;
  point.duration = 10.0;
  point.equilibration = 2.0;
  return point;
}

TEST(LammpsCase, TheTableHoldsThePotentialAndItsSlope) {
  const ScratchFolder scratch;
  const auto point = point_of(0.5);
  write_lammps_case(scratch.path(), {point, cases::CouetteRun(point, 0).frame(), 0.5});
  const std::string text = testing::contents(scratch / "lucy.table");
  const ColumnFile table =
      parse_columns(std::string_view(text).substr(text.find("RSQ 1e-12 3") + 11), scratch / "lucy.table");
  ASSERT_EQ(table.columns.size(), 4U);
  const auto& r = table.columns[1];
  ASSERT_EQ(r.size(), 16000U);
  EXPECT_EQ(r.front(), 1e-12);  // particles overlap, and LAMMPS stops where two are nearer
  EXPECT_EQ(r.back(), 3.0);
  const double a = 5.0 / (9.0 * std::acos(-1.0));
  for (std::size_t i = 0; i < r.size(); i += 333) {
    const double x = r[i] / 3.0;
    EXPECT_NEAR(table.columns[2][i], a * (1 + 3 * x) * std::pow(1 - x, 3), 1e-15);
    EXPECT_NEAR(table.columns[3][i], 12.0 * a / 3.0 * x * std::pow(1 - x, 2), 1e-15);
  }
  EXPECT_EQ(table.columns[2].back(), 0.0);
}

TEST(LammpsCase, TheErrorOfTheTableIsThatOfStraightLines) {
  const TableError error = table_error(kernel::Lucy<2>(3.0), 1.0);
  // phi'' of x^2 terms is linear in r^2; near r = 0 the cubic term's straight line is off by (12 A/h^2)(2/h)/4 of the
  // first interval's length, times r: 1.1e-5 there.
  EXPECT_NEAR(error.pair_force, 1.2e-5, 0.3e-5);
  EXPECT_LT(error.pair_energy, 1e-6);
  EXPECT_LT(error.force, error.pair_force);
  // Twice the density: twice the neighbours.
  const TableError denser = table_error(kernel::Lucy<2>(3.0), 2.0);
  EXPECT_NEAR(denser.energy, 2.0 * error.energy, 1e-20);
  EXPECT_NEAR(denser.force, std::sqrt(2.0) * error.force, 1e-20);
  EXPECT_NEAR(denser.pressure, 4.0 * error.pressure, 1e-20);
}

TEST(LammpsCase, OnlyShearedStatesGetAShearedScript) {
  for (const double rate : {0.0, 0.5}) {
    const ScratchFolder scratch;
    const auto point = point_of(rate);
    write_lammps_case(scratch.path(), {point, cases::CouetteRun(point, 0).frame(), 0.5});
    EXPECT_EQ(std::filesystem::exists(scratch / "sheared.in"), rate != 0.0);
    EXPECT_EQ(testing::contents(scratch / "nve.in").find('@'), std::string::npos);
  }
}

TEST(LammpsCase, OnlyATiltedCellIsHandedOverAsATiltedOne) {
  const auto point = point_of(0.5);
  cases::Frame frame = cases::CouetteRun(point, 0).frame();
  for (const double offset : {0.0, 2.0}) {
    const ScratchFolder scratch;
    frame.offset = offset;
    write_lammps_case(scratch.path(), {point, frame, 0.5});
    EXPECT_EQ(testing::contents(scratch / "start.data").find("xy xz yz") != std::string::npos, offset != 0.0);
  }
}

TEST(LammpsCase, OfARunThatWentOnFromARestartFileTheLaterRowsCount) {
  const ScratchFolder scratch;
  std::string text = "# step time";
  for (const auto name : cases::observables) text += fmt::format(" {}", name);
  text += " pxy pxx pyy energy heat tilt\n";
  const auto row = [&](double time, int attempt) {
    text += fmt::format("{} {}", time * 20, time);
    for (std::size_t q = 0; q < cases::observables.size(); ++q) text += fmt::format(" {}", attempt);
    text += fmt::format(" 1 2 3 {} 0 0\n", 10 * attempt);
  };
  for (const double time : {0.0, 0.2, 0.4, 0.6, 0.8}) row(time, 1);
  text += "# a title\n";
  for (const double time : {0.4, 0.6}) row(time, 2);
  for (const double time : {0.6, 0.8, 1.0}) row(time, 3);
  put(scratch / "series", text);
  const cases::EngineSeries series = read_lammps_series(scratch / "series");
  EXPECT_EQ(series.time, (std::vector{0.0, 0.2, 0.4, 0.6, 0.8, 1.0}));
  EXPECT_EQ(series.energy, (std::vector{10.0, 10.0, 20.0, 30.0, 30.0, 30.0}));
  EXPECT_EQ(series.instants[2][0], 2.0);
  EXPECT_EQ(series.instants[5][8], 3.0);
}

TEST(LammpsCase, ASeriesBecomesTheRecordOfAReplica) {
  const ScratchFolder scratch;
  std::string text = "# a title\n# step time";
  for (const auto name : cases::observables) text += fmt::format(" {}", name);
  text += " pxy pxx pyy energy heat tilt\n";
  const auto point = point_of(0.0);
  const int every = series_steps(point);
  for (int row = 0; row * every <= lammps_steps(point); ++row) {
    text += fmt::format("{} {}", row * every, row * every * point.step);
    for (std::size_t q = 0; q < cases::observables.size(); ++q)
      text += fmt::format(" {}", row + 100 * static_cast<int>(q));
    text += fmt::format(" 1 2 3 {} {} 0\n", 1000 - row, 2 * row);
  }
  put(scratch / "series", text);
  const cases::EngineSeries series = read_lammps_series(scratch / "series");
  ASSERT_EQ(series.time.size(), 61U);
  EXPECT_EQ(series.energy.back(), 940.0);
  EXPECT_EQ(series.heat.back(), 120.0);

  const cases::CouetteRecord record = record_of(series, point);
  EXPECT_NEAR(record.sample_interval, 0.4, 1e-12);
  ASSERT_EQ(record.samples.size(), 25U);  // the 50 rows after the equilibration, two by two
  EXPECT_EQ(record.samples.front()[0], 11.5);
  EXPECT_EQ(record.samples.back()[3], 359.5);
}

}  // namespace
}  // namespace lucy::files
