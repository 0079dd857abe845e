// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/whitened_fit.hpp"

namespace plumb::offline {

/// The whitened fit on at most `most` of its fit poses, evenly spread, without held-out poses.
WhitenedFit thinned(const WhitenedFit& whitened, Eigen::Index most);

}  // namespace plumb::offline
