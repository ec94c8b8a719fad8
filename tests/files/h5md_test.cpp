// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Written files are read again twice: with the C library here, and with h5py in h5md_check.py.
#include "lucy/files/h5md.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <cstdlib>

#include "lucy/errors.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using testing::contents;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::message_of;
using testing::ScratchFolder;
using ::testing::SizeIs;

cases::CouettePoint point() {
  cases::CouettePoint result;
  result.particles = 4;
  result.energy_per_particle = 1.0;
  result.strain_rate = 0.5;
  result.step = 0.05;
  result.duration = 40.0;
  result.sample_interval = 0.5;
  return result;
}

cases::CouetteRecord record(std::size_t samples) {
  cases::CouetteRecord result;
  result.sample_interval = 0.5;
  result.samples.resize(samples);
  for (std::size_t i = 0; i < samples; ++i)
    for (std::size_t k = 0; k < result.samples[i].size(); ++k)
      result.samples[i][k] = static_cast<double>(i) + 0.01 * static_cast<double>(k);
  result.worst_energy_error = 1e-9;
  result.steps = 1234;
  return result;
}

cases::Frame frame(int number) {
  cases::Frame result;
  result.step = 20 * number;
  result.time = number;
  result.offset = 0.25 * number;
  result.box = {2.0, 2.0};
  for (int i = 0; i < 8; ++i) {
    result.position.push_back(0.125 * i + 0.01 * number);
    result.momentum.push_back(-0.5 * i - 0.01 * number);
  }
  return result;
}

void expect_equal(const cases::Frame& a, const cases::Frame& b) {
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.offset, b.offset);
  EXPECT_EQ(a.box, b.box);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.momentum, b.momentum);
  EXPECT_EQ(a.internal_energy, b.internal_energy);
}

cases::Frame fluid_frame(int number) {
  cases::Frame result = frame(number);
  for (int i = 0; i < 4; ++i) result.internal_energy.push_back(1.5 + 0.25 * i + 0.01 * number);
  return result;
}

TEST(FrameSpool, GivesBackWhatWasAppended) {
  const ScratchFolder folder;
  {
    FrameSpool spool(folder / "frames.bin", 4);
    EXPECT_EQ(spool.count(), 0);
    for (int i = 0; i < 5; ++i) spool.append(frame(i));
    spool.synchronise();
  }
  const FrameSpool again(folder / "frames.bin", 4);
  EXPECT_EQ(again.count(), 5);
  const auto frames = again.read_all();
  ASSERT_THAT(frames, SizeIs(5));
  for (int i = 0; i < 5; ++i) expect_equal(frames[static_cast<std::size_t>(i)], frame(i));
}

TEST(FrameSpool, ContinuesFromTheFramesThatTheCheckpointKnowsOf) {
  const ScratchFolder folder;
  {
    FrameSpool spool(folder / "frames.bin", 4);
    for (int i = 0; i < 5; ++i) spool.append(frame(i));
  }
  std::ofstream(folder / "frames.bin", std::ios::app) << "half a record";
  FrameSpool spool(folder / "frames.bin", 4);
  EXPECT_EQ(spool.count(), 5);
  spool.truncate(3);
  spool.append(frame(7));
  ASSERT_EQ(spool.count(), 4);
  expect_equal(spool.read(2), frame(2));
  expect_equal(spool.read(3), frame(7));
  EXPECT_EQ(std::filesystem::file_size(folder / "frames.bin"), 4u * 8u * (5 + 4 * 4 + 1));
  EXPECT_THAT(message_of<RunFailed>([&] { spool.truncate(5); }), HasSubstr("holds 4 frames"));
  EXPECT_THAT(message_of<RunFailed>([&] { spool.read(4); }), HasSubstr("no frame 4"));
}

TEST(FrameSpool, RefusesDamagedFramesThatItIsToKeep) {
  const ScratchFolder folder;
  {
    FrameSpool spool(folder / "frames.bin", 4);
    for (int i = 0; i < 3; ++i) spool.append(frame(i));
  }
  {
    std::fstream file(folder / "frames.bin", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(8 * (5 + 4 * 4 + 1) + 60);
    file << "12345678";
  }
  FrameSpool spool(folder / "frames.bin", 4);
  EXPECT_THAT(message_of<RunFailed>([&] { spool.read(1); }), HasSubstr("frames.bin is damaged"));
  EXPECT_THROW(spool.read_all(), RunFailed);
  EXPECT_THAT(message_of<RunFailed>([&] { spool.truncate(2); }), HasSubstr("frame 2 in"));
  EXPECT_EQ(spool.count(), 3);
  spool.truncate(1);  // what goes may be damaged
  spool.append(frame(7));
  expect_equal(spool.read(0), frame(0));
  expect_equal(spool.read(1), frame(7));
}

TEST(FrameSpool, KeepsWholeRecordsOnAFullDisk) {
  const ScratchFolder folder;
  FrameSpool spool(folder / "frames.bin", 4);
  spool.append(frame(0));
  {
    const testing::FullDisk full(200);
    EXPECT_THAT(message_of<RunFailed>([&] { spool.append(frame(1)); }), HasSubstr("frames.bin: File too large"));
  }
  EXPECT_EQ(spool.count(), 1);
  spool.append(frame(2));
  expect_equal(spool.read(1), frame(2));
}

TEST(FrameSpool, RefusesAFrameOfAnotherSize) {
  const ScratchFolder folder;
  FrameSpool spool(folder / "frames.bin", 5);
  EXPECT_THROW(spool.append(frame(0)), RunFailed);
}

TEST(FrameSpool, KeepsInternalEnergiesWhereThereAreAny) {
  const ScratchFolder folder;
  {
    FrameSpool spool(folder / "frames.bin", 4, true);
    for (int i = 0; i < 3; ++i) spool.append(fluid_frame(i));
    EXPECT_THAT(message_of<RunFailed>([&] { spool.append(frame(3)); }), HasSubstr("0 internal energies"));
    EXPECT_EQ(spool.count(), 3);
  }
  EXPECT_EQ(std::filesystem::file_size(folder / "frames.bin"), 3u * 8u * (5 + 5 * 4 + 1));
  FrameSpool again(folder / "frames.bin", 4, true);
  EXPECT_TRUE(again.internal_energies());
  expect_equal(again.read(2), fluid_frame(2));
  const FrameSpool moved = std::move(again);
  expect_equal(moved.read(1), fluid_frame(1));

  FrameSpool atoms(folder / "atoms.bin", 4);
  EXPECT_THAT(message_of<RunFailed>([&] { atoms.append(fluid_frame(0)); }), HasSubstr("4 internal energies"));
}

std::vector<double> read_numbers(hid_t file, const char* path) {
  const hid_t dataset = H5Dopen2(file, path, H5P_DEFAULT);
  if (dataset < 0) return {};
  const hid_t space = H5Dget_space(dataset);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(space);
  H5Dclose(dataset);
  return values;
}

std::string read_text_attribute(hid_t file, const char* path, const char* name) {
  const hid_t attribute = H5Aopen_by_name(file, path, name, H5P_DEFAULT, H5P_DEFAULT);
  if (attribute < 0) return {};
  const hid_t type = H5Aget_type(attribute);
  std::string text(H5Tget_size(type), '\0');
  H5Aread(attribute, type, text.data());
  H5Tclose(type);
  H5Aclose(attribute);
  return text;
}

haddr_t address_of(hid_t file, const char* path) {
  H5O_info_t information{};
  return H5Oget_info_by_name(file, path, &information, H5P_DEFAULT) < 0 ? HADDR_UNDEF : information.addr;
}

class H5mdTest : public ::testing::Test {
 protected:
  H5mdTest() {
    for (int i = 0; i < 3; ++i) spool_.append(frame(i));
  }
  void write(const std::filesystem::path& path) const {
    const std::vector<H5mdReplica> replicas = {
        {.replica = 0, .record = &first_, .equilibration_intervals = 40, .frames = &spool_},
        {.replica = 1, .record = &second_, .equilibration_intervals = 40, .frames = nullptr}};
    write_h5md(path, point(), replicas, {.author = "somebody", .creator = "lucy", .creator_version = "1.2.3"});
  }

  ScratchFolder folder_;
  cases::CouetteRecord first_ = record(80);
  cases::CouetteRecord second_ = record(70);
  FrameSpool spool_{folder_ / "frames_001_01.bin", 4};
  std::filesystem::path path_ = folder_ / "point_001.h5";
};

TEST_F(H5mdTest, IsReadBackByTheLibrary) {
  write(path_);
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const auto values = read_numbers(file, "/observables/replica_01/pxy_kinetic/value");
  const auto steps = read_numbers(file, "/observables/replica_01/pxy_kinetic/step");
  const auto times = read_numbers(file, "/observables/replica_01/pxy_kinetic/time");
  ASSERT_THAT(values, SizeIs(80));
  EXPECT_EQ(values[3], first_.samples[3][2]);
  EXPECT_EQ(steps[0], 41 * 10);
  EXPECT_EQ(steps[79], 120 * 10);
  EXPECT_DOUBLE_EQ(times[79], 60.0);
  EXPECT_EQ(read_text_attribute(file, "/observables/replica_01", "description"),
            "each value is the average over the steps that end at its step and time");
  EXPECT_EQ(H5Aexists_by_name(file, "/observables/replica_01/pxy_kinetic", "averaged_over_steps", H5P_DEFAULT), 1);
  EXPECT_THAT(read_numbers(file, "/observables/replica_02/pyy_potential/value"), SizeIs(70));
  EXPECT_EQ(read_numbers(file, "/particles/replica_01/position/value")[8], frame(1).position[0]);

  const haddr_t step = address_of(file, "/particles/replica_01/position/step");
  ASSERT_NE(step, HADDR_UNDEF);
  for (const char* element :
       {"velocity", "momentum", "box/edges", "lees_edwards/offset", "lees_edwards/direction", "lees_edwards/normal"})
    EXPECT_EQ(address_of(file, ("/particles/replica_01/" + std::string(element) + "/step").c_str()), step) << element;
  EXPECT_EQ(address_of(file, "/observables/replica_01/potential_energy/time"),
            address_of(file, "/observables/replica_01/largest_kinetic_share/time"));
  EXPECT_EQ(H5Lexists(file, "/particles/replica_02", H5P_DEFAULT), 0);
  H5Fclose(file);
}

TEST_F(H5mdTest, InternalEnergiesStandBesideTheMomenta) {
  FrameSpool spool(folder_ / "fluid.bin", 4, true);
  for (int i = 0; i < 2; ++i) spool.append(fluid_frame(i));
  const std::vector<H5mdReplica> replicas = {{.replica = 0, .record = &first_, .frames = &spool}};
  write_h5md(path_, point(), replicas, {});
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  EXPECT_THAT(read_numbers(file, "/particles/replica_01/internal_energy/value"),
              ElementsAre(1.5, 1.75, 2.0, 2.25, 1.51, 1.76, 2.01, 2.26));
  EXPECT_EQ(address_of(file, "/particles/replica_01/internal_energy/step"),
            address_of(file, "/particles/replica_01/position/step"));
  H5Fclose(file);
}

TEST_F(H5mdTest, IsReadBackByH5py) {
  if (std::system("/usr/bin/python3 -c 'import h5py' 2> /dev/null") != 0)
    GTEST_SKIP() << "/usr/bin/python3 has no h5py";
  write(path_);
  const std::string command =
      "/usr/bin/python3 '" LUCY_SOURCE_DIRECTORY "/tests/files/h5md_check.py' '" + path_.string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(H5mdTest, TheSameContentsGiveTheSameBytes) {
  write(path_);
  const std::string before = contents(path_);
  ::sleep(1);  // time stamps of the library count seconds
  write(path_);
  EXPECT_EQ(contents(path_), before);
  EXPECT_LT(before.size(), 100000u);
}

TEST_F(H5mdTest, WithoutSamplesOrFramesIsStillAFile) {
  const cases::CouetteRecord empty;
  const std::vector<H5mdReplica> replicas = {{.replica = 0, .record = &empty}};
  write_h5md(path_, point(), replicas, {});
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  EXPECT_THAT(read_numbers(file, "/observables/replica_01/pxy_kinetic/value"), SizeIs(0));
  EXPECT_EQ(H5Lexists(file, "/particles", H5P_DEFAULT), 0);
  H5Fclose(file);
}

TEST_F(H5mdTest, AFullDiskKeepsTheOldFileAndTheProgram) {
  write(path_);
  const std::string before = contents(path_);
  for (const rlim_t limit : {10u, 1000u, 10000u}) {
    const testing::FullDisk full(limit);
    const std::string message = message_of<RunFailed>([&] { write(path_); });
    EXPECT_THAT(message, HasSubstr("point_001.h5: File too large"));
  }
  EXPECT_EQ(contents(path_), before);
  EXPECT_FALSE(std::filesystem::exists(folder_ / ".point_001.h5.tmp"));
  write(path_);
  EXPECT_EQ(contents(path_), before);
}

/// Samples and, if asked for, the stress series of a Green-Kubo state with six steps per interval and two per sample.
class GreenKuboH5mdTest : public ::testing::Test {
 protected:
  GreenKuboH5mdTest() {
    point_.particles = 64;
    point_.energy_per_particle = 1.0;
    point_.step = 0.1;
    point_.sample_interval = 0.2;
    point_.frame_interval = 0.6;
    point_.duration = 100.0;
    for (int i = 0; i < 5; ++i) record_.samples.push_back({1.0 * i, 10.0 + i, 20.0 + i, 30.0 + i});
    for (int i = 0; i < 15; ++i) series_.push_back({0.5 * i, 1.0, 2.0, 3.0, 4.0, 5.0 + i});
    record_.energy_drift = -1e-9;
    record_.steps = 90;
  }
  void write(std::span<const cases::StressSample> series) const {
    const std::vector<H5mdGreenKuboReplica> replicas = {
        {.replica = 0, .record = &record_, .series = series, .first_recorded_step = 60}};
    write_h5md(path_, point_, replicas, {});
  }

  ScratchFolder folder_;
  std::filesystem::path path_ = folder_ / "point_001.h5";
  cases::GreenKuboPoint point_;
  cases::GreenKuboRecord record_;
  std::vector<cases::StressSample> series_;
};

TEST_F(GreenKuboH5mdTest, HoldsTheSamplesAndTheSeriesWithStepsOfItsOwn) {
  ASSERT_EQ(cases::interval_steps(point_), 6);
  write(series_);
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  EXPECT_THAT(read_numbers(file, "/observables/replica_01/pressure_kinetic/value"), ElementsAre(10, 11, 12, 13, 14));
  EXPECT_THAT(read_numbers(file, "/observables/replica_01/potential_energy/step"), ElementsAre(66, 72, 78, 84, 90));
  EXPECT_THAT(read_numbers(file, "/observables/replica_01/stress/pyy_potential/value"), SizeIs(15));
  EXPECT_EQ(read_numbers(file, "/observables/replica_01/stress/pyy_potential/value")[14], 19.0);
  EXPECT_EQ(read_numbers(file, "/observables/replica_01/stress/pxy_kinetic/value")[3], 1.5);
  const auto steps = read_numbers(file, "/observables/replica_01/stress/pxy_kinetic/step");
  const auto times = read_numbers(file, "/observables/replica_01/stress/pxy_kinetic/time");
  EXPECT_EQ(steps[0], 62);
  EXPECT_EQ(steps[14], 90);
  EXPECT_DOUBLE_EQ(times[14], 9.0);
  EXPECT_EQ(address_of(file, "/observables/replica_01/stress/pxy_kinetic/step"),
            address_of(file, "/observables/replica_01/stress/pyy_kinetic/step"));
  EXPECT_EQ(H5Aexists_by_name(file, "/parameters", "preparation", H5P_DEFAULT), 1);
  EXPECT_EQ(H5Aexists_by_name(file, "/observables/replica_01", "energy_drift", H5P_DEFAULT), 1);
  EXPECT_EQ(H5Lexists(file, "/particles", H5P_DEFAULT), 0);
  H5Fclose(file);
}

TEST_F(GreenKuboH5mdTest, SaysThatItsValuesAreNoAverages) {
  write(series_);
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  for (const char* group : {"/observables/replica_01", "/observables/replica_01/stress"})
    EXPECT_EQ(read_text_attribute(file, group, "description"), "each value is that of its step and time");
  for (const char* element : {"/observables/replica_01/pressure_kinetic", "/observables/replica_01/stress/pxy_kinetic"})
    EXPECT_EQ(H5Aexists_by_name(file, element, "averaged_over_steps", H5P_DEFAULT), 0) << element;
  H5Fclose(file);
}

TEST_F(GreenKuboH5mdTest, WithoutASeriesThereIsNoStressGroup) {
  write({});
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  EXPECT_EQ(H5Lexists(file, "/observables/replica_01/stress", H5P_DEFAULT), 0);
  EXPECT_THAT(read_numbers(file, "/observables/replica_01/kinetic_temperature/value"), SizeIs(5));
  H5Fclose(file);
}

}  // namespace
}  // namespace lucy::files
