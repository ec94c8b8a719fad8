// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/output_directory.hpp"

#include <gtest/gtest.h>

#include "files/scratch.hpp"
#include "lucy/errors.hpp"

namespace lucy::program {
namespace {

using files::testing::message_of;
using files::testing::put;
using files::testing::ScratchFolder;

DirectoryState look_at(const std::filesystem::path& directory, const std::string& resolved) {
  return look_at_directory(directory, resolved, "sweep", "table.csv");
}

TEST(OutputDirectory, IsFreshWhenAbsentOrEmpty) {
  const ScratchFolder folder;
  EXPECT_EQ(look_at(folder / "new" / "deep", "a = 1\n"), DirectoryState::fresh);
  EXPECT_EQ(look_at(folder.path(), "a = 1\n"), DirectoryState::fresh);
}

TEST(OutputDirectory, IsFreshWhenKilledBeforeTheInputWasWritten) {
  const ScratchFolder folder;
  put(folder / ".lock", "123\n");
  put(folder / ".input.toml.tmp", "a =");
  EXPECT_EQ(look_at(folder.path(), "a = 1\n"), DirectoryState::fresh);
}

TEST(OutputDirectory, KnowsItsOwnSweep) {
  const ScratchFolder folder;
  put(folder / "input.toml", "a = 1\n");
  put(folder / "point_001.h5", "x");
  EXPECT_EQ(look_at(folder.path(), "a = 1\n"), DirectoryState::unfinished);
  put(folder / "table.csv", "x");
  EXPECT_EQ(look_at(folder.path(), "a = 1\n"), DirectoryState::finished);
}

TEST(OutputDirectory, RefusesAnotherInputNamingTheFirstDifference) {
  const ScratchFolder folder;
  put(folder / "input.toml", "a = 1\nb = 2\n");
  const auto message = message_of<BadInput>([&] { look_at(folder.path(), "a = 1\nb = 3\n"); });
  EXPECT_NE(message.find("line 2 is 'b = 2' there, 'b = 3' here"), std::string::npos) << message;
  EXPECT_NE(message_of<BadInput>([&] { look_at(folder.path(), "a = 1\n"); }).find("missing here"), std::string::npos);
  EXPECT_NE(message_of<BadInput>([&] { look_at(folder.path(), "a = 1\nb = 2"); }), "");
}

TEST(OutputDirectory, RefusesStrangersAndFiles) {
  const ScratchFolder folder;
  put(folder / "thesis.tex", "x");
  EXPECT_NE(message_of<BadInput>([&] { look_at(folder.path(), ""); }).find("thesis.tex"), std::string::npos);
  EXPECT_NE(message_of<BadInput>([&] { look_at(folder / "thesis.tex", ""); }).find("is a file"), std::string::npos);
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(OutputDirectory, CannotBeMadeBelowAFile) {
  const ScratchFolder folder;
  put(folder / "file", "x");
  EXPECT_NE(message_of<BadInput>([&] { make_directory(folder / "file" / "x"); }).find("cannot make"),
            std::string::npos);
}

}  // namespace
}  // namespace lucy::program
