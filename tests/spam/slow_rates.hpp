// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rates of a fluid of smooth particles by double loops over all particles and images, in the tensor notation of
// Kum, Hoover and Posch, Phys. Rev. E 52, 4899 (1995), with grad_i w and laboratory velocities: in a periodic box, or
// in a cell between walls, where what stands for them is numbered after the particles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include "lucy/space/walls.hpp"
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
  std::vector<double> viscous_entropy;  // produced, by particle
  std::vector<double> conducted_entropy;
  double virial_xy = 0.0;  // sum over pairs of f_x y
  std::array<WallExchange, 2 * D> exchange{};
};

/// What stands for a wall.
struct SlowWallParticle {
  static constexpr std::size_t no_parent = ~std::size_t{0};
  std::size_t parent;  // whose image it is
  int wall;
  double temperature;
};

/// One of two different places, or of a particle and its own periodic image, as the other is seen from it.
template <int D>
struct SlowPair {
  std::size_t i, j;
  Eigen::Matrix<double, D, 1> r;    // r_i - r_j
  Eigen::Matrix<double, D, 1> v;    // v_j - v_i
  Eigen::Matrix<double, D, 1> sum;  // v_i + v_j
};

/// Every ordered pair closer than the range must be there. Rates are those of the particles; densities, stresses and
/// fluxes of boundary particles are their own, those of mirror images their parents'.
template <int D>
SlowRates<D> slow_rates_of_pairs(const Fluid<D>& fluid, const std::vector<double>& energy,
                                 const std::vector<SlowWallParticle>& walls,
                                 const std::vector<SlowPair<D>>& ordered_pairs) {
  using Vector = typename SlowRates<D>::Vector;
  using Matrix = typename SlowRates<D>::Matrix;
  const std::size_t n = energy.size();
  const std::size_t places = n + walls.size();
  const auto weight = [&](double r) { return std::visit([&](const auto& w) { return w.weight(r); }, fluid.weight); };
  const auto slope = [&](double r) { return std::visit([&](const auto& w) { return w.slope(r); }, fluid.weight); };
  const auto copy_to_images = [&](auto& values) {
    for (std::size_t k = 0; k < walls.size(); ++k)
      if (walls[k].parent != SlowWallParticle::no_parent) values[n + k] = values[walls[k].parent];
  };

  SlowRates<D> slow;
  slow.density.assign(places, weight(0.0));
  for (const auto& pair : ordered_pairs) slow.density[pair.i] += weight(pair.r.norm());
  copy_to_images(slow.density);
  const auto& rho = slow.density;
  for (std::size_t i = 0; i < places; ++i) {
    std::visit(
        [&](const auto& state) {
          const double e = i < n ? energy[i] : state.energy(rho[i], walls[i - n].temperature);
          slow.pressure.push_back(state.pressure(rho[i], e));
          slow.temperature.push_back(i < n ? state.temperature(rho[i], e) : walls[i - n].temperature);
        },
        fluid.state);
  }
  copy_to_images(slow.pressure);

  slow.velocity_gradient.assign(places, Matrix::Zero());
  slow.temperature_gradient.assign(places, Vector::Zero());
  for (const auto& [i, j, r, v, sum] : ordered_pairs) {
    const double mean = fluid.mean == DensityMean::geometric ? std::sqrt(rho[i] * rho[j]) : 0.5 * (rho[i] + rho[j]);
    const Vector gradient = -slope(r.norm()) * r;
    slow.velocity_gradient[i] += v * gradient.transpose() / mean;
    slow.temperature_gradient[i] += (slow.temperature[j] - slow.temperature[i]) * gradient / mean;
  }
  copy_to_images(slow.velocity_gradient);
  copy_to_images(slow.temperature_gradient);

  const auto [eta, bulk, kappa] = fluid.transport;
  std::vector<Matrix> viscous;  // of P/rho^2
  std::vector<Matrix> stress;   // P/rho^2
  std::vector<Vector> flux;     // Q/rho^2
  for (std::size_t i = 0; i < places; ++i) {
    const Matrix& grad = slow.velocity_gradient[i];
    const double divergence = grad.trace();
    const Matrix traceless = grad + grad.transpose() - 2.0 / D * divergence * Matrix::Identity();
    const double square = rho[i] * rho[i];
    viscous.push_back((-eta * traceless - bulk * divergence * Matrix::Identity()) / square);
    stress.push_back(viscous[i] + slow.pressure[i] / square * Matrix::Identity());
    flux.push_back(-kappa * slow.temperature_gradient[i] / square);
  }

  Vector gravity;
  for (int d = 0; d < D; ++d) gravity[d] = fluid.gravity[d];
  slow.acceleration.assign(n, gravity);
  slow.energy_rate.assign(n, 0.0);
  slow.viscous_entropy.assign(n, 0.0);
  slow.conducted_entropy.assign(n, 0.0);
  for (const auto& [i, j, r, v, sum] : ordered_pairs) {
    if (i >= n) continue;
    const Vector gradient = -slope(r.norm()) * r;
    const Matrix both = stress[i] + stress[j];
    const Vector force = -both * gradient;
    const double heat = -(flux[i] + flux[j]).dot(gradient);
    slow.acceleration[i] += force;
    slow.energy_rate[i] -= 0.5 * (both.array() * (v * gradient.transpose()).array()).sum();
    slow.energy_rate[i] += heat;
    slow.viscous_entropy[i] -= 0.5 * v.dot((viscous[i] + viscous[j]) * gradient) / slow.temperature[i];
    slow.conducted_entropy[i] += 0.5 * heat * (1.0 / slow.temperature[i] - 1.0 / slow.temperature[j]);
    if constexpr (D > 1) slow.virial_xy += 0.5 * force[0] * r[1];
    if (j < n) continue;
    WallExchange& exchange = slow.exchange[static_cast<std::size_t>(walls[j - n].wall)];
    exchange.conduction += heat;
    exchange.work += 0.5 * force.dot(sum);
  }
  return slow;
}

template <int D>
SlowRates<D> slow_rates(const Fluid<D>& fluid, const SmoothCrowd<D>& crowd) {
  using Vector = typename SlowRates<D>::Vector;
  std::vector<SlowPair<D>> ordered_pairs;
  pairs::testing::for_all_pairs<D>(
      crowd.box, crowd.position, 0.0, kernel::range_of<D>(fluid.weight),
      [&](std::size_t i, std::size_t j, const space::Vector<D>& apart, const space::ImageShift<D>& image) {
        Vector r;
        Vector v;
        for (int d = 0; d < D; ++d) {
          r[d] = apart[d];
          v[d] = crowd.velocity[j][d] + image.velocity[d] - crowd.velocity[i][d];
        }
        if constexpr (D > 1) v[0] += crowd.box.strain_rate() * (crowd.position[j][1] - crowd.position[i][1]);
        ordered_pairs.push_back({i, j, r, v, Vector::Zero()});
        ordered_pairs.push_back({j, i, -r, -v, Vector::Zero()});
      });
  return slow_rates_of_pairs<D>(fluid, crowd.energy, {}, ordered_pairs);
}

/// Particles in a cell between walls, from its lowest corner.
template <int D>
struct WalledCrowd {
  space::Vector<D> lengths{};
  space::Walls<D> walls;
  double time = 0.0;  // for which boundary particles have moved
  std::vector<space::Vector<D>> position;
  std::vector<space::Vector<D>> velocity;
  std::vector<double> energy;
};

/// With those places appended that stand for walls.
template <int D>
struct WalledPlaces {
  std::vector<space::Vector<D>> position;
  std::vector<space::Vector<D>> velocity;
  std::vector<SlowWallParticle> walls;
};

/// All images of all particles that are nearer than the range to the wall, or boundary particles at unit spacing in a
/// cell of whole-numbered lengths.
template <int D>
WalledPlaces<D> places_between_walls(const WalledCrowd<D>& crowd, double range) {
  WalledPlaces<D> places{crowd.position, crowd.velocity, {}};
  const auto append = [&](space::Vector<D> position, std::size_t parent, int wall) {
    const space::Wall<D>& belongs_to = (*crowd.walls.across[static_cast<std::size_t>(wall / 2)])[wall % 2 ? 1 : 0];
    if (parent == SlowWallParticle::no_parent)
      for (int d = 0; d < D; ++d) position[d] += crowd.time * belongs_to.velocity[d];
    places.position.push_back(position);
    places.velocity.push_back(belongs_to.velocity);
    places.walls.push_back({parent, wall, belongs_to.temperature_at(position)});
  };
  // Of several walls that a place is behind, it belongs to the one across the last axis.
  const auto wall_of = [&](const space::Vector<D>& position) {
    int wall = -1;
    for (int d = 0; d < D; ++d) {
      if (!crowd.walls.across[d]) continue;
      if (position[d] < 0.0) wall = 2 * d;
      if (position[d] > crowd.lengths[d]) wall = 2 * d + 1;
    }
    return wall;
  };
  if (crowd.walls.kind == space::WallKind::mirror_images) {
    for (std::size_t i = 0; i < crowd.position.size(); ++i) {
      std::vector<space::Vector<D>> images{crowd.position[i]};
      for (int d = 0; d < D; ++d) {
        if (!crowd.walls.across[d]) continue;
        for (std::size_t k = images.size(); k-- > 0;) {
          for (const double wall : {0.0, crowd.lengths[d]}) {
            space::Vector<D> image = images[k];
            image[d] = 2.0 * wall - image[d];
            if (std::abs(image[d] - wall) < range) images.push_back(image);
          }
        }
      }
      for (std::size_t k = 1; k < images.size(); ++k) append(images[k], i, wall_of(images[k]));
    }
    return places;
  }
  const int rows = static_cast<int>(std::ceil(range));
  space::Vector<D> site;
  const auto stand = [&](const auto& self, int d) -> void {
    if (d == D) {
      const int wall = wall_of(site);
      if (wall < 0) return;
      append(site, SlowWallParticle::no_parent, wall);
      return;
    }
    const int behind = crowd.walls.across[d] ? rows : 0;
    for (int k = -behind; k < std::lround(crowd.lengths[d]) + behind; ++k) {
      site[d] = k + 0.5;
      self(self, d + 1);
    }
  };
  stand(stand, 0);
  return places;
}

template <int D>
SlowRates<D> slow_rates_between_walls(const Fluid<D>& fluid, const WalledCrowd<D>& crowd) {
  using Vector = typename SlowRates<D>::Vector;
  const double range = kernel::range_of<D>(fluid.weight);
  const WalledPlaces<D> places = places_between_walls<D>(crowd, range);
  std::vector<SlowPair<D>> ordered_pairs;
  // Nearest images along periodic axes, which are longer than twice the range.
  for (std::size_t i = 0; i < places.position.size(); ++i) {
    for (std::size_t j = 0; j < places.position.size(); ++j) {
      if (i == j) continue;
      SlowPair<D> pair{i, j, Vector::Zero(), Vector::Zero(), Vector::Zero()};
      for (int d = 0; d < D; ++d) {
        pair.r[d] = places.position[i][d] - places.position[j][d];
        if (!crowd.walls.across[d]) pair.r[d] -= std::round(pair.r[d] / crowd.lengths[d]) * crowd.lengths[d];
        pair.v[d] = places.velocity[j][d] - places.velocity[i][d];
        pair.sum[d] = places.velocity[j][d] + places.velocity[i][d];
      }
      if (pair.r.norm() < range) ordered_pairs.push_back(pair);
    }
  }
  return slow_rates_of_pairs<D>(fluid, crowd.energy, places.walls, ordered_pairs);
}

}  // namespace lucy::spam::testing
