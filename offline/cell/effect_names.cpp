// SPDX-License-Identifier: Apache-2.0
#include "cell/cell.hpp"
#include "plumb/runtime/effect_library.hpp"

namespace plumb::offline {

const std::vector<std::string>& known_effects() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out{"geometry", "local_tree"};
    for (int law = 0; law < kEffectLaws; ++law) out.emplace_back(effect_info(law).name);
    return out;
  }();
  return names;
}

}  // namespace plumb::offline
