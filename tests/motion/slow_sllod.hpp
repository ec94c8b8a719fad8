// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An independent integrator to test against: SLLOD with sums over all images, RK4 on plain vectors, images placed by
// the strain itself. It shares no code with the library but the weight function.
#pragma once

#include <cmath>
#include <vector>

#include "lucy/kernel/lucy.hpp"
#include "lucy/motion/settings.hpp"
#include "lucy/motion/start.hpp"

namespace lucy::motion::testing {

struct SlowState {
  std::vector<double> y;  // x, y, p_x, p_y of every particle, then the Nose-Hoover friction
  double time = 0.0;
};

struct SlowSllod {
  kernel::Lucy<2> kernel;
  space::Vector<2> lengths;
  double rate;
  Thermostat thermostat = Thermostat::isoenergetic;
  double target_kinetic = 0.0;
  double tau = 1.0;

  SlowState start(const Start<2>& from) const {
    SlowState state;
    for (std::size_t i = 0; i < from.position.size(); ++i) {
      for (double value : {from.position[i][0], from.position[i][1], from.momentum[i][0], from.momentum[i][1]}) {
        state.y.push_back(value);
      }
    }
    state.y.push_back(0.0);
    return state;
  }

  // Forces, and as the last three entries: Phi, virial xy, K.
  std::vector<double> forces(const std::vector<double>& y, double time) const {
    const std::size_t n = y.size() / 4;
    std::vector<double> f(2 * n + 3, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double rows = std::round((y[4 * i + 1] - y[4 * j + 1]) / lengths[1]);
        const double dy = y[4 * i + 1] - y[4 * j + 1] - rows * lengths[1];
        double dx = y[4 * i] - y[4 * j] - rows * rate * lengths[1] * time;
        dx -= std::round(dx / lengths[0]) * lengths[0];
        const double r = std::hypot(dx, dy);
        if (r >= kernel.range()) continue;
        const double slope = kernel.slope(r);
        f[2 * i] += slope * dx;
        f[2 * i + 1] += slope * dy;
        f[2 * j] -= slope * dx;
        f[2 * j + 1] -= slope * dy;
        f[2 * n] += kernel.weight(r);
        f[2 * n + 1] += slope * dx * dy;
      }
      f[2 * n + 2] += 0.5 * (y[4 * i + 2] * y[4 * i + 2] + y[4 * i + 3] * y[4 * i + 3]);
    }
    return f;
  }

  std::vector<double> rates(const std::vector<double>& y, double time) const {
    const std::size_t n = y.size() / 4;
    const auto f = forces(y, time);
    double p_xy = 0.0;
    double power = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      p_xy += y[4 * i + 2] * y[4 * i + 3];
      power += f[2 * i] * y[4 * i + 2] + f[2 * i + 1] * y[4 * i + 3];
    }
    const double kinetic = f[2 * n + 2];
    double zeta = 0.0;
    if (thermostat == Thermostat::isoenergetic) zeta = -rate * (p_xy + f[2 * n + 1]) / (2.0 * kinetic);
    if (thermostat == Thermostat::isokinetic) zeta = (power - rate * p_xy) / (2.0 * kinetic);
    if (thermostat == Thermostat::nose_hoover) zeta = y.back();
    std::vector<double> k(y.size());
    for (std::size_t i = 0; i < n; ++i) {
      k[4 * i] = y[4 * i + 2] + rate * y[4 * i + 1];
      k[4 * i + 1] = y[4 * i + 3];
      k[4 * i + 2] = f[2 * i] - rate * y[4 * i + 3] - zeta * y[4 * i + 2];
      k[4 * i + 3] = f[2 * i + 1] - zeta * y[4 * i + 3];
    }
    k.back() = thermostat == Thermostat::nose_hoover ? (kinetic / target_kinetic - 1.0) / (tau * tau) : 0.0;
    return k;
  }

  void step(SlowState& state, double dt) const {
    const auto shifted = [&](const std::vector<double>& k, double factor) {
      std::vector<double> moved = state.y;
      for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += factor * k[i];
      return moved;
    };
    const auto k1 = rates(state.y, state.time);
    const auto k2 = rates(shifted(k1, dt / 2.0), state.time + dt / 2.0);
    const auto k3 = rates(shifted(k2, dt / 2.0), state.time + dt / 2.0);
    const auto k4 = rates(shifted(k3, dt), state.time + dt);
    for (std::size_t i = 0; i < state.y.size(); ++i) state.y[i] += dt / 6.0 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    state.time += dt;
  }
};

}  // namespace lucy::motion::testing
