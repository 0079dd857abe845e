// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "check/interpretation.hpp"

namespace plumb::offline {

/// RMS residual [m] with the frame as the cell gives it and only the target fitted (or given too).
double misfit_in_given_frame(const Cell& cell, const Measurements& measured,
                             const std::vector<int>& rows);

/// The frame that the cell gives is contradicted by points that the nominal arm explains in another
/// one, to less than 1 % of the size of their cloud and ten times better (E-CHECK-FRAME, with how
/// the two differ). Nothing where the frame is fitted, or where there are several set-ups.
std::optional<Problem> given_frame_fault(const Cell& cell, const Measurements& measured,
                                         const std::vector<int>& rows);

/// The interpretation `best`, found with a free frame, made to agree with the frame of the cell:
/// which axes are mirrored, and whether the frame is the inverse. Unchanged unless one of these
/// leaves less than a tenth of the frame as given.
Convention with_given_frame(const Cell& cell, const Measurements& measured,
                            const std::vector<int>& rows, const Convention& labels,
                            const Interpretation& best);

}  // namespace plumb::offline
