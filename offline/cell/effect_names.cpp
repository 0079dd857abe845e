// SPDX-License-Identifier: Apache-2.0
#include "cell/cell.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {

const std::vector<std::string>& known_effects() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const EffectDescriptor* effect : effect_descriptors()) out.emplace_back(effect->name);
    return out;
  }();
  return names;
}

}  // namespace plumb::offline
