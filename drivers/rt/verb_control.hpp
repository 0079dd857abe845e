// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/program.hpp"

namespace plumb::drivers::rt {

/// status DIR, swap FILE --dir DIR, monitor DIR: requests to the plumb-rt that runs DIR.
void add_status(Program& program);
void add_swap(Program& program);
void add_monitor(Program& program);

}  // namespace plumb::drivers::rt
