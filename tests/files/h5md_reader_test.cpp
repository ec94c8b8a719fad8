// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/h5md_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <limits>

#include "lucy/errors.hpp"
#include "lucy/files/h5md.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::message_of;
using testing::ScratchFolder;

constexpr int particles = 5;

/// Positions within a box of 4 x 3, the later frames with another offset.
cases::Frame frame(int number, bool fluid) {
  cases::Frame result;
  result.step = 40 * number;
  result.time = 2.0 * number;
  result.offset = 0.75 * number;
  result.box = {4.0, 3.0};
  for (int i = 0; i < particles; ++i) {
    result.position.insert(result.position.end(), {0.7 * i + 0.01 * number, 0.5 * i + 0.25});
    result.momentum.insert(result.momentum.end(), {-0.5 * i, 0.1 * number});
    if (fluid) result.internal_energy.push_back(1.0 + 0.125 * i);
  }
  return result;
}

class H5mdReaderTest : public ::testing::Test {
 protected:
  /// A Couette point whose replicas 1 and 3 have three frames.
  void write(bool fluid = false, bool with_frames = true) const {
    cases::CouettePoint point;
    point.particles = particles;
    point.strain_rate = 0.5;
    point.range = 2.5;
    point.duration = 10.0;
    std::filesystem::remove(folder_ / "frames.bin");
    FrameSpool spool(folder_ / "frames.bin", particles, fluid);
    for (int i = 0; i < 3; ++i) spool.append(frame(i, fluid));
    const cases::CouetteRecord record;
    std::vector<H5mdReplica> replicas;
    for (const int replica : {0, 1, 2})
      replicas.push_back({.replica = replica,
                          .record = &record,
                          .equilibration_intervals = 0,
                          .frames = with_frames && replica != 1 ? &spool : nullptr});
    write_h5md(path_, point, replicas, {});
  }

  /// Changes the file by hand.
  template <class Change>
  void change(const Change& what) const {
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    what(file);
    H5Fclose(file);
  }
  static void remove(hid_t file, const char* name) { ASSERT_GE(H5Ldelete(file, name, H5P_DEFAULT), 0) << name; }

  std::string refusal(int replica = 1) const {
    return message_of<BadInput>([&] { H5mdReader reader(path_, replica); });
  }

  ScratchFolder folder_;
  std::filesystem::path path_ = folder_ / "point_001.h5";
};

TEST_F(H5mdReaderTest, GivesBackWhatWasWritten) {
  for (const bool fluid : {false, true}) {
    write(fluid);
    for (const int replica : {1, 3}) {
      const H5mdReader reader(path_, replica);
      EXPECT_EQ(reader.particles(), particles);
      EXPECT_EQ(reader.has_internal_energies(), fluid);
      EXPECT_THAT(reader.times(), ElementsAre(0.0, 2.0, 4.0));
      for (int i = 0; i < 3; ++i) {
        const cases::Frame expected = frame(i, fluid);
        const cases::Frame found = reader.frame(static_cast<std::size_t>(i));
        EXPECT_EQ(found.step, expected.step);
        EXPECT_EQ(found.time, expected.time);
        EXPECT_EQ(found.offset, expected.offset);
        EXPECT_EQ(found.box, expected.box);
        EXPECT_EQ(found.position, expected.position);
        EXPECT_EQ(found.momentum, expected.momentum);
        EXPECT_EQ(found.internal_energy, expected.internal_energy);
      }
    }
  }
}

TEST_F(H5mdReaderTest, KnowsTheParametersByName) {
  write();
  const H5mdReader reader(path_, 1);
  EXPECT_EQ(reader.number("strain_rate"), 0.5);
  EXPECT_EQ(reader.number("range"), 2.5);
  EXPECT_EQ(reader.number("particles"), 5.0);
  EXPECT_EQ(reader.word("kernel"), "lucy");
  EXPECT_EQ(reader.number("equation_of_state"), std::nullopt);
  EXPECT_EQ(reader.word("equation_of_state"), std::nullopt);
  EXPECT_THAT(message_of<BadInput>([&] { (void)reader.number("kernel"); }), HasSubstr("kernel is not a number"));
  EXPECT_THAT(message_of<BadInput>([&] { (void)reader.word("range"); }), HasSubstr("range is not a word"));
}

TEST_F(H5mdReaderTest, SeveralReadersMayBeOpen) {
  write();
  H5mdReader one(path_, 1);
  const H5mdReader other(path_, 3);
  const H5mdReader moved = std::move(one);
  EXPECT_EQ(moved.frame(2).position, other.frame(2).position);
}

TEST_F(H5mdReaderTest, RefusesAFrameThatIsNotThere) {
  write();
  const H5mdReader reader(path_, 3);
  const std::string message = message_of<BadInput>([&] { (void)reader.frame(3); });
  EXPECT_THAT(message, HasSubstr("point_001.h5 has no frame 4 of replica 3: it has frames 1 to 3"));
}

TEST_F(H5mdReaderTest, RefusesWhatIsNoPointFile) {
  EXPECT_THAT(refusal(), HasSubstr("point_001.h5: there is no such file"));
  testing::put(path_, "a text");
  EXPECT_THAT(refusal(), HasSubstr("point_001.h5 is not an HDF5 file"));
  testing::put(path_, "");
  EXPECT_THAT(refusal(), HasSubstr("is not an HDF5 file"));
  EXPECT_THAT(message_of<BadInput>([&] { H5mdReader reader(folder_.path(), 1); }), HasSubstr("a directory"));

  write();
  const std::string whole = testing::contents(path_);
  testing::put(path_, whole.substr(0, whole.size() / 2));
  EXPECT_THAT(refusal(), HasSubstr("cannot read"));

  const hid_t file = H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(file);
  EXPECT_THAT(refusal(), HasSubstr("no point file of Lucy (H5MD)"));
}

TEST_F(H5mdReaderTest, RefusesAFileWithoutFrames) {
  write(false, false);
  EXPECT_THAT(refusal(), HasSubstr("was written without output.frame_interval"));
  write();
  EXPECT_THAT(refusal(2), HasSubstr("no frames of replica 2 (frames of: replica_01, replica_03)"));
  EXPECT_THAT(refusal(99), HasSubstr("no frames of replica 99"));
}

TEST_F(H5mdReaderTest, RefusesFramesThatLucyDidNotWrite) {
  write();
  change([](hid_t file) { remove(file, "/particles/replica_01/momentum"); });
  EXPECT_THAT(refusal(), HasSubstr("its replica_01 has no momentum"));
  write();
  change([](hid_t file) { remove(file, "/particles/replica_01/box/edges"); });
  EXPECT_THAT(refusal(), HasSubstr("cannot read"));
  write();
  change([](hid_t file) {  // the momenta of another kind
    remove(file, "/particles/replica_01/momentum/value");
    ASSERT_GE(H5Lcreate_hard(file, "/particles/replica_01/lees_edwards/offset/value", file,
                             "/particles/replica_01/momentum/value", H5P_DEFAULT, H5P_DEFAULT),
              0);
  });
  EXPECT_THAT(refusal(), HasSubstr("momentum of replica_01 has not the shape (3, 5, 2)"));
}

TEST_F(H5mdReaderTest, RefusesNumbersThatAreNone) {
  for (const double value : {std::numeric_limits<double>::infinity(), 9.879999999999999e+300}) {
    write();
    change([value](hid_t file) {
      const hid_t dataset = H5Dopen2(file, "/particles/replica_01/position/value", H5P_DEFAULT);
      std::vector<double> values(3 * particles * 2, 0.5);
      values[13] = value;
      H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      H5Dclose(dataset);
    });
    const H5mdReader reader(path_, 1);
    EXPECT_NO_THROW((void)reader.frame(0));
    EXPECT_THAT(message_of<BadInput>([&] { (void)reader.frame(1); }), HasSubstr("frame 2 of replica 1"));
  }
}

TEST_F(H5mdReaderTest, WrapsPositionsIntoTheBox) {
  write();
  change([](hid_t file) {
    const hid_t dataset = H5Dopen2(file, "/particles/replica_01/position/value", H5P_DEFAULT);
    std::vector<double> values(3 * particles * 2, 0.5);
    values[10] = 1.0;  // frame 2, particle 1: one box up, the images there displaced by 0.75
    values[11] = 4.0;
    H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(dataset);
  });
  const auto position = H5mdReader(path_, 1).frame(1).position;
  EXPECT_EQ(position[0], 0.25);
  EXPECT_EQ(position[1], 1.0);
}

}  // namespace
}  // namespace lucy::files
