// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/benard_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/refusals.hpp"
#include "lucy/errors.hpp"

namespace lucy::cases {

namespace {

constexpr double growth_amplitude = 1e-5;      // over the usual one: its square is below rounding
constexpr double share_of_longest_step = 0.7;  // densities and temperatures will differ from those at rest
constexpr double steady_duration = 40.0;       // in tau, as the next two
constexpr double growth_duration = 3.0;
constexpr double sample_interval = 0.05;
constexpr double most_work = 4e6;  // nodes times steps of one interval, a fifth of a second
constexpr std::size_t steady_samples = 3;
constexpr double at_rest = 1e-10;  // kinetic energy in units of (nu/L)^2

double cells_along_x(const BenardGridPoint& point) { return width_of(point) / point.height * point.cells; }

/// All but the step, which needs all of it.
BenardGridPoint without_step(const BenardGridPoint& point) {
  BenardGridPoint all = point;
  set_unset(all);
  const bool growth = point.find == BenardGoal::growth_rate;
  all.roll_velocity =
      point.roll_velocity.value_or((growth ? growth_amplitude : 1.0) * usual_roll_velocity * (point.hot - point.cold));
  all.duration = point.duration.value_or((growth ? growth_duration : steady_duration) * diffusion_time(all));
  return all;
}

grid::Settings settings_of(const BenardGridPoint& all) {
  grid::Settings settings;
  settings.height = all.height;
  settings.width = *all.width;
  settings.cells_x = static_cast<int>(std::lround(cells_along_x(all)));
  settings.cells_y = all.cells;
  settings.sides = all.sides;
  settings.hot = all.hot;
  settings.cold = all.cold;
  settings.state = spam::make_equation_of_state(all.equation_of_state);
  settings.transport = all.transport;
  settings.viscosity = *all.viscosity;
  settings.conductivity = *all.conductivity;
  settings.gravity = *all.gravity;
  return settings;
}

}  // namespace

BenardGridPoint resolved(const BenardGridPoint& point) {
  BenardGridPoint all = without_step(point);
  if (!all.step) all.step = share_of_longest_step * grid::longest_step(settings_of(all));
  return all;
}

grid::Settings flow_settings(const BenardGridPoint& point) { return settings_of(without_step(point)); }

void validate(const BenardGridPoint& point) {
  validate(static_cast<const Convection&>(point), true);
  if (point.cells < 4) refuse(fmt::format("grid.cells = {} must be at least 4", point.cells));
  const double along_x = cells_along_x(point);
  if (std::abs(along_x - std::round(along_x)) > 1e-9 * along_x || along_x < 4.0 || along_x > 1e4)
    refuse(
        fmt::format("cell.width = {} at cell.height = {} and grid.cells = {} makes {} cells along x; a whole number "
                    "from 4 to 10000 is accepted",
                    width_of(point), point.height, point.cells, along_x));
  if (point.duration) refuse_unless_above_zero("run.duration", *point.duration);
  refuse_unless_above_zero("run.tolerance", point.tolerance);
  const double longest = grid::longest_step(flow_settings(point));
  if (point.step) {
    refuse_unless_above_zero("run.step", *point.step);
    if (*point.step > longest)
      refuse(
          fmt::format("run.step = {} is unstable with grid.cells = {}: at most {:.4g} is accepted (sound and "
                      "diffusion at the spacing {:.4g})",
                      *point.step, point.cells, longest, point.height / point.cells));
  }
  const BenardGridPoint all = resolved(point);
  refuse_endless_run(0.0, *all.duration, *all.step);
}

int interval_steps(const BenardGridPoint& point) {
  const BenardGridPoint all = resolved(point);
  const double most = most_work / (static_cast<double>(all.cells) * cells_along_x(all));
  return static_cast<int>(std::max(
      1.0, std::floor(std::min({sample_interval * diffusion_time(all) / *all.step, *all.duration / *all.step, most}))));
}

std::int64_t interval_count(const BenardGridPoint& point) {
  const BenardGridPoint all = resolved(point);
  return std::max<std::int64_t>(
      1, static_cast<std::int64_t>(std::ceil(*all.duration / (interval_steps(all) * *all.step) - 1e-6)));
}

BenardGridRun::BenardGridRun(const BenardGridPoint& point, int /*replica*/, int /*threads*/)
    : point_((validate(point), resolved(point))), flow_(settings_of(point_)), initial_mass_(flow_.mass()) {
  flow_.set_rolls(*point_.roll_velocity);
  sample();
}

void BenardGridRun::sample() {
  const auto nusselt = flow_.nusselt();
  samples_.push_back({flow_.time(), flow_.kinetic_energy(), nusselt.hot, nusselt.cold, nusselt.sides,
                      flow_.largest_speed(), flow_.roll_amplitude(), flow_.mass() / initial_mass_ - 1.0});
}

/// Over the last few intervals, each one: sound may stand still for a moment.
bool BenardGridRun::changes_little() const {
  if (samples_.size() <= steady_samples) return false;
  const double flow_unit = *point_.viscosity / point_.height;
  if (samples_.back().kinetic_energy < at_rest * flow_unit * flow_unit) return true;
  const auto little = [&](const BenardGridSample& before, const BenardGridSample& after) {
    const double most = point_.tolerance * (after.time - before.time) / diffusion_time(point_);
    return std::abs(after.kinetic_energy - before.kinetic_energy) <= most * after.kinetic_energy &&
           std::abs(after.nusselt_hot - before.nusselt_hot) <= most * after.nusselt_hot &&
           std::abs(after.nusselt_cold - before.nusselt_cold) <= most * after.nusselt_cold;
  };
  for (std::size_t i = samples_.size() - steady_samples; i < samples_.size(); ++i)
    if (!little(samples_[i - 1], samples_[i])) return false;
  return true;
}

void BenardGridRun::advance_one_interval() {
  ++intervals_;
  if (steady_ || !failure_.empty()) return;
  const grid::Flow before = flow_;
  try {
    for (int step = 0; step < interval_steps(point_); ++step) flow_.advance(*point_.step);
  } catch (const RunFailed& failure) {
    failure_ = failure.what();
    flow_ = before;
    return;
  }
  sample();
  steady_ = point_.find == BenardGoal::steady_state && changes_little();
}

BenardGridRecord BenardGridRun::record() const { return {samples_, steady_, failure_, flow_.fields()}; }

void BenardGridRun::save(ArchiveWriter& archive) const {
  flow_.save(archive);
  archive.put(intervals_);
  archive.put_sequence(samples_);
  archive.put(steady_);
  archive.put_sequence(failure_);
}

void BenardGridRun::load(ArchiveReader& archive) {
  flow_.load(archive);
  intervals_ = archive.get<std::int64_t>();
  archive.get_sequence(samples_);
  steady_ = archive.get<bool>();
  archive.get_sequence(failure_);
}

}  // namespace lucy::cases
