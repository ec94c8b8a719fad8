// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rates of a fluid of smooth particles by double loops over all particles and images, in the tensor notation of
// Kum, Hoover and Posch, Phys. Rev. E 52, 4899 (1995), with grad_i w and laboratory velocities.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include "smooth_crowd.hpp"

namespace lucy::spam::testing {

template <int D>
struct SlowRates {
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  std::vector<double> density;
  std::vector<double> pressure;
  std::vector<double> temperature;
  std::vector<Matrix> velocity_gradient;  // d v_a/d x_b at (a, b)
  std::vector<Vector> temperature_gradient;
  std::vector<Vector> acceleration;
  std::vector<double> energy_rate;
  double virial_xy = 0.0;  // sum over pairs of f_x y
};

template <int D>
SlowRates<D> slow_rates(const Fluid<D>& fluid, const SmoothCrowd<D>& crowd) {
  using Vector = typename SlowRates<D>::Vector;
  using Matrix = typename SlowRates<D>::Matrix;
  const std::size_t n = crowd.position.size();
  const double range = kernel::range_of<D>(fluid.weight);
  const auto weight = [&](double r) { return std::visit([&](const auto& w) { return w.weight(r); }, fluid.weight); };
  const auto slope = [&](double r) { return std::visit([&](const auto& w) { return w.slope(r); }, fluid.weight); };

  // Every ordered pair of different particles, or of one and its own image.
  struct Pair {
    std::size_t i, j;
    Vector r;  // r_i - r_j
    Vector v;  // v_j - v_i
  };
  std::vector<Pair> ordered_pairs;
  pairs::testing::for_all_pairs<D>(
      crowd.box, crowd.position, 0.0, range,
      [&](std::size_t i, std::size_t j, const space::Vector<D>& apart, const space::ImageShift<D>& image) {
        Vector r;
        Vector v;
        for (int d = 0; d < D; ++d) {
          r[d] = apart[d];
          v[d] = crowd.velocity[j][d] + image.velocity[d] - crowd.velocity[i][d];
        }
        if constexpr (D > 1) v[0] += crowd.box.strain_rate() * (crowd.position[j][1] - crowd.position[i][1]);
        ordered_pairs.push_back({i, j, r, v});
        ordered_pairs.push_back({j, i, -r, -v});
      });

  SlowRates<D> slow;
  slow.density.assign(n, weight(0.0));
  for (const auto& [i, j, r, v] : ordered_pairs) slow.density[i] += weight(r.norm());
  const auto& rho = slow.density;
  for (std::size_t i = 0; i < n; ++i) {
    std::visit(
        [&](const auto& state) {
          slow.pressure.push_back(state.pressure(rho[i], crowd.energy[i]));
          slow.temperature.push_back(state.temperature(rho[i], crowd.energy[i]));
        },
        fluid.state);
  }

  slow.velocity_gradient.assign(n, Matrix::Zero());
  slow.temperature_gradient.assign(n, Vector::Zero());
  for (const auto& [i, j, r, v] : ordered_pairs) {
    const double mean = fluid.mean == DensityMean::geometric ? std::sqrt(rho[i] * rho[j]) : 0.5 * (rho[i] + rho[j]);
    const Vector gradient = -slope(r.norm()) * r;
    slow.velocity_gradient[i] += v * gradient.transpose() / mean;
    slow.temperature_gradient[i] += (slow.temperature[j] - slow.temperature[i]) * gradient / mean;
  }

  const auto [eta, bulk, kappa] = fluid.transport;
  std::vector<Matrix> stress;  // P/rho^2
  std::vector<Vector> flux;    // Q/rho^2
  for (std::size_t i = 0; i < n; ++i) {
    const Matrix& grad = slow.velocity_gradient[i];
    const double divergence = grad.trace();
    const Matrix traceless = grad + grad.transpose() - 2.0 / D * divergence * Matrix::Identity();
    stress.push_back(
        (slow.pressure[i] * Matrix::Identity() - eta * traceless - bulk * divergence * Matrix::Identity()) /
        (rho[i] * rho[i]));
    flux.push_back(-kappa * slow.temperature_gradient[i] / (rho[i] * rho[i]));
  }

  Vector gravity;
  for (int d = 0; d < D; ++d) gravity[d] = fluid.gravity[d];
  slow.acceleration.assign(n, gravity);
  slow.energy_rate.assign(n, 0.0);
  for (const auto& [i, j, r, v] : ordered_pairs) {
    const Vector gradient = -slope(r.norm()) * r;
    const Matrix both = stress[i] + stress[j];
    const Vector force = -both * gradient;
    slow.acceleration[i] += force;
    slow.energy_rate[i] -= 0.5 * (both.array() * (v * gradient.transpose()).array()).sum();
    slow.energy_rate[i] -= (flux[i] + flux[j]).dot(gradient);
    if constexpr (D > 1) slow.virial_xy += 0.5 * force[0] * r[1];
  }
  return slow;
}

}  // namespace lucy::spam::testing
