// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every finished file appears whole or not at all: written to a temporary beside it, forced to disk, renamed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace lucy::files {

/// The name under which `path` is prepared: same folder, ".NAME.tmp". One left behind by a killed program is
/// overwritten by the next attempt.
std::filesystem::path temporary_beside(const std::filesystem::path& path);

/// Puts `text` under `path`, replacing what was there in one step. Throws RunFailed with path and reason (disk full,
/// no permission); the old file is then untouched and the temporary removed.
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

/// The same for several pieces written one after the other.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::span<const std::byte>> pieces);

/// The whole file. Throws BadInput when it cannot be opened, is not a regular file, or cannot be read.
std::string read_text_file(const std::filesystem::path& path);

}  // namespace lucy::files
