// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A run of atoms that starts from a saved state instead of a lattice. The box, tilted or not, is the state's; its total
// momentum is taken out, and the peculiar momenta are scaled so that the energy is exactly the point's.
#pragma once

#include "lucy/cases/couette.hpp"
#include "lucy/motion/start.hpp"

namespace lucy::cases {

/// A frame as a start, as it is.
motion::Start<2> start_of(const Frame& frame);

/// The start of a point from its `start_frame`. Throws BadInput for what refuse_unfit_start() refuses.
motion::Start<2> state_start(const CouettePoint& point);

/// Refuses (BadInput, naming the key) a `start_frame` of another particle number or density, one without velocities, a
/// box below twice the range, more than one replica, and momenta that the energy would scale by more than a tenth.
void refuse_unfit_start(const CouettePoint& point);

/// Refuses (BadInput) a `start_frame` whose velocities hold a flow, though nobody has said so: where the slope of v_x
/// over y, by least squares, is beyond five of its standard errors. The flow of strain rate g in N particles of kT in a
/// box of height L is seen from about g L N^(1/2) = 17 (kT)^(1/2) on.
void refuse_flow_in_start(const CouettePoint& point);

}  // namespace lucy::cases
