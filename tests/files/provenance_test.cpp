// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/provenance.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scratch.hpp"

namespace lucy::files {
namespace {

using ::testing::HasSubstr;

TEST(JsonString, EscapesWhatMustBeAndKeepsWhatIsText) {
  EXPECT_EQ(json_string("a \"b\" \\ \n\t\x01"), R"("a \"b\" \\ \n\t\u0001")");
  EXPECT_EQ(json_string("Hüfner, 粒子, 𝛾"), "\"Hüfner, 粒子, 𝛾\"");
}

TEST(JsonString, ReplacesBytesThatAreNoText) {
  EXPECT_EQ(json_string("a\xFFz"), "\"a\uFFFDz\"");
  EXPECT_EQ(json_string("\xC3"), "\"\uFFFD\"");
  EXPECT_EQ(json_string("\xC0\xAF"), "\"\uFFFD\uFFFD\"");                      // longer than needed
  EXPECT_EQ(json_string("\xED\xA0\x80"), "\"\uFFFD\uFFFD\uFFFD\"");            // half of a pair
  EXPECT_EQ(json_string("\xF4\x90\x80\x80"), "\"\uFFFD\uFFFD\uFFFD\uFFFD\"");  // beyond the last character
}

TEST(UtcText, IsTheTimeInGreenwich) {
  EXPECT_EQ(utc_text(std::chrono::system_clock::from_time_t(0)), "1970-01-01T00:00:00Z");
  EXPECT_EQ(utc_text(std::chrono::system_clock::from_time_t(1770091506)), "2026-02-03T04:05:06Z");
}

TEST(Provenance, IsReadByOthers) {
  const testing::ScratchFolder folder;
  Provenance provenance;
  provenance.version = "0.1.0";
  provenance.commit = "abc";
  provenance.compiler = "GNU 12.2";
  provenance.flags = "-O3 -DX=\"y\"";
  provenance.generator = "mt19937_64";
  provenance.seed = 18446744073709551615u;
  provenance.threads = 2;
  provenance.command_line = {"lucy", "sweep", "my input.toml"};
  provenance.wall_seconds_of_this_session = 12.5;
  provenance.wall_seconds_of_points = {1.25, std::nan("")};
  write_provenance(folder / "provenance.json", provenance);
  const std::string text = testing::contents(folder / "provenance.json");
  EXPECT_THAT(text, HasSubstr("\"seed\": 18446744073709551615,"));
  EXPECT_THAT(text, HasSubstr("\"wall_seconds_of_points\": [1.25, null]"));
  EXPECT_THAT(text, HasSubstr("\"command_line\": [\"lucy\", \"sweep\", \"my input.toml\"]"));
  EXPECT_THAT(text, HasSubstr("\"flags\": \"-O3 -DX=\\\"y\\\"\""));
  for (const char* key : {"version", "commit", "compiler", "processor", "host", "threads", "generator", "started",
                          "finished", "resumed", "wall_seconds_of_this_session", "wall_seconds_note"})
    EXPECT_THAT(text, HasSubstr(fmt::format("\"{}\": ", key)));
  if (std::system("command -v /usr/bin/python3 > /dev/null") != 0) GTEST_SKIP() << "there is no /usr/bin/python3";
  const std::string command = "/usr/bin/python3 -c 'import json, sys; json.load(open(sys.argv[1]))' '" +
                              (folder / "provenance.json").string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace lucy::files
