// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/program.hpp"

namespace plumb::drivers::rt {

/// replay FILE --dir DIR: a record through the same session, offline. Exit code 1 when it decides
/// otherwise than recorded.
void add_replay(Program& program);

}  // namespace plumb::drivers::rt
