// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/measure/field_spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "lucy/errors.hpp"
#include "lucy/measure/fields.hpp"

namespace lucy::measure {
namespace {

constexpr double pi = std::numbers::pi;

/// f at the nodes of a grid.
template <class Function>
std::vector<double> on_grid(const Grid& grid, const Function& f) {
  const auto points = grid.points();
  std::vector<double> values;
  for (std::size_t k = 0; k < grid.size(); ++k) values.push_back(f(points[2 * k], points[2 * k + 1]));
  return values;
}

std::vector<SpectrumRing> rings_of(const Grid& grid, const std::vector<double>& values, double offset = 0.0) {
  FieldSpectrum spectrum(grid.nodes, grid.lengths);
  spectrum.add(values, offset);
  return spectrum.rings();
}

double total(const std::vector<SpectrumRing>& rings) {
  double sum = 0.0;
  for (const SpectrumRing& ring : rings) sum += ring.modes * ring.power;
  return sum;
}

/// Everything is in the ring of |k| and nowhere else.
void expect_only(const std::vector<SpectrumRing>& rings, double wave_number, double width, double variance) {
  for (const SpectrumRing& ring : rings) {
    const bool there = std::floor(ring.wave_number / width + 0.5) == std::floor(wave_number / width + 0.5);
    EXPECT_NEAR(ring.modes * ring.power, there ? variance : 0.0, 1e-13) << "|k| = " << ring.wave_number;
  }
}

TEST(FieldSpectrum, ASingleWaveIsInItsRingAlone) {
  const Grid grid{{24, 40}, {12.0, 10.0}};
  const double dk = 2.0 * pi / 12.0;
  for (const auto& [a, b] : {std::pair{1, 0}, {0, 1}, {3, -2}, {5, 7}, {-4, 4}}) {
    const double kx = 2.0 * pi * a / 12.0;
    const double ky = 2.0 * pi * b / 10.0;
    const auto wave = on_grid(grid, [&](double x, double y) { return 7.0 + 3.0 * std::cos(kx * x + ky * y + 0.4); });
    expect_only(rings_of(grid, wave), std::hypot(kx, ky), dk, 4.5);
  }
}

// In a box whose images slide, a wave fits when its phase is the same at (x + offset, y + L_y) and at (x, y).
TEST(FieldSpectrum, AWaveThatFitsTheTiltedBoxIsInItsRingAlone) {
  const Grid grid{{32, 24}, {12.0, 10.0}};
  const double dk = 2.0 * pi / 12.0;
  for (const double offset : {0.7, 5.9, 6.1, 11.3}) {
    for (const auto& [a, b] : {std::pair{1, 0}, {2, 1}, {3, 3}, {0, 2}, {4, -1}}) {
      const double kx = 2.0 * pi * a / 12.0;
      const double ky = 2.0 * pi * (b - a * offset / 12.0) / 10.0;
      const auto f = [&](double x, double y) { return 2.0 * std::sin(kx * x + ky * y - 1.1); };
      ASSERT_NEAR(f(3.3 + offset, 10.0 + 0.2), f(3.3, 0.2), 1e-12);
      expect_only(rings_of(grid, on_grid(grid, f), offset), std::hypot(kx, ky), dk, 2.0);
    }
  }
}

TEST(FieldSpectrum, ThePowersOfAllWavesAddUpToTheVariance) {
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal(3.0, 2.0);
  for (const Grid& grid : {Grid{{16, 16}, {8.0, 8.0}}, Grid{{15, 22}, {30.0, 8.0}}, Grid{{2, 7}, {3.0, 9.0}}}) {
    std::vector<double> noise(grid.size());
    for (double& value : noise) value = normal(generator);
    const double deviation = summary(noise).deviation;
    for (const double offset : {0.0, 1.7, -2.9}) {
      const auto rings = rings_of(grid, noise, offset);
      EXPECT_NEAR(total(rings), deviation * deviation, 1e-12 * deviation * deviation);
      double modes = 0.0;
      for (const SpectrumRing& ring : rings) modes += ring.modes;
      EXPECT_EQ(modes, static_cast<double>(grid.size() - 1));
    }
  }
}

TEST(FieldSpectrum, WhiteNoiseIsWhite) {
  const Grid grid{{64, 64}, {32.0, 32.0}};
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  FieldSpectrum spectrum(grid.nodes, grid.lengths);
  std::vector<double> noise(grid.size());
  constexpr int fields = 20;
  for (int i = 0; i < fields; ++i) {
    for (double& value : noise) value = normal(generator);
    spectrum.add(noise, 0.3 * i);
  }
  // |f_k|^2 is exponentially distributed, the same for k and -k: modes/2 independent values in each ring.
  for (const SpectrumRing& ring : spectrum.rings()) {
    const double expected = 1.0 / static_cast<double>(grid.size());
    EXPECT_NEAR(ring.power, expected, 4.0 * expected / std::sqrt(0.5 * fields * ring.modes)) << ring.wave_number;
  }
}

TEST(FieldSpectrum, SeveralSpectraAreAveraged) {
  const Grid grid{{16, 16}, {8.0, 8.0}};
  const auto wave = [&](double amplitude) {
    return on_grid(grid, [&](double x, double) { return amplitude * std::cos(2.0 * pi * x / 8.0); });
  };
  FieldSpectrum spectrum(grid.nodes, grid.lengths);
  EXPECT_TRUE(spectrum.rings().empty());
  spectrum.add(wave(1.0), 0.0);
  spectrum.add(wave(3.0), 0.0);
  EXPECT_NEAR(total(spectrum.rings()), 0.5 * (0.5 + 4.5), 1e-13);
  EXPECT_EQ(spectrum.rings().front().modes, 8.0);  // (1, 0), (0, 1), (1, 1) and their like
}

TEST(FieldSpectrum, AFieldThatIsNotKnownEverywhereHasNone) {
  const Grid grid{{4, 4}, {8.0, 8.0}};
  std::vector<double> values(16, 1.0);
  values[5] = std::numeric_limits<double>::quiet_NaN();
  for (const SpectrumRing& ring : rings_of(grid, values)) EXPECT_TRUE(std::isnan(ring.power));
}

TEST(FieldSpectrum, RefusesAGridOfOneRow) {
  EXPECT_THROW(FieldSpectrum({8, 1}, {8.0, 8.0}), BadInput);
  EXPECT_NEAR(FieldSpectrum({8, 16}, {8.0, 8.0}).whole_up_to(), pi, 1e-15);
}

}  // namespace
}  // namespace lucy::measure
