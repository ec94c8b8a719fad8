// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/progress.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lucy::program {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

RunState halfway() {
  RunState state;
  state.points = 5;
  state.points_done = 2;
  state.fraction = 0.415;
  state.seconds_left = 92.3;
  state.label = "N = 1024, E/N = 1, rate 0.1";
  state.estimate = {2.6612, 0.0314, 50.0, 40};
  return state;
}

TEST(StatusLine, SaysEverythingWhereThereIsRoom) {
  EXPECT_EQ(status_line(halfway(), 65.9, 160),
            "[########------------]   41 %  2/5 points  N = 1024, E/N = 1, rate 0.1: viscosity 2.661(31)  1 min 05 s, "
            "1 min 33 s left");
}

TEST(StatusLine, LeavesOutWhatIsNotKnown) {
  auto state = halfway();
  state.estimate = {unknown, unknown, unknown, 0};
  state.seconds_left = unknown;
  EXPECT_EQ(status_line(state, 3.0, 160),
            "[########------------]   41 %  2/5 points  N = 1024, E/N = 1, rate 0.1  3 s");
  state.label.clear();
  EXPECT_EQ(status_line(state, 3.0, 160), "[########------------]   41 %  2/5 points  3 s");
}

TEST(StatusLine, ShowsNoEstimateBeforeThereIsOne) {
  auto state = halfway();
  for (const statistics::Estimate& none : {statistics::Estimate{}, statistics::Estimate{2.66, unknown, unknown, 0},
                                           statistics::Estimate{2.66, 0.0, 0, 0}}) {
    state.estimate = none;
    EXPECT_EQ(status_line(state, 65.9, 160).find("viscosity"), std::string::npos) << status_line(state, 65.9, 160);
  }
}

TEST(StatusLine, ShowsAnEstimateOnlyWithItsPoint) {
  EXPECT_EQ(status_line(halfway(), 65.9, 80),
            " 41 %  N = 1024, E/N = 1, rate 0.1: viscosity 2.661(31)  1 min 33 s left");
  for (int width = 1; width < 160; ++width) {
    const std::string line = status_line(halfway(), 65.9, width);
    if (line.find("viscosity") != std::string::npos) {
      EXPECT_NE(line.find("N = 1024, E/N = 1, rate 0.1: "), std::string::npos) << line;
    }
  }
}

TEST(StatusLine, NeverReachesTheEdgeOfTheTerminal) {
  for (int width = 1; width < 160; ++width)
    EXPECT_LT(static_cast<int>(status_line(halfway(), 65.0, width).size()), width) << width;
}

TEST(StatusLine, IsFullAtTheEnd) {
  auto state = halfway();
  state.fraction = 1.0;
  EXPECT_TRUE(status_line(state, 65.0, 160).starts_with("[####################]  100 %"));
}

}  // namespace
}  // namespace lucy::program
