// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The particles that stand for the walls of a cell (space/walls.hpp): mirror images, made anew with every neighbour
// list and following their parents in between, or boundary particles, which stay. They are guests in the neighbourhood:
// slots like all others, numbered from the number of particles on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lucy/motion/neighbourhood.hpp"
#include "lucy/space/columns.hpp"
#include "lucy/space/walls.hpp"
#include "lucy/spam/smooth_particles.hpp"

namespace lucy::motion {

template <int D>
class WallParticles {
 public:
  /// A cell between walls has to be longer than this many ranges: images at either end see different particles.
  static constexpr double shortest_in_ranges = 2.9;

  /// For `particles` particles in a cell, of interaction range `range`. Throws BadInput for a shorter cell, and for
  /// boundary particles that would move away from their places since other walls bar their way.
  WallParticles(const space::Cell<D>& cell, std::size_t particles, double range);

  const space::Cell<D>& cell() const { return cell_; }
  bool any() const { return cell_.walls().any(); }
  /// How many there can be.
  std::size_t most() const;
  /// The longest life of a list whose images are made by place().
  double longest_lifetime(double largest_speed) const;
  double largest_wall_speed() const;

  /// Gives them slots, for a list that is about to be sorted: `state` holds positions in its first D columns.
  void place(Neighbourhood<D>& near, space::Columns& state);
  /// Once it is sorted, finds them again and gives them the velocities with which they will move: what the list is
  /// made for.
  void settle(const Neighbourhood<D>& near, space::Columns& state);
  /// Puts images where their parents' positions in `state` have them, and gives all the velocities of their walls.
  void follow(space::Columns& state);

  /// Where they are, after settle().
  std::span<const spam::WallParticle> particles() const { return placed_; }
  /// What kinetic sums over all slots have too much: sum v v of the walls.
  Eigen::Matrix<double, D, D> momentum_flux() const;

 private:
  struct Image {
    std::int32_t parent;  // its number
    space::Behind<D> behind;
  };

  space::Cell<D> cell_;
  std::size_t particles_;
  double range_;
  double reach_;
  std::vector<typename space::Cell<D>::Site> sites_;  // of boundary particles
  std::vector<Image> images_;
  std::vector<spam::WallParticle> placed_;  // image or site k at k
  std::vector<std::uint32_t> slot_of_;      // scratch, by number
};

extern template class WallParticles<1>;
extern template class WallParticles<2>;
extern template class WallParticles<3>;

}  // namespace lucy::motion
