// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One program at a time in an output directory. The lock is the kernel's (flock), so it ends with the program however
// the program ends; a file left behind by kill -9 blocks nobody.
#pragma once

#include <filesystem>

namespace lucy::files {

class DirectoryLock {
 public:
  /// Locks `directory`/.lock, creating that file when needed. Throws BadInput when another program holds the lock
  /// (naming its process number) or when this one may not write there, RunFailed when the file cannot be made
  /// for another reason.
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(DirectoryLock&& other) noexcept;
  DirectoryLock& operator=(DirectoryLock&& other) noexcept;

 private:
  int descriptor_ = -1;
};

}  // namespace lucy::files
