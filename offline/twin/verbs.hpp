// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/program.hpp"

namespace plumb::offline::twin {

void add_new(Program& program);
void add_measure(Program& program);
void add_run(Program& program);

}  // namespace plumb::offline::twin
