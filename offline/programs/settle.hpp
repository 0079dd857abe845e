// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "programs/program.hpp"

namespace plumb::offline::programs {

/// Gives every target the tool and the frame of its moves. Lists those whose moves disagree, and
/// those that no move goes to.
void settle(Program& program);

/// Lists the targets of one program that another one moves to, with a tool and a frame that may be
/// others: those with the name of a target that is missing there.
void settle_between(Program& program, const Program& other);

}  // namespace plumb::offline::programs
