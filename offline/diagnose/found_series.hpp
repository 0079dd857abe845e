// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "diagnose/scan.hpp"

namespace plumb::offline {

/// Whether the model has a series of waves at that joint.
bool has_series_at(const WhitenedFit& whitened, int joint);

/// One series of waves at every joint where, alone, it says more than any law of that joint does.
/// library: what it competes with; paid: ln of the number of regressors tried.
std::optional<Found> find_series(const Scorer& scorer, const std::vector<Found>& library,
                                 double paid);

}  // namespace plumb::offline
