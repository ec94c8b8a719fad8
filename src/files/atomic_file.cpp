// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/atomic_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <array>
#include <cstdio>

#include "file_descriptor.hpp"
#include "lucy/errors.hpp"

namespace lucy::files {

namespace {

/// Removes the temporary unless the work was finished, and tells why it was not.
class Attempt {
 public:
  Attempt(std::filesystem::path temporary, const std::filesystem::path& path)
      : temporary_(std::move(temporary)), path_(path) {}
  ~Attempt() {
    if (!done_) ::unlink(temporary_.c_str());
  }
  Attempt(const Attempt&) = delete;
  Attempt& operator=(const Attempt&) = delete;

  [[noreturn]] void fail() const {
    const int reason = errno;
    throw RunFailed(
        fmt::format("cannot write {}: {} (earlier files are untouched)", path_.string(), system_reason(reason)));
  }
  void finish() { done_ = true; }

 private:
  std::filesystem::path temporary_;
  const std::filesystem::path& path_;
  bool done_ = false;
};

/// The new name itself must survive a power failure; a file system that cannot promise it is no reason to stop.
void synchronise_folder_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const FileDescriptor directory(folder.string(), O_RDONLY | O_DIRECTORY);
  if (directory.is_open()) ::fsync(directory.number());
}

}  // namespace

std::filesystem::path temporary_beside(const std::filesystem::path& path) {
  return path.parent_path() / fmt::format(".{}.tmp", path.filename().string());
}

void write_file_atomically(const std::filesystem::path& path, std::span<const std::span<const std::byte>> pieces) {
  const std::filesystem::path temporary = temporary_beside(path);
  Attempt attempt(temporary, path);
  FileDescriptor file(temporary.string(), O_WRONLY | O_CREAT | O_TRUNC);
  if (!file.is_open()) attempt.fail();
  for (const auto piece : pieces)
    if (!write_all(file.number(), piece)) attempt.fail();
  if (::fsync(file.number()) != 0 || !file.close()) attempt.fail();
  if (std::rename(temporary.c_str(), path.c_str()) != 0) attempt.fail();
  attempt.finish();
  synchronise_folder_of(path);
}

void write_file_atomically(const std::filesystem::path& path, std::string_view text) {
  const std::array<std::span<const std::byte>, 1> pieces = {std::as_bytes(std::span(text))};
  write_file_atomically(path, pieces);
}

std::string read_text_file(const std::filesystem::path& path) {
  const FileDescriptor file(path.string(), O_RDONLY | O_NONBLOCK);
  if (!file.is_open()) throw BadInput(fmt::format("cannot read {}: {}", path.string(), system_reason(errno)));
  struct stat status {};
  if (::fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode))
    throw BadInput(fmt::format("cannot read {}: it is not a regular file", path.string()));
  std::string text;
  std::array<char, 65536> part;
  for (;;) {
    const ssize_t got = ::read(file.number(), part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw BadInput(fmt::format("cannot read {}: {}", path.string(), system_reason(errno)));
    if (got == 0) return text;
    text.append(part.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace lucy::files
