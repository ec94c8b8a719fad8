// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A symmetric tensor without what it says twice: its lower triangle by rows (xx, yx, yy, zx, zy, zz).
#pragma once

namespace lucy::space {

/// Components of a symmetric tensor.
template <int D>
inline constexpr int triangle = D*(D + 1) / 2;

/// Where component ab, or ba, stands.
constexpr int in_triangle(int a, int b) { return a >= b ? a * (a + 1) / 2 + b : b * (b + 1) / 2 + a; }

}  // namespace lucy::space
