// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "programs/program.hpp"

namespace plumb::offline::programs {

/// Gives every target the tool and the frame of its moves, and leaves it the configuration if the
/// controller goes to it in one of them. Lists those whose moves disagree, and those that no move
/// goes to.
void settle(Program& program);

}  // namespace plumb::offline::programs
