// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/motion/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "lucy/errors.hpp"
#include "lucy/motion/velocity_verlet.hpp"
#include "lucy/spam/isentropic_forces.hpp"

namespace lucy::motion {

namespace {

// A list is made for about this much of a typical particle's path, in units of the range: longer lists have longer
// rows, shorter ones are made more often (measured optimum, flat between 0.05 and 0.09).
constexpr double typical_path = 0.065;
// How far, in units of the range, a particle may stray from its straight line before the list expires.
constexpr double slack_fraction = 0.015;
// Accelerations may grow by this factor over the one step that a list must still last.
constexpr double acceleration_margin = 1.5;
// After a step whose worst error is this much below the tolerance, the next is tried with half as many substeps
// (a fourth-order step twice as long errs 32 times as much).
constexpr double ease_factor = 1.0 / 64.0;

}  // namespace

template <int D>
std::array<const double*, D> Trajectory<D>::pointers(const space::Columns& columns, int first) {
  std::array<const double*, D> result;
  for (int d = 0; d < D; ++d) result[d] = columns[first + d];
  return result;
}

template <int D>
Trajectory<D>::Trajectory(const kernel::Lucy<D>& kernel, const Start<D>& start, const Shear& shear,
                          Integrator integrator, const Watch& watch, const Team& team, Reading reading)
    : kernel_(kernel),
      shear_(shear),
      integrator_(integrator),
      watch_(watch),
      team_(team),
      reading_(reading),
      particles_(start.position.size()),
      box_(start.lengths, shear.strain_rate),
      list_(static_cast<std::int64_t>(start.position.size()), start.lengths),
      number_(particles_),
      now_{space::Columns(columns, list_.capacity()), {}},
      next_{space::Columns(columns, list_.capacity()), {}},
      sum_(columns, list_.capacity()),
      force_(D, list_.capacity()),
      fluid_(reading == Reading::spam ? 2 : 0, list_.capacity()) {
  for (std::size_t i = 0; i < particles_; ++i) {
    number_[i] = static_cast<std::int32_t>(i);
    for (int d = 0; d < D; ++d) {
      now_.columns[d][i] = start.position[i][d];
      now_.columns[D + d][i] = start.momentum[i][d];
    }
  }
  const auto sum_momenta = [&] {
    kinetic_ = measure::kinetic_sums<D>(pointers(now_.columns, D), pointers(force_, 0), now_.columns.slots(), team_);
  };
  sum_momenta();
  if (!(shear_.target_kinetic_energy > 0.0)) shear_.target_kinetic_energy = kinetic_.kinetic_energy();
  if (shear_.thermostat == Thermostat::isokinetic) {
    scale_momenta(std::sqrt(shear_.target_kinetic_energy / kinetic_.kinetic_energy()));
    sum_momenta();
  }
  renew_list(0.0);
  evaluate(now_, 0.0, pairs::Wanted::everything);
  friction_ = sllod_friction(shear_, kinetic_, pair_totals_.virial(0, 1), 0.0);
  conserved_ = shear_.thermostat == Thermostat::isokinetic ? shear_.target_kinetic_energy : energy();
}

template <int D>
space::Box<D> Trajectory<D>::box() const {
  space::Box<D> present = box_;
  present.advance(list_age_);
  return present;
}

template <int D>
void Trajectory<D>::renew_list(double dt) {
  box_.advance(list_age_);
  list_age_ = 0.0;
  for (std::size_t slot = 0; slot < number_.size(); ++slot) {
    if (number_[slot] == pairs::nobody) continue;
    space::Vector<D> position;
    for (int d = 0; d < D; ++d) position[d] = now_.columns[d][slot];
    box_.wrap(position);
    for (int d = 0; d < D; ++d) now_.columns[d][slot] = position[d];
  }

  const auto order = list_.arrange(pointers(now_.columns, 0), number_);
  const auto take = [&](const double* from, double* to, auto empty) {
    for (std::size_t slot = 0; slot < order.size(); ++slot) {
      to[slot] = order[slot] == pairs::nobody ? empty(slot) : from[order[slot]];
    }
  };
  const auto zero = [](std::size_t) { return 0.0; };
  for (int d = 0; d < D; ++d) std::copy_n(force_[d], number_.size(), sum_[d]);
  for (int c = 0; c < columns; ++c) {
    if (c == 0) {
      take(now_.columns[c], next_.columns[c], pairs::far_away);
    } else {
      take(now_.columns[c], next_.columns[c], zero);
    }
  }
  for (int d = 0; d < D; ++d) take(sum_[d], force_[d], zero);
  std::swap(now_.columns, next_.columns);
  number_before_.swap(number_);
  number_.resize(order.size());
  for (std::size_t slot = 0; slot < order.size(); ++slot) {
    const std::int32_t from = order[slot];
    number_[slot] = from == pairs::nobody ? pairs::nobody : number_before_[static_cast<std::size_t>(from)];
  }

  const double range = kernel_.range();
  const double fastest = std::sqrt(kinetic_.largest_square);
  const double typical = std::sqrt(kinetic_.momentum_flux.trace() / (D * static_cast<double>(particles_)));
  list_acceleration_ = largest_acceleration();
  pairs::ListReach reach;
  reach.range = range;
  reach.slack = slack_fraction * range;
  reach.largest_speed = fastest;
  reach.typical_speed = typical;
  const double bound = std::min(std::sqrt(2.0 * reach.slack / (acceleration_margin * list_acceleration_ + 1e-300)),
                                list_.longest_lifetime(range, reach.slack, fastest, shear_.strain_rate));
  // Whole steps, so that no part of the lifetime is paid for and not used; at least one, where the bound allows it.
  reach.lifetime = std::min(std::max(dt, typical_path * range / typical), bound);
  if (dt > 0.0 && reach.lifetime > dt) {
    reach.lifetime = std::min(bound, dt * std::floor(reach.lifetime / dt * (1.0 + 1e-12)));
  }
  list_.build(pointers(now_.columns, 0), pointers(now_.columns, D), box_, reach, team_);
  list_lifetime_ = reach.lifetime;
}

template <int D>
bool Trajectory<D>::list_lasts(double dt) {
  const auto lasts = [&] {
    list_acceleration_ = std::max(list_acceleration_, largest_acceleration());
    const double age = list_age_ + dt;
    return age <= list_lifetime_ * (1.0 + 1e-9) &&
           0.5 * acceleration_margin * list_acceleration_ * age * age <= slack_fraction * kernel_.range();
  };
  if (lasts()) return true;
  renew_list(dt);
  return lasts();
}

template <int D>
void Trajectory<D>::evaluate(const Phase<sllod_numbers>& at, double age, pairs::Wanted wanted) {
  std::array<double*, D> force;
  for (int d = 0; d < D; ++d) force[d] = force_[d];
  const auto images = pairs::image_table(box_, age);
  if (reading_ == Reading::md) {
    pair_totals_ = md::lucy_forces<D>(kernel_, list_, images, pointers(at.columns, 0), force, wanted, team_);
  } else {
    pair_totals_ = spam::isentropic_forces<D>(kernel_, spam::Isentropic(), list_, images, pointers(at.columns, 0),
                                              force, fluid_[0], fluid_[1], wanted, team_);
  }
  kinetic_ = measure::kinetic_sums<D>(pointers(at.columns, D), pointers(force_, 0), number_.size(), team_);
  friction_ = sllod_friction(shear_, kinetic_, pair_totals_.virial(0, 1), at.numbers[nose_hoover_friction]);
}

template <int D>
void Trajectory<D>::prepare(const Phase<sllod_numbers>& at, double age) {
  evaluate(at, age, pairs::Wanted::shear_stress);
}

template <int D>
bool Trajectory<D>::try_step(double dt, pairs::Wanted wanted) {
  const double energy_before = energy();
  const double input_before = now_.numbers[energy_input];
  if (integrator_ == Integrator::runge_kutta_4) {
    runge_kutta_4(*this, now_, list_age_, dt, number_.size(), next_, sum_, team_);
    evaluate(next_, list_age_ + dt, pairs::Wanted::everything);
  } else {
    next_.numbers = now_.numbers;
    velocity_verlet<D>(now_.columns, dt, number_.size(), next_.columns, force_,
                       [&](const space::Columns&) { evaluate(next_, list_age_ + dt, wanted); });
    kinetic_ = measure::kinetic_sums<D>(pointers(next_.columns, D), pointers(force_, 0), number_.size(), team_);
  }
  const auto n = static_cast<double>(particles_);
  last_error_ = std::abs(energy() - energy_before - (next_.numbers[energy_input] - input_before)) / n;
  if (integrator_ == Integrator::velocity_verlet) {
    // A symplectic step of fixed length errs to and fro in a narrow band: watch the band, and leave the step alone.
    if (wanted == pairs::Wanted::everything && !(std::abs(energy() - conserved_) <= watch_.energy_band * n)) {
      throw RunFailed(
          fmt::format("at time {:.6g} the energy has left a band of {} per particle about its start; use a smaller "
                      "run.step than {}",
                      time_, watch_.energy_band, dt));
    }
  } else {
    spent_ = rescales() && !(rescaling_target() > 0.0);
    if (spent_ || !(last_error_ <= watch_.energy_tolerance)) {
      evaluate(now_, list_age_, pairs::Wanted::everything);
      return false;
    }
  }
  std::swap(now_, next_);
  time_ += dt;
  list_age_ += dt;
  if (std::isfinite(last_error_)) report_.worst_energy_error = std::max(report_.worst_energy_error, last_error_);
  if (rescales()) rescale();
  return true;
}

template <int D>
double Trajectory<D>::largest_acceleration() const {
  return std::sqrt(measure::largest_square<D>(pointers(force_, 0), number_.size())) +
         std::abs(friction_.zeta) * std::sqrt(kinetic_.largest_square);
}

template <int D>
bool Trajectory<D>::rescales() const {
  return watch_.rescale && integrator_ == Integrator::runge_kutta_4 &&
         (shear_.thermostat == Thermostat::isoenergetic || shear_.thermostat == Thermostat::isokinetic);
}

template <int D>
double Trajectory<D>::rescaling_target() const {
  return shear_.thermostat == Thermostat::isokinetic ? conserved_ : conserved_ - pair_totals_.potential_energy;
}

template <int D>
void Trajectory<D>::scale_momenta(double factor) {
  const std::size_t slots = number_.size();
  const auto chunks = static_cast<std::ptrdiff_t>((slots + chunk_slots - 1) / chunk_slots);
  team_.share(chunks, [&](std::ptrdiff_t chunk) {
    const std::size_t begin = static_cast<std::size_t>(chunk) * chunk_slots;
    const std::size_t end = std::min(begin + chunk_slots, slots);
    for (int d = 0; d < D; ++d) {
      double* const p = now_.columns[D + d];
      for (std::size_t slot = begin; slot < end; ++slot) p[slot] *= factor;
    }
  });
}

template <int D>
void Trajectory<D>::rescale() {
  const double kinetic = kinetic_.kinetic_energy();
  const double square = rescaling_target() / kinetic;
  const double factor = std::sqrt(square);
  scale_momenta(factor);
  report_.energy_rescaled += (rescaling_target() - kinetic) / static_cast<double>(particles_);
  kinetic_.momentum_flux *= square;
  kinetic_.force_power *= factor;
  kinetic_.largest_square *= square;
  friction_ = sllod_friction(shear_, kinetic_, pair_totals_.virial(0, 1), now_.numbers[nose_hoover_friction]);
}

template <int D>
std::string Trajectory<D>::why_stuck(bool near, double piece) const {
  const std::string when = fmt::format("at time {:.6g}, even in steps of {:.3g}", time_, piece);
  if (!near) {
    return fmt::format(
        "{}, the fastest particle (speed {:.3g}) outruns its neighbour list: the box is too small for it", when,
        std::sqrt(kinetic_.largest_square));
  }
  if (spent_ || !std::isfinite(last_error_)) {
    return fmt::format(
        "{}, the thermostat uses up the kinetic energy ({:.3g} per particle is left): at this energy and "
        "strain rate there is no steady flow",
        when, kinetic_.kinetic_energy() / static_cast<double>(particles_));
  }
  return fmt::format(
      "{}, a step changes the energy by {:.3g} per particle, which is more than run.energy_tolerance = "
      "{:.3g}; a smaller run.step or a larger tolerance may help",
      when, last_error_, watch_.energy_tolerance);
}

template <int D>
void Trajectory<D>::advance(double dt, pairs::Wanted wanted) {
  bool subdivided = halvings_ > 0;
  std::int64_t pieces = std::int64_t{1} << halvings_;
  double piece = dt / static_cast<double>(pieces);
  double worst = 0.0;
  while (pieces > 0) {
    const bool near = list_lasts(piece);
    if (near && try_step(piece, wanted)) {
      worst = std::isfinite(last_error_) ? std::max(worst, last_error_) : watch_.energy_tolerance;
      --pieces;
      continue;
    }
    if (halvings_ == watch_.most_halvings) throw RunFailed(why_stuck(near, piece));
    ++halvings_;
    subdivided = true;
    pieces *= 2;
    piece /= 2.0;
  }
  ++report_.steps;
  if (subdivided) ++report_.subdivided_steps;
  if (halvings_ > 0 && worst < ease_factor * watch_.energy_tolerance) --halvings_;
}

template <int D>
std::vector<double> Trajectory<D>::by_particle(const space::Columns& columns, int first) const {
  std::vector<double> values(particles_ * D);
  copy_by_particle(columns, first, values);
  return values;
}

template <int D>
void Trajectory<D>::copy_by_particle(const space::Columns& columns, int first, std::span<double> values) const {
  for (std::size_t slot = 0; slot < number_.size(); ++slot) {
    if (number_[slot] == pairs::nobody) continue;
    for (int d = 0; d < D; ++d) values[static_cast<std::size_t>(number_[slot]) * D + d] = columns[first + d][slot];
  }
}

template <int D>
md::HeatFlux<D> Trajectory<D>::heat_flux() const {
  return md::heat_flux<D>(kernel_, list_, pairs::image_table(box_, list_age_), pointers(now_.columns, 0),
                          pointers(now_.columns, D), team_);
}

template <int D>
std::vector<double> Trajectory<D>::positions() const {
  std::vector<double> values = by_particle(now_.columns, 0);
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
void Trajectory<D>::save(ArchiveWriter& archive) const {
  archive.put_sequence(number_);
  for (int c = 0; c < columns; ++c) archive.put_sequence(std::span(now_.columns[c], number_.size()));
  for (int d = 0; d < D; ++d) archive.put_sequence(std::span(force_[d], number_.size()));
  archive.put(now_.numbers);
  archive.put(box_.offset());
  archive.put(time_);
  archive.put(list_age_);
  archive.put(halvings_);
  archive.put(conserved_);
  archive.put(shear_.target_kinetic_energy);
  archive.put(pair_totals_.potential_energy);
  for (int a = 0; a < D * D; ++a) archive.put(pair_totals_.virial.data()[a]);
  for (int a = 0; a < D * D; ++a) archive.put(kinetic_.momentum_flux.data()[a]);
  archive.put(kinetic_.force_power);
  archive.put(kinetic_.largest_square);
  archive.put(friction_);
  archive.put(report_);
}

template <int D>
void Trajectory<D>::load(ArchiveReader& archive) {
  archive.get_sequence(number_);
  std::size_t there = 0;
  for (const std::int32_t number : number_) {
    if (number >= static_cast<std::int32_t>(particles_)) there = particles_ + 1;
    if (number != pairs::nobody) ++there;
  }
  if (number_.size() > now_.columns.slots() || there != particles_) {
    throw RunFailed("a saved state does not hold the particles of the input");
  }
  std::vector<double> column;
  const auto get_column = [&](double* to) {
    archive.get_sequence(column);
    if (column.size() != number_.size()) throw RunFailed("a saved state has columns of different lengths");
    std::copy(column.begin(), column.end(), to);
  };
  for (int c = 0; c < columns; ++c) get_column(now_.columns[c]);
  for (int d = 0; d < D; ++d) get_column(force_[d]);
  now_.numbers = archive.get<std::array<double, sllod_numbers>>();
  box_ = space::Box<D>(box_.lengths(), shear_.strain_rate, archive.get<double>());
  time_ = archive.get<double>();
  list_age_ = archive.get<double>();
  halvings_ = archive.get<int>();
  conserved_ = archive.get<double>();
  shear_.target_kinetic_energy = archive.get<double>();
  pair_totals_.potential_energy = archive.get<double>();
  for (int a = 0; a < D * D; ++a) pair_totals_.virial.data()[a] = archive.get<double>();
  for (int a = 0; a < D * D; ++a) kinetic_.momentum_flux.data()[a] = archive.get<double>();
  kinetic_.force_power = archive.get<double>();
  kinetic_.largest_square = archive.get<double>();
  friction_ = archive.get<SllodFriction>();
  report_ = archive.get<WatchReport>();
  list_lifetime_ = 0.0;  // the list is not part of the state: renew_list() comes next
}

template class Trajectory<2>;
template class Trajectory<3>;

}  // namespace lucy::motion
