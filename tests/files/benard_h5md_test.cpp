// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of convecting fluids: what stands in them beside the layout that is tested in h5md_test.cpp.
#include "lucy/files/benard_h5md.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "lucy/files/h5md_reader.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using testing::contents;
using testing::ScratchFolder;

/// An open file, as a stranger reads it.
class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path) : file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {}
  ~OpenFile() { H5Fclose(file_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool has(const char* name) const { return H5Lexists(file_, name, H5P_DEFAULT) > 0; }
  std::vector<hsize_t> shape(const char* name) const {
    const hid_t dataset = H5Dopen2(file_, name, H5P_DEFAULT);
    const hid_t space = H5Dget_space(dataset);
    std::vector<hsize_t> extents(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, extents.data(), nullptr);
    H5Sclose(space);
    H5Dclose(dataset);
    return extents;
  }
  std::vector<double> values(const char* name) const {
    std::size_t count = 1;
    for (const hsize_t extent : shape(name)) count *= extent;
    std::vector<double> read(count);
    const hid_t dataset = H5Dopen2(file_, name, H5P_DEFAULT);
    H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.data());
    H5Dclose(dataset);
    return read;
  }
  double number(const char* object, const char* attribute) const {
    double value = std::nan("");
    const hid_t opened = H5Aopen_by_name(file_, object, attribute, H5P_DEFAULT, H5P_DEFAULT);
    H5Aread(opened, H5T_NATIVE_DOUBLE, &value);
    H5Aclose(opened);
    return value;
  }
  std::string text(const char* object, const char* attribute) const {
    const hid_t opened = H5Aopen_by_name(file_, object, attribute, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t type = H5Aget_type(opened);
    const hid_t space = H5Aget_space(opened);
    std::string value(H5Tget_size(type) * static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)), ' ');
    H5Aread(opened, type, value.data());
    H5Sclose(space);
    H5Tclose(type);
    H5Aclose(opened);
    return value;
  }

 private:
  hid_t file_;
};

/// Four cells high, eight wide.
cases::BenardPoint point() {
  cases::BenardPoint p;
  p.particles = 200;
  p.equation_of_state = spam::EquationOfStateName::van_der_waals;
  p.viscosity = 0.0;
  p.conductivity = 0.5;
  p.equilibration = 10.0;
  p.duration = 20.0;
  p.cells = 4;
  return p;
}

/// Of six samples, the last four averaged: density 2 but for one empty cell, velocity (0.1, -0.2), e = 1.5.
cases::BenardRecord record() {
  using M = measure::Moments<2>;
  cases::BenardRecord r;
  r.sample_interval = 5.0;
  for (int i = 0; i < 6; ++i) {
    cases::BenardSample sample;
    sample.averages.fill(i);
    sample.instants.fill(10.0 * i);
    r.samples.push_back(sample);
  }
  for (int b = 0; b < 2; ++b) {
    M sums(32);
    for (std::size_t k = 1; k < 32; ++k) {
      const double samples = 2.0;
      sums.column[M::density][k] = samples * 2.0;
      sums.column[M::momentum][k] = samples * 0.2;
      sums.column[M::momentum + 1][k] = samples * -0.4;
      sums.column[M::energy][k] = samples * 3.0;
    }
    r.blocks.push_back(sums);
    r.block_samples.push_back(2.0);
  }
  r.reflections = 17;
  return r;
}

cases::BenardParticles last_state() {
  cases::BenardParticles last;
  last.time = 30.0;
  last.position = {0.0, 0.0, 20.0, 10.0, 10.0, 5.0};
  last.velocity = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  last.velocity_smoothed = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  last.density = {1.0, 1.1, 1.2};
  last.temperature = {1.5, 0.5, 1.0};
  return last;
}

void write(const std::filesystem::path& path, const cases::BenardPoint& p, const cases::BenardRecord& r,
           const FrameSpool* frames = nullptr, const cases::BenardParticles& last = last_state()) {
  write_h5md(path, p, std::span(&r, 1), std::span(&frames, 1), last, {"somebody", "lucy", "1.2.3"});
}

TEST(BenardH5md, HoldsTheAveragedFieldsFromTheMiddleOfTheCell) {
  const ScratchFolder folder;
  write(folder / "one.h5", point(), record());
  write(folder / "other.h5", point(), record());
  EXPECT_EQ(contents(folder / "one.h5"), contents(folder / "other.h5"));

  const OpenFile file(folder / "one.h5");
  EXPECT_EQ(file.values("grid/x"), (std::vector{-8.75, -6.25, -3.75, -1.25, 1.25, 3.75, 6.25, 8.75}));
  EXPECT_EQ(file.values("grid/y"), (std::vector{-3.75, -1.25, 1.25, 3.75}));
  EXPECT_EQ(file.shape("fields/density"), (std::vector<hsize_t>{4, 8}));
  EXPECT_EQ(file.number("fields", "time_from"), 10.0);
  EXPECT_EQ(file.number("fields", "time_to"), 30.0);
  const spam::VanDerWaals gas;
  EXPECT_EQ(file.values("fields/density")[5], 2.0);
  EXPECT_EQ(file.values("fields/velocity_x")[5], 0.1);
  EXPECT_EQ(file.values("fields/velocity_y")[5], -0.2);
  EXPECT_EQ(file.values("fields/internal_energy")[5], 1.5);
  EXPECT_EQ(file.values("fields/temperature")[5], gas.temperature(2.0, 1.5));
  EXPECT_EQ(file.values("fields/pressure")[5], gas.pressure(2.0, 1.5));
  EXPECT_EQ(file.values("fields/density")[0], 0.0);
  EXPECT_TRUE(std::isnan(file.values("fields/velocity_x")[0]));
  EXPECT_TRUE(std::isnan(file.values("fields/temperature")[0]));
}

TEST(BenardH5md, HoldsTheLastStateAndAllSamples) {
  const ScratchFolder folder;
  write(folder / "one.h5", point(), record());
  const OpenFile file(folder / "one.h5");
  EXPECT_EQ(file.number("last", "time"), 30.0);
  EXPECT_EQ(file.values("last/position"), (std::vector{-10.0, -5.0, 10.0, 5.0, 0.0, 0.0}));
  EXPECT_EQ(file.values("last/velocity"), last_state().velocity);
  EXPECT_EQ(file.values("last/velocity_smoothed"), last_state().velocity_smoothed);
  EXPECT_EQ(file.shape("last/velocity"), (std::vector<hsize_t>{3, 2}));
  EXPECT_EQ(file.values("last/density"), last_state().density);
  EXPECT_EQ(file.values("last/temperature"), last_state().temperature);

  EXPECT_EQ(file.values("observables/replica_01/kinetic_energy_total/time"),
            (std::vector{5.0, 10.0, 15.0, 20.0, 25.0, 30.0}));
  EXPECT_EQ(file.values("observables/replica_01/work_sides/value"), (std::vector{0.0, 1.0, 2.0, 3.0, 4.0, 5.0}));
  EXPECT_EQ(file.values("observables/replica_01/instants/total_energy/value")[5], 50.0);
  EXPECT_EQ(file.number("observables/replica_01", "averaged_from"), 10.0);
  EXPECT_EQ(file.number("observables/replica_01", "reflections"), 17.0);
  EXPECT_EQ(file.number("parameters", "height"), 10.0);
  EXPECT_TRUE(std::isinf(file.number("parameters", "rayleigh")));
  EXPECT_EQ(file.text("parameters", "wall"), "mirror-images");
  EXPECT_EQ(file.text("parameters", "kernel"), "lucy");
}

TEST(BenardH5md, OfARunThatEndedEarlyHoldsWhatThereIs) {
  const ScratchFolder folder;
  cases::BenardRecord broken;
  broken.sample_interval = 5.0;
  broken.failure = "at time 1 it broke";
  broken.blocks.assign(2, measure::Moments<2>(32));
  broken.block_samples.assign(2, 0.0);
  write(folder / "one.h5", point(), broken, nullptr, {});
  const OpenFile file(folder / "one.h5");
  for (const char* group : {"grid", "fields", "last"}) EXPECT_FALSE(file.has(group)) << group;
  EXPECT_EQ(file.shape("observables/replica_01/kinetic_energy_total/value"), (std::vector<hsize_t>{0}));
  EXPECT_EQ(file.text("observables/replica_01", "failure"), broken.failure);
}

TEST(BenardH5md, FramesSayWhereThereAreWalls) {
  const ScratchFolder folder;
  const std::string none("none\0\0\0\0", 8);
  for (const auto& [side, boundary] :
       {std::pair{grid::Sides::periodic, "periodic" + none}, std::pair{grid::Sides::walls, none + none}}) {
    cases::BenardPoint p = point();
    p.sides = side;
    p.width = 20.0;
    cases::BenardRun run(p, 0, 1);
    FrameSpool frames(folder / "frames", p.particles, true);
    frames.truncate(0);
    frames.append(run.frame());
    write(folder / "one.h5", p, run.record(), &frames, run.last());
    EXPECT_EQ(OpenFile(folder / "one.h5").text("particles/replica_01/box", "boundary"), boundary);
    const H5mdReader reader(folder / "one.h5", 1);
    EXPECT_EQ(reader.frame(0).internal_energy, run.frame().internal_energy);
    EXPECT_EQ(reader.word("wall"), "mirror-images");
    EXPECT_EQ(reader.frame(0).box, (std::array{20.0, 10.0}));
  }
}

}  // namespace
}  // namespace lucy::files
