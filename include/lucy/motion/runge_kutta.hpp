// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The classic fourth-order Runge-Kutta method for y' = f(t, y), knowing nothing of what y is:
//
//     y(t + dt) = y + (dt/6) (k1 + 2 k2 + 2 k3 + k4)
//     k1 = f(t, y)   k2 = f(t + dt/2, y + dt k1/2)   k3 = f(t + dt/2, y + dt k2/2)   k4 = f(t + dt, y + dt k3)
//
// y is a set of columns, one row per slot, and a few numbers more. The rate comes in two parts: `prepare` does what
// needs all rows at once (pair sums, thermostats), then `rate` is asked for a chunk of rows at a time, small enough to
// stay in the first-level cache between its computation and its use.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "lucy/space/columns.hpp"
#include "lucy/team.hpp"

namespace lucy::motion {

inline constexpr std::size_t chunk_slots = 256;

/// What an integrator advances.
template <std::size_t numbers_count>
struct Phase {
  space::Columns columns;
  std::array<double, numbers_count> numbers{};
};

/// Rates of one chunk, column by column.
template <int columns>
using ChunkRates = std::array<std::array<double, chunk_slots>, columns>;

/// Writes y(t + dt) to `next`, leaving `now` as it is; `sum` is scratch of the same shape. The System has
///
///     static constexpr int columns;
///     void prepare(const Phase& at, double time)         whole-system part of f(time, at)
///     void rate(const Columns& at, size_t begin, size_t count, ChunkRates<columns>& k) const
///     std::array<double, numbers> number_rates() const
///
/// prepare(now, time) must have been called; the last call made here is for the fourth stage.
template <class System, std::size_t numbers_count>
void runge_kutta_4(System& system, const Phase<numbers_count>& now, double time, double dt, std::size_t slots,
                   Phase<numbers_count>& next, space::Columns& sum, const Team& team) {
  constexpr int columns = System::columns;
  const auto chunks = static_cast<std::ptrdiff_t>((slots + chunk_slots - 1) / chunk_slots);
  std::array<double, numbers_count> number_sum{};

  struct Stage {
    double weight;  // of this k in the final sum
    double ahead;   // of the next stage, in units of dt
  };
  constexpr std::array<Stage, 4> stages = {{{1.0, 0.5}, {2.0, 0.5}, {2.0, 1.0}, {1.0, 0.0}}};

  for (int s = 0; s < 4; ++s) {
    const Phase<numbers_count>& at = s == 0 ? now : next;
    const double weight = stages[s].weight;
    const double ahead = stages[s].ahead * dt;
    const auto number_rates = system.number_rates();
    team.share(chunks, [&](std::ptrdiff_t chunk) {
      const std::size_t begin = static_cast<std::size_t>(chunk) * chunk_slots;
      const std::size_t count = std::min(chunk_slots, slots - begin);
      ChunkRates<columns> k;
      system.rate(at.columns, begin, count, k);
      for (int c = 0; c < columns; ++c) {
        const double* const y = now.columns[c] + begin;
        double* const out = next.columns[c] + begin;
        double* const total = sum[c] + begin;
        const double* const rate = k[c].data();
        if (s == 0) {
          for (std::size_t i = 0; i < count; ++i) total[i] = rate[i];
        } else if (s < 3) {
          for (std::size_t i = 0; i < count; ++i) total[i] = std::fma(weight, rate[i], total[i]);
        }
        if (s < 3) {
          for (std::size_t i = 0; i < count; ++i) out[i] = std::fma(ahead, rate[i], y[i]);
        } else {
          for (std::size_t i = 0; i < count; ++i) out[i] = std::fma(dt / 6.0, total[i] + rate[i], y[i]);
        }
      }
    });
    for (std::size_t n = 0; n < numbers_count; ++n) {
      number_sum[n] += weight * number_rates[n];
      next.numbers[n] = s < 3 ? now.numbers[n] + ahead * number_rates[n] : now.numbers[n] + dt / 6.0 * number_sum[n];
    }
    if (s < 3) system.prepare(next, time + ahead);
  }
}

}  // namespace lucy::motion
