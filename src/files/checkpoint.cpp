// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/checkpoint.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <type_traits>

#include "file_descriptor.hpp"
#include "lucy/files/atomic_file.hpp"

namespace lucy::files {

namespace {

constexpr std::array<char, 8> magic = {'L', 'U', 'C', 'Y', 'C', 'K', 'P', 'T'};
constexpr std::uint32_t format_version = 1;

struct Header {
  std::array<char, 8> magic;
  std::uint32_t format_version;
  std::uint32_t identity_length;
  std::uint64_t generation;
  std::uint64_t payload_length;
  std::uint64_t contents_checksum;
  std::uint64_t header_checksum;
};
static_assert(sizeof(Header) == 48 && std::has_unique_object_representations_v<Header>);

std::uint64_t checksum_of(const Header& header) {
  return crc64(std::as_bytes(std::span(&header, 1)).first(offsetof(Header, header_checksum)));
}

std::array<std::filesystem::path, 2> generations(const std::filesystem::path& stem) {
  return {stem.string() + ".a", stem.string() + ".b"};
}

/// One generation as it lies on disk: whether it is there, whether its header is sound, and if not, why.
struct Found {
  bool present = false;
  std::optional<Header> header;
  std::string cause;
};

Found look_at(const FileDescriptor& file) {
  Found found;
  if (!file.is_open()) {
    found.present = errno != ENOENT;
    found.cause = system_reason(errno);
    return found;
  }
  found.present = true;
  struct stat status {};
  Header header;
  if (::fstat(file.number(), &status) != 0 ||
      !read_all(file.number(), std::as_writable_bytes(std::span(&header, 1)), 0)) {
    found.cause = errno == 0 ? "it is truncated" : system_reason(errno);
    return found;
  }
  // Before the checksum, so that a later format is called that and not damaged.
  if (header.magic != magic) {
    found.cause = "it is damaged, or no checkpoint";
  } else if (header.format_version != format_version) {
    found.cause = fmt::format("its format version is {}, this program's is {}", header.format_version, format_version);
  } else if (checksum_of(header) != header.header_checksum) {
    found.cause = "it is damaged: the checksum of its header is wrong";
  } else if (static_cast<std::uint64_t>(status.st_size) !=
             sizeof header + header.identity_length + header.payload_length) {
    found.cause = fmt::format("it is truncated: {} bytes of {}", status.st_size,
                              sizeof header + header.identity_length + header.payload_length);
  } else {
    found.header = header;
  }
  return found;
}

}  // namespace

std::uint64_t crc64(std::span<const std::byte> bytes, std::uint64_t before) {
  static constexpr auto table = [] {
    std::array<std::uint64_t, 256> entries{};
    for (std::uint64_t i = 0; i < entries.size(); ++i) {
      std::uint64_t remainder = i;
      for (int bit = 0; bit < 8; ++bit)
        remainder = (remainder >> 1) ^ ((remainder & 1) != 0 ? 0xC96C5795D7870F42u : 0u);
      entries[i] = remainder;
    }
    return entries;
  }();
  std::uint64_t remainder = ~before;
  for (const std::byte byte : bytes)
    remainder = table[(remainder ^ std::to_integer<std::uint64_t>(byte)) & 0xFF] ^ (remainder >> 8);
  return ~remainder;
}

void write_checkpoint(const std::filesystem::path& stem, std::span<const std::byte> payload,
                      std::string_view identity) {
  const auto paths = generations(stem);
  std::array<std::uint64_t, 2> generation{};  // 0: not there or of no use, so the first to be replaced
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const Found found = look_at(FileDescriptor(paths[i].string(), O_RDONLY));
    if (found.header) generation[i] = found.header->generation;
  }
  const std::span<const std::byte> identity_bytes = std::as_bytes(std::span(identity));
  Header header{magic,
                format_version,
                static_cast<std::uint32_t>(identity.size()),
                std::max(generation[0], generation[1]) + 1,
                payload.size(),
                crc64(payload, crc64(identity_bytes)),
                0};
  header.header_checksum = checksum_of(header);
  const std::array<std::span<const std::byte>, 3> pieces = {std::as_bytes(std::span(&header, 1)), identity_bytes,
                                                            payload};
  write_file_atomically(paths[generation[0] <= generation[1] ? 0 : 1], pieces);
}

CheckpointRead read_checkpoint(const std::filesystem::path& stem, std::string_view identity) {
  CheckpointRead result;
  std::uint64_t newest = 0;
  for (const auto& path : generations(stem)) {
    const FileDescriptor file(path.string(), O_RDONLY);
    Found found = look_at(file);
    if (!found.present) continue;
    if (found.header) {
      const Header& header = *found.header;
      std::vector<std::byte> contents(header.identity_length + header.payload_length);
      const auto stored_identity = std::span(contents).first(header.identity_length);
      if (!read_all(file.number(), contents, sizeof header)) {
        found.cause = errno == 0 ? "it is truncated" : system_reason(errno);
      } else if (crc64(contents) != header.contents_checksum) {
        found.cause = "it is damaged: the checksum of its contents is wrong";
      } else if (!std::ranges::equal(stored_identity, std::as_bytes(std::span(identity)))) {
        found.cause = "it belongs to another run or another build of Lucy";
      } else {
        if (header.generation > newest) {
          newest = header.generation;
          contents.erase(contents.begin(), contents.begin() + header.identity_length);
          result.payload = std::move(contents);
        }
        continue;
      }
    }
    result.rejected.push_back(fmt::format("the checkpoint {} cannot be used: {}", path.string(), found.cause));
  }
  return result;
}

void remove_checkpoint(const std::filesystem::path& stem) {
  for (const auto& path : generations(stem)) {
    ::unlink(path.c_str());
    ::unlink(temporary_beside(path).c_str());
  }
}

}  // namespace lucy::files
