// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/wave_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch.hpp"
#include "wave_rows.hpp"

namespace lucy::files {
namespace {

using cases::wave_quantity;
using cases::WaveQuantity;
using cases::WaveRow;
using testing::atoms_row;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::unknown_value;
using testing::wave_row;
using testing::widest_line;

TEST(WaveText, SaysWhatAPointIsAndInWhatItDiffers) {
  const WaveRow base = wave_row();
  EXPECT_EQ(wave_label(base.settings), "N = 4096, lucy, h = 3, ideal-gas, kT = 1, eta = 0.3, A = 0.05, disorder 0.3");
  EXPECT_EQ(wave_difference(base.settings, base.settings), "");
  cases::WavePoint other = base.settings;
  other.viscosity = 0.0;
  other.noise = 1e-6;
  other.range = 2.5;
  other.uniform = cases::UniformStart::entropy;
  other.duration = 17.0;  // not physical
  EXPECT_EQ(wave_difference(other, base.settings), "h 2.5, eta 0, noise 0.000001, uniform entropy");
  const WaveRow atoms = atoms_row();
  EXPECT_EQ(wave_label(atoms.settings), "atoms E/N 0.5, N 1024, mode 2, A = 0.1");
  EXPECT_EQ(wave_difference(atoms.settings, base.settings), "atoms E/N 0.5, N 1024, mode 2");
  EXPECT_EQ(wave_difference(base.settings, atoms.settings), wave_label(base.settings));
  EXPECT_EQ(wave_difference(atoms.settings, atoms.settings), "");
}

TEST(WaveText, ShowsTheDecayItsPartsAndThePreferredForm) {
  const std::vector rows = {wave_row(), atoms_row()};
  const std::string text = format_waves(rows);
  EXPECT_THAT(text, HasSubstr("1: N = 4096, lucy, h = 3"));
  EXPECT_THAT(text, HasSubstr("prescribed   by parts  by integral          form  status\n"));
  EXPECT_THAT(text, HasSubstr("1  as stated                             0.3  0.652(12)"));
  EXPECT_THAT(text, HasSubstr("0.98527(21)"));
  EXPECT_THAT(text, HasSubstr("0.00096(19)"));
  EXPECT_THAT(text, HasSubstr("0.000480(95)"));  // over the pressure of 2
  EXPECT_THAT(text, HasSubstr("pressure forces: the rest"));
  EXPECT_THAT(text, HasSubstr("modulus: rho G/(k^2 tau); time: tau.\n"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_THAT(text, Not(HasSubstr("short: ")));
  EXPECT_LE(widest_line(text), 118u);
}

TEST(WaveText, SpeaksOfHeatWhereItIsHeat) {
  std::vector rows = {wave_row(WaveQuantity::temperature)};
  for (const auto quantity : {wave_quantity("yield_stress"), wave_quantity("modulus")})
    rows[0].estimates[quantity] = {unknown_value, unknown_value, unknown_value, 0};
  const std::string text = format_waves(rows);
  EXPECT_THAT(text, HasSubstr("kappa = 0.4"));
  EXPECT_THAT(text, HasSubstr("thermal diffusivities kappa/(rho c_P)"));
  EXPECT_THAT(text, HasSubstr("heating"));
  EXPECT_THAT(text, Not(HasSubstr("yield stress")));
  EXPECT_THAT(text, Not(HasSubstr("differ from it")));
  EXPECT_LE(widest_line(text), 118u);
}

TEST(WaveText, ExplainsWhatIsShortOrFailedAndWarns) {
  std::vector rows = {wave_row(), wave_row(), wave_row()};
  rows[0].status = cases::RowStatus::too_short;
  rows[0].estimates[wave_quantity("total")].error = unknown_value;
  rows[1] = cases::failed_row(rows[1].settings, "replica 2: at time 3, it broke");
  rows[2].settings.viscosity = 0.1;
  rows[2].warnings = {"the wave rings"};
  const std::string text = format_waves(rows);
  EXPECT_THAT(text, HasSubstr("0.6521(nan)"));
  EXPECT_THAT(text, HasSubstr("2  as 1 "));
  EXPECT_THAT(text, HasSubstr("3  eta 0.1"));
  EXPECT_THAT(text, HasSubstr("short: a single replica"));
  EXPECT_THAT(text, HasSubstr("failed: point 2: replica 2: at time 3, it broke\n"));
  EXPECT_THAT(text, HasSubstr("warning: point 3: the wave rings\n"));
  EXPECT_LE(widest_line(text), 118u);
  const std::vector failed = {rows[1]};
  EXPECT_THAT(format_waves(failed), Not(HasSubstr("The parts")));
}

}  // namespace
}  // namespace lucy::files
