// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "program/commands.hpp"

namespace lucy::program {

int explain(const std::string& filter, files::InputKind kind) {
  fmt::print("{}", files::explain(files::schema_of(kind), filter));
  return 0;
}

}  // namespace lucy::program
