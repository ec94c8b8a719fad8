// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Isomorphism cases for people, at most 118 columns wide.
#pragma once

#include <span>
#include <string>

#include "lucy/cases/isomorphism_table.hpp"

namespace lucy::files {

/// "N = 1024, E/N = 1, rate 0.1: identical in every bit: 200000 steps x 1024 particles, 1229... comparisons of ...", or
/// where the first difference is, both values with 17 digits; why a case failed. Ends with a line feed.
std::string isomorphism_verdict(const cases::IsomorphismRow& row);

/// The verdict of every case; below it the means that were sampled, as atoms and as smooth particles side by side with
/// their errors. Then a line on each of these. Ends with a line feed.
std::string format_isomorphism(std::span<const cases::IsomorphismRow> rows);

}  // namespace lucy::files
