// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// Rows, one after another, that were written otherwise than the others (W-CHECK-ROWS, at most
/// three a file): with a joint that counts the other way, with joint angles or points in another
/// unit, or with points that belong to the joint positions one or two rows above or below.
///
/// An arm near nominal is fitted to a half, a third or a quarter of the file, whichever it fits.
/// Each explanation then predicts every row, and the run of rows is taken that it makes likelier by
/// most. The repaired rows are fitted with the others. Said only if they then fit like the others,
/// at least twenty times better than as they are, and three times better than by any other of these
/// explanations.
/// Silent for files of fewer than 30 rows, for several set-ups, and where `placed`, the state that
/// all rows were fitted by, leaves nothing to explain.
///
/// Cost: 1 us a row for sound files; else some 0.2 s and 50 us a row, of at most 20,000 a file.
std::vector<Problem> row_fault_findings(const Cell& cell, const MeasurementFiles& measured,
                                        const std::vector<int>& rows, const ArmState& placed);

}  // namespace plumb::offline
