// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/program.hpp"

namespace plumb::drivers::rt {

/// doctor: what this machine grants a real-time cycle, what it denies, why, and what to do about
/// it. Exit code 0 if the checks could be made, whatever their results; with --strict 5 if the
/// machine is not fit.
void add_doctor(Program& program);

}  // namespace plumb::drivers::rt
