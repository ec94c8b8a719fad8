// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/benard_csv.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "benard_rows.hpp"
#include "lucy/errors.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using testing::benard_row;
using testing::contents;
using ::testing::HasSubstr;
using testing::message_of;
using testing::put;
using testing::ScratchFolder;
using ::testing::SizeIs;
using ::testing::StartsWith;

TEST(BenardCsv, HasSettingsThenValuesWithErrorsThenHowTheRunWent) {
  const ScratchFolder folder;
  write_benard_csv(folder / "benard.csv", {});
  const std::string header = contents(folder / "benard.csv");
  EXPECT_THAT(header,
              StartsWith("particles,equation_of_state,kernel,range,side,wall,height,width,hot,cold,gravity,rayleigh,"
                         "viscosity,conductivity,bulk_viscosity,roll_velocity,disorder,step,density_mean,duration,"
                         "replicas,equilibration,kinetic_energy_field,kinetic_energy_field_error,nusselt_hot,"
                         "nusselt_hot_error,nusselt_cold,nusselt_cold_error,"));
  for (const char* name : {"kinetic_energy_total", "kinetic_energy_smoothed", "conduction_hot", "temperature_largest"})
    EXPECT_THAT(header, HasSubstr(fmt::format(",{0},{0}_error,", name)));
  EXPECT_THAT(header, HasSubstr(",effective_samples,equilibration_discarded,worst_energy_error,energy_drift,"
                                "subdivided_steps,reflections,status\n"));
}

TEST(BenardCsv, GivesBackTheSameBits) {
  const ScratchFolder folder;
  const std::vector<cases::BenardRow> rows = {benard_row(), testing::unusual_benard_row()};
  write_benard_csv(folder / "benard.csv", rows);
  const auto back = read_benard_csv(folder / "benard.csv");
  ASSERT_THAT(back, SizeIs(2));
  const auto same = [](double a, double b) {
    return std::isnan(a) ? std::isnan(b) : std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  using P = cases::BenardPoint;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const P& read = back[r].settings;
    const P& wrote = rows[r].settings;
    EXPECT_EQ(read.particles, wrote.particles);
    EXPECT_EQ(read.replicas, wrote.replicas);
    EXPECT_EQ(read.equation_of_state, wrote.equation_of_state);
    EXPECT_EQ(read.weight, wrote.weight);
    EXPECT_EQ(read.sides, wrote.sides);
    EXPECT_EQ(read.wall, wrote.wall);
    EXPECT_EQ(read.density_mean, wrote.density_mean);
    for (const auto member : {&P::range, &P::bulk_viscosity, &P::disorder, &P::step, &P::duration, &P::equilibration})
      EXPECT_PRED2(same, wrote.*member, read.*member);
    for (const auto member : {&P::height, &P::hot, &P::cold}) EXPECT_PRED2(same, wrote.*member, read.*member);
    for (const auto member : {&P::width, &P::gravity, &P::rayleigh, &P::viscosity, &P::conductivity, &P::roll_velocity})
      EXPECT_PRED2(same, (wrote.*member).value(), (read.*member).value());
    for (const auto member :
         {&cases::BenardRow::duration, &cases::BenardRow::effective_samples, &cases::BenardRow::equilibration_discarded,
          &cases::BenardRow::worst_energy_error, &cases::BenardRow::energy_drift})
      EXPECT_PRED2(same, rows[r].*member, back[r].*member);
    EXPECT_EQ(back[r].subdivided_steps, 7);
    EXPECT_EQ(back[r].reflections, 321);
    EXPECT_EQ(back[r].status, rows[r].status);
    for (std::size_t i = 0; i < rows[r].estimates.size(); ++i) {
      EXPECT_PRED2(same, rows[r].estimates[i].value, back[r].estimates[i].value);
      EXPECT_PRED2(same, rows[r].estimates[i].error, back[r].estimates[i].error);
    }
  }
  EXPECT_TRUE(std::isinf(*back[1].settings.rayleigh));
}

TEST(BenardCsv, RefusesWithFileLineAndColumn) {
  const ScratchFolder folder;
  const auto path = folder / "benard.csv";
  write_benard_csv(path, std::vector{benard_row()});
  const std::string good = contents(path);
  const auto refused = [&](const std::string& before, const std::string& after) {
    std::string text = good;
    text.replace(text.rfind(before), before.size(), after);
    put(path, text);
    return message_of<BadInput>([&] { read_benard_csv(path); });
  };
  EXPECT_THAT(refused("ideal-gas", "air"),
              HasSubstr("benard.csv:2: equation_of_state is \"air\" where one of ideal-gas, van-der-waals, dense-fluid "
                        "was expected"));
  EXPECT_THAT(refused(",mirror-images,", ",glass,"), HasSubstr("benard.csv:2: wall is \"glass\""));
  EXPECT_THAT(refused(",1.532,0.012", ",1.532,-0.012"), HasSubstr("benard.csv:2: nusselt_hot_error is -0.012"));
  EXPECT_THAT(refused(",ok", ",good"), HasSubstr("benard.csv:2: status is \"good\""));
  EXPECT_THAT(refused("energy_drift", "drift"),
              HasSubstr("benard.csv:1: the header of a benard.csv has a column energy_drift"));
}

}  // namespace
}  // namespace lucy::files
