// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/block.hpp"
#include "diagnose/trial.hpp"
#include "fit/error_stats.hpp"

namespace plumb::offline {

/// 3-D error on poses that had no say, to first order: the stage's held-out poses, or where there
/// are none, each fold by the others.
ErrorStats held_out_error(const Judge& judge);

/// The same with a block in the model.
ErrorStats held_out_error(const Judge& judge, const Block& block, const Trial& trial);

}  // namespace plumb::offline
