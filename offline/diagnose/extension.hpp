// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/regressor.hpp"

namespace plumb::offline {

/// The whitened fit as it would be with the regressor in the model, to first order: its columns
/// join U, and y loses what they explain. Of a series, which a prior holds, y loses the motion of
/// the sizes theta, and only its smooth part joins U. Cost: a pass over the poses, no refit.
WhitenedFit extended(const WhitenedFit& whitened, const Regressor& regressor,
                     const Eigen::VectorXd& theta);

}  // namespace plumb::offline
