// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/grid/flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "lucy/errors.hpp"

namespace lucy::grid {

namespace {

constexpr double stable_radius = 2.6;

/// State is four columns of numbers that integrate alike.
constexpr std::array<std::vector<double> State::*, 4> columns = {&State::density, &State::velocity_x,
                                                                 &State::velocity_y, &State::energy};

/// Mean of a quantity at the four corners of what lies between rows `low` and `high`, columns i and i + 1.
inline double mean_of_four(const double* low, const double* high, int i) {
  return 0.25 * ((low[i] + low[i + 1]) + (high[i] + high[i + 1]));
}
inline double slope_x(const double* low, const double* high, int i, double half_over_dx) {
  return half_over_dx * ((low[i + 1] - low[i]) + (high[i + 1] - high[i]));
}
inline double slope_y(const double* low, const double* high, int i, double half_over_dy) {
  return half_over_dy * ((high[i] - low[i]) + (high[i + 1] - low[i + 1]));
}

}  // namespace

double energy_at(const spam::EquationOfState& state, double density, double temperature) {
  return std::visit(
      [&](const auto& equation) {
        const double at_zero = equation.temperature(density, 0.0);
        return (temperature - at_zero) / (equation.temperature(density, 1.0) - at_zero);
      },
      state);
}

double sound_speed(const spam::EquationOfState& state, double density, double energy) {
  constexpr double difference = 1e-4;
  return std::visit(
      [&](const auto& equation) {
        const auto slope = [&](double in_density, double in_energy) {
          return (equation.pressure(density + in_density, energy + in_energy) -
                  equation.pressure(density - in_density, energy - in_energy)) /
                 (2.0 * difference);
        };
        const double squared =
            slope(difference, 0.0) + equation.pressure(density, energy) / (density * density) * slope(0.0, difference);
        return std::sqrt(std::max(squared, 0.0));
      },
      state);
}

double longest_step(const Settings& settings) {
  const double spacing = std::min(settings.width / settings.cells_x, settings.height / settings.cells_y);
  const double hottest = std::max(settings.hot, settings.cold);
  const double capacity = energy_at(settings.state, 1.0, hottest) - energy_at(settings.state, 1.0, hottest - 1.0);
  const double diffusivity = std::max(settings.viscosity, settings.conductivity / capacity);
  const double sound = 2.0 / spacing *
                       std::max(sound_speed(settings.state, 1.0, energy_at(settings.state, 1.0, settings.hot)),
                                sound_speed(settings.state, 1.0, energy_at(settings.state, 1.0, settings.cold)));
  return stable_radius / std::hypot(sound, 4.0 * diffusivity / (spacing * spacing));
}

Flow::Flow(const Settings& settings)
    : settings_(settings),
      dx_(settings.width / settings.cells_x),
      dy_(settings.height / settings.cells_y),
      last_node_(settings.sides == Sides::walls ? settings.cells_x + 1 : settings.cells_x),
      first_inner_(settings.sides == Sides::walls ? 2 : 1),
      last_inner_(settings.cells_x),
      stride_(static_cast<std::size_t>(settings.cells_x) + 3) {
  const std::size_t cells = stride_ * static_cast<std::size_t>(settings.cells_y);
  const std::size_t nodes = cells + stride_;
  for (State* state : {&now_, &stage_, &sum_, &rate_}) {
    for (const auto column : columns) (state->*column).assign(nodes, 0.0);
    state->density.assign(cells, 0.0);
  }
  for (auto* at_nodes : {&node_density_, &temperature_, &flow_y_}) at_nodes->assign(nodes, 0.0);
  for (auto* at_cells : {&pressure_xx_, &pressure_yy_, &pressure_xy_, &heat_x_, &heat_y_, &work_, &flow_x_})
    at_cells->assign(cells, 0.0);
  std::ranges::fill(now_.density, 1.0);
  for (int row = 0; row <= settings.cells_y; ++row)
    for (std::size_t column = 0; column < stride_; ++column)
      now_.energy[at(static_cast<int>(column), row)] = energy_at(settings.state, 1.0, wall_temperature(row));
  // What is never computed stays as it is here: walls at rest, finite numbers in unused places.
  stage_ = now_;
  sum_ = now_;
}

double Flow::column_x(int column) const { return (column - 1) * dx_ - 0.5 * settings_.width; }
double Flow::row_y(int row) const { return row * dy_ - 0.5 * settings_.height; }

double Flow::wall_temperature(int row) const {
  return settings_.hot + (settings_.cold - settings_.hot) * row / settings_.cells_y;
}

std::array<double, 2> roll_pattern(Sides sides, double x, double y) {
  using std::numbers::pi;
  const double up = std::sin(2.0 * pi * y);
  const double across = std::cos(pi * y);
  if (sides == Sides::periodic) return {std::sin(2.0 * pi * x) * up, std::cos(2.0 * pi * x) * across};
  return {std::cos(pi * x) * up, -std::sin(2.0 * pi * x) * across};
}

std::array<double, 2> Flow::roll(int column, int row) const {
  return roll_pattern(settings_.sides, column_x(column) / settings_.width, row_y(row) / settings_.height);
}

void Flow::set_rolls(double amplitude) {
  for (int row = 1; row < settings_.cells_y; ++row) {
    for (int column = first_inner_; column <= last_inner_; ++column) {
      const auto velocity = roll(column, row);
      now_.velocity_x[at(column, row)] = amplitude * velocity[0];
      now_.velocity_y[at(column, row)] = amplitude * velocity[1];
    }
  }
}

void Flow::place_images(State& state) const {
  if (settings_.sides == Sides::walls) return;
  const int last = settings_.cells_x;
  for (const auto column : columns) {
    auto& values = state.*column;
    for (std::size_t row = 0; row < values.size(); row += stride_) {
      values[row] = values[row + static_cast<std::size_t>(last)];
      values[row + static_cast<std::size_t>(last) + 1] = values[row + 1];
    }
  }
}

/// Densities and temperatures at nodes, energies of walls, then P, Q and P : grad v in the cells.
template <class StateEquation>
void Flow::find_stress(const StateEquation& equation, State& state) {
  const int nx = settings_.cells_x;
  const int ny = settings_.cells_y;
  const bool walls = settings_.sides == Sides::walls;
  for (int row = 1; row < ny; ++row) {
    const double* below = &state.density[at(0, row - 1)];
    const double* above = &state.density[at(0, row)];
    double* density = &node_density_[at(0, row)];
    double* temperature = &temperature_[at(0, row)];
    const double* energy = &state.energy[at(0, row)];
#pragma omp simd
    for (int i = first_inner_; i <= last_inner_; ++i) {
      density[i] = mean_of_four(below, above, i - 1);
      temperature[i] = equation.temperature(density[i], energy[i]);
    }
    if (walls) {
      for (const int i : {1, nx + 1}) {
        density[i] = node_density(i, row, state);
        temperature[i] = wall_temperature(row);
      }
    } else {
      density[nx + 1] = density[1];
      temperature[nx + 1] = temperature[1];
    }
  }
  for (const int row : {0, ny}) {
    for (int i = 1; i <= nx + 1; ++i) {
      node_density_[at(i, row)] = node_density(i, row, state);
      temperature_[at(i, row)] = wall_temperature(row);
    }
  }
  // T(rho, e) is linear in e, and walls have a temperature.
  const auto wall_energy = [&](int i, int row) {
    const double at_zero = equation.temperature(node_density_[at(i, row)], 0.0);
    state.energy[at(i, row)] =
        (temperature_[at(i, row)] - at_zero) / (equation.temperature(node_density_[at(i, row)], 1.0) - at_zero);
  };
  for (int i = 1; i <= nx + 1; ++i) {
    wall_energy(i, 0);
    wall_energy(i, ny);
  }
  for (int row = 1; walls && row < ny; ++row) {
    wall_energy(1, row);
    wall_energy(nx + 1, row);
  }

  const double over_x = 0.5 / dx_;
  const double over_y = 0.5 / dy_;
  const bool kinematic = settings_.transport == Transport::kinematic;
  for (int row = 0; row < ny; ++row) {
    const double* density = &state.density[at(0, row)];
    const double* e0 = &state.energy[at(0, row)];
    const double* e1 = &state.energy[at(0, row + 1)];
    const double* vx0 = &state.velocity_x[at(0, row)];
    const double* vx1 = &state.velocity_x[at(0, row + 1)];
    const double* vy0 = &state.velocity_y[at(0, row)];
    const double* vy1 = &state.velocity_y[at(0, row + 1)];
    const double* t0 = &temperature_[at(0, row)];
    const double* t1 = &temperature_[at(0, row + 1)];
    double* pxx = &pressure_xx_[at(0, row)];
    double* pyy = &pressure_yy_[at(0, row)];
    double* pxy = &pressure_xy_[at(0, row)];
    double* qx = &heat_x_[at(0, row)];
    double* qy = &heat_y_[at(0, row)];
    double* work = &work_[at(0, row)];
#pragma omp simd
    for (int i = 1; i <= nx; ++i) {
      const double weight = kinematic ? density[i] : 1.0;
      const double eta = settings_.viscosity * weight;
      const double k = settings_.conductivity * weight;
      const double xx = slope_x(vx0, vx1, i, over_x);
      const double yx = slope_x(vy0, vy1, i, over_x);  // dv_y/dx
      const double xy = slope_y(vx0, vx1, i, over_y);  // dv_x/dy
      const double yy = slope_y(vy0, vy1, i, over_y);
      const double scalar = equation.pressure(density[i], mean_of_four(e0, e1, i));
      const double deviator = eta * (xx - yy);
      const double shear = -eta * (xy + yx);
      pxx[i] = scalar - deviator;
      pyy[i] = scalar + deviator;
      pxy[i] = shear;
      qx[i] = -k * slope_x(t0, t1, i, over_x);
      qy[i] = -k * slope_y(t0, t1, i, over_y);
      work[i] = (pxx[i] * xx + pyy[i] * yy) + shear * (xy + yx);
    }
    if (!walls)
      for (double* values : {pxx, pyy, pxy, qx, qy, work}) values[0] = values[nx];
  }
}

template <class StateEquation>
void Flow::find_rates(const StateEquation& equation, State& state) {
  place_images(state);
  find_stress(equation, state);
  const int nx = settings_.cells_x;
  const int ny = settings_.cells_y;
  const double over_x = 0.5 / dx_;
  const double over_y = 0.5 / dy_;

  for (int row = 1; row < ny; ++row) {
    const auto line = [&](const std::vector<double>& values, int j) { return &values[at(0, j)]; };
    const double* vx = line(state.velocity_x, row);
    const double* vy = line(state.velocity_y, row);
    const double* e = line(state.energy, row);
    const double* vx_above = line(state.velocity_x, row + 1);
    const double* vx_below = line(state.velocity_x, row - 1);
    const double* vy_above = line(state.velocity_y, row + 1);
    const double* vy_below = line(state.velocity_y, row - 1);
    const double* e_above = line(state.energy, row + 1);
    const double* e_below = line(state.energy, row - 1);
    const double* density = line(node_density_, row);
    const double* pxx0 = line(pressure_xx_, row - 1);
    const double* pxx1 = line(pressure_xx_, row);
    const double* pyy0 = line(pressure_yy_, row - 1);
    const double* pyy1 = line(pressure_yy_, row);
    const double* pxy0 = line(pressure_xy_, row - 1);
    const double* pxy1 = line(pressure_xy_, row);
    const double* qx0 = line(heat_x_, row - 1);
    const double* qx1 = line(heat_x_, row);
    const double* qy0 = line(heat_y_, row - 1);
    const double* qy1 = line(heat_y_, row);
    const double* work0 = line(work_, row - 1);
    const double* work1 = line(work_, row);
    double* rate_vx = &rate_.velocity_x[at(0, row)];
    double* rate_vy = &rate_.velocity_y[at(0, row)];
    double* rate_e = &rate_.energy[at(0, row)];
#pragma omp simd
    for (int i = first_inner_; i <= last_inner_; ++i) {
      const double specific = 1.0 / density[i];
      const double x = vx[i] * over_x;
      const double y = vy[i] * over_y;
      rate_vx[i] = -(x * (vx[i + 1] - vx[i - 1]) + y * (vx_above[i] - vx_below[i])) -
                   specific * (slope_x(pxx0, pxx1, i - 1, over_x) + slope_y(pxy0, pxy1, i - 1, over_y));
      rate_vy[i] = -(x * (vy[i + 1] - vy[i - 1]) + y * (vy_above[i] - vy_below[i])) -
                   specific * (slope_x(pxy0, pxy1, i - 1, over_x) + slope_y(pyy0, pyy1, i - 1, over_y)) -
                   settings_.gravity;
      rate_e[i] = -(x * (e[i + 1] - e[i - 1]) + y * (e_above[i] - e_below[i])) -
                  specific * (mean_of_four(work0, work1, i - 1) + slope_x(qx0, qx1, i - 1, over_x) +
                              slope_y(qy0, qy1, i - 1, over_y));
    }
  }

  // flow_x: through the left face of a cell; flow_y: through its lower face. Nothing passes floor and ceiling, and
  // nothing passes side walls, whose nodes are at rest.
  for (int row = 0; row < ny; ++row) {
    const double* density = &state.density[at(0, row)];
    const double* vx0 = &state.velocity_x[at(0, row)];
    const double* vx1 = &state.velocity_x[at(0, row + 1)];
    double* flow = &flow_x_[at(0, row)];
#pragma omp simd
    for (int i = 1; i <= nx + 1; ++i) flow[i] = over_x * 0.5 * (vx0[i] + vx1[i]) * (density[i - 1] + density[i]);
  }
  for (int row = 1; row < ny; ++row) {
    const double* below = &state.density[at(0, row - 1)];
    const double* above = &state.density[at(0, row)];
    const double* vy = &state.velocity_y[at(0, row)];
    double* flow = &flow_y_[at(0, row)];
#pragma omp simd
    for (int i = 1; i <= nx; ++i) flow[i] = over_y * 0.5 * (vy[i] + vy[i + 1]) * (below[i] + above[i]);
  }
  for (int row = 0; row < ny; ++row) {
    const double* across = &flow_x_[at(0, row)];
    const double* lower = &flow_y_[at(0, row)];
    const double* upper = &flow_y_[at(0, row + 1)];
    double* rate = &rate_.density[at(0, row)];
#pragma omp simd
    for (int i = 1; i <= nx; ++i) rate[i] = (across[i] - across[i + 1]) + (lower[i] - upper[i]);
  }
}

void Flow::find_rates_of(State& state) {
  std::visit([&](const auto& equation) { find_rates(equation, state); }, settings_.state);
}

void Flow::advance(double step) {
  struct Stage {
    double weight;  // of this rate in the sum
    double ahead;   // of the next stage, in steps
  };
  constexpr std::array<Stage, 4> stages = {{{1.0, 0.5}, {2.0, 0.5}, {2.0, 1.0}, {1.0, 0.0}}};
  for (std::size_t s = 0; s < stages.size(); ++s) {
    find_rates_of(s == 0 ? now_ : stage_);
    const double weighted = stages[s].weight * step / 6.0;
    const double ahead = stages[s].ahead * step;
    for (const auto column : columns) {
      const double* rate = (rate_.*column).data();
      double* now = (now_.*column).data();
      double* sum = (sum_.*column).data();
      double* next = (stage_.*column).data();
      const std::size_t count = (rate_.*column).size();
      const double* before = s == 0 ? now : sum;
#pragma omp simd
      for (std::size_t i = 0; i < count; ++i) {
        sum[i] = before[i] + weighted * rate[i];
        next[i] = now[i] + ahead * rate[i];
      }
    }
  }
  std::swap(now_, sum_);
  time_ += step;
  check(now_);
}

void Flow::check(const State& state) const {
  const auto refuse = [&](std::string_view what, double value, double x, double y) {
    throw RunFailed(
        fmt::format("at time {:.6g} the {} at x = {:.4g}, y = {:.4g} is {}, which must be above 0: the step is too "
                    "long (run.step), or the flow is too fast for so few cells (grid.cells)",
                    time_, what, x, y, value));
  };
  for (int row = 0; row < settings_.cells_y; ++row)
    for (int i = 1; i <= settings_.cells_x; ++i)
      if (const double density = state.density[at(i, row)]; !(density > 0.0) || !std::isfinite(density))
        refuse("density", density, column_x(i) + 0.5 * dx_, row_y(row) + 0.5 * dy_);
  std::visit(
      [&](const auto& equation) {
        for (int row = 1; row < settings_.cells_y; ++row)
          for (int i = first_inner_; i <= last_inner_; ++i) {
            const double temperature = equation.temperature(node_density_[at(i, row)], state.energy[at(i, row)]);
            if (!(temperature > 0.0) || !std::isfinite(temperature))
              refuse("temperature", temperature, column_x(i), row_y(row));
          }
      },
      settings_.state);
}

double Flow::node_density(int column, int row, const State& state) const {
  const int nx = settings_.cells_x;
  const int ny = settings_.cells_y;
  const bool walls = settings_.sides == Sides::walls;
  // Walls: the straight line through the two nearest means.
  const auto at_row = [&](int cell, int j) {
    const auto cell_density = [&](int k) { return state.density[at(cell, k)]; };
    if (j == 0) return 1.5 * cell_density(0) - 0.5 * cell_density(1);
    if (j == ny) return 1.5 * cell_density(ny - 1) - 0.5 * cell_density(ny - 2);
    return 0.5 * (cell_density(j - 1) + cell_density(j));
  };
  if (walls && column == 1) return 1.5 * at_row(1, row) - 0.5 * at_row(2, row);
  if (walls && column == nx + 1) return 1.5 * at_row(nx, row) - 0.5 * at_row(nx - 1, row);
  const int right = column > nx ? 1 : column;
  const int left = right == 1 ? nx : right - 1;
  return 0.5 * (at_row(left, row) + at_row(right, row));
}

double Flow::mass() const {
  double sum = 0.0;
  for (int row = 0; row < settings_.cells_y; ++row)
    for (int i = 1; i <= settings_.cells_x; ++i) sum += now_.density[at(i, row)];
  return sum * dx_ * dy_;
}

double Flow::kinetic_energy() const {
  double sum = 0.0;
  for (int row = 1; row < settings_.cells_y; ++row)
    for (int i = first_inner_; i <= last_inner_; ++i) {
      const double vx = now_.velocity_x[at(i, row)];
      const double vy = now_.velocity_y[at(i, row)];
      sum += 0.5 * node_density(i, row, now_) * (vx * vx + vy * vy);
    }
  return sum * dx_ * dy_ / mass();
}

double Flow::largest_speed() const {
  double largest = 0.0;
  for (std::size_t i = 0; i < now_.velocity_x.size(); ++i)
    largest = std::max(largest, std::hypot(now_.velocity_x[i], now_.velocity_y[i]));
  return largest;
}

double Flow::roll_amplitude() const {
  double sum = 0.0;
  double squares = 0.0;
  for (int row = 1; row < settings_.cells_y; ++row)
    for (int i = first_inner_; i <= last_inner_; ++i) {
      const double pattern = roll(i, row)[1];
      sum += pattern * now_.velocity_y[at(i, row)];
      squares += pattern * pattern;
    }
  return sum / squares;
}

Flow::Nusselt Flow::nusselt() const {
  const Fields field = fields();
  const auto per_row = static_cast<int>(field.x.size());
  const int ny = settings_.cells_y;
  const auto place = [&](int column, int row) {
    return static_cast<std::size_t>(row) * field.x.size() + static_cast<std::size_t>(column);
  };
  // k dT/dn into the fluid at a wall node, whose two neighbours inwards are one and two spacings away.
  const auto inwards = [&](std::size_t wall, std::size_t next, std::size_t second, double spacing) {
    const double slope =
        (3.0 * field.temperature[wall] - 4.0 * field.temperature[next] + field.temperature[second]) / (2.0 * spacing);
    return slope * settings_.conductivity * (settings_.transport == Transport::kinematic ? field.density[wall] : 1.0);
  };
  const auto end_weight = [](int i, int last) { return i == 0 || i == last ? 0.5 : 1.0; };
  Nusselt nusselt;
  for (int i = 0; i < per_row; ++i) {
    const double part = end_weight(i, per_row - 1) * dx_;
    nusselt.hot += part * inwards(place(i, 0), place(i, 1), place(i, 2), dy_);
    nusselt.cold -= part * inwards(place(i, ny), place(i, ny - 1), place(i, ny - 2), dy_);
  }
  if (settings_.sides == Sides::walls)
    for (int row = 0; row <= ny; ++row)
      nusselt.sides += end_weight(row, ny) * dy_ *
                       (inwards(place(0, row), place(1, row), place(2, row), dx_) +
                        inwards(place(per_row - 1, row), place(per_row - 2, row), place(per_row - 3, row), dx_));
  const double at_rest = settings_.conductivity * (settings_.hot - settings_.cold) * settings_.width / settings_.height;
  nusselt.hot /= at_rest;
  nusselt.cold /= at_rest;
  nusselt.sides /= at_rest;
  return nusselt;
}

Flow::Fields Flow::fields() const {
  const int nx = settings_.cells_x;
  const int ny = settings_.cells_y;
  const bool walls = settings_.sides == Sides::walls;
  Fields fields;
  for (int column = 1; column <= nx + 1; ++column) fields.x.push_back(column_x(column));
  for (int row = 0; row <= ny; ++row) fields.y.push_back(row_y(row));
  for (int row = 0; row <= ny; ++row) {
    for (int column = 1; column <= nx + 1; ++column) {
      const bool wall = row == 0 || row == ny || (walls && (column == 1 || column == nx + 1));
      const std::size_t node = at(column > last_node_ ? 1 : column, row);
      const double density = node_density(column, row, now_);
      fields.density.push_back(density);
      fields.velocity_x.push_back(wall ? 0.0 : now_.velocity_x[node]);
      fields.velocity_y.push_back(wall ? 0.0 : now_.velocity_y[node]);
      fields.temperature.push_back(
          wall ? wall_temperature(row)
               : std::visit([&](const auto& equation) { return equation.temperature(density, now_.energy[node]); },
                            settings_.state));
    }
  }
  return fields;
}

std::vector<double> Flow::cell_densities() const {
  std::vector<double> densities;
  for (int row = 0; row < settings_.cells_y; ++row)
    for (int i = 1; i <= settings_.cells_x; ++i) densities.push_back(now_.density[at(i, row)]);
  return densities;
}

void Flow::save(ArchiveWriter& archive) const {
  archive.put(time_);
  for (const auto column : columns) archive.put_sequence(now_.*column);
}

void Flow::load(ArchiveReader& archive) {
  time_ = archive.get<double>();
  for (const auto column : columns) {
    const std::size_t expected = (now_.*column).size();
    archive.get_sequence(now_.*column);
    if ((now_.*column).size() != expected) throw RunFailed("a saved state is of another grid");
  }
}

}  // namespace lucy::grid
