// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "lucy/errors.hpp"
#include "scratch.hpp"

namespace lucy::files {
namespace {

using testing::contents;
using ::testing::HasSubstr;
using testing::message_of;
using testing::put;
using ::testing::SizeIs;

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

std::string text_of(const std::optional<std::vector<std::byte>>& payload) {
  if (!payload) return "(none)";
  return {reinterpret_cast<const char*>(payload->data()), payload->size()};
}

TEST(Crc64, HasTheCheckValueOfItsDefinition) {
  EXPECT_EQ(crc64(bytes_of("123456789")), 0x995DC9BBDF1939FAu);
  EXPECT_EQ(crc64({}), 0u);
}

TEST(Crc64, OfTwoPiecesIsThatOfTheWhole) {
  EXPECT_EQ(crc64(bytes_of("6789"), crc64(bytes_of("12345"))), crc64(bytes_of("123456789")));
}

class CheckpointTest : public ::testing::Test {
 protected:
  void write(const std::string& payload, const std::string& identity = "point 1") {
    write_checkpoint(stem_, bytes_of(payload), identity);
  }
  CheckpointRead read(const std::string& identity = "point 1") const { return read_checkpoint(stem_, identity); }
  std::string newest() const { return text_of(read().payload); }

  testing::ScratchFolder folder_;
  std::filesystem::path stem_ = folder_ / "point_001_replica_01";
  std::filesystem::path a_ = folder_ / "point_001_replica_01.a";
  std::filesystem::path b_ = folder_ / "point_001_replica_01.b";
};

TEST_F(CheckpointTest, IsAbsentWithoutComplaintBeforeTheFirst) {
  EXPECT_FALSE(read().payload);
  EXPECT_THAT(read().rejected, SizeIs(0));
}

TEST_F(CheckpointTest, GivesBackTheNewestOfMany) {
  for (int i = 0; i < 7; ++i) {
    write("state " + std::to_string(i));
    EXPECT_EQ(newest(), "state " + std::to_string(i));
  }
  EXPECT_EQ(folder_.entries(), 2u);
  EXPECT_THAT(read().rejected, SizeIs(0));
}

TEST_F(CheckpointTest, KeepsAnEmptyState) {
  write("");
  EXPECT_EQ(newest(), "");
}

TEST_F(CheckpointTest, OfAnotherIdentityIsRefusedAndToldOf) {
  write("state");
  const auto result = read("point 2");
  EXPECT_FALSE(result.payload);
  ASSERT_THAT(result.rejected, SizeIs(1));
  EXPECT_THAT(result.rejected[0], HasSubstr(a_.string()));
  EXPECT_THAT(result.rejected[0], HasSubstr("another run"));
}

TEST_F(CheckpointTest, AnyDamagedByteIsNoticedAndTheOneBeforeTaken) {
  write("the one before");
  write("the newest one");
  const std::string sound = contents(b_);
  for (std::size_t i = 0; i < sound.size(); ++i) {
    std::string damaged = sound;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    put(b_, damaged);
    const auto result = read();
    ASSERT_EQ(text_of(result.payload), "the one before") << "byte " << i;
    ASSERT_THAT(result.rejected, SizeIs(1)) << "byte " << i;
    ASSERT_THAT(result.rejected[0], HasSubstr(b_.string()));
  }
}

TEST_F(CheckpointTest, AnyTruncationIsNoticedAndTheOneBeforeTaken) {
  write("the one before");
  write("the newest one");
  const std::string sound = contents(b_);
  for (std::size_t length = 0; length < sound.size(); ++length) {
    put(b_, sound.substr(0, length));
    const auto result = read();
    ASSERT_EQ(text_of(result.payload), "the one before") << length << " bytes left";
    ASSERT_THAT(result.rejected, SizeIs(1)) << length << " bytes left";
  }
  put(b_, sound + "x");
  EXPECT_EQ(newest(), "the one before");
}

TEST_F(CheckpointTest, TwoDamagedGenerationsLeaveNone) {
  write("one");
  write("two");
  put(a_, "something else altogether, longer than a header of forty-eight bytes");
  put(b_, "short");
  const auto result = read();
  EXPECT_FALSE(result.payload);
  EXPECT_THAT(result.rejected, SizeIs(2));
}

TEST_F(CheckpointTest, ReplacesTheDamagedGenerationFirst) {
  write("one");
  write("two");
  put(b_, "damaged");
  write("three");
  put(b_, "damaged again");
  EXPECT_EQ(newest(), "one");
}

TEST_F(CheckpointTest, OfALaterFormatIsCalledThat) {
  write("state");
  std::string later = contents(a_);
  later[8] = 2;
  put(a_, later);
  ASSERT_THAT(read().rejected, SizeIs(1));
  EXPECT_THAT(read().rejected[0], HasSubstr("format version is 2"));
}

TEST_F(CheckpointTest, AFullDiskLeavesBothGenerationsAndNothingElse) {
  write("one");
  write("two");
  const std::string large(100000, 'x');
  std::string message;
  {
    const testing::FullDisk full(5000);
    message = message_of<RunFailed>([&] { write(large); });
  }
  EXPECT_THAT(message, HasSubstr(a_.string()));
  EXPECT_THAT(message, HasSubstr("too large"));
  EXPECT_EQ(newest(), "two");
  EXPECT_EQ(folder_.entries(), 2u);
  put(b_, "damaged");
  EXPECT_EQ(newest(), "one");
}

TEST_F(CheckpointTest, OneLeftHalfWrittenByAKilledProgramIsPassedOver) {
  write("one");
  put(folder_ / ".point_001_replica_01.b.tmp", "half of a checkp");
  EXPECT_EQ(newest(), "one");
  write("two");
  EXPECT_EQ(newest(), "two");
  EXPECT_EQ(folder_.entries(), 2u);
}

TEST_F(CheckpointTest, RemovedIsGone) {
  write("one");
  write("two");
  put(folder_ / ".point_001_replica_01.a.tmp", "half");
  remove_checkpoint(stem_);
  EXPECT_EQ(folder_.entries(), 0u);
  remove_checkpoint(stem_);
}

TEST_F(CheckpointTest, KeepsEveryByteOfALargeState) {
  std::mt19937_64 generator(7);
  std::string state(1000003, '\0');
  for (char& c : state) c = static_cast<char>(generator());
  write(state);
  EXPECT_EQ(newest(), state);
}

}  // namespace
}  // namespace lucy::files
