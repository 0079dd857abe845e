// SPDX-License-Identifier: Apache-2.0
#include "diagnose/refit.hpp"

#include <map>

#include "fit/arm_change.hpp"
#include "fit/effect_binding.hpp"

namespace plumb::offline {
namespace {

/// Numbers that the new list of effects shares with the old one stay: a better start.
void keep_values(const ArmState& old, ArmState& fresh) {
  std::map<std::string, double> values;
  for (const auto& p : effect_parameters(old.arm)) values[p.name] = value_of(old, p);
  for (const auto& p : effect_parameters(fresh.arm))
    if (const auto it = values.find(p.name); it != values.end())
      fresh.arm.effects[p.joint].parameters[p.component] = it->second;
}

}  // namespace

Calibration refitted(const Cell& cell, const Measurements& measured, const std::vector<int>& fit,
                     const std::vector<EffectEntry>& effects, const Calibration& from, Refit how) {
  Cell with = cell;
  with.effects = effects;
  ArmState start = from.state;
  start.arm.effects = bind_effects(with, measured);
  keep_values(from.state, start);
  return how == Refit::kFully ? calibrate_from(with, measured, fit, start)
                              : calibrate_near(with, measured, fit, start, from);
}

}  // namespace plumb::offline
