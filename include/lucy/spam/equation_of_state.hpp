// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Equations of state, one small type each, in reduced units (m = k = 1): pressure and temperature of density rho and
// internal energy per mass e (of one particle, T = double, or of eight, T = pairs::Lanes), and the energy at a
// temperature. In two dimensions a pressure is force per length.
//
//     isentropic      P = (P0/2) (rho/rho0)^2     a two-dimensional ideal gas at constant entropy, where it starts with
//                                                 e = P0 rho/(2 rho0^2); P needs no e, and there is no temperature
//     ideal gas       P = rho e                   e = kT
//     van der Waals   P = rho kT/(1 - b rho) - a rho^2     e = kT - a rho, a = b = 1/2
//     dense fluid     fitted to molecular dynamics near rho = 1, kT = 1, with dn = rho - 1, du = e - 1.443 and
//                     dT = kT - 1:
//                     P/rho = 5 + 8 dn + 2.5 du + 9 dn^2 + 2 dn du
//                     kT    = 1 - dn + 0.7 du - 0.8 dn^2 - 0.5 dn du
//                     e     = 1.443 + 1.5 dn + 1.5 dT + 2.4 dn^2 + 1.2 dn dT
//
// (O. Kum, W. G. Hoover and H. A. Posch, Phys. Rev. E 52, 4899 (1995), Sec. IV.) The three polynomials of the dense
// fluid are as published: kT(rho, e) and e(rho, kT) are each other's inverses near the middle only, and the two are not
// thermodynamically consistent with P; so it has no entropy.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <variant>

#include "lucy/errors.hpp"

namespace lucy::spam {

/// P = (P0/2)(rho/rho0)^2, of the density alone.
class Isentropic {
 public:
  static constexpr bool has_temperature = false;
  static constexpr bool has_entropy = false;

  /// P0 and rho0 are powers of two, so that P/(rho rho) is exactly P0/(2 rho0^2) for every density.
  /// Throws BadInput otherwise.
  explicit Isentropic(double pressure = 1.0, double density = 1.0) : half_pressure_(0.5 * pressure), density_(density) {
    const auto power_of_two = [](double x) {
      int exponent = 0;
      return x > 0.0 && std::isfinite(x) && std::frexp(x, &exponent) == 0.5;
    };
    if (!power_of_two(pressure)) throw BadInput(fmt::format("P0 = {} must be a power of two", pressure));
    if (!power_of_two(density)) throw BadInput(fmt::format("rho0 = {} must be a power of two", density));
  }

  template <class T>
  T pressure(const T& density, const T& /*energy*/ = 0.0) const {
    const T ratio = density / density_;
    return half_pressure_ * (ratio * ratio);
  }
  template <class T>
  T temperature(const T& /*density*/, const T& /*energy*/) const {
    return 0.0;
  }
  /// Internal energy per mass: de = P/rho^2 drho, zero at zero density.
  double energy(double density, double /*temperature*/ = 0.0) const {
    return half_pressure_ * density / (density_ * density_);
  }

 private:
  double half_pressure_;
  double density_;
};

class IdealGas {
 public:
  static constexpr bool has_temperature = true;
  static constexpr bool has_entropy = true;

  template <class T>
  T pressure(const T& density, const T& energy) const {
    return density * energy;
  }
  template <class T>
  T temperature(const T& /*density*/, const T& energy) const {
    return energy;
  }
  double energy(double /*density*/, double temperature) const { return temperature; }
  /// Per mass, up to a constant.
  double entropy(double density, double energy) const { return std::log(energy / density); }
};

class VanDerWaals {
 public:
  static constexpr bool has_temperature = true;
  static constexpr bool has_entropy = true;
  static constexpr double attraction = 0.5;          ///< a
  static constexpr double excluded = 0.5;            ///< b
  static constexpr double densest = 1.0 / excluded;  ///< where the pressure diverges, to turn negative beyond

  /// Where dP/drho at constant temperature vanishes: colder, a uniform fluid is unstable.
  static constexpr double spinodal_temperature(double density) {
    const double free = 1.0 - excluded * density;
    return 2.0 * attraction * density * free * free;
  }

  template <class T>
  T pressure(const T& density, const T& energy) const {
    return density * temperature(density, energy) / (1.0 - excluded * density) - attraction * density * density;
  }
  template <class T>
  T temperature(const T& density, const T& energy) const {
    return energy + attraction * density;
  }
  double energy(double density, double temperature) const { return temperature - attraction * density; }
  /// Per mass, up to a constant: ds = (de + P d(1/rho))/T.
  double entropy(double density, double energy) const {
    return std::log(temperature(density, energy) * (1.0 - excluded * density) / density);
  }
};

class DenseFluid {
 public:
  static constexpr bool has_temperature = true;
  static constexpr bool has_entropy = false;

  template <class T>
  T pressure(const T& density, const T& energy) const {
    const T dn = density - 1.0;
    const T du = energy - middle_energy;
    return density * (5.0 + 8.0 * dn + 2.5 * du + 9.0 * dn * dn + 2.0 * dn * du);
  }
  template <class T>
  T temperature(const T& density, const T& energy) const {
    const T dn = density - 1.0;
    const T du = energy - middle_energy;
    return 1.0 - dn + 0.7 * du - 0.8 * dn * dn - 0.5 * dn * du;
  }
  double energy(double density, double temperature) const {
    const double dn = density - 1.0;
    const double dT = temperature - 1.0;
    return middle_energy + 1.5 * dn + 1.5 * dT + 2.4 * dn * dn + 1.2 * dn * dT;
  }

 private:
  static constexpr double middle_energy = 1.443;
};

using EquationOfState = std::variant<Isentropic, IdealGas, VanDerWaals, DenseFluid>;

enum class EquationOfStateName { isentropic, ideal_gas, van_der_waals, dense_fluid };
inline constexpr std::array<std::pair<std::string_view, EquationOfStateName>, 4> equation_of_state_names = {{
    {"isentropic", EquationOfStateName::isentropic},
    {"ideal-gas", EquationOfStateName::ideal_gas},
    {"van-der-waals", EquationOfStateName::van_der_waals},
    {"dense-fluid", EquationOfStateName::dense_fluid},
}};

inline EquationOfState make_equation_of_state(EquationOfStateName name) {
  switch (name) {
    case EquationOfStateName::isentropic:
      break;
    case EquationOfStateName::ideal_gas:
      return IdealGas();
    case EquationOfStateName::van_der_waals:
      return VanDerWaals();
    case EquationOfStateName::dense_fluid:
      return DenseFluid();
  }
  return Isentropic();
}

inline bool has_temperature(const EquationOfState& state) {
  return std::visit([](const auto& s) { return s.has_temperature; }, state);
}

/// The density that a fluid cannot reach: infinite but for van der Waals' particles of finite size.
inline double densest(const EquationOfState& state) {
  return std::holds_alternative<VanDerWaals>(state) ? VanDerWaals::densest : std::numeric_limits<double>::infinity();
}

}  // namespace lucy::spam
