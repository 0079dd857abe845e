// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/found.hpp"

namespace plumb::offline {

/// One cause often acts at several joints at once: gears yield, links bend. Of every such effect,
/// the best joint with those others that the evidence supports beside it, as one candidate. Where a
/// law of another cause would explain more than the yielding of those joints, joints that move
/// little join as well, down to all that carry a load, if together they explain clearly more.
/// `library`: what was found joint by joint, best first. Cost: a few regressors an effect.
std::vector<Found> joint_groups(const Scorer& scorer, const std::vector<Found>& library);

}  // namespace plumb::offline
