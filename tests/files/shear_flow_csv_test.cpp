// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/shear_flow_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "lucy/errors.hpp"
#include "scratch.hpp"
#include "shear_flow_rows.hpp"

namespace lucy::files {
namespace {

using testing::contents;
using ::testing::HasSubstr;
using testing::message_of;
using testing::put;
using testing::ScratchFolder;
using testing::shear_flow_row;
using ::testing::SizeIs;
using testing::unknown_value;

TEST(ShearFlowCsv, HasSettingsThenValuesWithErrorsThenHowTheRunWent) {
  const ScratchFolder folder;
  write_shear_flow_csv(folder / "shear_flow.csv", {});
  EXPECT_EQ(
      contents(folder / "shear_flow.csv"),
      "particles,equation_of_state,kernel,cooling,strain_rate,density,range,start_temperature,prescribed_viscosity,"
      "prescribed_bulk_viscosity,prescribed_conductivity,start_disorder,start_noise,step,duration,replicas,"
      "viscosity,viscosity_error,viscosity_excess,viscosity_excess_error,viscosity_carried,viscosity_carried_error,"
      "viscosity_pressure,viscosity_pressure_error,viscosity_newtonian,viscosity_newtonian_error,entropy_surplus,"
      "entropy_surplus_error,kinetic_temperature,kinetic_temperature_error,internal_energy,internal_energy_error,"
      "pxy_carried,pxy_carried_error,pxy_pressure,pxy_pressure_error,pxy_newtonian,pxy_newtonian_error,work,"
      "work_error,heating,heating_error,heat_removed,heat_removed_error,temperature,temperature_error,pressure,"
      "pressure_error,velocity_gradient,velocity_gradient_error,density_wave,density_wave_error,entropy_viscosity,"
      "entropy_viscosity_error,entropy_conduction,entropy_conduction_error,entropy_removed,entropy_removed_error,"
      "least_entropy_production,least_entropy_production_error,effective_samples,equilibration_discarded,"
      "worst_energy_error,energy_drift,subdivided_steps,status\n");
}

TEST(ShearFlowCsv, GivesBackTheSameBits) {
  const ScratchFolder folder;
  std::vector<cases::ShearFlowRow> rows = {shear_flow_row(), shear_flow_row()};
  rows[1].settings.equation_of_state = spam::EquationOfStateName::van_der_waals;
  rows[1].settings.weight = kernel::WeightName::monaghan;
  rows[1].settings.cooling = motion::Cooling::none;
  rows[1].settings.strain_rate = 0.1 + 0.2;
  rows[1].settings.noise = 1.0 / 3.0;
  rows[1].estimates[0].error = unknown_value;
  rows[1].status = cases::RowStatus::too_short;
  write_shear_flow_csv(folder / "shear_flow.csv", rows);
  const auto back = read_shear_flow_csv(folder / "shear_flow.csv");
  ASSERT_THAT(back, SizeIs(2));
  const auto same = [](double a, double b) {
    return std::isnan(a) ? std::isnan(b) : std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const cases::ShearFlowPoint& settings = back[r].settings;
    EXPECT_EQ(settings.particles, 1024);
    EXPECT_EQ(settings.replicas, 2);
    EXPECT_EQ(settings.equation_of_state, rows[r].settings.equation_of_state);
    EXPECT_EQ(settings.weight, rows[r].settings.weight);
    EXPECT_EQ(settings.cooling, rows[r].settings.cooling);
    EXPECT_PRED2(same, settings.strain_rate, rows[r].settings.strain_rate);
    EXPECT_PRED2(same, settings.viscosity, rows[r].settings.viscosity);
    EXPECT_PRED2(same, settings.conductivity, rows[r].settings.conductivity);
    EXPECT_PRED2(same, settings.noise, rows[r].settings.noise);
    EXPECT_PRED2(same, settings.disorder, rows[r].settings.disorder);
    EXPECT_PRED2(same, settings.step, rows[r].settings.step);
    for (const auto member : {&cases::ShearFlowRow::duration, &cases::ShearFlowRow::effective_samples,
                              &cases::ShearFlowRow::equilibration_discarded, &cases::ShearFlowRow::worst_energy_error,
                              &cases::ShearFlowRow::energy_drift})
      EXPECT_PRED2(same, rows[r].*member, back[r].*member);
    EXPECT_EQ(back[r].subdivided_steps, 7);
    EXPECT_EQ(back[r].status, rows[r].status);
    for (std::size_t i = 0; i < rows[r].estimates.size(); ++i) {
      EXPECT_PRED2(same, rows[r].estimates[i].value, back[r].estimates[i].value);
      EXPECT_PRED2(same, rows[r].estimates[i].error, back[r].estimates[i].error);
    }
  }
}

TEST(ShearFlowCsv, RefusesWithFileLineAndColumn) {
  const ScratchFolder folder;
  const auto path = folder / "shear_flow.csv";
  write_shear_flow_csv(path, std::vector{shear_flow_row()});
  const std::string good = contents(path);
  const auto refused = [&](const std::string& before, const std::string& after) {
    std::string text = good;
    text.replace(text.rfind(before), before.size(), after);
    put(path, text);
    return message_of<BadInput>([&] { read_shear_flow_csv(path); });
  };
  EXPECT_THAT(refused("ideal-gas", "air"),
              HasSubstr("shear_flow.csv:2: equation_of_state is \"air\" where one of isentropic, ideal-gas, "
                        "van-der-waals, dense-fluid was expected"));
  EXPECT_THAT(refused(",isoenergetic,", ",ice,"), HasSubstr("shear_flow.csv:2: cooling is \"ice\""));
  EXPECT_THAT(refused("0.0012", "-0.0012"), HasSubstr("shear_flow.csv:2: viscosity_error is -0.0012"));
  EXPECT_THAT(refused(",ok", ",good"), HasSubstr("shear_flow.csv:2: status is \"good\""));
  EXPECT_THAT(refused("energy_drift", "drift"), HasSubstr("shear_flow.csv:1: the header of a shear_flow.csv has a "
                                                          "column energy_drift"));
}

}  // namespace
}  // namespace lucy::files
