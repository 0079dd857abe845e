// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/revision.hpp"

namespace plumb::offline {

/// One series of waves at all joints that turn and have none yet: many small waves, none of which
/// shows alone. Nothing unless the evidence of all joints together and the poses held out in folds
/// both support it. Single waves of these joints that the model has stay beside it.
///
/// @param look  The scan at this whitened fit: the price of the search is that of all it has tried.
std::optional<Found> series_of_all(const WhitenedFit& whitened, const Calibration& calibration,
                                   const Scan& look);

/// Adds it to the scan of a model in which nothing else is missing.
void add_series_of_all(const WhitenedFit& whitened, const Calibration& calibration,
                       const std::vector<std::string>& not_testable, Scan& look);

/// The same at the end of a selection, when no single cause is left to add.
extern const Revision kSeriesOfAll;

}  // namespace plumb::offline
