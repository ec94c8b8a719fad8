// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "lucy/files/green_kubo_input.hpp"
#include "lucy/files/input.hpp"
#include "program/commands.hpp"

namespace lucy::program {

int explain(const std::string& filter, InputKind kind) {
  fmt::print("{}", kind == InputKind::sweep ? files::explain_text(filter) : files::explain_green_kubo(filter));
  return 0;
}

}  // namespace lucy::program
