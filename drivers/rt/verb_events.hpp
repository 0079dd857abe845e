// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/program.hpp"

namespace plumb::drivers::rt {

/// events DIR: what happened in the runs of a folder.
void add_events(Program& program);

}  // namespace plumb::drivers::rt
