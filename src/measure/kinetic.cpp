// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/measure/kinetic.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "lucy/pairs/lanes.hpp"
#include "lucy/space/triangle.hpp"

namespace lucy::measure {

namespace {

constexpr std::size_t part_slots = 4096;

template <int D>
KineticSums<D> sum_part(const std::array<const double*, D>& momentum, const std::array<const double*, D>& force,
                        std::size_t begin, std::size_t end) {
  using pairs::Lanes;
  std::array<Lanes, space::triangle<D>> flux;
  flux.fill(0.0);
  Lanes power = 0.0;
  Lanes largest = 0.0;
  for (std::size_t i = begin; i < end; i += pairs::lane_count) {
    std::array<Lanes, D> p;
    for (int d = 0; d < D; ++d) {
      p[d] = pairs::load(momentum[d] + i);
      power = fma(p[d], pairs::load(force[d] + i), power);
    }
    Lanes square = p[0] * p[0];
    for (int d = 1; d < D; ++d) square = fma(p[d], p[d], square);
    largest = pairs::simd::max(largest, square);
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b <= a; ++b) {
        Lanes& sum = flux[space::in_triangle(a, b)];
        sum = fma(p[a], p[b], sum);
      }
    }
  }
  KineticSums<D> sums;
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b <= a; ++b) {
      sums.momentum_flux(a, b) = sums.momentum_flux(b, a) = reduce(flux[space::in_triangle(a, b)]);
    }
  }
  sums.force_power = reduce(power);
  sums.largest_square = hmax(largest);
  return sums;
}

}  // namespace

template <int D>
KineticSums<D> kinetic_sums(const std::array<const double*, D>& momentum, const std::array<const double*, D>& force,
                            std::size_t slots, const Team& team) {
  const std::size_t parts = (slots + part_slots - 1) / part_slots;
  if (parts <= 1) return sum_part<D>(momentum, force, 0, slots);
  thread_local std::vector<KineticSums<D>> kept;  // from call to call: no allocation per step
  kept.resize(parts);
  const std::span<KineticSums<D>> partial(kept);  // the other threads' own are empty
  team.share(static_cast<std::ptrdiff_t>(parts), [&](std::ptrdiff_t part) {
    const std::size_t begin = static_cast<std::size_t>(part) * part_slots;
    partial[static_cast<std::size_t>(part)] = sum_part<D>(momentum, force, begin, std::min(begin + part_slots, slots));
  });
  KineticSums<D> total;
  for (const auto& part : partial) {
    total.momentum_flux += part.momentum_flux;
    total.force_power += part.force_power;
    total.largest_square = std::max(total.largest_square, part.largest_square);
  }
  return total;
}

template <int D>
double largest_square(const std::array<const double*, D>& columns, std::size_t slots) {
  pairs::Lanes largest = 0.0;
  for (std::size_t i = 0; i < slots; i += pairs::lane_count) {
    pairs::Lanes square = 0.0;
    for (int d = 0; d < D; ++d) square = fma(pairs::load(columns[d] + i), pairs::load(columns[d] + i), square);
    largest = pairs::simd::max(largest, square);
  }
  return hmax(largest);
}

double column_sum(const double* column, std::size_t slots) {
  pairs::Lanes sum = 0.0;
  for (std::size_t i = 0; i < slots; i += pairs::lane_count) sum += pairs::load(column + i);
  return reduce(sum);
}

template KineticSums<1> kinetic_sums<1>(const std::array<const double*, 1>&, const std::array<const double*, 1>&,
                                        std::size_t, const Team&);
template KineticSums<2> kinetic_sums<2>(const std::array<const double*, 2>&, const std::array<const double*, 2>&,
                                        std::size_t, const Team&);
template KineticSums<3> kinetic_sums<3>(const std::array<const double*, 3>&, const std::array<const double*, 3>&,
                                        std::size_t, const Team&);
template double largest_square<1>(const std::array<const double*, 1>&, std::size_t);
template double largest_square<2>(const std::array<const double*, 2>&, std::size_t);
template double largest_square<3>(const std::array<const double*, 3>&, std::size_t);

}  // namespace lucy::measure
