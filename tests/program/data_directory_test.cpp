// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/data_directory.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

#include "lucy/build_record.hpp"

namespace lucy {
namespace {

TEST(DataDirectory, HoldsWhatTheProgramReads) {
  const std::filesystem::path data = program::data_directory();
  EXPECT_TRUE(std::filesystem::is_regular_file(data / "reference" / "posch1995_table1.csv")) << data;
  EXPECT_TRUE(std::filesystem::is_regular_file(data / "inputs" / "quick.toml")) << data;
  EXPECT_TRUE(std::filesystem::is_directory(data / "analysis")) << data;
}

TEST(DataDirectory, OfATestIsTheSourceTree) {
  EXPECT_TRUE(std::filesystem::equivalent(program::data_directory(), LUCY_SOURCE_DIRECTORY));
}

TEST(BuildRecord, NamesVersionCommitCompilerAndFlags) {
  const BuildRecord record = build_record();
  EXPECT_TRUE(std::regex_match(std::string(record.version), std::regex("[0-9]+\\.[0-9]+\\.[0-9]+"))) << record.version;
  EXPECT_TRUE(std::regex_match(std::string(record.commit), std::regex("[0-9a-f]{40,64}(-modified)?|unknown")))
      << record.commit;
  EXPECT_TRUE(std::regex_match(std::string(record.compiler), std::regex("[A-Za-z]+ [0-9.]+"))) << record.compiler;
  EXPECT_NE(record.flags.find("-ffp-contract=off"), std::string_view::npos) << record.flags;
  EXPECT_EQ(record.flags.find("-ffast-math"), std::string_view::npos) << record.flags;
}

}  // namespace
}  // namespace lucy
