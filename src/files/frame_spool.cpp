// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/frame_spool.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cstring>
#include <utility>

#include "file_descriptor.hpp"
#include "lucy/archive.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/checkpoint.hpp"

namespace lucy::files {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view what) {
  const int reason = errno;
  throw RunFailed(fmt::format("cannot {} the frames in {}: {}", what, path.string(),
                              reason == 0 ? "the file is shorter than it was" : system_reason(reason)));
}

}  // namespace

FrameSpool::FrameSpool(const std::filesystem::path& path, std::int64_t particles, bool internal_energies)
    : path_(path), particles_(particles), internal_energies_(internal_energies) {
  FileDescriptor file(path.string(), O_RDWR | O_CREAT);
  struct stat status {};
  if (!file.is_open() || ::fstat(file.number(), &status) != 0) fail(path_, "open");
  count_ = status.st_size / record_size();
  descriptor_ = file.release();
}

FrameSpool::~FrameSpool() { close_file(); }

FrameSpool::FrameSpool(FrameSpool&& other) noexcept
    : path_(std::move(other.path_)),
      particles_(other.particles_),
      internal_energies_(other.internal_energies_),
      count_(other.count_),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

FrameSpool& FrameSpool::operator=(FrameSpool&& other) noexcept {
  if (this != &other) {
    close_file();
    path_ = std::move(other.path_);
    particles_ = other.particles_;
    internal_energies_ = other.internal_energies_;
    count_ = other.count_;
    descriptor_ = std::exchange(other.descriptor_, -1);
  }
  return *this;
}

void FrameSpool::close_file() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::int64_t FrameSpool::record_size() const { return 8 * (5 + (internal_energies_ ? 5 : 4) * particles_ + 1); }

void FrameSpool::append(const cases::Frame& frame) {
  const auto numbers = static_cast<std::size_t>(2 * particles_);
  if (frame.position.size() != numbers || frame.momentum.size() != numbers)
    throw RunFailed(fmt::format("a frame of {} particles cannot be added to {}, which holds frames of {}",
                                frame.position.size() / 2, path_.string(), particles_));
  if (frame.internal_energy.size() != static_cast<std::size_t>(internal_energies_ ? particles_ : 0))
    throw RunFailed(fmt::format("a frame with {} internal energies cannot be added to {}, which holds {} in each",
                                frame.internal_energy.size(), path_.string(), internal_energies_ ? particles_ : 0));
  ArchiveWriter record;
  record.put(frame.step);
  record.put(frame.time);
  record.put(frame.offset);
  record.put(frame.box);
  std::vector<std::byte> bytes = record.bytes();
  for (const auto* values : {&frame.position, &frame.momentum, &frame.internal_energy}) {
    const auto view = std::as_bytes(std::span(*values));
    bytes.insert(bytes.end(), view.begin(), view.end());
  }
  const std::uint64_t checksum = crc64(bytes);
  const auto view = std::as_bytes(std::span(&checksum, 1));
  bytes.insert(bytes.end(), view.begin(), view.end());
  // Written at the place that `count` gives, so that half a record left by an earlier failure is overwritten.
  if (::lseek(descriptor_, count_ * record_size(), SEEK_SET) < 0 || !write_all(descriptor_, bytes))
    fail(path_, "add to");
  ++count_;
}

void FrameSpool::truncate(std::int64_t count) {
  if (count < 0 || count > count_)
    throw RunFailed(fmt::format("{} holds {} frames where the checkpoint knows of {}", path_.string(), count_, count));
  for (std::int64_t i = 0; i < count; ++i) read_record(i);
  if (::ftruncate(descriptor_, count * record_size()) != 0) fail(path_, "cut off");
  count_ = count;
}

void FrameSpool::synchronise() {
  if (::fsync(descriptor_) != 0) fail(path_, "force to disk");
}

std::vector<std::byte> FrameSpool::read_record(std::int64_t index) const {
  if (index < 0 || index >= count_)
    throw RunFailed(fmt::format("{} has no frame {}: it holds {}", path_.string(), index, count_));
  std::vector<std::byte> bytes(static_cast<std::size_t>(record_size()));
  if (!files::read_all(descriptor_, bytes, index * record_size())) fail(path_, "read");
  const std::size_t contents = bytes.size() - sizeof(std::uint64_t);
  std::uint64_t checksum = 0;
  std::memcpy(&checksum, bytes.data() + contents, sizeof checksum);
  bytes.resize(contents);
  if (crc64(bytes) != checksum)
    throw RunFailed(fmt::format("frame {} in {} is damaged: its checksum is wrong", index + 1, path_.string()));
  return bytes;
}

cases::Frame FrameSpool::read(std::int64_t index) const {
  const std::vector<std::byte> bytes = read_record(index);
  ArchiveReader record(bytes);
  cases::Frame frame;
  frame.step = record.get<std::int64_t>();
  frame.time = record.get<double>();
  frame.offset = record.get<double>();
  frame.box = record.get<std::array<double, 2>>();
  const auto read_numbers = [&](std::vector<double>& values, std::int64_t count) {
    values.resize(static_cast<std::size_t>(count));
    for (double& value : values) value = record.get<double>();
  };
  read_numbers(frame.position, 2 * particles_);
  read_numbers(frame.momentum, 2 * particles_);
  if (internal_energies_) read_numbers(frame.internal_energy, particles_);
  return frame;
}

std::vector<cases::Frame> FrameSpool::read_all() const {
  std::vector<cases::Frame> frames;
  frames.reserve(static_cast<std::size_t>(count_));
  for (std::int64_t i = 0; i < count_; ++i) frames.push_back(read(i));
  return frames;
}

}  // namespace lucy::files
