// SPDX-License-Identifier: Apache-2.0
#include "check/effect_rules.hpp"

#include <utility>

#include "effects/registry.hpp"

namespace plumb::offline {

std::vector<Testable> testable_effects(const DataSense& sense) {
  std::vector<Testable> out;
  for (const EffectDescriptor* effect : effect_descriptors()) {
    if (effect->testable == nullptr) continue;
    Testability found = effect->testable(sense);
    const bool yes = found.answer == Testability::Answer::kYes;
    out.push_back({found.answer, std::string(effect->name), std::move(found.why),
                   yes ? "" : effect->measure});
  }
  return out;
}

}  // namespace plumb::offline
