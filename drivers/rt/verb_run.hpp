// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/program.hpp"

namespace plumb::drivers::rt {

/// run DIR: runs the cycle until SIGTERM. Exit codes: 0 ramped out and ended, 3 model or
/// configuration wrong, 5 the machine denies what is needed, 6 the bus was down for longer than
/// give_up_s.
void add_run(Program& program);

}  // namespace plumb::drivers::rt
