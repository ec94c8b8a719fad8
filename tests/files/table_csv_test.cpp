// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/table_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "lucy/errors.hpp"
#include "lucy/files/csv.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using testing::contents;
using ::testing::HasSubstr;
using testing::message_of;
using testing::put;
using testing::ScratchFolder;
using ::testing::SizeIs;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

cases::TableRow example() {
  cases::TableRow row;
  row.particles = 1024;
  row.energy_per_particle = 0.5;
  row.strain_rate = 0.1;
  row.step = 0.05;
  row.duration = 2000;
  row.replicas = 4;
  for (std::size_t i = 0; i < row.estimates.size(); ++i) {
    row.estimates[i].value = std::sin(1.0 + static_cast<double>(i));
    row.estimates[i].error = 1e-5 / (1.0 + static_cast<double>(i));
  }
  row.effective_samples = 123.25;
  row.equilibration_discarded = 12.5;
  row.worst_energy_error = 3e-9;
  row.subdivided_steps = 7;
  return row;
}

TEST(TableCsv, HasTheColumnsThatWerePromisedInTheirOrder) {
  const ScratchFolder folder;
  write_table_csv(folder / "table.csv", {});
  EXPECT_EQ(contents(folder / "table.csv"),
            "particles,energy_per_particle,strain_rate,step,duration,replicas,potential_energy,potential_energy_error,"
            "kinetic_temperature,kinetic_temperature_error,pxy_kinetic,pxy_kinetic_error,pxy_potential,"
            "pxy_potential_error,pxx_kinetic,pxx_kinetic_error,pxx_potential,pxx_potential_error,pyy_kinetic,"
            "pyy_kinetic_error,pyy_potential,pyy_potential_error,viscosity,viscosity_error,normal_stress,"
            "normal_stress_error,largest_kinetic_share,largest_kinetic_share_error,effective_samples,"
            "equilibration_discarded,worst_energy_error,subdivided_steps,status\n");
}

TEST(TableCsv, GivesBackTheSameBits) {
  const ScratchFolder folder;
  std::vector<cases::TableRow> rows = {example(), example()};
  rows[1].strain_rate = 0.0;
  rows[1].estimates[cases::quantity("viscosity")] = {-nan, nan, nan, 0};
  rows[1].estimates[0].value = -0.1 - 0.2;
  rows[1].estimates[1].value = 5e-324;
  rows[1].estimates[2].value = -std::numeric_limits<double>::infinity();
  rows[1].status = cases::RowStatus::too_short;
  write_table_csv(folder / "table.csv", rows);
  const auto back = read_table_csv(folder / "table.csv");
  ASSERT_THAT(back, SizeIs(2));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    EXPECT_EQ(back[r].particles, rows[r].particles);
    EXPECT_EQ(back[r].energy_per_particle, rows[r].energy_per_particle);
    EXPECT_EQ(back[r].strain_rate, rows[r].strain_rate);
    EXPECT_EQ(back[r].step, rows[r].step);
    EXPECT_EQ(back[r].duration, rows[r].duration);
    EXPECT_EQ(back[r].replicas, rows[r].replicas);
    EXPECT_EQ(back[r].effective_samples, rows[r].effective_samples);
    EXPECT_EQ(back[r].equilibration_discarded, rows[r].equilibration_discarded);
    EXPECT_EQ(back[r].worst_energy_error, rows[r].worst_energy_error);
    EXPECT_EQ(back[r].subdivided_steps, rows[r].subdivided_steps);
    EXPECT_EQ(back[r].status, rows[r].status);
    for (std::size_t i = 0; i < rows[r].estimates.size(); ++i) {
      const double before = rows[r].estimates[i].value;
      if (std::isnan(before)) {
        EXPECT_TRUE(std::isnan(back[r].estimates[i].value) && std::isnan(back[r].estimates[i].error));
        continue;
      }
      EXPECT_EQ(std::bit_cast<std::uint64_t>(back[r].estimates[i].value), std::bit_cast<std::uint64_t>(before));
      EXPECT_EQ(back[r].estimates[i].error, rows[r].estimates[i].error);
    }
  }
  EXPECT_THAT(contents(folder / "table.csv"), ::testing::Not(HasSubstr("-nan")));
}

TEST(TableCsv, PassesOverFurtherColumnsInAnyOrder) {
  const ScratchFolder folder;
  const std::vector rows = {example()};
  write_table_csv(folder / "table.csv", rows);
  std::string text = contents(folder / "table.csv");
  text.insert(text.find('\n') + 1, "a note,");
  text.insert(0, "remark,");
  put(folder / "table.csv", text);
  EXPECT_EQ(read_table_csv(folder / "table.csv").at(0).particles, 1024);
}

TEST(TableCsv, RefusesWithFileLineAndColumn) {
  const ScratchFolder folder;
  const auto path = folder / "table.csv";
  const std::vector rows = {example(), example()};
  write_table_csv(path, rows);
  const std::string good = contents(path);
  const auto refused = [&](const std::string& before, const std::string& after) {
    std::string text = good;
    text.replace(text.rfind(before), before.size(), after);
    put(path, text);
    return message_of<BadInput>([&] { read_table_csv(path); });
  };
  EXPECT_THAT(refused("1024", "many"), HasSubstr("table.csv:3: particles is \"many\""));
  EXPECT_THAT(refused("0.05", "0.05s"), HasSubstr("table.csv:3: step is \"0.05s\""));
  EXPECT_THAT(refused(",ok", ",fine"), HasSubstr("table.csv:3: status is \"fine\""));
  EXPECT_THAT(refused(",ok", ""), HasSubstr("table.csv:3: 32 cells"));
  EXPECT_THAT(refused("pxy_kinetic,", "pxy,"), HasSubstr("has a column pxy_kinetic"));
  EXPECT_THAT(refused("pxy_kinetic,", "step,"), HasSubstr("step stands twice"));
  EXPECT_THAT(refused("1e-05", "-1e-05"), HasSubstr("table.csv:3: potential_energy_error is -1e-05"));
  put(path, "");
  EXPECT_THAT(message_of<BadInput>([&] { read_table_csv(path); }), HasSubstr("is empty"));
  put(path, std::string("a,b\0c\n", 6));
  EXPECT_THAT(message_of<BadInput>([&] { read_table_csv(path); }), HasSubstr("binary"));
}

TEST(ReplicasCsv, HasOneLinePerReplica) {
  const ScratchFolder folder;
  const std::vector<cases::ReplicaRow> rows = {{.particles = 64,
                                                .energy_per_particle = 1,
                                                .strain_rate = 0.5,
                                                .replica = 1,
                                                .seed = 18446744073709551615u,
                                                .viscosity = 0.42,
                                                .viscosity_error = nan,
                                                .energy_rescaled = -1e-9,
                                                .worst_energy_error = 2e-8,
                                                .steps = 3000,
                                                .subdivided_steps = 0}};
  write_replicas_csv(folder / "replicas.csv", rows);
  EXPECT_EQ(contents(folder / "replicas.csv"),
            "particles,energy_per_particle,strain_rate,replica,seed,viscosity,viscosity_error,energy_rescaled,"
            "worst_energy_error,steps,subdivided_steps\n"
            "64,1,0.5,1,18446744073709551615,0.42,nan,-1e-09,2e-08,3000,0\n");
}

TEST(CsvFile, UnderstandsQuotesAndLineEndsOfOtherMachines) {
  const ScratchFolder folder;
  put(folder / "x.csv", "name,text\r\na,\"one, \"\"two\"\"\"\r\n\r\nb,\r\n");
  const CsvFile file(folder / "x.csv");
  ASSERT_THAT(file.rows(), SizeIs(2));
  EXPECT_EQ(file.rows()[0].cells[1], "one, \"two\"");
  EXPECT_EQ(file.rows()[1].cells[1], "");
  EXPECT_EQ(file.rows()[1].line, 4);
  put(folder / "x.csv", "name,text\na,\"open\n");
  EXPECT_THAT(message_of<BadInput>([&] { CsvFile again(folder / "x.csv"); }), HasSubstr("x.csv:2: a quotation mark"));
}

}  // namespace
}  // namespace lucy::files
