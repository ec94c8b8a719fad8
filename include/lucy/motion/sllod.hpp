// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SLLOD equations of motion for plane Couette flow u_x = rate y, with p the peculiar momentum and m = 1
// (Posch, Hoover and Kum, Phys. Rev. E 52, 1711 (1995), Sec. III):
//
//     x' = p_x + rate y     y' = p_y     p_x' = F_x - rate p_y - zeta p_x     p_y' = F_y - zeta p_y
//
// and the thermostat's friction zeta:
//
//     isoenergetic   zeta = -rate P_xy V / (2K)                  keeps E = Phi + K
//     isokinetic     zeta = (sum F.p - rate sum p_x p_y) / (2K)  keeps K
//     Nose-Hoover    zeta' = (K/K_0 - 1) / tau^2
//     none           zeta = 0
//
// with P_xy V = sum p_x p_y + sum_{i<j} x_ij F_y,ij. In all four, dE/dt = -rate P_xy V - 2 K zeta: work done by the
// flow less heat taken out. Its integral is carried along, so that the integrator's own error can be told from it.
#pragma once

#include <array>

#include "lucy/md/lucy_atoms.hpp"
#include "lucy/measure/kinetic.hpp"
#include "lucy/motion/runge_kutta.hpp"
#include "lucy/motion/settings.hpp"

namespace lucy::motion {

/// How the flow is driven and kept warm: strain rate in inverse time, tau in time, K_0 in energy (of all particles;
/// 0: that of the start).
struct Shear {
  double strain_rate = 0.0;
  Thermostat thermostat = Thermostat::isoenergetic;
  double relaxation_time = 1.0;        ///< tau of Nose-Hoover
  double target_kinetic_energy = 0.0;  ///< K_0 of isokinetic and Nose-Hoover
};

/// Numbers integrated beside the particles.
enum SllodNumber : std::size_t { nose_hoover_friction = 0, energy_input = 1 };
inline constexpr std::size_t sllod_numbers = 2;

struct SllodFriction {
  double zeta = 0.0;
  double zeta_rate = 0.0;    ///< of Nose-Hoover
  double energy_rate = 0.0;  ///< dE/dt
};

/// `virial_xy`: sum_{i<j} x_ij F_y,ij. `carried_zeta`: the Nose-Hoover variable.
template <int D>
SllodFriction sllod_friction(const Shear& shear, const measure::KineticSums<D>& kinetic, double virial_xy,
                             double carried_zeta) {
  const double twice_kinetic = kinetic.momentum_flux.trace();
  const double stress = kinetic.momentum_flux(0, 1) + virial_xy;  // P_xy V
  SllodFriction friction;
  switch (shear.thermostat) {
    case Thermostat::isoenergetic:
      friction.zeta = -shear.strain_rate * stress / twice_kinetic;
      break;
    case Thermostat::isokinetic:
      friction.zeta = (kinetic.force_power - shear.strain_rate * kinetic.momentum_flux(0, 1)) / twice_kinetic;
      break;
    case Thermostat::nose_hoover:
      friction.zeta = carried_zeta;
      friction.zeta_rate =
          (0.5 * twice_kinetic / shear.target_kinetic_energy - 1.0) / (shear.relaxation_time * shear.relaxation_time);
      break;
    case Thermostat::none:
      break;
  }
  friction.energy_rate = -shear.strain_rate * stress - twice_kinetic * friction.zeta;
  return friction;
}

/// Rates of `count` particles from slot `begin` on: columns 0 .. D-1 positions, D .. 2D-1 peculiar momenta.
template <int D>
void sllod_rate(const space::Columns& at, const space::Columns& force, double strain_rate, double zeta,
                std::size_t begin, std::size_t count, ChunkRates<2 * D>& k) {
  for (int d = 0; d < D; ++d) {
    const double* const p = at[D + d] + begin;
    const double* const f = force[d] + begin;
    for (std::size_t i = 0; i < count; ++i) k[d][i] = p[i];
    for (std::size_t i = 0; i < count; ++i) k[D + d][i] = std::fma(-zeta, p[i], f[i]);
  }
  const double* const y = at[1] + begin;
  const double* const p_y = at[D + 1] + begin;
  for (std::size_t i = 0; i < count; ++i) k[0][i] = std::fma(strain_rate, y[i], k[0][i]);
  for (std::size_t i = 0; i < count; ++i) k[D][i] = std::fma(-strain_rate, p_y[i], k[D][i]);
}

}  // namespace lucy::motion
