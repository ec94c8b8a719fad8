// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/data_directory.hpp"

#include <fmt/format.h>

#include <array>
#include <system_error>

#include "lucy/errors.hpp"

namespace lucy::program {

std::filesystem::path data_directory() {
  std::error_code error;  // a folder that cannot be looked at is a folder that is not there
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path installed = (program.parent_path() / LUCY_DATA_FROM_PROGRAM).lexically_normal();
  const std::filesystem::path source = LUCY_SOURCE_DIRECTORY;
  for (const auto& candidate : std::array{installed, source})
    if (std::filesystem::is_directory(candidate / "reference", error)) return candidate;
  throw RunFailed(
      fmt::format("Lucy's own data (analysis, reference, inputs) are neither in {} nor in {}: install again",
                  installed.string(), source.string()));
}

}  // namespace lucy::program
