// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "plumb/format/model.hpp"

namespace plumb::offline {

/// One way in which a controller may couple joints, in the order of (joint, by).
using Couplings = std::vector<format::JointCoupling>;

/// Couplings that controllers have: of any two joints that turn, by the whole angle, half of it or
/// twice; of three neighbours in every way by the whole angle (hollow wrists); and of two pairs of
/// neighbours.
std::vector<Couplings> plausible_couplings(const format::Chain& arm);

/// Only those of a joint with the one ahead of it, by the whole angle.
std::vector<Couplings> neighbour_couplings(const format::Chain& arm);

/// The same coupling where some joints count the other way: S K S, S being the signs.
Couplings reversed_couplings(Couplings all, const std::vector<bool>& reversed);

}  // namespace plumb::offline
