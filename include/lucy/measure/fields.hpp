// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fields at any point r of the box, from the particles (m = 1) and the weight function,
//
//     rho(r) = sum_j m w(r - r_j)          rho(r) <f>(r) = sum_j m f_j w(r - r_j)
//
// (Lucy (1977); Kum, Hoover and Posch, Phys. Rev. E 52, 4899 (1995), Eq. (1) and Sec. II). With the individual
// velocities v_j, with which particles move,
//
//     u(r) = <v>                           the smoothed velocity
//     kT_kin(r) = (<p^2> - <p>^2)/D        the kinetic temperature: what smoothing takes out; p = v - rate y e_x
//     e(r) = <e>                           internal energy per mass, where particles have any
//
// The places take part in the one pair loop as particles without mass: they give nothing, and one that coincides with a
// particle gets its w(0). What enters are the sums, called moments here, so that an average over time is one of
// densities: of rho, rho v, rho v^2, rho e. Its fluctuations are then those about the flow averaged over time.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lucy/kernel/weight.hpp"
#include "lucy/pairs/lanes.hpp"
#include "lucy/pairs/traverse.hpp"
#include "lucy/space/box.hpp"
#include "lucy/spam/equation_of_state.hpp"
#include "lucy/team.hpp"

namespace lucy::measure {

/// The particles that make the fields, by particle number; vectors as x0 y0 x1 y1 ...
template <int D>
struct FieldSource {
  space::Box<D> box;
  std::span<const double> position;
  std::span<const double> velocity;  ///< peculiar: relative to the mean flow rate y e_x
  std::span<const double> energy;    ///< internal, per mass; empty: the particles have none
};

/// Sums over the particles at a number of places, one column per quantity.
template <int D>
struct Moments {
  static constexpr int density = 0;        ///< sum m w
  static constexpr int momentum = 1;       ///< sum m p w, D columns
  static constexpr int square = 1 + D;     ///< sum m p^2 w
  static constexpr int energy = 2 + D;     ///< sum m e w
  static constexpr int elevation = 3 + D;  ///< sum m (y_j - y) w: the mean flow at the particles is not that at r
  static constexpr int count = 4 + D;

  std::array<std::vector<double>, count> column;

  explicit Moments(std::size_t places = 0) { column.fill(std::vector<double>(places)); }
  std::size_t places() const { return column[density].size(); }
  /// Adds those of the same places at another time.
  void add(const Moments& other);
  void divide_by(double number);
};

/// The pair sum: each partner gives the other what it carries (m, m p, m p^2, m e), weighted, and its elevation.
template <int D, class Kernel>
struct MomentSum {
  static constexpr int carried = Moments<D>::count - 1;
  static constexpr int lab_velocity = -1;
  static constexpr int given = Moments<D>::count;
  static constexpr int totals = 0;
  static constexpr pairs::Keeping keeping = pairs::Keeping::nothing;
  static constexpr int gradient_axis = D > 1 ? 1 : 0;  // y; in one dimension nothing is sheared

  Kernel kernel;

  void operator()(const pairs::Pair<D, carried>& pair, std::array<pairs::Lanes, given>& to_i,
                  std::array<pairs::Lanes, given>& to_j, std::array<pairs::Lanes, 0>&) const {
    const pairs::Lanes weight = kernel.weight(pair.distance);
    for (int c = 0; c < carried; ++c) {
      to_i[c] = weight * pair.of_j[c];
      to_j[c] = weight * pair.of_i[c];
    }
    const pairs::Lanes& above = pair.displacement[gradient_axis];
    to_i[carried] = -(to_i[Moments<D>::density] * above);
    to_j[carried] = to_j[Moments<D>::density] * above;
  }
};

template <int D>
struct MomentsAtPlaces {
  Moments<D> points;
  Moments<D> particles;  ///< at the particles themselves, each with its own term
};

/// The moments at `points` (x0 y0 x1 y1 ..., anywhere) and at the particles. The same bits for every team. Throws
/// BadInput, naming kernel.range, when the range is longer than an edge of the box.
template <int D>
MomentsAtPlaces<D> moments(const kernel::Weight<D>& weight, const FieldSource<D>& source,
                           std::span<const double> points, const Team& team);

/// A field under its name; `components` values per place, side by side.
struct Field {
  std::string_view name;
  int components = 1;
  std::vector<double> values;

  std::size_t places() const { return values.size() / static_cast<std::size_t>(components); }
  std::vector<double> component(int c) const;
};

/// What the particles are: atoms (nothing), or a fluid with this equation of state.
using Medium = std::optional<spam::EquationOfState>;

/// All fields that follow from moments at places with these `points`, in this order:
///     density
///     velocity_smoothed                   D components, laboratory
///     velocity_smoothed_peculiar          D components, without the mean flow; at a strain rate other than zero
///     internal_energy                     per mass; where `with_energy`
///     temperature                         of a fluid: kT(rho, e) by its equation of state, where it has any
///     kinetic_temperature                 of the particles' own motion, see above
///     pressure                            of a fluid: P(rho, e); of atoms: the sum of the next two
///     pressure_kinetic                    rho kT_kin
///     pressure_potential                  of atoms: rho^2/2, what the sum over pairs is when read as a fluid
///     kinetic_energy_density_individual   rho <p^2>/2 per volume
///     kinetic_energy_density_smoothed     rho <p>^2/2: the same of the smoothed (peculiar) velocity
/// Where there is no particle within the range, velocities, temperatures and e are nan, densities and pressures zero.
template <int D>
std::vector<Field> fields_of(const Moments<D>& moments, std::span<const double> points, double strain_rate,
                             const Medium& medium, bool with_energy);

/// The field of this name, or nothing.
const Field* find_field(std::span<const Field> fields, std::string_view name);

/// A regular grid over the box: node (i, j) at (i L_x/n_x, j L_y/n_y), counted along x first.
struct Grid {
  std::array<int, 2> nodes{};
  space::Vector<2> lengths{};

  std::size_t size() const { return static_cast<std::size_t>(nodes[0]) * static_cast<std::size_t>(nodes[1]); }
  std::vector<double> axis(int d) const;
  /// x0 y0 x1 y1 ...
  std::vector<double> points() const;
};

/// Six nodes to the range, an even number along each edge, 16 to 1024: fine enough to draw, and for the spectrum to
/// have died out at its end.
Grid default_grid(const space::Vector<2>& lengths, double range);

/// Over the places where the field is known: those outside the fluid may not be.
struct FieldSummary {
  double mean = 0.0;
  double deviation = 0.0;  ///< root mean square, from the mean
  double lowest = 0.0;
  double highest = 0.0;
  std::size_t known = 0;
};
FieldSummary summary(std::span<const double> values);

/// Kinetic energy per particle, three ways; peculiar velocities.
struct KineticEnergies {
  double individual = 0.0;  ///< mean of v_i^2/2
  double smoothed = 0.0;    ///< mean of u_i^2/2, u at the particles
  double field = 0.0;       ///< integral of rho u^2/2 over the box, over N

  void add(const KineticEnergies& other);
  void divide_by(double number);
};

/// Individual and smoothed; the field's is field_kinetic_energy().
KineticEnergies kinetic_energies(const FieldSource<2>& source, const Moments<2>& at_particles);
double field_kinetic_energy(const Moments<2>& on_grid, double volume, std::size_t particles);

}  // namespace lucy::measure
