// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/found.hpp"

namespace plumb::offline {

/// What a candidate may be instead where the cell states no mass of any link: a link that bends, or
/// the base. As candidates these laws know the loads that are stated, so that a joint under unknown
/// weights (`gravity_free`), or anything else that changes with the pose, explains more than they
/// do, whichever of them it is. Here they stand under any weights as well: a law is linear in its
/// loads, so it is a sum of what it does under a unit of mass, and of first moment about each axis,
/// of every link. It is taken as equally soft in all directions. In the place of several joints
/// that yield two laws together, or one and a joint, are tried too.
///
/// @param first  A candidate of the library, or a pattern.
/// @return  Those within 10 nats of the best explanation, `first` among these, best first: of each
///          law the link that explains most. Two laws together only where they explain more
///          than `first`. Their evidence is as far from that of `first` as it is
///          on the poses that are compared. Empty unless `first` depends on the pose alone and no
///          mass is stated. None can be added: their numbers are products of compliances and
///          weights.
/// Cost: 4 motions of each law a link, on 1,000 poses at most.
std::vector<Found> rivals_under_unknown_weights(const WhitenedFit& whitened, const Found& first);

}  // namespace plumb::offline
