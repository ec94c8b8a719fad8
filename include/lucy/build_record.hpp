// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What this library was built from and with, for provenance records and `lucy --version`.
// The definitions are written by CMake into the build folder.
#pragma once

#include <string_view>

namespace lucy {

struct BuildRecord {
  std::string_view version;     ///< "0.1.0"
  std::string_view commit;      ///< full hash, "-modified" appended when compiled files differ from it; or "unknown"
  std::string_view compiler;    ///< "GNU 12.2.0"
  std::string_view flags;       ///< compiler options that decide the arithmetic
  std::string_view build_type;  ///< "Release"
};

BuildRecord build_record();

namespace detail {
extern const char* const commit;
}

}  // namespace lucy
