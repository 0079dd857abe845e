// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>

#include "plumb/runtime/detail/effect_library.hpp"
#include "plumb/runtime/detail/effect_set.hpp"

namespace plumb::tests {

/// What a law must be told in the cycle, with fallbacks.
inline std::vector<format::ContextNeed> needs_of(const EffectInfo& info) {
  using format::ContextInput;
  std::vector<format::ContextNeed> out;
  if ((info.needs & kNeedsDirection) != 0) out.push_back({ContextInput::kDirection, "", 1.0});
  if ((info.needs & kNeedsPayload) != 0) out.push_back({ContextInput::kPayload, "", 5.0});
  if ((info.needs & kNeedsTemperature) != 0)
    out.push_back({ContextInput::kTemperature, "temp_arm", 25.0});
  if ((info.needs & kNeedsTime) != 0) out.push_back({ContextInput::kTime, "", 60.0});
  if ((info.needs & kNeedsTravel) != 0) out.push_back({ContextInput::kTravel, "", 0.5});
  return out;
}

/// Of one sigma of the law's prior, repeated to as many as the law expects.
inline void fill_parameters(const EffectInfo& info, std::size_t count, format::Effect& out) {
  for (std::size_t i = 0; i < count; ++i) {
    const EffectParameter& p = info.parameters[i % info.parameters.size()];
    out.parameters.push_back(p.linear ? 0.5 * p.typical : p.start);
  }
}

/// The law's effect on the model's first `joints` joints, with typical numbers: an effect that
/// find_effect_fault has nothing to say about. Not for 'formula'; a joint table is of one joint.
inline format::Effect typical_effect(format::Model model, int law, int joints) {
  const EffectInfo& info = effect_info(law);
  format::Effect out;
  out.name = std::string(info.name);
  out.version = info.version;
  const int acted_on = info.name == "joint_table" ? 1 : joints;
  for (int i = 0; i < acted_on; ++i) out.joints.push_back(static_cast<std::uint8_t>(i));
  out.context = needs_of(info);
  for (int tries = 0; tries < 2; ++tries) {
    model.effects = {out};
    const EffectFault fault = find_effect_fault(model);
    if (fault.kind == EffectFault::Kind::kConstants) {
      out.constants.assign(fault.count, 1.0);
      if (info.name == "joint_series") out.constants.front() = 21.0;  // waves
    }
    if (fault.kind == EffectFault::Kind::kParameters) fill_parameters(info, fault.count, out);
  }
  return out;
}

/// Masses of a medium arm, so that what depends on loads moves.
inline void add_masses(format::Model& model) {
  for (std::size_t i = 0; i < model.nominal.joints.size(); ++i)
    model.mechanics.links.push_back({20.0 / (1.0 + static_cast<double>(i)), {0.05, -0.02, 0.1}});
  model.mechanics.payload_kg = 5.0;
  model.mechanics.payload_com_m = {0.0, 0.02, 0.1};
}

}  // namespace plumb::tests
