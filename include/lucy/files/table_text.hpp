// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Results for people: numbers with their errors, and tables that fit a terminal of 120 columns.
#pragma once

#include <span>
#include <string>

#include "lucy/cases/comparison.hpp"
#include "lucy/cases/couette_table.hpp"

namespace lucy::files {

/// "13.52(14)": value and one standard error with two significant digits, plain decimals. The parenthesis is in units
/// of the value's last digit, or has a point of its own: "13.5(1.4)". "13.52(nan)" when the error is not known (four
/// significant digits of the value), "nan" when the value is not. "1.234(12)e-20" where the value would take more than
/// twelve characters and this is shorter.
std::string format_with_error(double value, double error);

/// A plain decimal with so many significant digits, trailing zeros dropped: 0.00451, never 4.51e-03; with an exponent
/// where it would take more than twelve characters, 1e-300.
std::string format_plain(double value, int significant_digits = 6);

/// The table of a sweep with a header, and below it how the errors were estimated, what the status words mean (only
/// those that occur) and why rows failed. Ends with a line feed.
std::string format_table(std::span<const cases::TableRow> rows);

/// Row by row ours, published, difference in combined standard errors; then the summary and the verdict in words.
std::string format_comparison(const cases::Comparison& comparison);

}  // namespace lucy::files
