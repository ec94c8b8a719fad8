// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What smooth particles are made of: weight function, equation of state, transport laws and gravity, in reduced units.
//
//     P = P_eq(rho, e) I - eta (grad v + grad v^T - (2/D) (div v) I) - eta_bulk (div v) I       Newton
//     Q = - kappa grad T                                                                       Fourier
//
// (Kum, Hoover and Posch, Phys. Rev. E 52, 4899 (1995), Eqs. (3) and (4), where D = 2 and eta_bulk = 0.)
#pragma once

#include "lucy/kernel/weight.hpp"
#include "lucy/space/box.hpp"
#include "lucy/spam/equation_of_state.hpp"
#include "lucy/spam/gradients.hpp"

namespace lucy::spam {

inline constexpr std::array<std::pair<std::string_view, DensityMean>, 2> density_mean_names = {{
    {"geometric", DensityMean::geometric},
    {"arithmetic", DensityMean::arithmetic},
}};

struct Transport {
  double viscosity = 0.0;       ///< eta
  double bulk_viscosity = 0.0;  ///< eta_bulk
  double conductivity = 0.0;    ///< kappa

  bool none() const { return viscosity == 0.0 && bulk_viscosity == 0.0 && conductivity == 0.0; }
};

template <int D>
struct Fluid {
  kernel::Weight<D> weight;
  EquationOfState state;
  Transport transport;
  DensityMean mean = DensityMean::geometric;  ///< rho_ij of the gradients
  space::Vector<D> gravity{};

  /// Throws BadInput for negative coefficients, and for conduction in a fluid without temperature.
  void validate() const;
};

}  // namespace lucy::spam
