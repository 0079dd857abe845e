// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/regressor.hpp"

namespace plumb::offline {

/// The whitened fit as it would be with the regressor in the model, to first order: its columns
/// join U, and y loses what they explain. Cost: a pass over the poses, no refit.
WhitenedFit extended(const WhitenedFit& whitened, const Regressor& regressor);

}  // namespace plumb::offline
