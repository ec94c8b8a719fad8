// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/directory_lock.hpp"

#include <fmt/format.h>
#include <sys/file.h>

#include <array>
#include <charconv>
#include <utility>

#include "file_descriptor.hpp"
#include "lucy/errors.hpp"

namespace lucy::files {

DirectoryLock::DirectoryLock(const std::filesystem::path& directory) {
  const std::string path = (directory / ".lock").string();
  FileDescriptor file(path, O_RDWR | O_CREAT);
  if (!file.is_open()) {
    const int reason = errno;
    const std::string message = fmt::format("cannot create {}: {}", path, system_reason(reason));
    if (reason == EACCES || reason == EPERM || reason == EROFS)
      throw BadInput(message + " (choose another directory with --out)");
    throw RunFailed(message);
  }
  if (::flock(file.number(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) throw RunFailed(fmt::format("cannot lock {}: {}", path, system_reason(errno)));
    std::array<char, 24> holder{};
    long process = 0;
    const ssize_t got = ::pread(file.number(), holder.data(), holder.size() - 1, 0);
    if (got > 0) std::from_chars(holder.data(), holder.data() + got, process);
    throw BadInput(fmt::format("another lucy{} is at work in {}: wait for it to end, or choose another --out",
                               process > 0 ? fmt::format(" (process {})", process) : "", directory.string()));
  }
  // Only for the message above: who holds the lock. A full disk is no reason to stop here.
  const std::string self = fmt::format("{}\n", ::getpid());
  if (::ftruncate(file.number(), 0) == 0) write_all(file.number(), std::as_bytes(std::span(self)));
  descriptor_ = file.release();
}

DirectoryLock::~DirectoryLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

DirectoryLock::DirectoryLock(DirectoryLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

DirectoryLock& DirectoryLock::operator=(DirectoryLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

}  // namespace lucy::files
