// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Configurations on their way into a point's H5MD file: records of one size, appended while the point runs.
// A checkpoint states how many records it knows of; what was appended after it is cut off when the run resumes.
// Record, in the machine's byte order: step (8 bytes), time, offset, L_x, L_y, x0 y0 x1 y1 ..., px0 py0 px1 py1 ...,
// e0 e1 ... where internal energies are kept, CRC-64 of all these (checkpoint.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "lucy/cases/frame.hpp"

namespace lucy::files {

class FrameSpool {
 public:
  /// Opens or creates the file for frames of so many particles, with or without their internal energies. Throws
  /// RunFailed with path and reason.
  FrameSpool(const std::filesystem::path& path, std::int64_t particles, bool internal_energies = false);
  ~FrameSpool();
  FrameSpool(FrameSpool&& other) noexcept;
  FrameSpool& operator=(FrameSpool&& other) noexcept;

  std::int64_t particles() const { return particles_; }
  bool internal_energies() const { return internal_energies_; }
  /// Whole records in the file.
  std::int64_t count() const { return count_; }

  /// Throws RunFailed when the disk refuses; the records before stay whole.
  void append(const cases::Frame& frame);

  /// Forgets all but the first `count` records (and half a record at the end). Throws RunFailed when there are
  /// fewer, or when one of those that stay is damaged; the file is then as it was.
  void truncate(std::int64_t count);

  /// Forces everything appended to disk; call it before writing the checkpoint that counts these frames.
  void synchronise();

  /// Throws RunFailed when there is no such record, or it cannot be read or is damaged.
  cases::Frame read(std::int64_t index) const;
  std::vector<cases::Frame> read_all() const;

 private:
  std::int64_t record_size() const;
  std::vector<std::byte> read_record(std::int64_t index) const;
  void close_file();

  std::filesystem::path path_;
  std::int64_t particles_ = 0;
  bool internal_energies_ = false;
  std::int64_t count_ = 0;
  int descriptor_ = -1;
};

}  // namespace lucy::files
