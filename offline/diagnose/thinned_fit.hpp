// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/whitened_fit.hpp"

namespace plumb::offline {

/// The whitened fit as `most` of its fit poses show it, evenly spread, with none held out for good.
WhitenedFit thinned(const WhitenedFit& whitened, Eigen::Index most);

}  // namespace plumb::offline
