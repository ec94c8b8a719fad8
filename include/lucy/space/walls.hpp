// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cell between walls. Across each axis it is either periodic or has a wall on both sides, of one of two kinds:
//
//     mirror images         a particle near a wall has an image behind it, at its mirrored position, which moves with
//                           the wall and has the wall's temperature. In a corner there is a third, diagonal image,
//                           which belongs to the wall across the last axis (the floor or the ceiling).
//     boundary particles    rows of particles that move with the wall, at the spacing of the particles inside; the
//                           first row half a spacing behind the wall, as many as the range reaches over
//
// (O. Kum, W. G. Hoover and H. A. Posch, Phys. Rev. E 52, 4899 (1995), Sec. III.) A particle that crosses a wall is
// reflected. The cell stands in a larger periodic box, with room behind the walls for images or rows and for nobody to
// see round the back: positions in the box are those in the cell plus `corner()`.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "lucy/space/box.hpp"

namespace lucy::space {

enum class WallKind { mirror_images, boundary_particles };
inline constexpr std::array<std::pair<std::string_view, WallKind>, 2> wall_kind_names = {{
    {"mirror-images", WallKind::mirror_images},
    {"boundary-particles", WallKind::boundary_particles},
}};

/// One wall: its velocity, which lies in it, and its temperature kT, which may change along it.
template <int D>
struct Wall {
  Vector<D> velocity{};
  double temperature = 1.0;  ///< at the corner of the cell, the origin
  Vector<D> temperature_gradient{};

  double temperature_at(const Vector<D>& position) const {
    double value = temperature;
    for (int d = 0; d < D; ++d) value += temperature_gradient[d] * position[d];
    return value;
  }
};

/// The walls of a cell, those across axis d at its low and its high end; where there are none it is periodic.
template <int D>
struct Walls {
  WallKind kind = WallKind::mirror_images;
  std::array<std::optional<std::array<Wall<D>, 2>>, D> across;

  bool any() const {
    for (const auto& pair : across)
      if (pair) return true;
    return false;
  }
};

/// Walls are numbered 2 d + (0: low, 1: high).
inline constexpr int wall_number(int axis, bool high) { return 2 * axis + (high ? 1 : 0); }

/// Which walls a mirror image is behind, axis by axis: -1 low, 1 high, 0 none.
template <int D>
using Behind = std::array<std::int8_t, D>;

/// The number of the wall that such an image (or boundary particle) belongs to.
template <int D>
int wall_behind(const Behind<D>& behind) {
  for (int d = D - 1; d > 0; --d)
    if (behind[d] != 0) return wall_number(d, behind[d] > 0);
  return wall_number(0, behind[0] > 0);
}

enum class Crossing { none, reflected, lost };

template <int D>
class Cell {
 public:
  /// Edge lengths; `range` of the interaction: how much room there is behind walls.
  Cell(const Vector<D>& lengths, const Walls<D>& walls, double range) : lengths_(lengths), walls_(walls) {
    for (int d = 0; d < D; ++d)
      if (walls.across[d]) corner_[d] = room_in_ranges * range;
  }

  const Vector<D>& lengths() const { return lengths_; }
  const Walls<D>& walls() const { return walls_; }
  /// Where its lowest corner is in the box around it.
  const Vector<D>& corner() const { return corner_; }
  Vector<D> box_lengths() const {
    Vector<D> lengths = lengths_;
    for (int d = 0; d < D; ++d) lengths[d] += 2.0 * corner_[d];
    return lengths;
  }

  const Wall<D>& wall(int number) const { return (*walls_.across[number / 2])[number % 2]; }
  /// Of a wall at a position in the box.
  double temperature(int number, Vector<D> position) const {
    for (int d = 0; d < D; ++d) position[d] -= corner_[d];
    return wall(number).temperature_at(position);
  }

  /// Brings a particle that crossed walls back to its side of them, with the velocity across relative to the wall
  /// reversed. Lost: it is farther behind one than the cell is wide, or its position is not a number.
  Crossing reflect(Vector<D>& position, Vector<D>& velocity) const {
    Crossing crossing = Crossing::none;
    for (int d = 0; d < D; ++d) {
      if (!walls_.across[d]) continue;
      const double low = corner_[d];
      const double high = corner_[d] + lengths_[d];
      if (position[d] >= low && position[d] <= high) continue;
      position[d] = 2.0 * (position[d] < low ? low : high) - position[d];
      velocity[d] = -velocity[d];
      if (!(position[d] >= low && position[d] <= high)) return Crossing::lost;
      crossing = Crossing::reflected;
    }
    return crossing;
  }

  /// The mirror image of a position, and of a velocity relative to walls at rest.
  Vector<D> mirrored(const Behind<D>& behind, Vector<D> position) const {
    for (int d = 0; d < D; ++d) {
      if (behind[d] == 0) continue;
      const double wall = corner_[d] + (behind[d] > 0 ? lengths_[d] : 0.0);
      position[d] = 2.0 * wall - position[d];
    }
    return position;
  }
  static Vector<D> turned(const Behind<D>& behind, Vector<D> velocity) {
    for (int d = 0; d < D; ++d)
      if (behind[d] != 0) velocity[d] = -velocity[d];
    return velocity;
  }

  /// found(behind) for every mirror image of a particle at `position` that is nearer than `reach` to every wall it is
  /// behind.
  template <class Found>
  void for_images(const Vector<D>& position, double reach, const Found& found) const {
    int combinations = 1;
    for (int d = 0; d < D; ++d) combinations *= 3;
    for (int combination = 1; combination < combinations; ++combination) {
      Behind<D> behind{};
      bool near = true;
      for (int d = 0, rest = combination; d < D; ++d, rest /= 3) {
        const int side = rest % 3;  // 0: none, 1: low, 2: high
        if (side == 0) continue;
        behind[d] = side == 1 ? -1 : 1;
        const double depth = position[d] - corner_[d];
        near = near && walls_.across[d].has_value() && (side == 1 ? depth : lengths_[d] - depth) < reach;
      }
      if (near) found(behind);
    }
  }
  /// The most images that one particle can have, in a cell wider than twice the reach.
  std::size_t most_images() const {
    std::size_t most = 1;
    for (int d = 0; d < D; ++d)
      if (walls_.across[d]) most *= 2;
    return most - 1;
  }

  struct Site {
    Vector<D> position;  ///< in the box
    int wall = 0;
  };
  /// Where boundary particles stand: the lattice of about this spacing that fits into the cell, continued behind the
  /// walls over at least `range`.
  std::vector<Site> boundary_sites(double spacing, double range) const {
    std::array<int, D> inside{};
    std::array<int, D> rows{};
    std::array<int, D> index{};
    for (int d = 0; d < D; ++d) {
      inside[d] = std::max(1, static_cast<int>(std::lround(lengths_[d] / spacing)));
      rows[d] = walls_.across[d] ? static_cast<int>(std::ceil(range * inside[d] / lengths_[d] - 1e-9)) : 0;
      index[d] = -rows[d];
    }
    std::vector<Site> sites;
    for (;;) {
      Behind<D> behind{};
      Site site;
      bool outside = false;
      for (int d = 0; d < D; ++d) {
        behind[d] = static_cast<std::int8_t>(index[d] < 0 ? -1 : index[d] >= inside[d] ? 1 : 0);
        outside = outside || behind[d] != 0;
        site.position[d] = corner_[d] + (index[d] + 0.5) * lengths_[d] / inside[d];
      }
      if (outside) {
        site.wall = wall_behind<D>(behind);
        sites.push_back(site);
      }
      int d = 0;
      for (; d < D; ++d) {
        if (++index[d] < inside[d] + rows[d]) break;
        index[d] = -rows[d];
      }
      if (d == D) return sites;
    }
  }

 private:
  /// Behind a wall: an image may be farther away than the range, and so may whoever looks round the back.
  static constexpr double room_in_ranges = 2.0;

  Vector<D> lengths_;
  Walls<D> walls_;
  Vector<D> corner_{};
};

}  // namespace lucy::space
