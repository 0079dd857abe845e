// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/answer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace plumb::tests {

bool is_like(const HiddenCase::Answer& hidden, const offline::EffectEntry& entry) {
  // The last link under the payload is the tool that hangs.
  if (hidden.law == "tool_sag" && entry.name == "link_flexure")
    return entry.joints == std::vector<int>{5};
  return std::find(hidden.names.begin(), hidden.names.end(), entry.name) != hidden.names.end();
}

bool is_third_harmonic(const HiddenCase::Answer& hidden, const offline::EffectEntry& entry) {
  const bool gear = hidden.law == "gear_harmonics" || hidden.law == "encoder_eccentricity";
  return gear && entry.name == "gear_ripple" &&
         std::abs(std::get<double>(entry.options.at("cycles_per_turn")) - 3.0) < 0.4;
}

bool at_joint(const HiddenCase::Answer& hidden, const offline::EffectEntry& entry) {
  // Between elbow and wrist the DH frames part one forearm into two links.
  if (hidden.law == "link_flexure" && !entry.joints.empty())
    return std::abs(entry.joints.front() - hidden.joint) <= 1;
  if (hidden.also_joint >= 0 &&
      std::find(entry.joints.begin(), entry.joints.end(), hidden.also_joint) != entry.joints.end())
    return true;
  return hidden.joint < 0 || entry.joints.empty() || entry.joints.front() == hidden.joint ||
         std::find(entry.joints.begin(), entry.joints.end(), hidden.joint) != entry.joints.end();
}

bool is_related(const HiddenCase::Answer& hidden, const offline::EffectEntry& entry) {
  if (is_like(hidden, entry) || is_third_harmonic(hidden, entry)) return true;
  return hidden.joint >= 0 && !entry.joints.empty() && at_joint(hidden, entry);
}

}  // namespace plumb::tests
