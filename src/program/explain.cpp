// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "lucy/files/green_kubo_input.hpp"
#include "lucy/files/input.hpp"
#include "lucy/files/isomorphism_input.hpp"
#include "lucy/files/shear_flow_input.hpp"
#include "lucy/files/wave_input.hpp"
#include "program/commands.hpp"

namespace lucy::program {

int explain(const std::string& filter, InputKind kind) {
  switch (kind) {
    case InputKind::sweep:
      fmt::print("{}", files::explain_text(filter));
      break;
    case InputKind::green_kubo:
      fmt::print("{}", files::explain_green_kubo(filter));
      break;
    case InputKind::isomorphism:
      fmt::print("{}", files::explain_isomorphism(filter));
      break;
    case InputKind::shear_flow:
      fmt::print("{}", files::explain_shear_flow(filter));
      break;
    case InputKind::shear_wave:
      fmt::print("{}", files::explain_wave(cases::WaveQuantity::shear, filter));
      break;
    case InputKind::temperature_wave:
      fmt::print("{}", files::explain_wave(cases::WaveQuantity::temperature, filter));
      break;
  }
  return 0;
}

}  // namespace lucy::program
