// SPDX-License-Identifier: Apache-2.0
#include "rt/whole_number.hpp"

#include <fmt/format.h>

#include <cmath>

namespace plumb::drivers::rt {

void read_whole(TomlTable& table, const char* key, Range range, int& out) {
  const auto value = table.number(key);
  if (!value) return;
  if (*value != std::floor(*value) || *value < range.least || *value > range.most)
    return table.out_of_range(key,
                              fmt::format("a whole number, {} to {}", range.least, range.most));
  out = static_cast<int>(*value);
}

}  // namespace plumb::drivers::rt
