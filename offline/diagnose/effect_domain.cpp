// SPDX-License-Identifier: Apache-2.0
#include "diagnose/effect_domain.hpp"

#include "effects/registry.hpp"

namespace plumb::offline {

std::string domain_word(const EffectEntry& entry) {
  switch (descriptor_of(entry.name).law->domain) {
    case EffectDomain::kRobot:
      return "robot";
    case EffectDomain::kEnvironment:
      return "environment";
    case EffectDomain::kProcedure:
      return "procedure";
    default:
      return "measurement";
  }
}

bool is_compiled(const EffectEntry& entry) {
  const EffectDomain domain = descriptor_of(entry.name).law->domain;
  return domain == EffectDomain::kRobot || domain == EffectDomain::kEnvironment;
}

}  // namespace plumb::offline
