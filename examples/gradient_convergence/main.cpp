// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How well smooth particles know a gradient: the relative root-mean-square error of grad T, T = 1 + sin(2 pi x/L)/2,
// at the particles of square boxes. Lattice of unit spacing, with random offsets up to 0, 0.1 or 0.3 along each axis.
// The first table goes through h (in spacings) and L/h, the second lets h grow with the number of particles.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <lucy/motion/fluid_trajectory.hpp>
#include <numbers>
#include <random>
#include <string>

namespace {

using lucy::kernel::WeightName;

/// A box of side L whose energies, which are the temperatures of an ideal gas, are the wave.
lucy::motion::FluidStart<2> wave(int side, double offset) {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> uniform(-offset, offset);
  lucy::motion::FluidStart<2> start;
  start.lengths = {static_cast<double>(side), static_cast<double>(side)};
  for (int site = 0; site < side * side; ++site) {
    const double x = site % side + 0.5 + uniform(generator);
    const double y = site / side + 0.5 + uniform(generator);
    start.position.push_back({x, y});
    start.velocity.push_back({0.0, 0.0});
    start.energy.push_back(1.0 + 0.5 * std::sin(2.0 * std::numbers::pi * x / side));
  }
  return start;
}

double relative_error(WeightName weight, double range, int side, double offset) {
  const lucy::spam::Fluid<2> fluid{lucy::kernel::make_weight<2>(weight, range),
                                   lucy::spam::IdealGas(),
                                   {.viscosity = 0.0, .bulk_viscosity = 0.0, .conductivity = 1.0},
                                   lucy::spam::DensityMean::geometric,
                                   {}};
  const auto start = wave(side, offset);
  const lucy::motion::FluidTrajectory<2> trajectory(fluid, start, 0.0, lucy::motion::Cooling::none, {}, lucy::Team(1));
  const auto gradients = trajectory.gradients();  // per particle: four of velocity, two of temperature
  const double k = 2.0 * std::numbers::pi / side;
  double error = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < start.position.size(); ++i) {
    const double truth = 0.5 * k * std::cos(k * start.position[i][0]);
    error += std::pow(gradients[6 * i + 4] - truth, 2) + std::pow(gradients[6 * i + 5], 2);
    size += truth * truth;
  }
  return std::sqrt(error / size);
}

/// The errors of both weights from all starts, as cells of a row.
std::string cells(double range, int side) {
  std::string row;
  for (const WeightName weight : {WeightName::lucy, WeightName::monaghan}) {
    for (const double offset : {0.0, 0.1, 0.3})
      row += fmt::format(" {:.5f} |", relative_error(weight, range, side, offset));
  }
  return row;
}

constexpr const char* starts =
    " Lucy, lattice | offsets 0.1 | offsets 0.3 | Monaghan, lattice | offsets 0.1 | offsets 0.3 |";

}  // namespace

int main() {
  fmt::print("| h | L/h |{}\n|---|---|---|---|---|---|---|---|\n", starts);
  for (const double range : {2.0, 2.5, 3.0, 4.0, 5.0, 6.0}) {
    for (const int lengths : {8, 16, 32})
      fmt::print("| {} | {} |{}\n", range, lengths, cells(range, static_cast<int>(std::lround(range * lengths))));
  }
  fmt::print("\n| N | h | L/h |{}\n|---|---|---|---|---|---|---|---|---|\n", starts);
  for (const int range : {2, 3, 4, 5, 6, 8}) {
    const int side = 4 * range * range;
    fmt::print("| {} | {} | {} |{}\n", side * side, range, 4 * range, cells(range, side));
  }
}
