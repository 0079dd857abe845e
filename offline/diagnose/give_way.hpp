// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/selection.hpp"

namespace plumb::offline {

/// A step may only imitate what follows no law: a joint that moves with a temperature looks like
/// one that has slipped. Where such a structure is left in the end, each step that was added is
/// taken out if, without it, structure of that same part is clearly ahead of it; true if one was.
/// It stays out.
bool step_gives_way(Selection& selection);

}  // namespace plumb::offline
