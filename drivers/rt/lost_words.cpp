// SPDX-License-Identifier: Apache-2.0
#include "rt/lost_words.hpp"

namespace plumb::drivers::rt {

std::vector<const char*> lost_words(Lost set) {
  std::vector<const char*> out;
  for (int i = 0; i < kLostBits; ++i) {
    const auto one = static_cast<Lost>(1U << static_cast<unsigned>(i));
    if (has(set, one)) out.push_back(to_string(one));
  }
  return out;
}

}  // namespace plumb::drivers::rt
