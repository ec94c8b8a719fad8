// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/process.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

namespace lucy::program {
namespace {

TEST(RunCommand, KeepsWhatWasPrinted) {
  const auto result = run_command({"/bin/sh", "-c", "echo one; echo two"}, 60.0);
  EXPECT_TRUE(result.succeeded);
  EXPECT_EQ(result.output, "one\ntwo\n");
}

TEST(RunCommand, SurvivesALotOfOutputOnBothStreams) {
  const auto result = run_command(
      {"/bin/sh", "-c", "i=0; while [ $i -lt 20000 ]; do echo line; echo line >&2; i=$((i+1)); done"}, 60.0);
  EXPECT_TRUE(result.succeeded);
  EXPECT_EQ(result.output.size(), 5u * 20000u);
}

TEST(RunCommand, TellsTheLastLineOfAComplaint) {
  const auto result = run_command({"/bin/sh", "-c", "echo Traceback >&2; echo no such module >&2; exit 3"}, 60.0);
  EXPECT_FALSE(result.succeeded);
  EXPECT_EQ(result.complaint, "no such module");
}

TEST(RunCommand, PassesOverTheFrameOfAComplaint) {
  const auto result =
      run_command({"/bin/sh", "-c", "echo There are not enough slots. >&2; echo ----- >&2; exit 1"}, 60.0);
  EXPECT_EQ(result.complaint, "There are not enough slots.");
}

TEST(RunCommand, RunsInTheFolderThatIsAskedFor) {
  CommandSettings settings;
  settings.folder = "/usr";
  EXPECT_EQ(run_command({"/bin/pwd"}, 60.0, settings).output, "/usr\n");
  settings.folder = "/no/such/folder";
  EXPECT_EQ(run_command({"/bin/pwd"}, 60.0, settings).complaint, "No such file or directory");
}

TEST(RunCommand, EndsWithTheProgramThatRunsIt) {
  const auto file = std::filesystem::path(testing::TempDir()) / "lucy_process_test.pid";
  std::filesystem::remove(file);
  const pid_t parent = ::fork();
  if (parent == 0) {
    run_command({"/bin/sh", "-c", "echo $$ > " + file.string() + "; exec sleep 1000"}, 60.0);
    ::_exit(0);
  }
  const auto wait_until = [](const auto& happened) {
    for (int i = 0; i < 600 && !happened(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return happened();
  };
  pid_t child = 0;
  ASSERT_TRUE(wait_until([&] { return static_cast<bool>(std::ifstream(file) >> child); }));
  ASSERT_EQ(::kill(child, 0), 0);
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  const auto gone = [&] {  // nobody may collect an orphan in a container: a zombie is gone, too
    std::ifstream status("/proc/" + std::to_string(child) + "/stat");
    std::string number, name, state;
    return !(status >> number >> name >> state) || state == "Z";
  };
  EXPECT_TRUE(wait_until(gone));
}

TEST(RunCommand, TellsOfASilentEnd) {
  EXPECT_EQ(run_command({"/bin/sh", "-c", "exit 3"}, 60.0).complaint, "it ended with exit code 3");
  EXPECT_EQ(run_command({"/bin/sh", "-c", "kill -9 $$"}, 60.0).complaint, "it was ended by signal 9");
  EXPECT_FALSE(run_command({"/no/such/program"}, 60.0).succeeded);
}

TEST(RunCommand, EndsWhatDoesNotEnd) {
  const auto result = run_command({"/bin/sh", "-c", "exec sleep 1000"}, 0.1);
  EXPECT_FALSE(result.succeeded);
  EXPECT_NE(result.complaint.find("did not end"), std::string::npos);
}

TEST(ShellText, QuotesWhatAShellWouldRead) {
  EXPECT_EQ(shell_text({"python3", "a b", "it's", "", "plain-1.0"}), "python3 'a b' 'it'\\''s' '' plain-1.0");
}

}  // namespace
}  // namespace lucy::program
