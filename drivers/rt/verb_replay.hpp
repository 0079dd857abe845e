// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/program.hpp"

namespace plumb::drivers::rt {

/// replay FILE --dir DIR: runs a record through the same session, offline. Exit code 1 if its
/// output differs from the record.
void add_replay(Program& program);

}  // namespace plumb::drivers::rt
