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

template <int D>
Trajectory<D>::Trajectory(const kernel::Lucy<D>& kernel, const Start<D>& start, const Shear& shear,
                          Integrator integrator, const Watch& watch, const Team& team, Reading reading,
                          const spam::Isentropic& fluid)
    : kernel_(kernel),
      shear_(shear),
      integrator_(integrator),
      watch_(watch),
      team_(team),
      reading_(reading),
      fluid_(fluid),
      near_(space::Box<D>(start.lengths, shear.strain_rate, start.offset), start.position.size(), kernel.range()),
      now_{space::Columns(columns, near_.capacity()), {}},
      next_{space::Columns(columns, near_.capacity()), {}},
      sum_(columns, near_.capacity()),
      force_(D, near_.capacity()),
      density_(reading == Reading::spam ? 1 : 0, near_.capacity()),
      specific_pressure_(density_.count(), near_.capacity()) {
  for (std::size_t i = 0; i < start.position.size(); ++i) {
    for (int d = 0; d < D; ++d) {
      now_.columns[d][i] = start.position[i][d];
      now_.columns[D + d][i] = start.momentum[i][d];
    }
  }
  const auto sum_momenta = [&] {
    kinetic_ =
        measure::kinetic_sums<D>(pointers<D>(now_.columns, D), pointers<D>(force_, 0), now_.columns.slots(), team_);
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
void Trajectory<D>::renew_list(double dt) {
  near_.sort(now_.columns, next_.columns, std::array{&force_, &density_});
  Speeds speeds;
  speeds.largest = std::sqrt(kinetic_.largest_square);
  speeds.typical = std::sqrt(kinetic_.momentum_flux.trace() / (D * static_cast<double>(particles())));
  speeds.acceleration = largest_acceleration();
  near_.make_list(now_.columns, speeds, dt, team_);
}

template <int D>
bool Trajectory<D>::list_lasts(double dt) {
  if (near_.lasts(dt, largest_acceleration())) return true;
  renew_list(dt);
  return near_.lasts(dt, largest_acceleration());
}

template <int D>
void Trajectory<D>::evaluate(const Phase<sllod_numbers>& at, double age, pairs::Wanted wanted) {
  std::array<double*, D> force;
  for (int d = 0; d < D; ++d) force[d] = force_[d];
  const auto images = near_.images(age);
  if (reading_ == Reading::md) {
    pair_totals_ = md::lucy_forces<D>(kernel_, near_.list(), images, pointers<D>(at.columns, 0), force, wanted, team_);
  } else {
    pair_totals_ = spam::isentropic_forces<D>(kernel_, fluid_, near_.list(), images, pointers<D>(at.columns, 0), force,
                                              density_[0], specific_pressure_[0], slopes_, wanted, team_);
  }
  kinetic_ = measure::kinetic_sums<D>(pointers<D>(at.columns, D), pointers<D>(force_, 0), near_.slots(), team_);
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
    runge_kutta_4(*this, now_, near_.age(), dt, near_.slots(), next_, sum_, team_);
    evaluate(next_, near_.age() + dt, pairs::Wanted::everything);
  } else {
    next_.numbers = now_.numbers;
    velocity_verlet<D>(now_.columns, dt, near_.slots(), next_.columns, force_,
                       [&](const space::Columns&) { evaluate(next_, near_.age() + dt, wanted); });
    kinetic_ = measure::kinetic_sums<D>(pointers<D>(next_.columns, D), pointers<D>(force_, 0), near_.slots(), team_);
  }
  const auto n = static_cast<double>(particles());
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
      evaluate(now_, near_.age(), pairs::Wanted::everything);
      return false;
    }
  }
  std::swap(now_, next_);
  time_ += dt;
  near_.advance(dt);
  if (std::isfinite(last_error_)) report_.worst_energy_error = std::max(report_.worst_energy_error, last_error_);
  if (rescales()) rescale();
  return true;
}

template <int D>
double Trajectory<D>::largest_acceleration() const {
  return std::sqrt(measure::largest_square<D>(pointers<D>(force_, 0), near_.slots())) +
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
  const std::size_t slots = near_.slots();
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
  report_.energy_rescaled += (rescaling_target() - kinetic) / static_cast<double>(particles());
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
        "{}, the fastest particle (speed {:.3g}) outruns its neighbour list: the box, or the range, is too small for "
        "it",
        when, std::sqrt(kinetic_.largest_square));
  }
  if (spent_ || !std::isfinite(last_error_)) {
    return fmt::format(
        "{}, the thermostat uses up the kinetic energy ({:.3g} per particle is left): at this energy and "
        "strain rate there is no steady flow",
        when, kinetic_.kinetic_energy() / static_cast<double>(particles()));
  }
  return fmt::format(
      "{}, a step changes the energy by {:.3g} per particle, which is more than run.energy_tolerance = "
      "{:.3g}; a smaller run.step or a larger tolerance may help",
      when, last_error_, watch_.energy_tolerance);
}

template <int D>
void Trajectory<D>::advance(double dt, pairs::Wanted wanted) {
  bool near = false;
  advance_in_pieces(
      dt, watch_, halvings_, report_,
      [&](double piece) -> std::optional<double> {
        near = list_lasts(piece);
        if (near && try_step(piece, wanted)) return last_error_;
        return std::nullopt;
      },
      [&](double piece) { throw RunFailed(why_stuck(near, piece)); });
}

template <int D>
std::vector<double> Trajectory<D>::momenta() const {
  std::vector<double> values(near_.particles() * D);
  copy_momenta(values);
  return values;
}

template <int D>
std::vector<double> Trajectory<D>::forces() const {
  std::vector<double> values(near_.particles() * D);
  copy_forces(values);
  return values;
}

template <int D>
md::HeatFlux<D> Trajectory<D>::heat_flux() const {
  return md::heat_flux<D>(kernel_, near_.list(), near_.images(near_.age()), pointers<D>(now_.columns, 0),
                          pointers<D>(now_.columns, D), team_);
}

template <int D>
void Trajectory<D>::save(ArchiveWriter& archive) const {
  near_.save(archive);
  now_.columns.save(archive, near_.slots());
  force_.save(archive, near_.slots());
  archive.put(now_.numbers);
  archive.put(time_);
  archive.put(halvings_);
  archive.put(conserved_);
  archive.put(shear_.target_kinetic_energy);
  archive.put(pair_totals_.potential_energy);
  for (int a = 0; a < D * D; ++a) archive.put(pair_totals_.virial.data()[a]);
  kinetic_.save(archive);
  archive.put(friction_);
  archive.put(report_);
}

template <int D>
void Trajectory<D>::load(ArchiveReader& archive) {
  near_.load(archive);
  now_.columns.load(archive, near_.slots());
  force_.load(archive, near_.slots());
  now_.numbers = archive.get<std::array<double, sllod_numbers>>();
  time_ = archive.get<double>();
  halvings_ = archive.get<int>();
  conserved_ = archive.get<double>();
  shear_.target_kinetic_energy = archive.get<double>();
  pair_totals_.potential_energy = archive.get<double>();
  for (int a = 0; a < D * D; ++a) pair_totals_.virial.data()[a] = archive.get<double>();
  kinetic_.load(archive);
  friction_ = archive.get<SllodFriction>();
  report_ = archive.get<WatchReport>();
}

template class Trajectory<2>;
template class Trajectory<3>;

}  // namespace lucy::motion
