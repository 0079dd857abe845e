// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/program.hpp"

namespace plumb::drivers::rt {

/// seal DIR: accepts an edited rt.toml by renewing its check sum.
void add_seal(Program& program);

}  // namespace plumb::drivers::rt
