// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/python.hpp"

#include <gtest/gtest.h>

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

TEST(FindPython, TakesTheFirstThatImportsEverything) {
  EXPECT_EQ(find_python({"/no/such/python", "/bin/false", "/usr/bin/python3"}, {"json", "math"}), "/usr/bin/python3");
  EXPECT_EQ(find_python({"/usr/bin/python3"}, {"json", "no_such_module_at_all"}), std::nullopt);
}

TEST(ShellText, QuotesWhatAShellWouldRead) {
  EXPECT_EQ(shell_text({"python3", "a b", "it's", "", "plain-1.0"}), "python3 'a b' 'it'\\''s' '' plain-1.0");
}

}  // namespace
}  // namespace lucy::program
