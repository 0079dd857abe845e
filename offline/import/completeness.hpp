// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "import/imported.hpp"

namespace plumb::offline {

/// What a calibration needs and the imported data lack: joint positions q1 to qN without a gap, and
/// at least one coordinate of the measured point. Says which unused columns may be meant, and gives
/// the --map for them. `joints`: the number of joints of the cell's arm, 0 if it is not known.
/// E-IMPORT-MISSING; nothing if the data are complete.
std::optional<Problem> missing_for_calibration(const Imported& data, int joints);

}  // namespace plumb::offline
