// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/viscosities_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "lucy/errors.hpp"
#include "lucy/files/csv.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using testing::contents;
using ::testing::ElementsAre;
using testing::FullDisk;
using ::testing::HasSubstr;
using testing::message_of;
using testing::ScratchFolder;
using ::testing::SizeIs;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

cases::SideBySide state() {
  cases::SideBySide state;
  state.particles = 1024;
  state.energy_per_particle = 0.5;
  state.routes = {{"nemd", 0.5895, 0.0071, -0.25, "a note, with a comma and a \"quotation\""},
                  {"green-kubo", 0.1 + 0.2, 0.01, nan, ""}};
  state.sweep.resize(4);
  for (std::size_t i = 0; i < state.sweep.size(); ++i) {
    state.sweep[i].strain_rate = 0.01 * static_cast<double>(i + 1);
    state.sweep[i].estimates[cases::quantity("viscosity")] = {0.5, 0.125, 100.0, 99};
  }
  state.fit.viscosity = {0.5895, 0.0071, 3.0, 1};
  state.fit.fit_error = 0.007;
  state.fit.curvature = -93.5;
  state.fit.curvature_error = 12.0;
  state.fit.covariance = -0.0625;
  using enum cases::FitPart;
  state.fit.parts = {fitted, beyond, unstable, no_error};
  return state;
}

TEST(ViscositiesCsv, HasOneLineForEachRoute) {
  const ScratchFolder folder;
  write_viscosities_csv(folder / "viscosities.csv", std::vector{state(), state()});
  const CsvFile file(folder / "viscosities.csv");
  EXPECT_THAT(file.columns(),
              ElementsAre("particles", "energy_per_particle", "route", "viscosity", "viscosity_error", "z", "note"));
  ASSERT_THAT(file.rows(), SizeIs(4));
  EXPECT_THAT(file.rows()[0].cells, ElementsAre("1024", "0.5", "nemd", "0.5895", "0.0071", "-0.25",
                                                "a note, with a comma and a \"quotation\""));
  EXPECT_THAT(file.rows()[3].cells, ElementsAre("1024", "0.5", "green-kubo", "0.30000000000000004", "0.01", "nan", ""));
}

TEST(ViscositiesCsv, SaysOfEachRowOfTheSweepWhetherItWasFitted) {
  const ScratchFolder folder;
  write_sweep_fit_csv(folder / "sweep_fit.csv", std::vector{state()});
  EXPECT_EQ(contents(folder / "sweep_fit.csv"),
            "particles,energy_per_particle,strain_rate,viscosity,viscosity_error,part,eta_0,eta_0_error,eta_2,"
            "eta_2_error,eta_covariance\n"
            "1024,0.5,0.01,0.5,0.125,fitted,0.5895,0.007,-93.5,12,-0.0625\n"
            "1024,0.5,0.02,0.5,0.125,beyond,0.5895,0.007,-93.5,12,-0.0625\n"
            "1024,0.5,0.03,0.5,0.125,unstable,0.5895,0.007,-93.5,12,-0.0625\n"
            "1024,0.5,0.04,0.5,0.125,no-error,0.5895,0.007,-93.5,12,-0.0625\n");
}

TEST(ViscositiesCsv, GivesTheExtrapolatedViscosityWithItsWholeError) {
  const ScratchFolder folder;
  write_nemd_csv(folder / "nemd.csv", std::vector{state()});
  EXPECT_EQ(contents(folder / "nemd.csv"),
            "particles,energy_per_particle,viscosity,viscosity_error\n1024,0.5,0.5895,0.0071\n");
}

TEST(ViscositiesCsv, IsTheOldOneWhenTheDiskIsFull) {
  const ScratchFolder folder;
  write_nemd_csv(folder / "nemd.csv", {});
  const std::string before = contents(folder / "nemd.csv");
  const FullDisk full(8);
  EXPECT_THAT(message_of<RunFailed>([&] { write_nemd_csv(folder / "nemd.csv", std::vector{state()}); }),
              HasSubstr("nemd.csv"));
  EXPECT_EQ(contents(folder / "nemd.csv"), before);
}

}  // namespace
}  // namespace lucy::files
