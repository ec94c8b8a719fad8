// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/cases/convection.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cases/refusals.hpp"

namespace lucy::cases {

namespace {

struct FluidFactors {
  double gravity;    // g L/(T_hot - T_cold) of a uniform fluid at rest
  double expansion;  // alpha C_V
};

FluidFactors factors_of(spam::EquationOfStateName fluid) {
  switch (fluid) {
    case spam::EquationOfStateName::van_der_waals:
      return {2.0, 2.0 / 3.0};
    case spam::EquationOfStateName::dense_fluid:
      return {3.75, 1.26 / 3.75};
    case spam::EquationOfStateName::isentropic:
    case spam::EquationOfStateName::ideal_gas:
      break;
  }
  return {1.0, 1.0};
}

}  // namespace

double width_of(const Convection& convection) {
  return convection.width.value_or(convection.sides == grid::Sides::periodic ? 2.0 * convection.height
                                                                             : convection.height);
}

void set_unset(Convection& convection) {
  const double difference = convection.hot - convection.cold;
  const FluidFactors factors = factors_of(convection.equation_of_state);
  convection.width = width_of(convection);
  if (!convection.gravity) convection.gravity = factors.gravity * difference / convection.height;
  const double drive = *convection.gravity * factors.expansion * std::pow(convection.height, 3) * difference;
  if (!convection.rayleigh) convection.rayleigh = drive / (*convection.viscosity * *convection.conductivity);
  if (!convection.viscosity) convection.viscosity = std::sqrt(drive / *convection.rayleigh);
  if (!convection.conductivity) convection.conductivity = convection.viscosity;
}

double diffusion_time(const Convection& convection) {
  Convection all = convection;
  set_unset(all);
  return all.height * all.height / *all.viscosity;
}

double heat_at_rest(const Convection& convection) {
  Convection all = convection;
  set_unset(all);
  return *all.conductivity * (all.hot - all.cold) * *all.width / all.height;
}

void validate(const Convection& convection, bool viscous) {
  refuse_unless_above_zero("cell.height", convection.height);
  refuse_unless_above_zero("cell.cold", convection.cold);
  if (!(convection.hot > convection.cold) || !std::isfinite(convection.hot))
    refuse(fmt::format("cell.hot = {} must be above cell.cold = {}", convection.hot, convection.cold));
  if (convection.width) refuse_unless_above_zero("cell.width", *convection.width);
  if (convection.gravity) refuse_unless_above_zero("cell.gravity", *convection.gravity);
  if (convection.rayleigh) {
    refuse_unless_above_zero("fluid.rayleigh", *convection.rayleigh);
    if (convection.viscosity || convection.conductivity)
      refuse(
          fmt::format("fluid.rayleigh = {} leaves nothing to fluid.viscosity and fluid.conductivity: give the one "
                      "or the other two",
                      *convection.rayleigh));
  } else if (!convection.viscosity || !convection.conductivity) {
    refuse("fluid.rayleigh is missing: give it, or both fluid.viscosity and fluid.conductivity");
  } else {
    if (viscous)
      refuse_unless_above_zero("fluid.viscosity", *convection.viscosity);
    else
      refuse_unless_at_least_zero("fluid.viscosity", *convection.viscosity);
    refuse_unless_above_zero("fluid.conductivity", *convection.conductivity);
  }
  if (convection.roll_velocity) refuse_unless_above_zero("start.roll_velocity", *convection.roll_velocity);
}

}  // namespace lucy::cases
