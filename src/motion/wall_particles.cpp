// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/motion/wall_particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lucy/errors.hpp"

namespace lucy::motion {

namespace {

// How far a particle may move along its straight line while the images of a list last, in units of the range.
constexpr double path_in_ranges = 0.2;
// Particles up to this far from a wall have images: nearer than the range is what counts, or than the range and a path
// where another particle is behind the wall for a moment; then comes their own path, and the list's slack.
constexpr double reach_in_ranges = 1.45;
static_assert(WallParticles<2>::shortest_in_ranges == 2.0 * reach_in_ranges);

}  // namespace

template <int D>
WallParticles<D>::WallParticles(const space::Cell<D>& cell, std::size_t particles, double range)
    : cell_(cell), particles_(particles), range_(range), reach_(reach_in_ranges * range) {
  if (!any()) return;
  double volume = 1.0;
  for (int d = 0; d < D; ++d) {
    volume *= cell.lengths()[d];
    if (cell.walls().across[d] && !(cell.lengths()[d] > shortest_in_ranges * range)) {
      throw BadInput(fmt::format("a cell of length {:.6g} between walls must be longer than {} times kernel.range = {}",
                                 cell.lengths()[d], shortest_in_ranges, range));
    }
  }
  if (cell.walls().kind != space::WallKind::boundary_particles) return;
  for (int d = 0; d < D; ++d) {
    if (!cell.walls().across[d]) continue;
    for (const auto& pair : cell.walls().across) {
      if (pair && ((*pair)[0].velocity[d] != 0.0 || (*pair)[1].velocity[d] != 0.0))
        throw BadInput("walls of boundary particles move along periodic directions only: other walls bar their way");
    }
  }
  sites_ = cell.boundary_sites(std::pow(volume / static_cast<double>(particles), 1.0 / D), range);
}

template <int D>
std::size_t WallParticles<D>::most() const {
  if (!any()) return 0;
  return sites_.empty() ? particles_ * cell_.most_images() : sites_.size();
}

template <int D>
double WallParticles<D>::longest_lifetime(double largest_speed) const {
  if (!any() || !sites_.empty() || largest_speed <= 0.0) return std::numeric_limits<double>::infinity();
  return path_in_ranges * range_ / largest_speed;
}

template <int D>
double WallParticles<D>::largest_wall_speed() const {
  double largest = 0.0;
  for (const auto& pair : cell_.walls().across) {
    if (!pair) continue;
    for (const space::Wall<D>& wall : *pair) {
      double square = 0.0;
      for (const double component : wall.velocity) square += component * component;
      largest = std::max(largest, std::sqrt(square));
    }
  }
  return largest;
}

template <int D>
void WallParticles<D>::place(Neighbourhood<D>& near, space::Columns& state) {
  if (!any()) return;
  if (!sites_.empty()) {
    if (near.guests() == sites_.size()) return;
    for (std::size_t k = 0; k < sites_.size(); ++k) {
      const std::size_t slot = near.admit();
      for (int c = 0; c < state.count(); ++c) state[c][slot] = c < D ? sites_[k].position[c] : 0.0;
    }
    return;
  }
  near.dismiss_guests();
  images_.clear();
  const std::size_t slots = near.slots();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    const std::int32_t number = near.numbers()[slot];
    if (number == pairs::nobody || near.is_guest(slot)) continue;
    space::Vector<D> position;
    for (int d = 0; d < D; ++d) position[d] = state[d][slot];
    cell_.for_images(position, reach_, [&](const space::Behind<D>& behind) {
      images_.push_back({number, behind});
      const std::size_t at = near.admit();
      const space::Vector<D> image = cell_.mirrored(behind, position);
      for (int c = 0; c < state.count(); ++c) state[c][at] = c < D ? image[c] : 0.0;
    });
  }
}

template <int D>
void WallParticles<D>::settle(const Neighbourhood<D>& near, space::Columns& state) {
  if (!any()) return;
  const std::size_t count = near.guests();
  slot_of_.resize(particles_ + count);
  for (std::size_t slot = 0; slot < near.slots(); ++slot) {
    const std::int32_t number = near.numbers()[slot];
    if (number != pairs::nobody) slot_of_[static_cast<std::size_t>(number)] = static_cast<std::uint32_t>(slot);
  }
  placed_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    spam::WallParticle& placed = placed_[k];
    placed.slot = slot_of_[particles_ + k];
    if (!sites_.empty()) {
      placed.parent = spam::WallParticle::no_parent;
      placed.wall = sites_[k].wall;
      for (int d = 0; d < D; ++d) state[D + d][placed.slot] = cell_.wall(placed.wall).velocity[d];
      continue;
    }
    const Image& image = images_[k];
    placed.parent = slot_of_[static_cast<std::size_t>(image.parent)];
    placed.wall = space::wall_behind<D>(image.behind);
    space::Vector<D> velocity;
    for (int d = 0; d < D; ++d) velocity[d] = state[D + d][placed.parent];
    velocity = space::Cell<D>::turned(image.behind, velocity);
    for (int d = 0; d < D; ++d) state[D + d][placed.slot] = velocity[d];
  }
}

template <int D>
void WallParticles<D>::follow(space::Columns& state) {
  for (std::size_t k = 0; k < placed_.size(); ++k) {
    spam::WallParticle& placed = placed_[k];
    space::Vector<D> position;
    const std::size_t from = placed.has_parent() ? placed.parent : placed.slot;
    for (int d = 0; d < D; ++d) position[d] = state[d][from];
    if (placed.has_parent()) position = cell_.mirrored(images_[k].behind, position);
    const space::Vector<D>& velocity = cell_.wall(placed.wall).velocity;
    for (int d = 0; d < D; ++d) {
      state[d][placed.slot] = position[d];
      state[D + d][placed.slot] = velocity[d];
    }
    placed.temperature = cell_.temperature(placed.wall, position);
  }
}

template <int D>
Eigen::Matrix<double, D, D> WallParticles<D>::momentum_flux() const {
  Eigen::Matrix<double, D, D> flux = Eigen::Matrix<double, D, D>::Zero();
  for (const spam::WallParticle& placed : placed_) {
    const space::Vector<D>& velocity = cell_.wall(placed.wall).velocity;
    const Eigen::Map<const Eigen::Matrix<double, D, 1>> v(velocity.data());
    flux += v * v.transpose();
  }
  return flux;
}

template class WallParticles<1>;
template class WallParticles<2>;
template class WallParticles<3>;

}  // namespace lucy::motion
