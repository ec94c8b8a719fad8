// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/measure/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <variant>

#include "lucy/errors.hpp"
#include "lucy/pairs/cluster_list.hpp"
#include "lucy/space/columns.hpp"

namespace lucy::measure {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// Places that meet the particles at a time, at least. As many as there are particles is best: more would meet each
// other in vain, fewer would let the particles meet each other once more.
constexpr std::size_t smallest_batch = 1024;

template <int D>
std::array<const double*, D> pointers(const space::Columns& columns) {
  std::array<const double*, D> result;
  for (int d = 0; d < D; ++d) result[d] = columns[d];
  return result;
}

/// What a particle carries into the sums: a column for each.
template <int D>
space::Columns what_particles_carry(const FieldSource<D>& source) {
  using M = Moments<D>;
  const std::size_t count = source.position.size() / D;
  space::Columns carried(M::count - 1, count);
  for (std::size_t i = 0; i < count; ++i) {
    double square = 0.0;
    for (int d = 0; d < D; ++d) {
      const double p = source.velocity[i * D + static_cast<std::size_t>(d)];
      carried[M::momentum + d][i] = p;
      square += p * p;
    }
    carried[M::density][i] = 1.0;
    carried[M::square][i] = square;
    carried[M::energy][i] = source.energy.empty() ? 0.0 : source.energy[i];
  }
  return carried;
}

/// The particles and some of the places in one cluster list: particles first, by number, then the places.
template <int D>
class Meeting {
 public:
  Meeting(const FieldSource<D>& source, const space::Columns& carried, std::span<const space::Vector<D>> places)
      : list_(static_cast<std::int64_t>(source.position.size() / D + places.size()), source.box.lengths()),
        position_(D, list_.capacity()),
        carried_(carried.count(), list_.capacity()),
        given_(carried.count() + 1, list_.capacity()) {
    const std::size_t particles = source.position.size() / D;
    space::Columns unsorted(D, particles + places.size());
    const auto put = [&](std::size_t at, space::Vector<D> position) {
      source.box.wrap(position);
      for (int d = 0; d < D; ++d) unsorted[d][at] = position[d];
    };
    for (std::size_t i = 0; i < particles; ++i) {
      space::Vector<D> position;
      std::copy_n(source.position.data() + i * D, D, position.data());
      put(i, position);
    }
    for (std::size_t k = 0; k < places.size(); ++k) put(particles + k, places[k]);
    std::vector<std::int32_t> number(particles + places.size());
    std::iota(number.begin(), number.end(), 0);
    const auto order = list_.arrange(pointers<D>(unsorted), number);
    number_.assign(order.begin(), order.end());
    for (std::size_t slot = 0; slot < number_.size(); ++slot) {
      if (number_[slot] == pairs::nobody) {
        position_[0][slot] = pairs::far_away(slot);
        continue;
      }
      const auto i = static_cast<std::size_t>(number_[slot]);
      for (int d = 0; d < D; ++d) position_[d][slot] = unsorted[d][i];
      if (i >= particles) continue;
      for (int c = 0; c < carried_.count(); ++c) carried_[c][slot] = carried[c][i];
    }
  }

  template <class Kernel>
  void sum(const Kernel& kernel, const space::Box<D>& box, const Team& team) {
    using Sum = MomentSum<D, Kernel>;
    const space::Columns at_rest(D, list_.capacity());
    list_.build(pointers<D>(position_), pointers<D>(at_rest), box, {.range = kernel.range()}, team);
    pairs::Pass<D, Sum> pass;
    pass.position = pointers<D>(position_);
    for (int c = 0; c < Sum::carried; ++c) pass.carried[c] = carried_[c];
    for (int c = 0; c < Sum::given; ++c) pass.given[c] = given_[c];
    pairs::traverse<D>(list_, pairs::image_table(box, 0.0), kernel.range(), pass, Sum{kernel}, team);
  }

  /// visit(number, slot): particles have the numbers below N, places those from N on.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t slot = 0; slot < number_.size(); ++slot)
      if (number_[slot] != pairs::nobody) visit(static_cast<std::size_t>(number_[slot]), slot);
  }
  double given(int column, std::size_t slot) const { return given_[column][slot]; }

 private:
  pairs::ClusterList<D> list_;
  space::Columns position_;
  space::Columns carried_;
  space::Columns given_;
  std::vector<std::int32_t> number_;
};

void refuse_long_range(double range, double shortest_edge) {
  if (range > shortest_edge)
    throw BadInput(
        fmt::format("kernel.range = {} is longer than the box, whose shorter edge is {}: choose a range up to "
                    "that",
                    range, shortest_edge));
}

}  // namespace

template <int D>
void Moments<D>::add(const Moments& other) {
  for (int c = 0; c < count; ++c) std::ranges::transform(column[c], other.column[c], column[c].begin(), std::plus<>());
}

template <int D>
void Moments<D>::divide_by(double number) {
  for (auto& values : column)
    for (double& value : values) value /= number;
}

template <int D>
MomentsAtPlaces<D> moments(const kernel::Weight<D>& weight, const FieldSource<D>& source,
                           std::span<const double> points, const Team& team) {
  refuse_long_range(kernel::range_of(weight), std::ranges::min(source.box.lengths()));
  const std::size_t particles = source.position.size() / D;
  const std::size_t places = points.size() / D;
  const space::Columns carried = what_particles_carry(source);
  MomentsAtPlaces<D> result{Moments<D>(places), Moments<D>(particles)};

  // Neighbouring places go to different meetings.
  const std::size_t batch = std::max(particles, smallest_batch);
  const std::size_t meetings = std::max<std::size_t>(1, (places + batch - 1) / batch);
  std::vector<space::Vector<D>> present;
  for (std::size_t m = 0; m < meetings; ++m) {
    present.clear();
    for (std::size_t k = m; k < places; k += meetings) {
      space::Vector<D> place;
      std::copy_n(points.data() + k * D, D, place.data());
      present.push_back(place);
    }
    Meeting<D> meeting(source, carried, present);
    std::visit([&](const auto& kernel) { meeting.sum(kernel, source.box, team); }, weight);
    meeting.for_each([&](std::size_t number, std::size_t slot) {
      if (number < particles && m > 0) return;  // known since the first meeting
      const bool is_place = number >= particles;
      Moments<D>& target = is_place ? result.points : result.particles;
      const std::size_t at = is_place ? m + (number - particles) * meetings : number;
      for (int c = 0; c < Moments<D>::count; ++c) target.column[c][at] = meeting.given(c, slot);
    });
  }

  const double own = std::visit([](const auto& kernel) { return kernel.weight_at_zero(); }, weight);
  for (int c = 0; c < carried.count(); ++c)
    for (std::size_t i = 0; i < particles; ++i) result.particles.column[c][i] += own * carried[c][i];
  return result;
}

std::vector<double> Field::component(int c) const {
  std::vector<double> result(places());
  for (std::size_t k = 0; k < result.size(); ++k)
    result[k] = values[k * static_cast<std::size_t>(components) + static_cast<std::size_t>(c)];
  return result;
}

template <int D>
std::vector<Field> fields_of(const Moments<D>& moments, std::span<const double> points, double strain_rate,
                             const Medium& medium, bool with_energy) {
  using M = Moments<D>;
  const std::size_t places = moments.places();
  const std::vector<double>& density = moments.column[M::density];
  const bool with_temperature = with_energy && medium && spam::has_temperature(*medium);
  // P of an isentropic fluid needs no e, that of every other one does.
  const bool with_pressure = !medium || with_energy || !spam::has_temperature(*medium);

  Field velocity{"velocity_smoothed", D, std::vector<double>(places * D)};
  Field peculiar{"velocity_smoothed_peculiar", D, std::vector<double>(places * D)};
  Field energy{"internal_energy", 1, std::vector<double>(places)};
  Field temperature{"temperature", 1, std::vector<double>(places)};
  Field kinetic_temperature{"kinetic_temperature", 1, std::vector<double>(places)};
  Field pressure{"pressure", 1, std::vector<double>(places)};
  Field pressure_kinetic{"pressure_kinetic", 1, std::vector<double>(places)};
  Field pressure_potential{"pressure_potential", 1, std::vector<double>(places)};
  Field individual{"kinetic_energy_density_individual", 1, std::vector<double>(places)};
  Field smoothed{"kinetic_energy_density_smoothed", 1, std::vector<double>(places)};
  const spam::EquationOfState isentropic = spam::Isentropic();

  for (std::size_t k = 0; k < places; ++k) {
    const double rho = density[k];
    const bool inside = rho > 0.0;
    double square = 0.0;
    for (int d = 0; d < D; ++d) {
      const double p = moments.column[M::momentum + d][k] / rho;
      double v = p;
      if constexpr (D > 1) {
        if (d == 0) v += strain_rate * (points[k * D + 1] + moments.column[M::elevation][k] / rho);
      }
      const std::size_t at = k * D + static_cast<std::size_t>(d);
      peculiar.values[at] = inside ? p : not_a_number;
      velocity.values[at] = inside ? v : not_a_number;
      square += p * p;
    }
    // What rounding leaves of a difference that cannot be negative.
    const double fluctuation = std::max(0.0, moments.column[M::square][k] / rho - square);
    kinetic_temperature.values[k] = inside ? fluctuation / D : not_a_number;
    pressure_kinetic.values[k] = inside ? rho * fluctuation / D : 0.0;
    individual.values[k] = 0.5 * moments.column[M::square][k];
    smoothed.values[k] = inside ? 0.5 * rho * square : 0.0;
    const double e = moments.column[M::energy][k] / rho;
    energy.values[k] = inside ? e : not_a_number;
    const auto& state = medium ? *medium : isentropic;
    std::visit(
        [&](const auto& law) {
          temperature.values[k] = inside ? law.temperature(rho, e) : not_a_number;
          pressure_potential.values[k] = inside ? law.pressure(rho, e) : 0.0;
        },
        state);
    pressure.values[k] =
        medium ? pressure_potential.values[k] : pressure_kinetic.values[k] + pressure_potential.values[k];
  }

  std::vector<Field> fields;
  fields.push_back({"density", 1, density});
  fields.push_back(std::move(velocity));
  if (strain_rate != 0.0) fields.push_back(std::move(peculiar));
  if (with_energy) fields.push_back(std::move(energy));
  if (with_temperature) fields.push_back(std::move(temperature));
  fields.push_back(std::move(kinetic_temperature));
  if (with_pressure) fields.push_back(std::move(pressure));
  fields.push_back(std::move(pressure_kinetic));
  if (!medium) fields.push_back(std::move(pressure_potential));
  fields.push_back(std::move(individual));
  fields.push_back(std::move(smoothed));
  return fields;
}

const Field* find_field(std::span<const Field> fields, std::string_view name) {
  const auto found = std::ranges::find(fields, name, &Field::name);
  return found == fields.end() ? nullptr : &*found;
}

std::vector<double> Grid::axis(int d) const {
  std::vector<double> result(static_cast<std::size_t>(nodes[d]));
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = lengths[d] * static_cast<double>(k) / nodes[d];
  return result;
}

std::vector<double> Grid::points() const {
  const std::vector<double> x = axis(0);
  std::vector<double> result;
  result.reserve(2 * size());
  for (const double height : axis(1))
    for (const double along : x) result.insert(result.end(), {along, height});
  return result;
}

Grid default_grid(const space::Vector<2>& lengths, double range) {
  Grid grid{{}, lengths};
  for (int d = 0; d < 2; ++d)
    grid.nodes[d] = 2 * static_cast<int>(std::clamp(std::ceil(3.0 * lengths[d] / range), 8.0, 512.0));
  return grid;
}

FieldSummary summary(std::span<const double> values) {
  FieldSummary result{.lowest = std::numeric_limits<double>::infinity(),
                      .highest = -std::numeric_limits<double>::infinity()};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    ++result.known;
    result.mean += value;
    result.lowest = std::min(result.lowest, value);
    result.highest = std::max(result.highest, value);
  }
  if (result.known == 0) return {not_a_number, not_a_number, not_a_number, not_a_number, 0};
  result.mean /= static_cast<double>(result.known);
  for (const double value : values)
    if (std::isfinite(value)) result.deviation += (value - result.mean) * (value - result.mean);
  result.deviation = std::sqrt(result.deviation / static_cast<double>(result.known));
  return result;
}

void KineticEnergies::add(const KineticEnergies& other) {
  individual += other.individual;
  smoothed += other.smoothed;
  field += other.field;
}

void KineticEnergies::divide_by(double number) {
  individual /= number;
  smoothed /= number;
  field /= number;
}

KineticEnergies kinetic_energies(const FieldSource<2>& source, const Moments<2>& at_particles) {
  using M = Moments<2>;
  const std::size_t particles = at_particles.places();
  KineticEnergies result;
  for (const double v : source.velocity) result.individual += 0.5 * v * v;
  for (std::size_t i = 0; i < particles; ++i)
    for (int d = 0; d < 2; ++d) {
      const double u = at_particles.column[M::momentum + d][i] / at_particles.column[M::density][i];
      result.smoothed += 0.5 * u * u;
    }
  result.divide_by(static_cast<double>(particles));
  return result;
}

double field_kinetic_energy(const Moments<2>& on_grid, double volume, std::size_t particles) {
  using M = Moments<2>;
  double sum = 0.0;
  for (std::size_t k = 0; k < on_grid.places(); ++k) {
    const double rho = on_grid.column[M::density][k];
    if (rho == 0.0) continue;
    for (int d = 0; d < 2; ++d)
      sum += 0.5 * on_grid.column[M::momentum + d][k] * on_grid.column[M::momentum + d][k] / rho;
  }
  return sum / static_cast<double>(on_grid.places()) * volume / static_cast<double>(particles);
}

template struct Moments<1>;
template struct Moments<2>;
template struct Moments<3>;
template MomentsAtPlaces<1> moments(const kernel::Weight<1>&, const FieldSource<1>&, std::span<const double>,
                                    const Team&);
template MomentsAtPlaces<2> moments(const kernel::Weight<2>&, const FieldSource<2>&, std::span<const double>,
                                    const Team&);
template MomentsAtPlaces<3> moments(const kernel::Weight<3>&, const FieldSource<3>&, std::span<const double>,
                                    const Team&);
template std::vector<Field> fields_of(const Moments<1>&, std::span<const double>, double, const Medium&, bool);
template std::vector<Field> fields_of(const Moments<2>&, std::span<const double>, double, const Medium&, bool);
template std::vector<Field> fields_of(const Moments<3>&, std::span<const double>, double, const Medium&, bool);

}  // namespace lucy::measure
