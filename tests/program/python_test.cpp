// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/python.hpp"

#include <gtest/gtest.h>

namespace lucy::program {
namespace {

TEST(FindPython, TakesTheFirstThatImportsEverything) {
  EXPECT_EQ(find_python({"/no/such/python", "/bin/false", "/usr/bin/python3"}, {"json", "math"}), "/usr/bin/python3");
  EXPECT_EQ(find_python({"/usr/bin/python3"}, {"json", "no_such_module_at_all"}), std::nullopt);
}

}  // namespace
}  // namespace lucy::program
