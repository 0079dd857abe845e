// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/toml_table.hpp"

namespace plumb::drivers::rt {

struct Range {
  int least, most;
};

/// Reads a whole number into `out`. An absent key changes nothing; a number that is not whole or
/// out of range is reported (code RANGE) and changes nothing either.
void read_whole(TomlTable& table, const char* key, Range range, int& out);

}  // namespace plumb::drivers::rt
