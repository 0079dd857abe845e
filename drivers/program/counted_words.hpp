// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace plumb {

/// "1 pose", "3 poses"; `many` may hold a verb: "1 reading misses", "3 readings miss".
inline std::string counted_words(long long n, std::string_view one, std::string_view many) {
  return std::to_string(n) + ' ' + std::string(n == 1 ? one : many);
}

}  // namespace plumb
