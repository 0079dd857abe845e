// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/block.hpp"

namespace plumb::offline {

/// The stage as it would be with the block in the model, to first order: its columns join U, and y
/// loses what they explain. Cost: a pass over the poses, no refit.
Stage extended(const Stage& stage, const Block& block);

}  // namespace plumb::offline
