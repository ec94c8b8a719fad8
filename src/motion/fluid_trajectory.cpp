// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/motion/fluid_trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lucy/errors.hpp"

namespace lucy::motion {

namespace {

template <int D>
void refuse_start_outside(const FluidStart<D>& start) {
  for (int d = 0; d < D; ++d) {
    if (!start.walls.across[d]) continue;
    for (std::size_t i = 0; i < start.position.size(); ++i)
      if (!(start.position[i][d] >= 0.0 && start.position[i][d] <= start.lengths[d]))
        throw BadInput(fmt::format("particle {} starts at {:.6g}, outside of the walls at 0 and {:.6g}", i,
                                   start.position[i][d], start.lengths[d]));
  }
}

}  // namespace

template <int D>
FluidTrajectory<D>::FluidTrajectory(const spam::Fluid<D>& fluid, const FluidStart<D>& start, double strain_rate,
                                    Cooling cooling, const Watch& watch, const Team& team)
    : strain_rate_(strain_rate),
      cooling_(cooling),
      watch_(watch),
      team_(team),
      walls_(space::Cell<D>(start.lengths, start.walls, kernel::range_of<D>(fluid.weight)), start.position.size(),
             kernel::range_of<D>(fluid.weight)),
      near_(space::Box<D>(walls_.cell().box_lengths(), strain_rate), start.position.size(),
            kernel::range_of<D>(fluid.weight), walls_.most()),
      fluid_(fluid, near_.capacity()),
      now_{space::Columns(columns, near_.capacity()), {}},
      next_{space::Columns(columns, near_.capacity()), {}},
      sum_(columns, near_.capacity()) {
  refuse_start_outside(start);
  if (walls_.any() && (strain_rate != 0.0 || cooling != Cooling::none))
    throw BadInput("a fluid between walls is neither sheared by sliding images nor cooled by a thermostat");
  for (std::size_t i = 0; i < start.position.size(); ++i) {
    for (int d = 0; d < D; ++d) {
      now_.columns[d][i] = start.position[i][d] + cell().corner()[d];
      now_.columns[D + d][i] = start.velocity[i][d];
    }
    now_.columns[2 * D][i] = start.energy[i];
  }
  kinetic_ = measure::kinetic_sums<D>(pointers<D>(now_.columns, D), pointers<D>(fluid_.acceleration(), 0),
                                      now_.columns.slots(), team_);
  renew_list(0.0);
  prepare(now_, near_.age());
  start_energy_ = energy();
  find_power_of_walls();
  if (cooling_ == Cooling::isoenergetic && !(internal_energy_ > 0.0)) {
    throw BadInput(
        fmt::format("isoenergetic cooling takes heat in proportion to the internal energy, and so needs a fluid that "
                    "has some: at the start its sum is {:.6g}",
                    internal_energy_));
  }
  refuse_impossible_particles();
}

template <int D>
spam::Particles<D> FluidTrajectory<D>::particles_at(const space::Columns& at,
                                                    const pairs::ImageTable<D>& images) const {
  return {near_.list(),       images,    near_.numbers(), pointers<D>(at, 0),
          pointers<D>(at, D), at[2 * D], strain_rate_,    walls_.particles()};
}

template <int D>
void FluidTrajectory<D>::renew_list(double dt) {
  walls_.place(near_, now_.columns);
  near_.sort(now_.columns, next_.columns, fluid_.columns_to_sort());
  walls_.settle(near_, now_.columns);
  Speeds speeds;
  speeds.largest = std::max(std::sqrt(kinetic_.largest_square), walls_.largest_wall_speed());
  speeds.typical = std::sqrt(kinetic_.momentum_flux.trace() / (D * static_cast<double>(particles())));
  speeds.acceleration = largest_acceleration();
  near_.make_list(now_.columns, speeds, dt, team_, walls_.longest_lifetime(speeds.largest));
  walls_.follow(now_.columns);
  fluid_.renew_walls(walls_.particles());
}

template <int D>
bool FluidTrajectory<D>::list_lasts(double dt) {
  if (near_.lasts(dt, largest_acceleration())) return true;
  renew_list(dt);
  return near_.lasts(dt, largest_acceleration());
}

template <int D>
double FluidTrajectory<D>::largest_acceleration() const {
  return std::sqrt(measure::largest_square<D>(pointers<D>(fluid_.acceleration(), 0), near_.slots()));
}

template <int D>
void FluidTrajectory<D>::prepare(Phase<numbers>& at, double age) {
  walls_.follow(at.columns);
  const auto images = near_.images(age);
  fluid_.evaluate(particles_at(at.columns, images), team_);
  kinetic_ =
      measure::kinetic_sums<D>(pointers<D>(at.columns, D), pointers<D>(fluid_.acceleration(), 0), near_.slots(), team_);
  internal_energy_ = measure::column_sum(at.columns[2 * D], near_.slots());
  if (walls_.any()) {
    kinetic_.momentum_flux -= walls_.momentum_flux();
    energy_rate_ = kinetic_.force_power + measure::column_sum(fluid_.energy_rate()[0], near_.slots());
    return;
  }
  energy_rate_ = 0.0;
  if constexpr (D > 1) {
    energy_rate_ = -strain_rate_ * (kinetic_.momentum_flux(0, 1) + fluid_.virial_xy());
  }
  chi_ = cooling_ == Cooling::isoenergetic ? energy_rate_ / internal_energy_ : 0.0;
  energy_rate_ -= chi_ * internal_energy_;
  for (int d = 0; d < D; ++d) {
    const double gravity = fluid_.fluid().gravity[d];
    if (gravity != 0.0) energy_rate_ += gravity * measure::column_sum(at.columns[D + d], near_.slots());
  }
}

template <int D>
void FluidTrajectory<D>::rate(const space::Columns& at, std::size_t begin, std::size_t count,
                              ChunkRates<columns>& k) const {
  for (int d = 0; d < D; ++d) {
    std::copy_n(at[D + d] + begin, count, k[d].begin());
    std::copy_n(fluid_.acceleration()[d] + begin, count, k[D + d].begin());
  }
  const double* const e = at[2 * D] + begin;
  const double* const rate = fluid_.energy_rate()[0] + begin;
  for (std::size_t i = 0; i < count; ++i) k[2 * D][i] = std::fma(-chi_, e[i], rate[i]);
  if constexpr (D > 1) {
    const double* const y = at[1] + begin;
    const double* const p_y = at[D + 1] + begin;
    for (std::size_t i = 0; i < count; ++i) k[0][i] = std::fma(strain_rate_, y[i], k[0][i]);
    for (std::size_t i = 0; i < count; ++i) k[D][i] = std::fma(-strain_rate_, p_y[i], k[D][i]);
  }
}

template <int D>
bool FluidTrajectory<D>::try_step(double dt) {
  const double energy_before = energy();
  const double input_before = now_.numbers[energy_input];
  runge_kutta_4(*this, now_, near_.age(), dt, near_.slots(), next_, sum_, team_);
  prepare(next_, near_.age() + dt);
  last_error_ = std::abs(energy() - energy_before - (next_.numbers[energy_input] - input_before)) /
                static_cast<double>(particles());
  if (!(last_error_ <= watch_.energy_tolerance)) {
    prepare(now_, near_.age());
    return false;
  }
  std::swap(now_, next_);
  time_ += dt;
  near_.advance(dt);
  count_what_walls_gave(dt);
  report_.worst_energy_error = std::max(report_.worst_energy_error, last_error_);
  return true;
}

template <int D>
void FluidTrajectory<D>::reflect_at_walls(double dt) {
  if (!walls_.any()) return;
  std::int64_t crossed = 0;
  for (std::size_t slot = 0; slot < near_.slots(); ++slot) {
    const std::int32_t number = near_.numbers()[slot];
    if (number == pairs::nobody || near_.is_guest(slot)) continue;
    space::Vector<D> position;
    space::Vector<D> velocity;
    for (int d = 0; d < D; ++d) {
      position[d] = now_.columns[d][slot];
      velocity[d] = now_.columns[D + d][slot];
    }
    const space::Crossing crossing = cell().reflect(position, velocity);
    if (crossing == space::Crossing::none) continue;
    if (crossing == space::Crossing::lost) {
      double square = 0.0;
      for (const double v : velocity) square += v * v;
      throw RunFailed(
          fmt::format("at time {:.6g} particle {} was thrown through a wall and out of the cell (speed {:.3g}); a "
                      "smaller run.step or a smoother start may help",
                      time_, number, std::sqrt(square)));
    }
    ++crossed;
    for (int d = 0; d < D; ++d) {
      const double moved = position[d] - now_.columns[d][slot];
      if (moved != 0.0) given_by_walls_[space::wall_number(d, moved < 0.0)].work -= fluid_.fluid().gravity[d] * moved;
      now_.columns[d][slot] = position[d];
      now_.columns[D + d][slot] = velocity[d];
    }
  }
  if (crossed == 0) return;
  // Its path is no longer the straight line that the list was made for.
  reflections_ += crossed;
  renew_list(dt);
  prepare(now_, near_.age());
  find_power_of_walls();
}

template <int D>
std::string FluidTrajectory<D>::why_stuck(bool near, double piece) const {
  const std::string when = fmt::format("at time {:.6g}, even in steps of {:.3g}", time_, piece);
  if (!near) {
    return fmt::format(
        "{}, the fastest particle (speed {:.3g}) outruns its neighbour list: the box, or the range, is too small for "
        "it",
        when, std::sqrt(kinetic_.largest_square));
  }
  return fmt::format(
      "{}, a step changes the energy by {:.3g} per particle, which is more than run.energy_tolerance = {:.3g}; a "
      "smaller run.step or a larger tolerance may help",
      when, last_error_, watch_.energy_tolerance);
}

template <int D>
void FluidTrajectory<D>::refuse_impossible_particles() const {
  if (!spam::has_temperature(fluid_.fluid().state)) return;
  const auto numbers_of_slots = near_.numbers();
  const double* const temperature = fluid_.temperature()[0];
  const double densest = spam::densest(fluid_.fluid().state);
  for (std::size_t slot = 0; slot < numbers_of_slots.size(); ++slot) {
    if (numbers_of_slots[slot] == pairs::nobody || near_.is_guest(slot)) continue;
    if (fluid_.density()[0][slot] >= densest) {
      throw RunFailed(fmt::format(
          "at time {:.6g} the density of particle {} is {:.3g}, but from {:.3g} on its equation of state describes no "
          "fluid; a smaller run.step or a smoother start may help",
          time_, numbers_of_slots[slot], fluid_.density()[0][slot], densest));
    }
    if (temperature[slot] > 0.0) continue;
    throw RunFailed(fmt::format(
        "at time {:.6g} the temperature of particle {} is {:.3g} (density {:.3g}, energy {:.3g}): it was cooled or "
        "expanded beyond what its equation of state describes; a smaller run.step or a smoother start may help",
        time_, numbers_of_slots[slot], temperature[slot], fluid_.density()[0][slot], now_.columns[2 * D][slot]));
  }
}

template <int D>
void FluidTrajectory<D>::advance(double dt) {
  bool near = false;
  advance_in_pieces(
      dt, watch_, halvings_, report_,
      [&](double piece) -> std::optional<double> {
        near = list_lasts(piece);
        if (!near || !try_step(piece)) return std::nullopt;
        reflect_at_walls(piece);
        return last_error_;
      },
      [&](double piece) { throw RunFailed(why_stuck(near, piece)); });
  refuse_impossible_particles();
}

template <int D>
void FluidTrajectory<D>::find_power_of_walls() {
  if (!walls_.any()) return;
  const auto images = near_.images(near_.age());
  power_of_walls_ = fluid_.wall_exchange(particles_at(now_.columns, images), team_);
}

template <int D>
void FluidTrajectory<D>::count_what_walls_gave(double dt) {
  const auto before = power_of_walls_;
  find_power_of_walls();
  for (std::size_t wall = 0; wall < before.size(); ++wall) {
    given_by_walls_[wall].conduction += 0.5 * dt * (before[wall].conduction + power_of_walls_[wall].conduction);
    given_by_walls_[wall].work += 0.5 * dt * (before[wall].work + power_of_walls_[wall].work);
  }
}

template <int D>
std::vector<double> FluidTrajectory<D>::positions() const {
  std::vector<double> values = near_.wrapped_positions(now_.columns);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] -= cell().corner()[k % D];
  return values;
}

template <int D>
FieldPlaces<D> FluidTrajectory<D>::field_places() const {
  FieldPlaces<D> places{near_.box(), near_.wrapped_positions(now_.columns), velocities(), energies()};
  std::visit(
      [&](const auto& state) {
        for (const spam::WallParticle& at : walls_.particles()) {
          for (int d = 0; d < D; ++d) {
            places.position.push_back(now_.columns[d][at.slot]);
            places.velocity.push_back(now_.columns[D + d][at.slot]);
          }
          places.energy.push_back(state.energy(fluid_.density()[0][at.slot], at.temperature));
        }
      },
      fluid_.fluid().state);
  return places;
}

template <int D>
double FluidTrajectory<D>::energy_drift() const {
  return (energy() - start_energy_ - now_.numbers[energy_input]) / static_cast<double>(particles());
}

template <int D>
std::vector<double> FluidTrajectory<D>::by_particle(const space::Columns& from, int first, int count) const {
  std::vector<double> values(near_.particles() * static_cast<std::size_t>(count));
  near_.copy_by_particle(from, first, values, count);
  return values;
}

template <int D>
std::vector<double> FluidTrajectory<D>::rates_of(const spam::Fluid<D>& fluid) const {
  spam::SmoothParticles<D> other(fluid, near_.capacity());
  const auto images = near_.images(near_.age());
  other.evaluate(particles_at(now_.columns, images), team_);
  const std::vector<double> accelerations = by_particle(other.acceleration(), 0, D);
  const std::vector<double> energy_rates = by_particle(other.energy_rate(), 0, 1);
  std::vector<double> rates;
  rates.reserve(accelerations.size() + energy_rates.size());
  for (std::size_t i = 0; i < energy_rates.size(); ++i) {
    for (int d = 0; d < D; ++d) rates.push_back(accelerations[i * D + static_cast<std::size_t>(d)]);
    rates.push_back(energy_rates[i]);
  }
  return rates;
}

template <int D>
std::vector<double> FluidTrajectory<D>::gradients() const {
  if (fluid_.fluid().transport.none()) return {};
  const auto images = near_.images(near_.age());
  return by_particle(fluid_.gradients(particles_at(now_.columns, images), team_), 0, D * D + D);
}

template <int D>
std::vector<double> FluidTrajectory<D>::entropy_production() const {
  const auto images = near_.images(near_.age());
  return by_particle(fluid_.entropy_production(particles_at(now_.columns, images), team_), 0, 2);
}

template <int D>
void FluidTrajectory<D>::save(ArchiveWriter& archive) const {
  near_.save(archive);
  now_.columns.save(archive, near_.slots());
  fluid_.save(archive, near_.slots());
  archive.put(now_.numbers);
  archive.put(time_);
  archive.put(start_energy_);
  archive.put(halvings_);
  kinetic_.save(archive);
  archive.put(internal_energy_);
  archive.put(chi_);
  archive.put(energy_rate_);
  archive.put(power_of_walls_);
  archive.put(given_by_walls_);
  archive.put(reflections_);
  archive.put(report_);
}

template <int D>
void FluidTrajectory<D>::load(ArchiveReader& archive) {
  near_.load(archive);
  now_.columns.load(archive, near_.slots());
  fluid_.load(archive, near_.slots());
  now_.numbers = archive.get<std::array<double, numbers>>();
  time_ = archive.get<double>();
  start_energy_ = archive.get<double>();
  halvings_ = archive.get<int>();
  kinetic_.load(archive);
  internal_energy_ = archive.get<double>();
  chi_ = archive.get<double>();
  energy_rate_ = archive.get<double>();
  power_of_walls_ = archive.get<std::array<spam::WallExchange, 2 * D>>();
  given_by_walls_ = archive.get<std::array<spam::WallExchange, 2 * D>>();
  reflections_ = archive.get<std::int64_t>();
  report_ = archive.get<WatchReport>();
}

template class FluidTrajectory<1>;
template class FluidTrajectory<2>;
template class FluidTrajectory<3>;

}  // namespace lucy::motion
