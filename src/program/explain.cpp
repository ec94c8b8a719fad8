// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "lucy/files/input.hpp"
#include "program/commands.hpp"

namespace lucy::program {

int explain(const std::string& filter) {
  fmt::print("{}", files::explain_text(filter));
  return 0;
}

}  // namespace lucy::program
