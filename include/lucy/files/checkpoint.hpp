// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// States that outlive the program. Two generations per state, STEM.a and STEM.b, written in turn, so that one whole
// state is on disk at every moment. A file is, in the byte order of the machine:
//
//     magic "LUCYCKPT", format version (4 bytes), length of identity (4), generation (8), length of payload (8),
//     CRC-64 of identity and payload (8), CRC-64 of the 40 bytes so far (8), identity, payload
//
// CRC-64 is the reflected ECMA-182 polynomial, all ones in and out (known as CRC-64/XZ).
// The identity is any text that two states must share to be interchangeable: build, point, replica.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lucy::files {

/// CRC-64/XZ; continues from the checksum of what came before. Of "123456789": 0x995DC9BBDF1939FA.
std::uint64_t crc64(std::span<const std::byte> bytes, std::uint64_t before = 0);

/// Replaces the older of the two generations. Throws RunFailed with path and reason when the disk refuses; both
/// generations are then as they were.
void write_checkpoint(const std::filesystem::path& stem, std::span<const std::byte> payload, std::string_view identity);

struct CheckpointRead {
  std::optional<std::vector<std::byte>> payload;  ///< of the newest valid generation; none when there is none
  std::vector<std::string> rejected;  ///< one sentence per generation that is there but cannot be used, naming file and
                                      ///< cause: damaged, truncated, of another format version, of another run or build
};

/// Never throws for what stands in the files: a damaged one is told of in `rejected` and the other one taken.
CheckpointRead read_checkpoint(const std::filesystem::path& stem, std::string_view identity);

/// Removes both generations and what a killed program may have left of a third. Missing files are no error.
void remove_checkpoint(const std::filesystem::path& stem);

}  // namespace lucy::files
