// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/revision.hpp"

namespace plumb::offline {

/// A step may only imitate what follows no law: a joint that moves with a temperature looks like
/// one that has slipped. Where such a structure is left in the end, a step that was added is taken
/// out if, without it, structure of that same part is clearly ahead of it. It stays out.
extern const Revision kImitatingStep;

}  // namespace plumb::offline
