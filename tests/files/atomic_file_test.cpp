// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <optional>

#include "lucy/errors.hpp"
#include "lucy/files/directory_lock.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using testing::contents;
using ::testing::HasSubstr;
using testing::message_of;
using testing::ScratchFolder;

TEST(AtomicFile, ReplacesTheOldTextAndLeavesNoTemporary) {
  const ScratchFolder folder;
  write_file_atomically(folder / "table.csv", "old\n");
  write_file_atomically(folder / "table.csv", "new\n");
  EXPECT_EQ(contents(folder / "table.csv"), "new\n");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, KeepsTheOldTextOnAFullDisk) {
  const ScratchFolder folder;
  write_file_atomically(folder / "table.csv", "old\n");
  std::string message;
  {
    const testing::FullDisk full(1000);
    message = message_of<RunFailed>([&] { write_file_atomically(folder / "table.csv", std::string(5000, 'x')); });
  }
  EXPECT_THAT(message, HasSubstr((folder / "table.csv").string()));
  EXPECT_THAT(message, HasSubstr("too large"));
  EXPECT_EQ(contents(folder / "table.csv"), "old\n");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, NamesPathAndReasonWhereItCannotWrite) {
  const ScratchFolder folder;
  EXPECT_THAT(message_of<RunFailed>([&] { write_file_atomically(folder / "missing/table.csv", "x"); }),
              HasSubstr("missing/table.csv: No such file or directory"));
  std::filesystem::create_directory(folder / "taken");
  EXPECT_THAT(message_of<RunFailed>([&] { write_file_atomically(folder / "taken", "x"); }), HasSubstr("directory"));
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(ReadTextFile, RefusesWhatIsNoFile) {
  const ScratchFolder folder;
  EXPECT_THAT(message_of<BadInput>([&] { read_text_file(folder.path()); }), HasSubstr("not a regular file"));
  EXPECT_THAT(message_of<BadInput>([&] { read_text_file(folder / "none"); }), HasSubstr("No such file"));
  EXPECT_THAT(message_of<BadInput>([&] { read_text_file("/dev/zero"); }), HasSubstr("not a regular file"));
}

TEST(DirectoryLock, KeepsASecondProgramOutUntilTheFirstEnds) {
  const ScratchFolder folder;
  std::optional<DirectoryLock> first(folder.path());
  const auto second = message_of<BadInput>([&] { DirectoryLock lock(folder.path()); });
  EXPECT_THAT(second, HasSubstr("another lucy (process " + std::to_string(::getpid()) + ")"));
  EXPECT_THAT(second, HasSubstr(folder.path().string()));
  first.reset();
  EXPECT_NO_THROW(DirectoryLock(folder.path()));
}

TEST(DirectoryLock, OfAKilledProgramDoesNotBlock) {
  const ScratchFolder folder;
  std::array<int, 2> ready{};
  ASSERT_EQ(::pipe(ready.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const DirectoryLock lock(folder.path());
    if (::write(ready[1], "x", 1) != 1) ::_exit(1);
    for (;;) ::pause();
  }
  char signal = 0;
  ASSERT_EQ(::read(ready[0], &signal, 1), 1);
  EXPECT_THROW(DirectoryLock(folder.path()), BadInput);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / ".lock"));
  EXPECT_NO_THROW(DirectoryLock(folder.path()));
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST(DirectoryLock, MovesWithItsOwner) {
  const ScratchFolder folder;
  DirectoryLock first(folder.path());
  {
    const DirectoryLock second(std::move(first));
    EXPECT_THROW(DirectoryLock(folder.path()), BadInput);
  }
  EXPECT_NO_THROW(DirectoryLock(folder.path()));
}

TEST(DirectoryLock, InAMissingFolderNamesIt) {
  const ScratchFolder folder;
  EXPECT_THAT(message_of<RunFailed>([&] { DirectoryLock lock(folder / "missing"); }), HasSubstr("missing/.lock"));
}

}  // namespace
}  // namespace lucy::files
