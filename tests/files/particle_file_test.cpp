// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// States written and read again, in every format and at every tilt; and what is refused. Independent readers are asked
// in tests/program/read_dump_test.py.
#include "lucy/files/particle_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "files/scratch.hpp"
#include "lucy/errors.hpp"

namespace lucy::files {
namespace {

using ::testing::HasSubstr;
using testing::put;
using testing::ScratchFolder;

constexpr double flow = 0.3;

cases::Frame random_frame(double offset, std::uint64_t seed = 7) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal;
  cases::Frame frame;
  frame.step = 1200;
  frame.time = 60.0;
  frame.offset = offset;
  frame.box = {11.0, 13.0};
  for (int i = 0; i < 40; ++i) {
    for (const double length : frame.box) frame.position.push_back(length * uniform(generator));
    for (int d = 0; d < 2; ++d) frame.momentum.push_back(normal(generator));
  }
  return frame;
}

/// Equal positions but for whole boxes, equal momenta.
void expect_same_state(const cases::Frame& a, const cases::Frame& b) {
  ASSERT_EQ(a.position.size(), b.position.size());
  ASSERT_EQ(a.momentum.size(), b.momentum.size());
  EXPECT_NEAR(a.offset, b.offset, 1e-12);
  for (std::size_t d = 0; d < 2; ++d) EXPECT_NEAR(a.box[d], b.box[d], 1e-12);
  for (std::size_t i = 0; i < a.position.size(); ++i) {
    EXPECT_NEAR(a.position[i], b.position[i], 1e-12) << i;
    EXPECT_NEAR(a.momentum[i], b.momentum[i], 1e-12) << i;
  }
}

class ParticleFile : public ::testing::Test {
 protected:
  ScratchFolder scratch_;

  ParticleReader written(const std::string& text) {
    put(scratch_ / "particles", text);
    return ParticleReader(scratch_ / "particles");
  }
  void expect_refusal(const std::string& text, const std::string& what) {
    put(scratch_ / "particles", text);
    try {
      const ParticleReader reader(scratch_ / "particles");
      reader.state(0);
      FAIL() << "accepted: " << text;
    } catch (const BadInput& refusal) {
      EXPECT_THAT(refusal.what(), HasSubstr(what));
      EXPECT_THAT(refusal.what(), HasSubstr((scratch_ / "particles").string()));
    }
  }
};

constexpr std::array written_formats = {ParticleFormat::lammps_data, ParticleFormat::lammps_dump,
                                        ParticleFormat::extended_xyz};

TEST_F(ParticleFile, ReadsBackWhatItWroteAtEveryTilt) {
  for (const auto format : written_formats)
    for (const double offset : {0.0, 3.3, 5.5, 5.6, 10.9}) {
      SCOPED_TRACE(fmt::format("{} {}", format_name(format), offset));
      const cases::Frame frame = random_frame(offset);
      const auto reader = written(particle_text(format, frame, 0.0, "a title"));
      EXPECT_EQ(reader.format(), format);
      ASSERT_EQ(reader.frames(), 1U);
      expect_same_state(reader.state(0).frame, frame);
    }
}

TEST_F(ParticleFile, TakesOutTheFlowThatWasPutIn) {
  const cases::Frame frame = random_frame(8.0);
  for (const auto format : written_formats) {
    const auto reader = written(particle_text(format, frame, flow, "a title"));
    const bool says_it = format != ParticleFormat::lammps_dump;
    const ParticleState state = says_it ? reader.state(0) : reader.state(0, flow);
    EXPECT_EQ(state.flow, flow);
    expect_same_state(state.frame, frame);
    EXPECT_EQ(reader.state(0).flow, says_it ? flow : 0.0);
    EXPECT_EQ(reader.state(0, 0.1).flow, 0.1);
  }
}

TEST_F(ParticleFile, KeepsParticlesWithinTheCellAndTimesWithTheFrames) {
  std::string text;
  for (const double offset : {1.0, 9.0})
    text += particle_text(ParticleFormat::lammps_dump, random_frame(offset), 0, "");
  const auto reader = written(text);
  ASSERT_EQ(reader.frames(), 2U);
  EXPECT_EQ(reader.state(0).frame.offset, 1.0);
  EXPECT_EQ(reader.state(1).frame.offset, 9.0);
  EXPECT_EQ(reader.state(1).time, 60.0);
  EXPECT_EQ(reader.state(1).frame.step, 1200);
}

TEST_F(ParticleFile, WrapsAParticleThatLeftTheCellWithItsVelocity) {
  // Above the box by 0.5: its image within has slid by the tilt, and its laboratory velocity is lower by flow L_y; the
  // peculiar one is the same.
  const auto reader = written(
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp pp pp\n-1 12 2\n2 12 0\n-0.5 0.5 0\n"
      "ITEM: ATOMS id vx vy x y\n1 4 0.25 5 12.5\n");
  const cases::Frame frame = reader.state(0, 0.3).frame;
  EXPECT_DOUBLE_EQ(frame.box[0], 11.0);
  EXPECT_DOUBLE_EQ(frame.box[1], 10.0);
  EXPECT_DOUBLE_EQ(frame.position[1], 0.5);
  EXPECT_DOUBLE_EQ(frame.position[0], 5.0 + 1.0 - 2.0);
  EXPECT_DOUBLE_EQ(frame.momentum[0], 4.0 - 0.3 * 10.5);
  EXPECT_DOUBLE_EQ(frame.momentum[1], 0.25);
}

TEST_F(ParticleFile, ReadsScaledCoordinatesAndIdsInAnyOrder) {
  const auto reader = written(
      "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS xy xz yz pp pp pp\n0 12 2\n0 10 0\n-0.5 0.5 0\n"
      "ITEM: ATOMS id type xs ys\n2 1 0.5 0.5\n1 1 0.1 0\n");
  const cases::Frame frame = reader.state(0).frame;
  EXPECT_TRUE(frame.momentum.empty());
  EXPECT_DOUBLE_EQ(frame.position[0], 1.0);
  EXPECT_DOUBLE_EQ(frame.position[2], 6.0);
  EXPECT_DOUBLE_EQ(frame.position[3], 5.0);
}

TEST_F(ParticleFile, ReadsWhatWriteDataOfLammpsWrites) {
  const auto reader = written(
      "LAMMPS data file via write_data, version 29 Sep 2021, timestep = 100\n\n2 atoms\n1 atom types\n\n0 10 xlo xhi\n"
      "0 10 ylo yhi\n-0.5 0.5 zlo zhi\n-3 0 0 xy xz yz\n\nMasses\n\n1 1\n\nAtoms # atomic\n\n2 1 9 9 0 0 1 0\n"
      "1 1 1 2 0 0 0 0\n\nVelocities\n\n1 0.5 0 0\n2 -0.5 0 0\n");
  const cases::Frame frame = reader.state(0).frame;
  EXPECT_DOUBLE_EQ(frame.offset, 7.0);
  EXPECT_DOUBLE_EQ(frame.position[2], 9.0);
  EXPECT_DOUBLE_EQ(frame.momentum[0], 0.5);
}

TEST_F(ParticleFile, RefusesInASentenceWithTheLine) {
  const std::string dump =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 10\n0 10\n-0.5 0.5\nITEM: ATOMS id x "
      "y\n";
  expect_refusal("", "none of these");
  expect_refusal(std::string("\0\1", 2), "binary");
  expect_refusal("1 2 3\n4 5 6\n", "none of these");
  expect_refusal(dump + "1 2 3\n", "ends in line 10 where an atom is expected");
  expect_refusal(dump + "1 2 3\n1 2 3\n", ":11: the particle 1 stands there twice");
  expect_refusal(dump + "1 2 3\n3 2 3\n", "ids go from 1 to 2");
  expect_refusal(dump + "1 2 nan\n2 2 3\n", ":10: 'nan' was found");
  expect_refusal(dump + "1 2\n2 2 3\n", "2 words were found where the atoms have 3 columns");
  expect_refusal("t\n\n1 atoms\n\n0 10 xlo xhi\n10 0 ylo yhi\n\nAtoms\n\n1 1 0 0 0\n", "the box ends at 0");
  expect_refusal("t\n\n1 atoms\n0 9 xlo xhi\n0 9 ylo yhi\n\nMasses\n\n1 2\n", "mass one");
  expect_refusal("t\n\n1 atoms\n0 9 xlo xhi\n0 9 ylo yhi\n", "without a section Atoms");
  expect_refusal("t\n\n1 atoms\n0 9 xlo xhi\n0 9 ylo yhi\n1 1 0 xy xz yz\n", "out of the plane");
  expect_refusal("1\nLattice=\"9 0 0 0 9 0 0 0 1\" Properties=species:S:1\nX\n", "no pos");
}

TEST_F(ParticleFile, RefusesWhatItWouldMisread) {
  const auto dump = [](const std::string& bounds, const std::string& columns) {
    return "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS " + bounds +
           "\n0 10\n0 10\n-0.5 0.5\nITEM: ATOMS " + columns + "\n";
  };
  expect_refusal(dump("ff ss pp", "id x y") + "1 2 3\n", ":5: the bounds of the box are of the kind ff ss pp");
  expect_refusal(dump("pp ss pp", "id x y") + "1 2 3\n", "only periodic ones");
  expect_refusal(dump("pp pp pp", "id mass x y") + "1 2.5 2 3\n", ":10: the mass is 2.5");
  EXPECT_EQ(written(dump("pp pp ff", "id mass x y") + "1 1 2 3\n").state(0).frame.position[1], 3.0);

  const std::string head = "1 atoms\n2 atom types\n0 9 xlo xhi\n0 9 ylo yhi\n";
  expect_refusal("t\n" + head + "\nMasses\n\n1 1\n2 3\n", ":10: the mass is 3");
  expect_refusal("t\n" + head + "\nAtoms # charge\n\n1 1 0.5 2 3 0\n", ":7: Atoms are of style charge");
  expect_refusal("t\n" + head + "\nAtoms\n\n1 1 0.5 2 3 0\n", "6 words were found where an entry of Atoms");
  expect_refusal("t\n" + head + "\nAtoms\n\n1 1 2 3 0\n\nVelocities\n\n1 0 0 0 0 0 0\n",
                 "an entry of Velocities has 4");
  expect_refusal("velocities with the flow of strain rate \n" + head, ":1: '' was found where a strain rate");
  expect_refusal("t\n" + head + "\nAtoms\n\n1 1 2 3 0", "ends within line 9");
  const std::string particle = "Properties=pos:R:3:masses:R:1";
  const std::string lattice = "1\nLattice=\"9 0 0 0 9 0 0 0 1\" ";
  expect_refusal(lattice + particle + "\n1 2 0 4\n", ":3: the mass is 4");
  expect_refusal(dump("pp pp pp", "id x y") + "1 1e300 3\n", "particle 1 has the coordinate 1e+300");
  expect_refusal(dump("pp pp pp", "id x y vx vy") + "1 2 3 0 1e200\n", "particle 1 has the velocity 1e+200");
  expect_refusal(lattice + "pbc=\"T F F\" " + particle + "\n1 2 0 1\n", "pbc is 'T F F'");
}

TEST_F(ParticleFile, PassesOverCoefficientsInADataFile) {
  const auto reader = written(
      "LAMMPS data file\n\n1 atoms\n1 atom types\n0 bonds\n\n0 10 xlo xhi\n0 10 ylo yhi\n\nMasses\n\n1 1\n\n"
      "Pair Coeffs # table\n\n1 lucy.table LUCY\n\nPairIJ Coeffs # nm/cut\n\n1 1 0.5 3 -2 -3\n\n"
      "Atoms # atomic\n\n1 1 4 5 0 0 0 0\n\nBond Coeffs\n\n1 1 2\n2 1 2\n\nVelocities\n\n1 0.5 0.25 0\n");
  const cases::Frame frame = reader.state(0).frame;
  EXPECT_EQ(frame.position, (std::vector{4.0, 5.0}));
  EXPECT_EQ(frame.momentum, (std::vector{0.5, 0.25}));
}

TEST_F(ParticleFile, ReadsCompleteFramesOfAFileThatIsStillBeingWritten) {
  for (const auto format : {ParticleFormat::lammps_dump, ParticleFormat::extended_xyz}) {
    const std::string frame = particle_text(format, random_frame(1.0), 0, "");
    for (std::size_t written_of_it = 1; written_of_it < frame.size(); written_of_it += 7) {
      const auto reader = written(frame + frame + frame.substr(0, written_of_it));
      ASSERT_EQ(reader.frames(), 2U) << written_of_it;
      EXPECT_TRUE(reader.has_unfinished_frame());
      EXPECT_EQ(reader.state(1).frame.position.size(), 80U);
      EXPECT_THROW(reader.state(2), BadInput);
    }
    // All but the end of the last line: half of a number is a number, too.
    const auto cut = written(frame + frame.substr(0, frame.size() - 1));
    EXPECT_EQ(cut.frames(), 1U);
    try {
      cut.state(1);
      FAIL();
    } catch (const BadInput& refusal) {
      EXPECT_THAT(refusal.what(), HasSubstr("frame 2 is not finished"));
    }
    expect_refusal(frame.substr(0, frame.size() - 1), "no end of line");
    EXPECT_FALSE(written(frame + "\n").has_unfinished_frame());
  }
}

TEST_F(ParticleFile, KnowsWhetherTheFileTellsItsFlow) {
  for (const auto format : written_formats) {
    const auto of = [&](double rate) { return written(particle_text(format, random_frame(0.0), rate, "")).state(0); };
    EXPECT_EQ(of(0.3).flow_told, format != ParticleFormat::lammps_dump);
    EXPECT_EQ(of(0.0).flow_told, format == ParticleFormat::extended_xyz);
  }
}

TEST_F(ParticleFile, KnowsFormatsByTheNamesOfFiles) {
  EXPECT_EQ(format_of_name("a.data"), ParticleFormat::lammps_data);
  EXPECT_EQ(format_of_name("a.lammpstrj"), ParticleFormat::lammps_dump);
  EXPECT_EQ(format_of_name("b/a.xyz"), ParticleFormat::extended_xyz);
  EXPECT_THROW(format_of_name("a.txt"), BadInput);
}

}  // namespace
}  // namespace lucy::files
