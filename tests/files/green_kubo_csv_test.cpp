// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/green_kubo_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "green_kubo_rows.hpp"
#include "lucy/errors.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using testing::contents;
using testing::green_kubo_row;
using ::testing::HasSubstr;
using testing::message_of;
using ::testing::Not;
using testing::put;
using testing::ScratchFolder;
using ::testing::SizeIs;
using testing::unknown;

TEST(ViscosityCsv, HasTheColumnsThatWerePromisedInTheirOrder) {
  const ScratchFolder folder;
  write_viscosity_csv(folder / "viscosity.csv", {});
  EXPECT_EQ(
      contents(folder / "viscosity.csv"),
      "energy_per_particle,particles,viscosity,viscosity_error,viscosity_half_cutoff,viscosity_half_cutoff_error,"
      "viscosity_twice_cutoff,viscosity_twice_cutoff_error,viscosity_spectrum,viscosity_spectrum_error,"
      "viscosity_kinetic,viscosity_kinetic_error,viscosity_cross,viscosity_cross_error,viscosity_potential,"
      "viscosity_potential_error,viscosity_xy,viscosity_xy_error,viscosity_difference,viscosity_difference_error,"
      "decay_time,decay_time_error,kinetic_temperature,kinetic_temperature_error,pressure,pressure_error,"
      "pressure_kinetic,pressure_kinetic_error,pressure_potential,pressure_potential_error,potential_energy,"
      "potential_energy_error,shear_modulus,shear_modulus_error,self_diffusion,self_diffusion_error,"
      "thermal_conductivity,thermal_conductivity_error,spectrum_z,cutoff,decay_begin,decay_end,spectrum_frequency,"
      "spectrum_p_value,self_diffusion_cutoff,thermal_conductivity_cutoff,blocks,step,sample_interval,duration,"
      "replicas,energy_drift,largest_energy_error,status\n");
}

TEST(ViscosityCsv, GivesBackTheSameBits) {
  const ScratchFolder folder;
  std::vector<cases::GreenKuboRow> rows = {green_kubo_row(), green_kubo_row()};
  rows[1].energy_per_particle = 0.1 + 0.2;
  rows[1].spectrum_z = -unknown;
  rows[1].estimates[0].error = unknown;
  rows[1].status = cases::RowStatus::too_short;
  write_viscosity_csv(folder / "viscosity.csv", rows);
  const auto back = read_viscosity_csv(folder / "viscosity.csv");
  ASSERT_THAT(back, SizeIs(2));
  const auto same = [](double a, double b) {
    return std::isnan(a) ? std::isnan(b) : std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  for (std::size_t r = 0; r < rows.size(); ++r) {
    EXPECT_EQ(back[r].particles, rows[r].particles);
    EXPECT_EQ(back[r].blocks, rows[r].blocks);
    EXPECT_EQ(back[r].replicas, rows[r].replicas);
    EXPECT_EQ(back[r].status, rows[r].status);
    for (const auto member :
         {&cases::GreenKuboRow::energy_per_particle, &cases::GreenKuboRow::spectrum_z, &cases::GreenKuboRow::cutoff,
          &cases::GreenKuboRow::decay_begin, &cases::GreenKuboRow::decay_end, &cases::GreenKuboRow::spectrum_frequency,
          &cases::GreenKuboRow::spectrum_p_value, &cases::GreenKuboRow::step, &cases::GreenKuboRow::sample_interval,
          &cases::GreenKuboRow::duration, &cases::GreenKuboRow::energy_drift,
          &cases::GreenKuboRow::largest_energy_error})
      EXPECT_PRED2(same, rows[r].*member, back[r].*member);
    for (std::size_t i = 0; i < rows[r].estimates.size(); ++i) {
      EXPECT_PRED2(same, rows[r].estimates[i].value, back[r].estimates[i].value);
      EXPECT_PRED2(same, rows[r].estimates[i].error, back[r].estimates[i].error);
    }
  }
  EXPECT_THAT(contents(folder / "viscosity.csv"), Not(HasSubstr("-nan")));
}

TEST(ViscosityCsv, RefusesWithFileLineAndColumn) {
  const ScratchFolder folder;
  const auto path = folder / "viscosity.csv";
  const std::vector rows = {green_kubo_row()};
  write_viscosity_csv(path, rows);
  const std::string good = contents(path);
  const auto refused = [&](const std::string& before, const std::string& after) {
    std::string text = good;
    text.replace(text.rfind(before), before.size(), after);
    put(path, text);
    return message_of<BadInput>([&] { read_viscosity_csv(path); });
  };
  EXPECT_THAT(refused(",128,", ",-1,"), HasSubstr("viscosity.csv:2: blocks is -1 where a count was expected"));
  EXPECT_THAT(refused("0.0123", "-0.0123"), HasSubstr("viscosity.csv:2: viscosity_error is -0.0123"));
  EXPECT_THAT(refused(",ok", ",good"), HasSubstr("viscosity.csv:2: status is \"good\""));
  EXPECT_THAT(refused("spectrum_z", "z"), HasSubstr("viscosity.csv:1: the header of a viscosity.csv has a column "
                                                    "spectrum_z"));
}

/// Two times, every curve known but the parts.
cases::GreenKuboResult result() {
  cases::GreenKuboResult result;
  result.row = green_kubo_row();
  cases::StressCurves& curves = result.curves;
  curves.time = {0.0, 0.2};
  curves.xy = {{1.0, 0.5}, {0.25, 0.125}};
  curves.difference = {{2.0, 1.5}, {0.75, unknown}};
  curves.mean = {{1.5, 1.0}, {0.5, 0.25}};
  curves.integral = {{0.0, 0.25}, {0.0, 0.0625}};
  curves.noise_envelope = {0.0, 3.0};
  curves.noise_integral = {{0.0, -0.5}, {0.0, 4.0}};
  return result;
}

TEST(CorrelationCsv, HasOneLinePerStateAndTime) {
  const ScratchFolder folder;
  std::vector<cases::GreenKuboResult> results = {result(), {}, result()};
  results[2].row.energy_per_particle = 1.0;
  results[2].curves.kinetic = {{7.0, 8.0}, {9.0, 10.0}};
  write_correlation_csv(folder / "correlation.csv", results);
  EXPECT_EQ(
      contents(folder / "correlation.csv"),
      "point,energy_per_particle,particles,time,C_xy,C_xy_error,C_difference,C_difference_error,C_mean,C_mean_error,"
      "integral,integral_error,noise_envelope,noise_integral,noise_integral_error,C_kinetic,C_kinetic_error,"
      "C_cross,C_cross_error,C_potential,C_potential_error\n"
      "1,0.5,1024,0,1,0.25,2,0.75,1.5,0.5,0,0,0,0,0,nan,nan,nan,nan,nan,nan\n"
      "1,0.5,1024,0.2,0.5,0.125,1.5,nan,1,0.25,0.25,0.0625,3,-0.5,4,nan,nan,nan,nan,nan,nan\n"
      "3,1,1024,0,1,0.25,2,0.75,1.5,0.5,0,0,0,0,0,7,9,nan,nan,nan,nan\n"
      "3,1,1024,0.2,0.5,0.125,1.5,nan,1,0.25,0.25,0.0625,3,-0.5,4,8,10,nan,nan,nan,nan\n");
}

TEST(PairsCsv, IsThereOnlyWhenSomethingElseWasCorrelated) {
  const ScratchFolder folder;
  std::vector<cases::GreenKuboResult> results = {result(), result()};
  write_pairs_csv(folder / "pairs.csv", results);
  EXPECT_EQ(folder.entries(), 0u);
  results[1].others = {{"velocity velocity", {0.0, 0.5}, {{0.25, 0.125}, {1.0, 2.0}}, {{0.0, 3.0}, {4.0, unknown}}},
                       {"pressure pressure", {0.0}, {{5.0}, {6.0}}, {{0.0}, {0.0}}}};
  write_pairs_csv(folder / "pairs.csv", results);
  EXPECT_EQ(contents(folder / "pairs.csv"),
            "point,energy_per_particle,particles,pair,time,correlation,correlation_error,integral,integral_error\n"
            "2,0.5,1024,velocity velocity,0,0.25,1,0,4\n"
            "2,0.5,1024,velocity velocity,0.5,0.125,2,3,nan\n"
            "2,0.5,1024,pressure pressure,0,5,6,0,0\n");
}

}  // namespace
}  // namespace lucy::files
