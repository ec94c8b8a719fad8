// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The upkeep of the neighbour list along a trajectory: box, list, and which particle sits in which slot. A list is made
// for a stretch of time (pairs/cluster_list.hpp) and expires with it, or when the largest acceleration could have bent
// a path by more than the slack. Then positions are wrapped, particles sorted, and the rows filled anew.
//
// Guests are slots with neighbours that are no particles of the system: what stands for walls (wall_particles.hpp).
// They are numbered after the particles, in the order of their admission.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/pairs/cluster_list.hpp"
#include "lucy/space/box.hpp"
#include "lucy/space/columns.hpp"
#include "lucy/team.hpp"

namespace lucy::motion {

/// Pointers to D columns from `first` on.
template <int D>
std::array<const double*, D> pointers(const space::Columns& columns, int first) {
  std::array<const double*, D> result;
  for (int d = 0; d < D; ++d) result[d] = columns[first + d];
  return result;
}

/// How fast particles move, relative to the mean flow: what a list is made for.
struct Speeds {
  double largest = 0.0;
  double typical = 0.0;       ///< root mean square, per component
  double acceleration = 0.0;  ///< the largest
};

template <int D>
class Neighbourhood {
 public:
  /// For particles that start in slots 0, 1, ..., and up to `most_guests` guests.
  Neighbourhood(const space::Box<D>& box, std::size_t particles, double range, std::size_t most_guests = 0);

  std::size_t particles() const { return particles_; }
  /// Slots to allocate, and those in use.
  std::size_t capacity() const { return list_.capacity(); }
  std::size_t slots() const { return number_.size(); }
  /// Of the particle or guest in each slot; pairs::nobody where it is empty.
  std::span<const std::int32_t> numbers() const { return number_; }
  const pairs::ClusterList<D>& list() const { return list_; }
  /// Time since the list was made, and the box now.
  double age() const { return age_; }
  space::Box<D> box() const;
  /// Images when the list is so old.
  pairs::ImageTable<D> images(double age) const { return pairs::image_table(box_, age); }
  void advance(double dt) { age_ += dt; }

  std::size_t guests() const { return guests_; }
  bool is_guest(std::size_t slot) const { return number_[slot] >= static_cast<std::int32_t>(particles_); }
  /// A slot for one more guest, for the caller to fill before sort(). Throws RunFailed beyond the most.
  std::size_t admit();
  void dismiss_guests();

  /// Whether the list is good for `dt` more, when accelerations are up to `acceleration` now.
  bool lasts(double dt, double acceleration);

  /// Wraps and sorts: `state` holds positions in columns 0 .. D-1; `scratch` has its shape, and the other columns are
  /// sorted along.
  void sort(space::Columns& state, space::Columns& scratch, std::span<space::Columns* const> others);
  /// Makes the list for sorted particles with (peculiar) velocities in columns D .. 2D-1 of `state`, for steps of `dt`
  /// and no longer than `longest`.
  void make_list(const space::Columns& state, const Speeds& speeds, double dt, const Team& team,
                 double longest = std::numeric_limits<double>::infinity());

  /// D values per particle, by particle number; guests are left out.
  void copy_by_particle(const space::Columns& columns, int first, std::span<double> values, int count = D) const;
  /// The same for positions, wrapped into the box.
  std::vector<double> wrapped_positions(const space::Columns& state) const;

  /// Everything but the list, which is to be made anew. load() throws RunFailed when what was saved holds other
  /// particles.
  void save(ArchiveWriter& archive) const;
  void load(ArchiveReader& archive);

 private:
  double range_;
  std::size_t particles_;
  std::size_t guests_ = 0;
  std::size_t most_guests_;
  std::size_t vacant_from_ = 0;  // slots before it are taken: where admit() looks
  space::Box<D> box_;            // at the moment the list was made
  pairs::ClusterList<D> list_;
  std::vector<std::int32_t> number_;
  std::vector<std::int32_t> number_before_;  // scratch of sort()
  double age_ = 0.0;
  double lifetime_ = 0.0;
  double acceleration_ = 0.0;  // bound on every particle's, since the list was made
};

extern template class Neighbourhood<1>;
extern template class Neighbourhood<2>;
extern template class Neighbourhood<3>;

}  // namespace lucy::motion
