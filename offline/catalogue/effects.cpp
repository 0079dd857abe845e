// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "catalogue/explanation.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {

std::span<const Explanation> effect_explanations() {
  static const std::vector<Explanation> all = [] {
    std::vector<Explanation> out;
    for (const EffectDescriptor* effect : effect_descriptors())
      out.push_back({effect->name, effect->explanation});
    return out;
  }();
  return all;
}

}  // namespace plumb::offline
