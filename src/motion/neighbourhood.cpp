// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/motion/neighbourhood.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lucy/errors.hpp"

namespace lucy::motion {

namespace {

// A list is made for about this much of a typical particle's path, in units of the range: longer lists have longer
// rows, shorter ones are made more often (measured optimum, flat between 0.05 and 0.09).
constexpr double typical_path = 0.065;
// How far, in units of the range, a particle may stray from its straight line before the list expires.
constexpr double slack_fraction = 0.015;
// Accelerations may grow by this factor over the one step that a list must still last.
constexpr double acceleration_margin = 1.5;

}  // namespace

template <int D>
Neighbourhood<D>::Neighbourhood(const space::Box<D>& box, std::size_t particles, double range, std::size_t most_guests)
    : range_(range),
      particles_(particles),
      most_guests_(most_guests),
      box_(box),
      list_(static_cast<std::int64_t>(particles), box.lengths(), static_cast<std::int64_t>(most_guests)),
      number_(particles) {
  for (std::size_t i = 0; i < particles; ++i) number_[i] = static_cast<std::int32_t>(i);
}

template <int D>
space::Box<D> Neighbourhood<D>::box() const {
  space::Box<D> present = box_;
  present.advance(age_);
  return present;
}

template <int D>
std::size_t Neighbourhood<D>::admit() {
  if (guests_ == most_guests_) throw RunFailed("there are more particles near walls than were expected");
  while (vacant_from_ < number_.size() && number_[vacant_from_] != pairs::nobody) ++vacant_from_;
  if (vacant_from_ == number_.size()) number_.push_back(pairs::nobody);
  number_[vacant_from_] = static_cast<std::int32_t>(particles_ + guests_);
  ++guests_;
  return vacant_from_++;
}

template <int D>
void Neighbourhood<D>::dismiss_guests() {
  for (std::size_t slot = 0; slot < number_.size(); ++slot)
    if (is_guest(slot)) number_[slot] = pairs::nobody;
  guests_ = 0;
  vacant_from_ = 0;
}

template <int D>
bool Neighbourhood<D>::lasts(double dt, double acceleration) {
  acceleration_ = std::max(acceleration_, acceleration);
  const double age = age_ + dt;
  return age <= lifetime_ * (1.0 + 1e-9) &&
         0.5 * acceleration_margin * acceleration_ * age * age <= slack_fraction * range_;
}

template <int D>
void Neighbourhood<D>::sort(space::Columns& state, space::Columns& scratch, std::span<space::Columns* const> others) {
  box_.advance(age_);
  age_ = 0.0;
  lifetime_ = 0.0;
  for (std::size_t slot = 0; slot < number_.size(); ++slot) {
    if (number_[slot] == pairs::nobody) continue;
    space::Vector<D> position;
    for (int d = 0; d < D; ++d) position[d] = state[d][slot];
    box_.wrap(position);
    for (int d = 0; d < D; ++d) state[d][slot] = position[d];
  }

  const auto order = list_.arrange(pointers<D>(state, 0), number_);
  const auto take = [&](const double* from, double* to, auto empty) {
    for (std::size_t slot = 0; slot < order.size(); ++slot) {
      to[slot] = order[slot] == pairs::nobody ? empty(slot) : from[order[slot]];
    }
  };
  const auto zero = [](std::size_t) { return 0.0; };
  take(state[0], scratch[0], pairs::far_away);
  for (int c = 1; c < state.count(); ++c) take(state[c], scratch[c], zero);
  std::swap(state, scratch);
  for (space::Columns* const columns : others) {
    for (int c = 0; c < columns->count(); ++c) {
      std::copy_n((*columns)[c], number_.size(), scratch[0]);
      take(scratch[0], (*columns)[c], zero);
    }
  }
  vacant_from_ = 0;
  number_before_.swap(number_);
  number_.resize(order.size());
  for (std::size_t slot = 0; slot < order.size(); ++slot) {
    const std::int32_t from = order[slot];
    number_[slot] = from == pairs::nobody ? pairs::nobody : number_before_[static_cast<std::size_t>(from)];
  }
}

template <int D>
void Neighbourhood<D>::make_list(const space::Columns& state, const Speeds& speeds, double dt, const Team& team,
                                 double longest) {
  acceleration_ = speeds.acceleration;
  pairs::ListReach reach;
  reach.range = range_;
  reach.slack = slack_fraction * range_;
  reach.largest_speed = speeds.largest;
  reach.typical_speed = speeds.typical;
  const double bound =
      std::min({std::sqrt(2.0 * reach.slack / (acceleration_margin * acceleration_ + 1e-300)),
                list_.longest_lifetime(range_, reach.slack, speeds.largest, box_.strain_rate()), longest});
  // Whole steps, so that no part of the lifetime is paid for and not used; at least one, where the bound allows it.
  reach.lifetime = std::min(std::max(dt, typical_path * range_ / speeds.typical), bound);
  if (dt > 0.0 && reach.lifetime > dt) {
    reach.lifetime = std::min(bound, dt * std::floor(reach.lifetime / dt * (1.0 + 1e-12)));
  }
  list_.build(pointers<D>(state, 0), pointers<D>(state, D), box_, reach, team);
  lifetime_ = reach.lifetime;
}

template <int D>
void Neighbourhood<D>::copy_by_particle(const space::Columns& columns, int first, std::span<double> values,
                                        int count) const {
  const auto stride = static_cast<std::size_t>(count);
  for (std::size_t slot = 0; slot < number_.size(); ++slot) {
    if (number_[slot] == pairs::nobody || is_guest(slot)) continue;
    double* const of_particle = values.data() + static_cast<std::size_t>(number_[slot]) * stride;
    for (int c = 0; c < count; ++c) of_particle[c] = columns[first + c][slot];
  }
}

template <int D>
std::vector<double> Neighbourhood<D>::wrapped_positions(const space::Columns& state) const {
  std::vector<double> values(particles_ * D);
  copy_by_particle(state, 0, values);
  const space::Box<D> present = box();
  for (std::size_t i = 0; i < particles_; ++i) {
    space::Vector<D> position;
    std::copy_n(values.data() + i * D, D, position.data());
    present.wrap(position);
    std::copy_n(position.data(), D, values.data() + i * D);
  }
  return values;
}

template <int D>
void Neighbourhood<D>::save(ArchiveWriter& archive) const {
  archive.put_sequence(number_);
  archive.put(box_.offset());
  archive.put(age_);
}

template <int D>
void Neighbourhood<D>::load(ArchiveReader& archive) {
  archive.get_sequence(number_);
  std::size_t there = 0;
  guests_ = 0;
  vacant_from_ = 0;
  for (const std::int32_t number : number_) {
    if (number >= static_cast<std::int32_t>(particles_))
      ++guests_;
    else if (number != pairs::nobody)
      ++there;
  }
  if (number_.size() > capacity() || there != particles_ || guests_ > most_guests_) {
    throw RunFailed("a saved state does not hold the particles of the input");
  }
  box_ = space::Box<D>(box_.lengths(), box_.strain_rate(), archive.get<double>());
  age_ = archive.get<double>();
  lifetime_ = 0.0;  // the list is not part of the state: it is to be made anew
}

template class Neighbourhood<1>;
template class Neighbourhood<2>;
template class Neighbourhood<3>;

}  // namespace lucy::motion
