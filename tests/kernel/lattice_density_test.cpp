// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// W. G. Hoover and C. G. Hoover, "SPAM-based recipes for continuum simulations" (2001), exercise: the least and the
// greatest density of a regular lattice of unit spacing over all positions, for Lucy's weight function. In two
// dimensions they are not always at a particle or at the centre of a cell: the whole cell is scanned.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lucy/kernel/lucy.hpp"

namespace lucy::kernel {
namespace {

using Point = std::array<double, 2>;

double chain_density(const Lucy<1>& kernel, const Point& at) {
  double density = 0.0;
  for (int site = -7; site <= 7; ++site) density += kernel.weight(std::min(std::abs(site - at[0]), kernel.range()));
  return density;
}

double square_lattice_density(const Lucy<2>& kernel, const Point& at) {
  double density = 0.0;
  for (int a = -7; a <= 7; ++a) {
    for (int b = -7; b <= 7; ++b) density += kernel.weight(std::min(std::hypot(a - at[0], b - at[1]), kernel.range()));
  }
  return density;
}

/// The greatest value in the quarter of a cell next to a particle, by scans that close in on it; 1D: along x alone.
template <class Density>
double greatest(bool plane, const Density& density) {
  constexpr int cuts = 24;
  Point centre = {0.25, 0.25};
  double half_width = 0.25;
  double best = density(centre);
  for (int closer = 0; closer < 4; ++closer) {
    const Point middle = centre;
    for (int i = -cuts; i <= cuts; ++i) {
      for (int j = plane ? -cuts : 0; j <= (plane ? cuts : 0); ++j) {
        const Point at = {middle[0] + half_width * i / cuts, middle[1] + half_width * j / cuts};
        const double here = density(at);
        if (here <= best) continue;
        best = here;
        centre = at;
      }
    }
    half_width /= 8.0;
  }
  return best;
}

struct Row {
  double range, least, greatest;
};
constexpr double last_digit = 0.51e-6;

TEST(LatticeDensity, OfAChainIsAsTabulated) {
  for (const Row& row : {Row{1.5, .987654, 1.018519},
                         {2, .986328, 1.015625},
                         {3, .997299, 1.003086},
                         {4, .999146, 1.000977},
                         {5, .999650, 1.000400},
                         {6, .999831, 1.000193}}) {
    const Lucy<1> kernel(row.range);
    EXPECT_NEAR(greatest(false, [&](const Point& at) { return chain_density(kernel, at); }), row.greatest, last_digit)
        << "h = " << row.range;
    EXPECT_NEAR(-greatest(false, [&](const Point& at) { return -chain_density(kernel, at); }), row.least, last_digit)
        << "h = " << row.range;
  }
}

TEST(LatticeDensity, OfASquareLatticeIsAsTabulated) {
  for (const Row& row : {Row{1.5, .989534, 1.023762},
                         {2, .984568, 1.020067},
                         {3, .998033, 1.002930},
                         {4, .999366, 1.000633},
                         {5, .999835, 1.000277},
                         {6, .999914, 1.000090}}) {
    const Lucy<2> kernel(row.range);
    EXPECT_NEAR(greatest(true, [&](const Point& at) { return square_lattice_density(kernel, at); }), row.greatest,
                last_digit)
        << "h = " << row.range;
    EXPECT_NEAR(-greatest(true, [&](const Point& at) { return -square_lattice_density(kernel, at); }), row.least,
                last_digit)
        << "h = " << row.range;
  }
}

}  // namespace
}  // namespace lucy::kernel
