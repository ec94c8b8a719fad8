// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Test particles in a sheared box, and sums over all their pairs and images the slow way.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "lucy/pairs/cluster_list.hpp"
#include "lucy/space/box.hpp"
#include "lucy/space/columns.hpp"

namespace lucy::pairs::testing {

template <int D>
struct Crowd {
  space::Box<D> box;
  std::vector<space::Vector<D>> position;  // by particle number
  std::vector<space::Vector<D>> velocity;  // peculiar

  static Crowd random(int particles, const space::Box<D>& box, double speed, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    std::uniform_real_distribution<double> uniform;
    std::normal_distribution<double> normal;
    Crowd crowd{box, {}, {}};
    for (int i = 0; i < particles; ++i) {
      space::Vector<D> r;
      space::Vector<D> v;
      for (int d = 0; d < D; ++d) {
        r[d] = uniform(generator) * box.lengths()[d];
        v[d] = speed * normal(generator);
      }
      crowd.position.push_back(r);
      crowd.velocity.push_back(v);
    }
    return crowd;
  }

  double fastest() const {
    double largest = 0.0;
    for (const auto& v : velocity) {
      double square = 0.0;
      for (double component : v) square += component * component;
      largest = std::max(largest, square);
    }
    return std::sqrt(largest);
  }

  // Root mean square of a component.
  double typical() const {
    double sum = 0.0;
    for (const auto& v : velocity) {
      for (double component : v) sum += component * component;
    }
    return std::sqrt(sum / (D * static_cast<double>(velocity.size())));
  }

  // Along straight laboratory lines, u_x = rate y at the start.
  space::Vector<D> position_at(std::size_t i, double age) const {
    space::Vector<D> r = position[i];
    for (int d = 0; d < D; ++d) r[d] += velocity[i][d] * age;
    if constexpr (D > 1) r[0] += box.strain_rate() * position[i][1] * age;
    return r;
  }
};

// visit(i, j, displacement r_i - r_j - image, image numbers) for every pair i < j (and i == j with its own images, once
// for each of two opposite images) closer than `range`, with images up to three boxes away.
template <int D, class Visit>
void for_all_pairs(const space::Box<D>& box, const std::vector<space::Vector<D>>& position, double age, double range,
                   const Visit& visit) {
  constexpr int reach = 3;
  const int images = D == 1 ? 7 : D == 2 ? 49 : 343;
  for (std::size_t i = 0; i < position.size(); ++i) {
    for (std::size_t j = i; j < position.size(); ++j) {
      for (int code = 0; code < images; ++code) {
        std::array<int, D> n{};
        for (int d = 0, rest = code; d < D; ++d, rest /= 7) n[d] = rest % 7 - reach;
        if (i == j && code >= images / 2) continue;  // opposite images, and the particle itself
        const auto shift = box.image(n, age);
        space::Vector<D> apart;
        double squared = 0.0;
        for (int d = 0; d < D; ++d) {
          apart[d] = position[i][d] - position[j][d] - shift.position[d];
          squared += apart[d] * apart[d];
        }
        if (squared < range * range) visit(i, j, apart, shift);
      }
    }
  }
}

// The crowd arranged into the slots of a list.
template <int D>
struct Arranged {
  ClusterList<D> list;
  space::Columns position;
  space::Columns velocity;
  std::vector<std::int32_t> number;

  explicit Arranged(const Crowd<D>& crowd)
      : list(static_cast<std::int64_t>(crowd.position.size()), crowd.box.lengths()),
        position(D, list.capacity()),
        velocity(D, list.capacity()) {
    const std::size_t count = crowd.position.size();
    std::vector<std::int32_t> old(count);
    for (std::size_t i = 0; i < count; ++i) {
      old[i] = static_cast<std::int32_t>(i);
      for (int d = 0; d < D; ++d) position[d][i] = crowd.position[i][d];
    }
    const auto order = list.arrange(pointers(position), old);
    number.assign(order.begin(), order.end());
    move_to(crowd, 0.0);
  }

  void move_to(const Crowd<D>& crowd, double age) {
    for (std::size_t slot = 0; slot < number.size(); ++slot) {
      const bool empty = number[slot] == nobody;
      const auto i = static_cast<std::size_t>(empty ? 0 : number[slot]);
      const space::Vector<D> r = crowd.position_at(i, age);
      for (int d = 0; d < D; ++d) {
        position[d][slot] = empty ? (d == 0 ? far_away(slot) : 0.0) : r[d];
        velocity[d][slot] = empty ? 0.0 : crowd.velocity[i][d];
      }
    }
  }

  static std::array<const double*, D> pointers(const space::Columns& columns) {
    std::array<const double*, D> result;
    for (int d = 0; d < D; ++d) result[d] = columns[d];
    return result;
  }

  void build(const Crowd<D>& crowd, double range, double lifetime, double slack, const Team& team = Team(1)) {
    list.build(pointers(position), pointers(velocity), crowd.box,
               ListReach{range, lifetime, slack, crowd.fastest(), crowd.typical()}, team);
  }
};

}  // namespace lucy::pairs::testing
