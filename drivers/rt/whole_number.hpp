// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/toml_table.hpp"

namespace plumb::drivers::rt {

struct Range {
  int least, most;
};

/// A whole number within its range, if the key is there; else a problem of code RANGE, or nothing.
void read_whole(TomlTable& table, const char* key, Range range, int& out);

}  // namespace plumb::drivers::rt
