// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/isomorphism_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "lucy/files/table_text.hpp"
#include "text_layout.hpp"

namespace lucy::files {

namespace {

using cases::isomorphism_quantity;
using cases::IsomorphismRow;

/// One line of the table: a quantity of the atoms, and what the continuum makes of it.
struct Pairing {
  std::string_view atoms_name;  ///< empty: only the continuum knows it
  std::optional<std::size_t> atoms;
  std::size_t smooth;
  std::string_view smooth_name;
};

constexpr std::array<Pairing, 14> pairings = {{
    {"potential energy Phi/N", isomorphism_quantity("atoms_potential_energy"),
     isomorphism_quantity("smooth_internal_energy"), "internal energy e"},
    {"kinetic energy K/N", isomorphism_quantity("atoms_kinetic_energy"), isomorphism_quantity("smooth_kinetic_energy"),
     "kinetic energy of the particles"},
    {"", std::nullopt, isomorphism_quantity("smooth_kinetic_energy_of_field"), "  of it in the smoothed velocity"},
    {"energy E/N", isomorphism_quantity("atoms_energy"), isomorphism_quantity("smooth_energy"), "sum of both"},
    {"pressure, kinetic", isomorphism_quantity("atoms_pressure_kinetic"),
     isomorphism_quantity("smooth_pressure_reynolds"), "Reynolds stress, isotropic part"},
    {"pressure, potential", isomorphism_quantity("atoms_pressure_potential"),
     isomorphism_quantity("smooth_pressure_tensor"), "SPAM pressure tensor, isotropic part"},
    {"", std::nullopt, isomorphism_quantity("smooth_pressure_fluid"), "  by the equation of state"},
    {"P_xy, kinetic", isomorphism_quantity("atoms_pxy_kinetic"), isomorphism_quantity("smooth_pxy_reynolds"),
     "Reynolds stress"},
    {"", std::nullopt, isomorphism_quantity("smooth_pxy_reynolds_of_field"), "  of it in the smoothed velocity"},
    {"P_xy, potential", isomorphism_quantity("atoms_pxy_potential"), isomorphism_quantity("smooth_pxy_tensor"),
     "SPAM pressure tensor"},
    {"viscosity, kinetic", isomorphism_quantity("atoms_viscosity_kinetic"),
     isomorphism_quantity("smooth_viscosity_reynolds"), "by the Reynolds stress"},
    {"", std::nullopt, isomorphism_quantity("smooth_viscosity_reynolds_of_field"), "  of it in the smoothed velocity"},
    {"viscosity, potential", isomorphism_quantity("atoms_viscosity_potential"),
     isomorphism_quantity("smooth_viscosity_tensor"), "by the SPAM pressure tensor"},
    {"viscosity", isomorphism_quantity("atoms_viscosity"), isomorphism_quantity("smooth_viscosity"), "sum of both"},
}};

std::string label(const IsomorphismRow& row) {
  return fmt::format("{}, rate {}", state_text(row.particles, row.energy_per_particle), format_plain(row.strain_rate));
}

std::string means(const IsomorphismRow& row) {
  const auto text_of = [&](std::size_t quantity) {
    const auto& estimate = row.estimates[quantity];
    const bool conserved =
        quantity == isomorphism_quantity("atoms_energy") || quantity == isomorphism_quantity("smooth_energy");
    // But for the drift of the integrator it is known to all digits.
    if (conserved && !(estimate.error > 0.0)) return format_plain(estimate.value, 7);
    return format_with_error(estimate.value, estimate.error);
  };
  TextTable table({"atoms", "", "", "smooth particles"}, 1);
  for (const Pairing& pairing : pairings) {
    if (std::isnan(row.estimates[pairing.smooth].value)) continue;  // viscosities at rest
    table.add({std::string(pairing.atoms_name), pairing.atoms ? text_of(*pairing.atoms) : "", text_of(pairing.smooth),
               std::string(pairing.smooth_name)});
    if (pairing.smooth == isomorphism_quantity("smooth_internal_energy"))
      table.add({"", "", format_plain(row.estimates[pairing.smooth].value - row.estimates[*pairing.atoms].value, 5),
                 "  of it the self term"});
  }
  return table.text();
}

std::string explanation(std::span<const IsomorphismRow> rows) {
  const auto any = [&](cases::RowStatus status) {
    return std::ranges::any_of(rows,
                               [&](const IsomorphismRow& row) { return row.status == status && !row.difference; });
  };
  std::string text;
  if (any(cases::RowStatus::ok) || any(cases::RowStatus::too_short)) {
    text += wrapped("",
                    "Reduced units. In parentheses one standard error, in units of the last digits: blocking of each "
                    "replica's series, pooled over replicas; with Student's factor where there are fewer than ten "
                    "degrees of freedom.");
    text += wrapped("self term: ",
                    "w(0)/2 in e_i = P0 rho_i/(2 rho0^2), since a density counts its own particle; a potential does "
                    "not.");
    text += wrapped("Reynolds stress: ", "sum_i m v_i v_i/V, v_i the peculiar velocities of the particles.");
    text += wrapped("smoothed velocity: ",
                    "u_i = sum_j v_j w_ij/rho_i, its own particle counted; it makes up "
                    "sum_i m u_i u_i/V of the stress.");
    text += wrapped("SPAM pressure tensor: ", "sum_{i<j} r_ij F_ij/V, F_ij by the P/rho^2 of both particles.");
    text += wrapped("equation of state: ", "sum_i m P_i/(rho_i V).");
    text += wrapped("viscosity: ", "-P_xy/rate.");
  }
  if (any(cases::RowStatus::too_short))
    text +=
        wrapped("(nan): ", "too short for an error bar; or sheared without a thermostat, which never becomes steady.");
  return text;
}

}  // namespace

std::string isomorphism_verdict(const IsomorphismRow& row) {
  const std::string prefix = label(row) + ": ";
  if (row.status == cases::RowStatus::failed)
    return wrapped(prefix, row.failure.empty() ? "failed" : "failed: " + row.failure);
  if (row.difference) {
    const cases::Difference& difference = *row.difference;
    const std::string when =
        difference.step == 0 ? "at the start"
                             : fmt::format("after step {} (time {})", difference.step, format_plain(difference.time));
    const std::string where = difference.particle >= 0 ? fmt::format("{} of particle {} (counted from 0)",
                                                                     difference.component_name(), difference.particle)
                                                       : fmt::format("the {}", difference.component_name());
    const std::string replica = row.replicas > 1 ? fmt::format("in replica {}, ", row.differing_replica + 1) : "";
    return wrapped(prefix, fmt::format("not identical: {}{}, {} is {:.17g} of the atoms and {:.17g} of the smooth "
                                       "particles",
                                       replica, when, where, difference.atoms, difference.smooth));
  }
  return wrapped(prefix,
                 fmt::format("identical in every bit: {} steps x {} particles{}, {} comparisons of positions, "
                             "momenta and forces, and of their sums",
                             row.steps, row.particles,
                             row.replicas > 1 ? fmt::format(" in {} replicas", row.replicas) : "", row.comparisons));
}

std::string format_isomorphism(std::span<const IsomorphismRow> rows) {
  std::vector<std::string> parts;
  for (const IsomorphismRow& row : rows) {
    parts.push_back(isomorphism_verdict(row));
    if (row.status != cases::RowStatus::failed && !row.difference) parts.push_back(means(row));
  }
  if (std::string text = explanation(rows); !text.empty()) parts.push_back(std::move(text));
  return fmt::format("{}", fmt::join(parts, "\n"));
}

}  // namespace lucy::files
