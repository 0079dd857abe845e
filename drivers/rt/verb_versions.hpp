// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/program.hpp"

namespace plumb::drivers::rt {

/// The verbs that look at what is installed in a place.
void add_list(Program& program);
void add_verify(Program& program);

}  // namespace plumb::drivers::rt
