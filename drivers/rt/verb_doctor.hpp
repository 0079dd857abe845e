// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/program.hpp"

namespace plumb::drivers::rt {

/// doctor: what this machine grants a real-time cycle, what it denies, why, and what to do about
/// it. Exit code 0 when it could look, whatever it saw; with --strict 5 when the machine is not
/// fit.
void add_doctor(Program& program);

}  // namespace plumb::drivers::rt
