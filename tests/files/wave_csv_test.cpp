// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/wave_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "lucy/errors.hpp"
#include "scratch.hpp"
#include "wave_rows.hpp"

namespace lucy::files {
namespace {

using cases::WaveQuantity;
using cases::WaveResult;
using cases::WaveRow;
using testing::atoms_row;
using testing::contents;
using ::testing::HasSubstr;
using testing::message_of;
using testing::put;
using testing::ScratchFolder;
using testing::unknown_value;
using testing::wave_row;

bool same(double a, double b) {
  return std::isnan(a) ? std::isnan(b) : std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

TEST(WaveCsv, HasSettingsThenValuesWithErrorsThenHowTheRunWent) {
  const ScratchFolder folder;
  write_wave_csv(folder / "shear_wave.csv", WaveQuantity::shear, {});
  EXPECT_EQ(contents(folder / "shear_wave.csv"),
            "particles,density,reading,energy_per_particle,kernel,range,equation_of_state,temperature,viscosity,"
            "bulk_viscosity,conductivity,density_mean,disorder,noise,uniform,amplitude,mode,step,equilibration,"
            "duration,replicas,wave_vector,sample_interval,prescribed,imposed_amplitude,parts_until,operator_factor,"
            "operator_factor_error,operator,operator_error,pressure_forces,pressure_forces_error,carried,"
            "carried_error,total,total_error,integral,integral_error,tail_share,tail_share_error,fitted,"
            "fitted_error,yield_stress,yield_stress_error,modulus,modulus_error,relaxation_time,"
            "relaxation_time_error,particle_noise,particle_noise_error,pressure,pressure_error,preferred_form,"
            "preferred_by,worst_energy_error,subdivided_steps,status\n");
  const auto columns = wave_columns(WaveQuantity::temperature);
  EXPECT_THAT(columns, ::testing::Contains("heating_error"));
  EXPECT_THAT(columns, ::testing::Not(::testing::Contains("reading")));
}

TEST(WaveCsv, GivesBackTheSameBits) {
  const ScratchFolder folder;
  std::vector<WaveRow> rows = {wave_row(), wave_row(), atoms_row()};
  rows[1].settings.equation_of_state = spam::EquationOfStateName::van_der_waals;
  rows[1].settings.weight = kernel::WeightName::monaghan;
  rows[1].settings.uniform = cases::UniformStart::entropy;
  rows[1].settings.density_mean = spam::DensityMean::arithmetic;
  rows[1].settings.noise = 1.0 / 3.0;
  rows[1].settings.temperature = 0.1 + 0.2;
  rows[1].preferred = statistics::DecayForm::viscoelastic;
  rows[1].by_likelihood = false;
  rows[1].estimates[3].error = unknown_value;
  rows[1].status = cases::RowStatus::too_short;
  write_wave_csv(folder / "x.csv", WaveQuantity::shear, rows);
  const auto back = read_wave_csv(folder / "x.csv", WaveQuantity::shear);
  ASSERT_EQ(back.size(), 3u);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    EXPECT_TRUE(same_settings(back[r].settings, rows[r].settings)) << r;
    EXPECT_EQ(back[r].settings.replicas, 8);
    EXPECT_EQ(back[r].settings.reading, rows[r].settings.reading);
    EXPECT_EQ(back[r].settings.energy_per_particle, rows[r].settings.energy_per_particle);
    for (std::size_t i = 0; i < rows[r].estimates.size(); ++i) {
      EXPECT_PRED2(same, back[r].estimates[i].value, rows[r].estimates[i].value);
      EXPECT_PRED2(same, back[r].estimates[i].error, rows[r].estimates[i].error);
    }
    EXPECT_PRED2(same, back[r].prescribed, rows[r].prescribed);
    EXPECT_PRED2(same, back[r].wave_vector, rows[r].wave_vector);
    EXPECT_PRED2(same, back[r].parts_until, rows[r].parts_until);
    EXPECT_PRED2(same, back[r].worst_energy_error, rows[r].worst_energy_error);
    EXPECT_EQ(back[r].preferred, rows[r].preferred);
    EXPECT_EQ(back[r].by_likelihood, rows[r].by_likelihood);
    EXPECT_EQ(back[r].subdivided_steps, 12);
    EXPECT_EQ(back[r].status, rows[r].status);
  }
  EXPECT_FALSE(same_settings(back[0].settings, back[1].settings));
  write_wave_csv(folder / "y.csv", WaveQuantity::shear, back);
  EXPECT_EQ(contents(folder / "y.csv"), contents(folder / "x.csv"));
}

TEST(WaveCsv, WhatIsOfFluidsIsNotSaidOfAtoms) {
  const ScratchFolder folder;
  const std::vector rows = {atoms_row()};
  write_wave_csv(folder / "x.csv", WaveQuantity::shear, rows);
  EXPECT_THAT(contents(folder / "x.csv"),
              HasSubstr("\n1024,1,md,0.5,lucy,3,none,nan,nan,nan,nan,none,nan,nan,none,0.1,2,"));
}

TEST(WaveCsv, IsRefusedWhereItIsDamaged) {
  const ScratchFolder folder;
  const std::vector rows = {wave_row()};
  write_wave_csv(folder / "x.csv", WaveQuantity::shear, rows);
  const auto refusal = [&](const std::string& from, const std::string& to) {
    std::string text = contents(folder / "x.csv");
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    put(folder / "y.csv", text.replace(at, from.size(), to));
    return message_of<BadInput>([&] { read_wave_csv(folder / "y.csv", WaveQuantity::shear); });
  };
  EXPECT_THAT(refusal(",lucy,", ",lucky,"), HasSubstr("y.csv:2: kernel is \"lucky\" where one of lucy, monaghan"));
  EXPECT_THAT(refusal(",yielding,", ",bending,"), HasSubstr("preferred_form is \"bending\" where one of exponential"));
  EXPECT_THAT(refusal("carried_error", "hidden"), HasSubstr("carried_error"));
  EXPECT_THAT(message_of<BadInput>([&] { read_wave_csv(folder / "x.csv", WaveQuantity::temperature); }),
              HasSubstr("the header of a temperature_wave.csv has a column heating"));
}

TEST(WaveCsv, WritesWindowsFormsAndCurvesByPoint) {
  const ScratchFolder folder;
  WaveResult result;
  result.row = wave_row();
  result.local = {{0.0, 48.0, {0.045, 0.001, 8, 7}, {0.0044, 0.0001, 8, 7}, {0.45, 0.02, 8, 7}, {0.0007, 1e-5, 8, 7}}};
  cases::WaveForm form;
  form.form = statistics::DecayForm::yielding;
  form.preferred = true;
  form.diffusivity = {0.3, 0.05, 8, 7};
  form.yield_stress = {0.001, 0.0002, 8, 7};
  form.modulus = {unknown_value, unknown_value, unknown_value, 0};
  result.forms = {form};
  result.curve.time = {0.0, 2.0};
  result.curve.mean = {0.05, 0.04};
  result.curve.error = {0.0, 0.001};
  result.curve.fit = {0.051, 0.041};
  result.curve.particle_noise = {0.0, 0.001};
  result.curve.parts = {{{-0.1, -0.2}, {-0.01, -0.02}, {0.0, 0.5}}};
  const std::vector results = {WaveResult{}, result};
  write_local_csv(folder / "local.csv", results);
  EXPECT_EQ(contents(folder / "local.csv"),
            "point,begin,end,amplitude,amplitude_error,gradient,gradient_error,diffusivity,diffusivity_error,"
            "particle_noise,particle_noise_error\n"
            "2,0,48,0.045,0.001,0.0044,0.0001,0.45,0.02,0.0007,1e-05\n");
  write_forms_csv(folder / "forms.csv", results);
  EXPECT_THAT(contents(folder / "forms.csv"), HasSubstr("\n2,yielding,yes,0,0,0.3,0.05,0.001,0.0002,"));
  EXPECT_THAT(contents(folder / "forms.csv"), HasSubstr(",nan,nan,0,0,0,0\n"));
  write_amplitude_csv(folder / "amplitude.csv", WaveQuantity::shear, results);
  EXPECT_EQ(contents(folder / "amplitude.csv"),
            "point,time,amplitude,amplitude_error,fit,particle_noise,operator,pressure_forces,carried\n"
            "2,0,0.05,0,0.051,0,-0.1,-0.01,0\n"
            "2,2,0.04,0.001,0.041,0.001,-0.2,-0.02,0.5\n");
}

}  // namespace
}  // namespace lucy::files
