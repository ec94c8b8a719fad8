// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The continuum between a hot floor and a cold ceiling: a compressible, viscous, conducting fluid in two dimensions on
// a staggered grid, against which smooth particles are judged.
//
//     d rho/dt = -div (rho v)
//     rho dv/dt = -rho (v.grad) v - div P + rho g
//     rho de/dt = -rho v.grad e - P : grad v - div Q
//     P = P_eq I - eta (grad v + grad v^T - (div v) I)     Q = -k grad T
//
// (O. Kum, W. G. Hoover and H. A. Posch, Phys. Rev. E 52, 4899 (1995), Sec. V; D = 2, no bulk viscosity.) Velocity v
// and energy e stand at the nodes, density rho, pressure tensor P and heat flux Q at the centres of the cells between
// them. All differences are centred, second order in the spacing; what is needed at the other place is the mean of the
// four neighbours. Mass flows through the faces of cells, so that it is conserved to rounding. Momentum and energy are
// not in conservation form: how well the energy balances is one more measure of the error of the grid.
//
//     y                                    rows of nodes j = 0 ... cells_y: floor and ceiling are the first and last
//     ^   v,e --- v,e --- v,e              rows of cells j = 0 ... cells_y - 1: above the row of nodes j
//     |    |  rho  |  rho  |               periodic: cells_x nodes to a row; walls: cells_x + 1, side walls among them
//     |   v,e --- v,e --- v,e  --> x
//
// Walls are at rest. Floor and ceiling have one temperature each, side walls the straight line between the two. x runs
// from -width/2 to width/2, y from -height/2 to height/2. Reduced units m = k = 1; pressures are force per length.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "lucy/archive.hpp"
#include "lucy/spam/equation_of_state.hpp"

namespace lucy::grid {

enum class Sides { periodic, walls };
inline constexpr std::array<std::pair<std::string_view, Sides>, 2> sides_names = {
    {{"periodic", Sides::periodic}, {"walls", Sides::walls}}};

/// What is constant: eta and k, or eta/rho and k/rho.
enum class Transport { dynamic, kinematic };
inline constexpr std::array<std::pair<std::string_view, Transport>, 2> transport_names = {
    {{"dynamic", Transport::dynamic}, {"kinematic", Transport::kinematic}}};

struct Settings {
  double height = 50.0;
  double width = 100.0;
  int cells_x = 40;  ///< at least 4
  int cells_y = 20;  ///< at least 4
  Sides sides = Sides::periodic;
  double hot = 1.5;   ///< kT of the floor
  double cold = 0.5;  ///< kT of the ceiling
  spam::EquationOfState state = spam::IdealGas();
  Transport transport = Transport::dynamic;
  double viscosity = 1.0;     ///< eta, or eta/rho
  double conductivity = 1.0;  ///< k, or k/rho
  double gravity = 0.02;      ///< towards the floor
};

/// Energy per mass at a density and a temperature, by T(rho, e), which is linear in e for every equation of state here.
/// (The published e(rho, T) of the dense fluid is not its inverse.)
double energy_at(const spam::EquationOfState& state, double density, double temperature);

/// The sound speed of density rho and energy e: c^2 = (dP/drho)_e + (P/rho^2) (dP/de)_rho.
double sound_speed(const spam::EquationOfState& state, double density, double energy);

/// The longest step that is surely stable: of the fourth-order Runge-Kutta method for waves of sound and diffusion
/// about the fluid at rest with density 1: inside the ellipse of half axes 2.6 that fits into the method's region of
/// stability, with 2 c/d for sound and 4 D/d^2 for diffusion at the spacing d.
double longest_step(const Settings& settings);

/// Everything that changes, as rows of `stride` numbers with one column of images at either end. Column 1 is the first
/// node of a row, and the first cell.
struct State {
  std::vector<double> density;     ///< rows of cells
  std::vector<double> velocity_x;  ///< rows of nodes, as the next two
  std::vector<double> velocity_y;
  std::vector<double> energy;
};

/// The rolls at the start with amplitude 1, at x in [-1/2, 1/2] widths and y in [-1/2, 1/2] heights: two between
/// periodic sides, v_x = sin(2 pi x) sin(2 pi y) and v_y = cos(2 pi x) cos(pi y); one between side walls, v_x = cos(pi
/// x) sin(2 pi y) and v_y = -sin(2 pi x) cos(pi y).
std::array<double, 2> roll_pattern(Sides sides, double x, double y);

class Flow {
 public:
  /// At rest with density 1, T falling linearly from floor to ceiling.
  explicit Flow(const Settings& settings);

  /// Those of roll_pattern().
  void set_rolls(double amplitude);

  /// One step of the classic Runge-Kutta method. Throws RunFailed naming time, node and likely cause when a density or
  /// a temperature is no longer positive or no longer a number; the state is then useless.
  void advance(double step);

  double time() const { return time_; }
  int nodes_x() const { return last_node_; }  ///< distinct nodes in a row
  const Settings& settings() const { return settings_; }

  double mass() const;  ///< width times height at the start
  /// Of the flow, per mass: the sum of rho v^2/2 over the nodes, over the mass.
  double kinetic_energy() const;
  double largest_speed() const;
  /// Mean of v_y times its pattern at the start with A = 1: the amplitude of the rolls, as long as they are small.
  double roll_amplitude() const;

  /// Heat per time through the walls over that of the fluid at rest, k (hot - cold) width/height: into the fluid by the
  /// floor and by the side walls, out of it by the ceiling. One-sided differences of second order.
  struct Nusselt {
    double hot = 0.0;
    double cold = 0.0;
    double sides = 0.0;
  };
  Nusselt nusselt() const;

  /// Fields at all nodes, the walls included and for periodic sides the last column, which is the first; by rows from
  /// the floor up, nodes_in_row() to a row.
  struct Fields {
    std::vector<double> x;  ///< of the columns
    std::vector<double> y;  ///< of the rows
    std::vector<double> density;
    std::vector<double> velocity_x;
    std::vector<double> velocity_y;
    std::vector<double> temperature;
  };
  Fields fields() const;
  /// The density in the cells, by rows.
  std::vector<double> cell_densities() const;

  void save(ArchiveWriter& archive) const;
  void load(ArchiveReader& archive);

 private:
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * stride_ + static_cast<std::size_t>(column);
  }
  double column_x(int column) const;
  double row_y(int row) const;
  std::array<double, 2> roll(int column, int row) const;
  double wall_temperature(int row) const;
  double node_density(int column, int row, const State& at) const;
  void place_images(State& at) const;
  template <class StateEquation>
  void find_stress(const StateEquation& equation, State& at);
  template <class StateEquation>
  void find_rates(const StateEquation& equation, State& at);
  void find_rates_of(State& at);
  void check(const State& state) const;

  Settings settings_;
  double dx_;
  double dy_;
  int last_node_;    // column of the last distinct node of a row
  int first_inner_;  // columns of nodes that move
  int last_inner_;
  std::size_t stride_;
  double time_ = 0.0;
  State now_;
  State stage_;
  State sum_;
  State rate_;
  // Of the stage: at nodes, at cells, and mass flow through the faces of cells.
  std::vector<double> node_density_, temperature_;
  std::vector<double> pressure_xx_, pressure_yy_, pressure_xy_, heat_x_, heat_y_, work_;
  std::vector<double> flow_x_, flow_y_;
};

}  // namespace lucy::grid
