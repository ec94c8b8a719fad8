// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of sheared fluids as h5md_reader.hpp reads them. The layout itself is tested in h5md_test.cpp.
#include "lucy/files/shear_flow_h5md.hpp"

#include <gtest/gtest.h>

#include "lucy/files/h5md_reader.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using testing::contents;
using testing::ScratchFolder;

cases::ShearFlowPoint point() {
  cases::ShearFlowPoint p;
  p.particles = 64;
  p.equation_of_state = spam::EquationOfStateName::van_der_waals;
  p.weight = kernel::WeightName::monaghan;
  p.viscosity = 0.5;
  p.strain_rate = 0.25;
  p.duration = 4.0;
  p.frame_interval = 2.0;
  return p;
}

TEST(ShearFlowH5md, HoldsTheSettingsAndFramesWithInternalEnergies) {
  const ScratchFolder folder;
  const cases::ShearFlowPoint p = point();
  cases::ShearFlowRun run(p, 0);
  FrameSpool frames(folder / "frames", p.particles, true);
  frames.append(run.frame());
  while (run.intervals_done() < cases::interval_count(p)) {
    run.advance_one_interval();
    if (run.frame_due()) frames.append(run.frame());
  }
  const H5mdShearFlowReplica replica = {0, &run.record(), &frames};
  for (const char* name : {"one.h5", "other.h5"})
    write_h5md(folder / name, p, std::span(&replica, 1), {"somebody", "lucy", "1.2.3"});
  EXPECT_EQ(contents(folder / "one.h5"), contents(folder / "other.h5"));

  const H5mdReader reader(folder / "one.h5", 1);
  EXPECT_EQ(reader.word("equation_of_state"), "van-der-waals");
  EXPECT_EQ(reader.word("kernel"), "monaghan");
  EXPECT_EQ(reader.word("cooling"), "isoenergetic");
  EXPECT_EQ(reader.number("strain_rate"), 0.25);
  EXPECT_EQ(reader.number("viscosity"), 0.5);
  EXPECT_TRUE(reader.has_internal_energies());
  EXPECT_EQ(reader.times(), (std::vector{0.0, 2.0, 4.0}));
  const cases::Frame last = reader.frame(2);
  EXPECT_EQ(last.position, run.frame().position);
  EXPECT_EQ(last.momentum, run.frame().momentum);
  EXPECT_EQ(last.internal_energy, run.frame().internal_energy);
}

}  // namespace
}  // namespace lucy::files
