// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a Green-Kubo point means in steps, samples and intervals; green_kubo_point.cpp decides, the run follows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "lucy/cases/green_kubo.hpp"
#include "lucy/cases/place_of.hpp"

namespace lucy::cases {

std::int64_t steps_per_sample(const GreenKuboPoint& point);
std::int64_t recorded_intervals(const GreenKuboPoint& point);
std::int64_t recorded_samples(const GreenKuboPoint& point);

/// The sheared time that is nearest to `preparation`: through a whole number of box lengths, so that the images stand
/// straight again.
double preparation_time(const GreenKuboPoint& point);
std::int64_t preparation_steps(const GreenKuboPoint& point);
std::int64_t preparation_intervals(const GreenKuboPoint& point);
std::int64_t equilibration_intervals(const GreenKuboPoint& point);

/// Place of a name in sampled_quantities; a wrong name does not compile.
consteval std::size_t sampled(std::string_view name) { return place_of(sampled_quantities, name); }

/// Whether a pair of the point names this quantity.
bool names_in_pairs(const GreenKuboPoint& point, std::string_view name);
bool needs_heat_flux(const GreenKuboPoint& point);

}  // namespace lucy::cases
