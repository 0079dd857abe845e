// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/program.hpp"

namespace plumb::drivers::rt {

/// The verbs that change what a place runs.
void add_install(Program& program);
void add_rollback(Program& program);

}  // namespace plumb::drivers::rt
