// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/series_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lucy/errors.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using testing::message_of;
using testing::put;
using testing::ScratchFolder;
using ::testing::SizeIs;

class SeriesFileTest : public ::testing::Test {
 protected:
  ColumnFile read(const std::string& text) const {
    put(path_, text);
    return read_columns(path_);
  }
  std::string refusal(const std::string& text) const {
    return message_of<BadInput>([&] { read(text); });
  }
  std::string column_refusal(const ColumnFile& file, const std::string& name) const {
    return message_of<BadInput>([&] { find_column(file, name, path_); });
  }

  ScratchFolder folder_;
  std::filesystem::path path_ = folder_ / "stress.dat";
};

TEST_F(SeriesFileTest, ReadsBareColumns) {
  const ColumnFile file = read("1 2.5\n  +3\t-4e-3  \n\n5 6");
  EXPECT_THAT(file.names, SizeIs(0));
  EXPECT_THAT(file.columns, ElementsAre(ElementsAre(1.0, 3.0, 5.0), ElementsAre(2.5, -4e-3, 6.0)));
}

TEST_F(SeriesFileTest, TakesNamesFromTheCommentsOfLammps) {
  const ColumnFile file = read(
      "# Time-averaged data for fix stress\n# TimeStep v_pxy c_press[1]\n0 0.25 1\n# appended later, again\n100 -0.5 "
      "2\n");
  EXPECT_THAT(file.names, ElementsAre("TimeStep", "v_pxy", "c_press[1]"));
  EXPECT_THAT(file.columns, ElementsAre(ElementsAre(0.0, 100.0), ElementsAre(0.25, -0.5), ElementsAre(1.0, 2.0)));
}

TEST_F(SeriesFileTest, TakesNamesFromALineOfTheirOwn) {
  EXPECT_THAT(read("   Step          Pxy  \n   0  0.1\n").names, ElementsAre("Step", "Pxy"));
  EXPECT_THAT(read("# a b\nc d\n1 2\n").names, ElementsAre("c", "d"));
  const ColumnFile file = read("\xEF\xBB\xBF\"time\", stress xy,D\r\n0,0.1 ,0.2\r\n1, 0.3,0.4\r\n");
  EXPECT_THAT(file.names, ElementsAre("time", "stress xy", "D"));
  EXPECT_THAT(file.columns, ElementsAre(ElementsAre(0.0, 1.0), ElementsAre(0.1, 0.3), ElementsAre(0.2, 0.4)));
}

TEST_F(SeriesFileTest, CommentsOfOtherLengthsAreNoNames) {
  EXPECT_THAT(read("# made by hand\n1 2\n").names, SizeIs(0));
  EXPECT_THAT(read("#\n# time x\n# one more remark\n1 2\n").names, ElementsAre("time", "x"));
}

TEST_F(SeriesFileTest, FindsColumnsByNameAndByNumber) {
  const ColumnFile file = read("# t pxy 1\n0 1 2\n");
  EXPECT_EQ(find_column(file, "pxy", path_), 1u);
  EXPECT_EQ(find_column(file, "3", path_), 2u);
  EXPECT_EQ(find_column(file, "1", path_), 2u);  // a name comes first
  EXPECT_THAT(column_refusal(file, "pxz"),
              EndsWith("stress.dat: there is no column pxz; it has 3 columns, numbered from 1: t, pxy, 1"));
  for (const char* wrong : {"0", "4", "-1", "2x", "", "99999999999999999999"})
    EXPECT_THAT(column_refusal(file, wrong), HasSubstr("there is no column")) << wrong;
  EXPECT_THAT(column_refusal(read("1 2\n"), "pxy"),
              EndsWith("there is no column pxy; it has 2 columns without names, numbered from 1"));
  EXPECT_THAT(column_refusal(read("# a a\n1 2\n"), "a"), HasSubstr("the column a stands there 2 times"));
}

TEST_F(SeriesFileTest, RefusesWithFileAndLine) {
  EXPECT_THAT(refusal("# x\n1 2\n3\n"), EndsWith("stress.dat:3: 1 numbers were found where the first row has 2"));
  EXPECT_THAT(refusal("1 2\n3 4 5\n"), EndsWith("stress.dat:2: 3 numbers were found where the first row has 2"));
  EXPECT_THAT(refusal("1 2\n\n3 x\n"),
              EndsWith("stress.dat:3: \"x\" was found in column 2 where a finite number was expected"));
  EXPECT_THAT(refusal("1 2\n3 nan\n"), HasSubstr("stress.dat:2: \"nan\" was found in column 2"));
  EXPECT_THAT(refusal("1 inf\n"), HasSubstr("stress.dat:1: \"inf\""));
  EXPECT_THAT(refusal("1 2.5e\n"), HasSubstr("stress.dat:1: \"2.5e\""));
  EXPECT_THAT(refusal("1,,2\n"), HasSubstr("stress.dat:1: \"\" was found in column 2"));
  EXPECT_THAT(refusal("a b\nc d\n1 2\n"), HasSubstr("stress.dat:2: \"c\" was found in column 1"));
  EXPECT_THAT(refusal("a b c\n1 2\n"), EndsWith("stress.dat:2: 2 numbers were found where line 1 has 3 names of "
                                                "columns"));
  EXPECT_THAT(refusal("1 2\n3 " + std::string(100, 'y') + "\n"), HasSubstr("yyy...\""));
}

TEST_F(SeriesFileTest, RefusesWhatHoldsNoNumbers) {
  EXPECT_THAT(refusal(""), EndsWith("stress.dat has no row of numbers"));
  EXPECT_THAT(refusal("# only a comment\na b\n"), EndsWith("stress.dat has no row of numbers"));
  EXPECT_THAT(refusal(std::string("\x89HDF\0\1", 6)), HasSubstr("it is binary"));
  EXPECT_THAT(message_of<BadInput>([&] { read_columns(folder_ / "none"); }), HasSubstr("cannot read"));
}

TEST_F(SeriesFileTest, KeepsEveryBitOfManyRows) {
  std::string text = "# t x\n";
  constexpr int rows = 20000;
  for (int i = 0; i < rows; ++i) fmt::format_to(std::back_inserter(text), "{} {}\n", i, 1.0 / (i + 0.1));
  const ColumnFile file = read(text);
  ASSERT_EQ(file.columns[1].size(), static_cast<std::size_t>(rows));
  for (int i = 0; i < rows; ++i) ASSERT_EQ(file.columns[1][static_cast<std::size_t>(i)], 1.0 / (i + 0.1));
}

}  // namespace
}  // namespace lucy::files
